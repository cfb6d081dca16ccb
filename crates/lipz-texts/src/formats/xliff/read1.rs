//! Reading of XLIFF 1.0 to 1.2.

use super::read::{locale, start, unknown_markup};
use super::xml::{inner, whole};
use super::{CHARACTER, COMMENTS_EXPORTED, EXPORTED};
use crate::exchange::entry::{self, Entry, IncomingFile, ReadOptions, Words};
use crate::exchange::model::{State, joined};
use lipz_diagnostics::{Code, Diagnostic, bound};
use roxmltree::{Node, NodeType};
use std::sync::Arc;

/// Adds the entries of a file.
pub(super) fn read(root: Node<'_, '_>, options: &ReadOptions, incoming: &mut IncomingFile) {
    for file in root.children().filter(|node| node.tag_name().name() == "file") {
        let Some(locale) = locale(file, "target-language", options, &mut incoming.diagnostics) else { continue };
        for node in file.descendants().filter(|node| node.tag_name().name() == "trans-unit") {
            unit(node, &locale, incoming);
            bound::limit_many(&mut incoming.diagnostics);
        }
    }
}

fn unit(node: Node<'_, '_>, locale: &Arc<str>, incoming: &mut IncomingFile) {
    let Some(id) = node.attribute("resname").or_else(|| node.attribute("id")) else {
        incoming.diagnostics.push(Diagnostic::at(Code::ExchangeSyntax, start(node), "the trans-unit has no id"));
        return;
    };
    let child = |name: &str| node.children().find(|child| child.tag_name().name() == name);
    let Some(source) = child("source") else {
        incoming.diagnostics.push(Diagnostic::at(Code::ExchangeSyntax, start(node), "the trans-unit has no source"));
        return;
    };
    let source = Words { text: text(source, &mut incoming.diagnostics), span: inner(source) };
    let target = child("target");
    if let Some(beside) = target.and_then(beside_segments) {
        let message = "a text is outside the segments of its target, which are marked (`<mrk>`)";
        let help = "write it into a segment, or export with `--by segment` if your tool does not support `<mrk>`";
        incoming.diagnostics.push(Diagnostic::at(Code::ExchangeSyntax, whole(beside), message).help(help));
        return;
    }
    let words = match target {
        Some(target) => Words { text: text(target, &mut incoming.diagnostics), span: inner(target) },
        None => Words { text: String::new(), span: whole(node) },
    };
    let notes = || node.children().filter(|child| child.tag_name().name() == "note");
    let mark = |name: &str| {
        let mut marks = notes().filter_map(|note| note.text()?.strip_prefix(name)?.strip_prefix(": "));
        marks.next().and_then(|mark| mark.parse().ok())
    };
    // Tools do not always keep the author of a note, but they keep the texts of those by lipz.
    let is_own = |note: &Node<'_, '_>| note.attribute("from").is_some_and(|author| author != "lipz");
    let comments = notes().filter(is_own).filter_map(|note| note.text()).flat_map(str::lines).map(str::trim);
    let (key, segment) = entry::id(id);
    incoming.entries.push(Entry {
        key: Words { text: key.to_owned(), span: start(node) }.into(),
        segment,
        source: Some(source.into()),
        locale: Arc::clone(locale),
        state: if words.text.is_empty() { State::Initial } else { state(node, target) },
        says_state: node.has_attribute("approved") || target.is_some_and(|target| target.has_attribute("state")),
        text: words,
        mark: mark(EXPORTED),
        comments: comments.filter(|line| !line.is_empty()).map(str::to_owned).collect(),
        comments_mark: mark(COMMENTS_EXPORTED),
        ..Entry::default()
    });
}

fn state(unit: Node<'_, '_>, target: Option<Node<'_, '_>>) -> State {
    let is_approved = unit.attribute("approved") == Some("yes");
    match target.and_then(|target| target.attribute("state")).unwrap_or_default() {
        "new" => State::Initial,
        needs if needs.starts_with("needs-") => State::Initial,
        "final" => State::Final,
        "signed-off" => State::Reviewed,
        _ if is_approved => State::Reviewed,
        _ => State::Translated,
    }
}

fn is_segment(node: &Node<'_, '_>) -> bool {
    node.tag_name().name() == "mrk" && node.attribute("mtype") == Some("seg")
}

/// Returns text other than `|` between marked segments, which is inserted by tools without support for such marks.
fn beside_segments<'a, 'input>(target: Node<'a, 'input>) -> Option<Node<'a, 'input>> {
    let is_divider = |text: &str| text.chars().all(|c| c == '|' || c.is_whitespace());
    let mut beside = target.children().filter(|node| node.is_text() && !node.text().is_none_or(is_divider));
    if target.descendants().any(|node| is_segment(&node)) { beside.next() } else { None }
}

/// Returns the text of a source or target. If its segments are marked, the text between them is ignored.
fn text(node: Node<'_, '_>, diagnostics: &mut Vec<Diagnostic>) -> String {
    let mut segments: Vec<Node<'_, '_>> = node.descendants().filter(is_segment).collect();
    if segments.is_empty() {
        return content(node, diagnostics);
    }
    // Languages may order them differently, but each has its number.
    segments.sort_by_key(|segment| segment.attribute("mid").and_then(|mid| mid.parse::<usize>().ok()));
    joined(&segments.into_iter().map(|segment| content(segment, diagnostics)).collect::<Vec<_>>())
}

fn content(node: Node<'_, '_>, diagnostics: &mut Vec<Diagnostic>) -> String {
    let mut text = String::new();
    for node in node.descendants().skip(1) {
        match (node.node_type(), node.tag_name().name()) {
            (NodeType::Text, _) if is_character(node.parent()) => {
                let code = node.text().and_then(|code| u32::from_str_radix(code.strip_prefix("U+")?, 16).ok());
                text.extend(code.and_then(char::from_u32));
            }
            // The content of a placeholder is its text.
            (NodeType::Text, _) => text.push_str(node.text().unwrap_or_default()),
            (NodeType::Element, "x") => match node.attribute("equiv-text") {
                Some(placeholder) => text.push_str(placeholder),
                None => diagnostics.push(unknown_markup(node)),
            },
            (NodeType::Element, "ph" | "mrk" | "bpt" | "ept" | "it" | "g" | "sub") => {}
            (NodeType::Element, _) => diagnostics.push(unknown_markup(node)),
            _ => {}
        }
    }
    text
}

fn is_character(node: Option<Node<'_, '_>>) -> bool {
    node.is_some_and(|node| node.attribute("ctype") == Some(CHARACTER))
}
