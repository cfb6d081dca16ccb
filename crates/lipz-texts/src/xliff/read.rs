//! Reading XLIFF of both versions.

use super::{read1, read2, xml};
use crate::{Incoming, ReadOptions, decode};
use lipz_diagnostics::{Code, Diagnostic, escape};
use roxmltree::{Document, Node, ParsingOptions};
use std::sync::Arc;

/// Nodes of a file, at most: what fits into a file of the greatest length that somebody wrote.
const MAX_NODES: u32 = 20_000_000;

/// Reads a file of any bytes. A file with a DTD, and so with entities, is refused.
pub(crate) fn read(bytes: &[u8], options: &ReadOptions, incoming: &mut Incoming) {
    let label = decode::label(bytes, b"encoding=\"").or_else(|| decode::label(bytes, b"encoding='"));
    let Some(text) = decode::text(bytes, label, &mut incoming.diagnostics) else {
        incoming.text = decode::readable(bytes);
        return;
    };
    let parsing = ParsingOptions { nodes_limit: MAX_NODES, ..ParsingOptions::default() };
    match Document::parse_with_options(&text, parsing) {
        Ok(document) => root(document.root_element(), options, incoming),
        Err(error) => {
            let (what, span) = xml::mistake(&text, &error);
            let diagnostic = Diagnostic::at(Code::ExchangeSyntax, span, format!("the file is not XML: {what}"));
            incoming.diagnostics.push(match error {
                roxmltree::Error::DtdDetected => diagnostic
                    .note("entities of a DTD can name other files, and grow without end: lipz reads none")
                    .help("XLIFF has no DTD: delete `<!DOCTYPE …>`"),
                _ => diagnostic.help("open it in the tool that wrote it, and save it again"),
            });
        }
    }
    incoming.text = text.into_owned();
}

fn root(root: Node<'_, '_>, options: &ReadOptions, incoming: &mut Incoming) {
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

/// The name of an element in its first tag.
pub(super) fn start(node: Node<'_, '_>) -> lipz_diagnostics::Span {
    let start = node.range().start;
    let length = node.document().input_text().get(start..).unwrap_or_default();
    let length = length.find([' ', '>', '/', '\n', '\t', '\r']).unwrap_or(length.len());
    lipz_diagnostics::Span::new(start, start + length)
}

/// The locale of the translations; reports that there is none.
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
            .help("name the locale of the file for the import, as in de-de"),
        _ => why.diagnostic(tag, start(node)),
    });
    locale.map_err(|diagnostic| diagnostics.push(diagnostic)).ok()
}

/// The diagnostic for markup that texts of clips do not have.
pub(super) fn unknown_markup(node: Node<'_, '_>) -> Diagnostic {
    let message = format!("the markup {} is left out", escape::quoted(node.tag_name().name()));
    Diagnostic::at(Code::ExchangeLoss, start(node), message)
        .note("texts of clips have no markup but {meta}, which are placeholders")
}
