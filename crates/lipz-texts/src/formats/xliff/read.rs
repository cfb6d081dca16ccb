//! Reading of both versions of XLIFF.

use super::{read1, read2, xml};
use crate::exchange::decode;
use crate::exchange::entry::{IncomingFile, ReadOptions};
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use roxmltree::{Document, Node, ParsingOptions};
use std::sync::Arc;

/// The most nodes of a file: as many as a regular file of the greatest size has.
const MAX_NODES: u32 = 20_000_000;

/// Reads a file with arbitrary content. A file with a DTD, and therefore with entities, is rejected.
pub(crate) fn read(bytes: &[u8], options: &ReadOptions, incoming: &mut IncomingFile) {
    let label = decode::label(bytes, b"encoding=\"").or_else(|| decode::label(bytes, b"encoding='"));
    let Some(text) = decode::text(bytes, label, &mut incoming.diagnostics) else {
        incoming.text = decode::readable(bytes);
        return;
    };
    if let Some(tag) = lipz_file::costly_xml_tag(&text) {
        let most = lipz_file::MOST_XML_ATTRIBUTES;
        let message = format!("a tag has more than {most} attributes, or the file declares too many namespaces");
        let diagnostic = Diagnostic::at(Code::ExchangeSyntax, Span::new(tag.start, tag.end), message);
        incoming.diagnostics.push(diagnostic.help("open it in the tool that wrote it, and save it again"));
        incoming.text = text.into_owned();
        return;
    }
    let parsing = ParsingOptions { nodes_limit: MAX_NODES, ..ParsingOptions::default() };
    match Document::parse_with_options(&text, parsing) {
        Ok(document) => root(document.root_element(), options, incoming),
        Err(error) => {
            let (what, span) = xml::mistake(&text, &error);
            let diagnostic = Diagnostic::at(Code::ExchangeSyntax, span, format!("the file is not XML: {what}"));
            incoming.diagnostics.push(match error {
                roxmltree::Error::DtdDetected => diagnostic
                    .note("lipz does not read a DTD, because its entities can name other files and grow without limit")
                    .help("delete `<!DOCTYPE …>`; XLIFF has no DTD"),
                _ => diagnostic.help("open it in the tool that wrote it, and save it again"),
            });
        }
    }
    incoming.text = text.into_owned();
}

fn root(root: Node<'_, '_>, options: &ReadOptions, incoming: &mut IncomingFile) {
    let version = root.attribute("version").unwrap_or_default();
    match (root.tag_name().name(), version.split('.').next()) {
        ("xliff", Some("2")) => read2::read(root, options, incoming),
        ("xliff", Some("1")) => read1::read(root, options, incoming),
        ("xliff", _) => incoming.diagnostics.push(
            Diagnostic::at(Code::ExchangeSyntax, start(root), "the version of the file is not 1 or 2")
                .help("save it as XLIFF 1.2 or 2.1"),
        ),
        (other, _) => {
            let message = format!("the root of the file is {}, not `xliff`", escape::quoted(other));
            incoming.diagnostics.push(Diagnostic::at(Code::ExchangeSyntax, start(root), message));
        }
    }
}

/// Returns the span of the name in an element's start tag.
pub(super) fn start(node: Node<'_, '_>) -> Span {
    let start = node.range().start;
    let length = node.document().input_text().get(start..).unwrap_or_default();
    let length = length.find([' ', '>', '/', '\n', '\t', '\r']).unwrap_or(length.len());
    Span::new(start, start + length)
}

/// Returns the locale of the translations, or reports that it is missing.
pub(super) fn locale(
    node: Node<'_, '_>,
    attribute: &str,
    options: &ReadOptions,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Arc<str>> {
    if let [only] = options.wanted.as_slice() {
        return Some(only.as_str().into());
    }
    let tag = node.attribute(attribute).unwrap_or_default();
    let locale = options.locale(tag).map(Arc::from).map_err(|why| match tag {
        "" => Diagnostic::at(Code::ExchangeSyntax, start(node), format!("the file has no `{attribute}`"))
            .help("name the locale of the file with `--locale`, as in de-de"),
        _ => why.diagnostic(tag, start(node)),
    });
    locale.map_err(|diagnostic| diagnostics.push(diagnostic)).ok()
}

/// Returns the diagnostic for markup that texts of clips do not have.
pub(super) fn unknown_markup(node: Node<'_, '_>) -> Diagnostic {
    let message = format!("the markup {} is left out", escape::quoted(node.tag_name().name()));
    Diagnostic::at(Code::ExchangeLoss, start(node), message)
        .note("texts of clips have no markup except {meta}, which is written as placeholders")
}
