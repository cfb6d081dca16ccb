//! Parses a Lipz file: bytes → text → elements with spans.

mod elements;
mod encoding;
mod recover;
mod syntax;

pub use encoding::{decode, decode_marked, too_large, without_byte_order_mark};

use crate::Document;
use crate::text::trim;
use lipz_diagnostics::{Code, Diagnostic, bound};

/// The greatest length of a file that is parsed, in bytes. It is far more than a clip can need (20 million frames with
/// 40 subtitles), and small enough for 32-bit spans and texts of 2²⁸ bytes.
pub const MAX_FILE_BYTES: usize = 1 << 28;

/// The result of parsing a file.
#[derive(Debug)]
pub struct ParsedFile<'s> {
    /// The elements; `None` if they cannot be found.
    pub document: Option<Document<'s>>,
    /// The problems, ordered by position.
    pub diagnostics: Vec<Diagnostic>,
    /// Without a document: the readable part, if the file is text. Use it only to look for further errors.
    pub fragment: Option<Fragment<'s>>,
}

/// The readable elements of a file with errors.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Fragment<'s> {
    /// These elements; if names repeat, the first ones.
    pub document: Document<'s>,
    /// Whether there are no other elements in the file, because all errors are between these.
    pub is_complete: bool,
}

/// Parses a Lipz file. Takes time and memory in proportion to its length, whatever it contains.
///
/// Reports the first thousand diagnostics of each code, and the number of the others
/// ([`bound`](mod@lipz_diagnostics::bound)).
///
/// Checks encoding, JSON syntax, the root and duplicate elements. Parsing continues after a syntax error, so that all
/// independent errors are reported. Spans count from the first byte after a byte order mark.
///
/// ```
/// let parsed = lipz_file::parse(b"{ 'fps': 024,\n \"visemes\": \"MA\"\n \"text_en-us\": \"Hi\", }");
/// let messages = parsed.diagnostics.iter().map(|found| found.message.as_str());
/// assert_eq!(messages.collect::<Vec<_>>(), [
///     "a name or string does not start with a straight double quote",
///     "`024` is not a JSON number",
///     "a comma is missing between two elements",
///     "a comma follows the last element",
/// ]);
/// ```
pub fn parse(bytes: &[u8]) -> ParsedFile<'_> {
    let mut diagnostics = Vec::new();
    let (mut document, mut fragment) = (None, None);
    match decode(bytes, &mut diagnostics) {
        Some(text) if trim(text).is_empty() => {
            let message = if text.is_empty() { "the file is empty" } else { "the file contains only whitespace" };
            diagnostics.push(
                Diagnostic::new(Code::EmptyFile, message)
                    .help("write at least {} for a clip without mouth shapes, texts or events"),
            );
        }
        Some(text) => match elements::elements(text, &mut diagnostics) {
            Ok(whole) => document = Some(whole),
            Err(part) => fragment = Some(part),
        },
        None => {}
    }
    if document.as_ref().is_some_and(|document| document.elements.is_empty()) {
        diagnostics.push(
            Diagnostic::new(Code::EmptyDocument, "the file has no elements")
                .help("a clip usually has \"visemes\", and \"text_ll-cc\" for its subtitles"),
        );
    }
    bound::limit(&mut diagnostics);
    diagnostics.sort_by_key(Diagnostic::start);
    ParsedFile { document, diagnostics, fragment }
}
