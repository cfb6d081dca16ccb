//! Reading a Lipz file: bytes → text → elements with spans.

mod elements;
mod encoding;
mod recover;
mod syntax;

pub use encoding::{decode, decode_marked, too_large, without_byte_order_mark};

use crate::Document;
use crate::text::trim;
use lipz_diagnostics::{Code, Diagnostic, bound};

/// Longest file that is read, in bytes: far more than a clip can need (20 million frames with 40
/// subtitles), and little enough for 32-bit spans and texts of 2²⁸ bytes.
pub const MAX_FILE_BYTES: usize = 1 << 28;

/// What reading a file gave.
#[derive(Debug)]
pub struct Parsed<'s> {
    /// The elements; `None` if they cannot be found.
    pub document: Option<Document<'s>>,
    /// What is wrong, in the order of the places.
    pub diagnostics: Vec<Diagnostic>,
    /// Without a document: what can be read all the same, if the file is text. It is good for looking for further
    /// mistakes, and for nothing else.
    pub fragment: Option<Fragment<'s>>,
}

/// The elements of a file with mistakes that can be read.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Fragment<'s> {
    /// These elements; of those with the same name, the first.
    pub document: Document<'s>,
    /// Whether they are all that the file has: what is wrong stands between them.
    pub is_complete: bool,
}

/// Reads a Lipz file. Takes time and memory in proportion to its length, whatever it contains.
///
/// Of each code, the first thousand diagnostics are told, and how many others there are
/// ([`bound`](mod@lipz_diagnostics::bound)).
///
/// Checked here: encoding, JSON syntax, the root, duplicate elements. Behind a mistake in the syntax, reading goes on:
/// mistakes that do not depend on each other are all reported. Spans count from the first byte after a byte order mark.
///
/// ```
/// let parsed = lipz_file::parse(b"{ 'fps': 024,\n \"visemes\": \"MA\"\n \"text_en-us\": \"Hi\", }");
/// let messages = parsed.diagnostics.iter().map(|found| found.message.as_str());
/// assert_eq!(messages.collect::<Vec<_>>(), [
///     "names and strings need straight double quotes",
///     "`024` is not a number as JSON has it",
///     "a comma is missing between two elements",
///     "a comma follows the last element",
/// ]);
/// ```
pub fn parse(bytes: &[u8]) -> Parsed<'_> {
    let mut diagnostics = Vec::new();
    let (mut document, mut fragment) = (None, None);
    match decode(bytes, &mut diagnostics) {
        Some(text) if trim(text).is_empty() => {
            let message = if text.is_empty() { "the file is empty" } else { "the file contains only white space" };
            diagnostics.push(
                Diagnostic::new(Code::EmptyFile, message)
                    .help("write at least {} for a clip without mouth shapes, texts and events"),
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
            Diagnostic::new(Code::EmptyDocument, "the file has no elements: an empty clip")
                .help("a clip usually has \"visemes\", and \"text_ll-cc\" for its subtitles"),
        );
    }
    bound::limit(&mut diagnostics);
    diagnostics.sort_by_key(Diagnostic::start);
    Parsed { document, diagnostics, fragment }
}
