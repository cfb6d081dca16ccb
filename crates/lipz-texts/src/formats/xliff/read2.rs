//! Reading of XLIFF 2.0, 2.1 and 2.2.

use super::read::{locale, start, unknown_markup};
use super::xml::{inner, whole};
use super::{COMMENTS_EXPORTED, EXPORTED};
use crate::exchange::State;
use crate::exchange::entry::{Entry, IncomingFile, ReadOptions, Words};
use lipz_diagnostics::{Code, Diagnostic, bound};
use roxmltree::{Node, NodeType};
use std::collections::HashMap;
use std::sync::Arc;

/// Adds the entries of a file.
pub(super) fn read(root: Node<'_, '_>, options: &ReadOptions, incoming: &mut IncomingFile) {
    let Some(locale) = locale(root, "trgLang", options, &mut incoming.diagnostics) else { return };
    for node in root.descendants().filter(|node| node.has_tag_name((namespace(root), "unit"))) {
        unit(node, &locale, incoming);
        bound::limit_many(&mut incoming.diagnostics);
    }
}

/// Returns the namespace of the root, which is the same for 2.0 and 2.1.
fn namespace<'a>(root: Node<'a, '_>) -> &'a str {
    root.tag_name().namespace().unwrap_or_default()
}

/// The categories of notes that lipz writes. All other notes are comments of translators.
const OWN_NOTES: [&str; 5] = ["context", "location", "translated from", EXPORTED, COMMENTS_EXPORTED];

/// The data that a unit shares with its segments.
struct UnitContent<'d> {
    data: HashMap<&'d str, String>,
    /// The placeholders of the sources by their IDs, because tools may omit `dataRef` in targets.
    codes: HashMap<String, String>,
}

fn unit(node: Node<'_, '_>, locale: &Arc<str>, incoming: &mut IncomingFile) {
    let Some(key) = node.attribute("name").or_else(|| node.attribute("id")) else {
        incoming.diagnostics.push(Diagnostic::at(Code::ExchangeSyntax, start(node), "the unit has no name"));
        return;
    };
    let key = Arc::new(Words { text: key.to_owned(), span: start(node) });
    let children = |name: &'static str| node.children().filter(move |child| child.tag_name().name() == name);
    let mut unit = UnitContent { data: HashMap::new(), codes: HashMap::new() };
    for data in children("originalData").flat_map(|all| all.children()) {
        if let Some(id) = data.attribute("id") {
            let text = unit.text(data, &mut incoming.diagnostics);
            unit.data.insert(id, text);
        }
    }
    let notes = || children("notes").flat_map(|notes| notes.children()).filter(|note| note.tag_name().name() == "note");
    let marks: HashMap<&str, &str> = notes()
        .filter(|note| note.attribute("category") == Some(EXPORTED))
        .filter_map(|note| Some((note.attribute("id")?, note.text()?)))
        .collect();
    let is_by_lipz =
        |note: &Node<'_, '_>| note.attribute("category").is_some_and(|category| OWN_NOTES.contains(&category));
    let lines = notes().filter(|note| !is_by_lipz(note)).filter_map(|note| note.text()).flat_map(str::lines);
    let comments: Vec<String> = lines.map(str::trim).filter(|line| !line.is_empty()).map(str::to_owned).collect();
    let is_mark = |note: &Node<'_, '_>| note.attribute("category") == Some(COMMENTS_EXPORTED);
    let comments_mark = notes().find(is_mark).and_then(|note| note.text()?.trim().parse().ok());
    let is_segment = |child: &Node<'_, '_>| matches!(child.tag_name().name(), "segment" | "ignorable");
    let segments: Vec<Node<'_, '_>> = node.children().filter(is_segment).collect();
    for (at, segment) in segments.iter().enumerate().filter(|(_, segment)| segment.tag_name().name() == "segment") {
        let child = |name: &str| segment.children().find(|child| child.tag_name().name() == name);
        let Some(source) = child("source") else {
            incoming.diagnostics.push(Diagnostic::at(
                Code::ExchangeSyntax,
                start(*segment),
                "the segment has no source",
            ));
            continue;
        };
        let words = |node: Node<'_, '_>, unit: &mut UnitContent<'_>, found: &mut Vec<Diagnostic>| Words {
            text: unit.text(node, found),
            span: inner(node),
        };
        let source = words(source, &mut unit, &mut incoming.diagnostics);
        let text = match child("target") {
            Some(target) => words(target, &mut unit, &mut incoming.diagnostics),
            None => Words { text: String::new(), span: whole(*segment) },
        };
        let id = segment.attribute("id").unwrap_or_default();
        // A target without a state counts as translated.
        let state = segment.attribute("state").and_then(State::from_name).unwrap_or(State::Translated);
        incoming.entries.push(Entry {
            key: Arc::clone(&key),
            segment: Some(at + 1),
            segment_count: Some(segments.len()),
            source: Some(source.into()),
            locale: Arc::clone(locale),
            state: if text.text.is_empty() { State::Initial } else { state },
            says_state: segment.has_attribute("state"),
            text,
            mark: marks.get(id).and_then(|mark| mark.parse().ok()),
            comments: comments.clone(),
            comments_mark,
            ..Entry::default()
        });
    }
}

impl UnitContent<'_> {
    /// Returns the text of a source or target, with its placeholders.
    fn text(&mut self, node: Node<'_, '_>, diagnostics: &mut Vec<Diagnostic>) -> String {
        let mut text = String::new();
        for node in node.descendants().skip(1) {
            match (node.node_type(), node.tag_name().name()) {
                (NodeType::Text, _) => text.push_str(node.text().unwrap_or_default()),
                (NodeType::Element, "cp") => {
                    let code = node.attribute("hex").and_then(|hex| u32::from_str_radix(hex, 16).ok());
                    text.extend(code.and_then(char::from_u32));
                }
                (NodeType::Element, "ph") => match self.placeholder(node) {
                    Some(placeholder) => text.push_str(&placeholder),
                    None => diagnostics.push(unknown_markup(node)),
                },
                // Marks of terms and comments do not change the text that they enclose.
                (NodeType::Element, "mrk" | "sm" | "em") => {}
                (NodeType::Element, _) => diagnostics.push(unknown_markup(node)),
                _ => {}
            }
        }
        text
    }

    fn placeholder(&mut self, node: Node<'_, '_>) -> Option<String> {
        let id = node.attribute("id").unwrap_or_default();
        let data = node.attribute("dataRef").and_then(|data| self.data.get(data));
        let known = data.or_else(|| self.codes.get(id)).cloned();
        let text = known.or_else(|| node.attribute("disp").map(str::to_owned))?;
        self.codes.insert(id.to_owned(), text.clone());
        Some(text)
    }
}
