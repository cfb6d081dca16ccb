//! Reading a Lipz file: bytes → text → elements with spans.

mod elements;
mod encoding;
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
}

/// Reads a Lipz file. Takes time and memory in proportion to its length, whatever it contains.
///
/// Of each code, the first thousand diagnostics are told, and how many others there are
/// ([`bound`](mod@lipz_diagnostics::bound)).
///
/// Checked here: encoding, JSON syntax, the root, duplicate elements. Spans count from the first
/// byte after a byte order mark.
pub fn parse(bytes: &[u8]) -> Parsed<'_> {
    let mut diagnostics = Vec::new();
    let document = match decode(bytes, &mut diagnostics) {
        Some(text) if trim(text).is_empty() => {
            let message = if text.is_empty() { "the file is empty" } else { "the file contains only white space" };
            diagnostics.push(
                Diagnostic::new(Code::EmptyFile, message)
                    .help("write at least {} for a clip without mouth shapes, texts and events"),
            );
            None
        }
        Some(text) => elements::elements(text, &mut diagnostics),
        None => None,
    };
    if document.as_ref().is_some_and(|document| document.elements.is_empty()) {
        diagnostics.push(
            Diagnostic::new(Code::EmptyDocument, "the file has no elements: an empty clip")
                .help("a clip usually has \"visemes\", and \"text_ll-cc\" for its subtitles"),
        );
    }
    bound::limit(&mut diagnostics);
    diagnostics.sort_by_key(Diagnostic::start);
    Parsed { document, diagnostics }
}
