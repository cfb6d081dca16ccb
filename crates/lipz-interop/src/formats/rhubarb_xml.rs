//! Rhubarb Lip Sync, `-f xml`: `mouthCue` elements with `start` and `end`, and the shape as their text.

use super::Format;
use super::rhubarb::{self, Cue};
use crate::{ImportOptions, Time, Track, source, xml};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use roxmltree::{Document, Node, ParsingOptions};

pub(super) const FORMAT: Format = Format {
    name: "rhubarb-xml",
    about: "Rhubarb Lip Sync, XML (-f xml)",
    extension: "xml",
    maps: rhubarb::MAPS,
    is_binary: false,
    is_legacy: false,
    keeps_texts: false,
    read: Some(read),
    write: None,
};

fn read(bytes: &[u8], _: &ImportOptions<'_>, diagnostics: &mut Vec<Diagnostic>) -> Vec<Track> {
    let Some(text) = source::text(bytes, diagnostics) else { return Vec::new() };
    if let Some(diagnostic) = xml::too_costly(text, Code::ForeignSyntax) {
        diagnostics.push(diagnostic.help("check whether this is a file of Rhubarb"));
        return Vec::new();
    }
    // Entities of a document type can grow without bound. Rhubarb does not write them, and the parser rejects them by
    // default.
    let document = match Document::parse_with_options(text, ParsingOptions::default()) {
        Ok(document) => document,
        Err(error) => {
            diagnostics.push(syntax(text, &error));
            return Vec::new();
        }
    };
    let duration = document.descendants().find(|node| node.has_tag_name("duration"));
    let duration = duration.and_then(|node| {
        let start = node.first_child().map_or(node.range().start, |text| text.range().start);
        time(node.text().unwrap_or_default(), start, diagnostics)
    });
    let cues: Vec<Cue> = document
        .descendants()
        .filter(|node| node.has_tag_name("mouthCue"))
        .filter_map(|node| cue(node, diagnostics))
        .collect();
    if !document.root_element().has_tag_name("rhubarbResult") {
        let span = xml::whole(document.root_element());
        let message = "the root is not rhubarbResult".to_owned();
        diagnostics
            .push(Diagnostic::at(Code::ForeignSyntax, span, message).help("check whether this is a file of Rhubarb"));
    }
    vec![rhubarb::track(cues, duration)]
}

fn cue(node: Node<'_, '_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Cue> {
    let mut attribute = |name: &str| {
        let Some(attribute) = node.attribute_node(name) else {
            let message = format!("`mouthCue` has no attribute `{name}`");
            diagnostics.push(Diagnostic::at(Code::ForeignSyntax, xml::whole(node), message));
            return None;
        };
        time(attribute.value(), attribute.range_value().start, diagnostics)
    };
    let (start, end) = (attribute("start")?, attribute("end")?);
    let text = node.first_child().filter(Node::is_text);
    let symbol = text.and_then(|text| text.text()).unwrap_or_default().trim().to_owned();
    Some(Cue { start, end, symbol, span: xml::whole(text.unwrap_or(node)) })
}

fn time(text: &str, at: usize, diagnostics: &mut Vec<Diagnostic>) -> Option<Time> {
    let time = Time::parse(text.trim());
    if time.is_none() {
        let message = format!("{} is not a time in seconds", escape::quoted(text));
        diagnostics.push(Diagnostic::at(Code::ForeignSyntax, Span::new(at, at + text.len()), message));
    }
    time
}

fn syntax(text: &str, error: &roxmltree::Error) -> Diagnostic {
    if matches!(
        error,
        roxmltree::Error::UnclosedRootNode | roxmltree::Error::UnexpectedEndOfStream | roxmltree::Error::NoRootNode
    ) {
        return source::cut_off(text, "its XML is not complete");
    }
    let (what, span) = xml::mistake(text, error);
    Diagnostic::at(Code::ForeignSyntax, span, format!("the file is not XML: {what}"))
}
