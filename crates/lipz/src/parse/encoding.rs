//! From bytes to text: UTF-8, with or without a byte order mark.

use super::MAX_FILE_BYTES;
use crate::{Code, Diagnostic, Span};

/// The text of the file without byte order mark, or `None` and the reason why there is none.
pub(super) fn decode<'s>(bytes: &'s [u8], diagnostics: &mut Vec<Diagnostic>) -> Option<&'s str> {
    if bytes.len() > MAX_FILE_BYTES {
        let mebibytes = bytes.len() >> 20;
        diagnostics.push(
            Diagnostic::new(Code::FileTooLarge, format!("the file has {mebibytes} MiB, more than a clip can be"))
                .note(format!("the largest file that is read has {} MiB", MAX_FILE_BYTES >> 20))
                .help("one Lipz file describes one audio file: split the recording"),
        );
        return None;
    }
    if let Some(order) = utf16_byte_order(bytes) {
        diagnostics.push(
            Diagnostic::new(Code::Utf16, format!("the file is UTF-16 ({order}), not UTF-8")).help("save it as UTF-8"),
        );
        return None;
    }
    let without_mark = bytes.strip_prefix(b"\xEF\xBB\xBF");
    if without_mark.is_some() {
        diagnostics.push(
            Diagnostic::at(Code::ByteOrderMark, Span::new(0, 0), "the file starts with a byte order mark")
                .note("it is skipped; JSON texts must not start with one (RFC 8259, section 8.1)")
                .help("save the file as UTF-8 without byte order mark (\"without BOM\")"),
        );
    }
    let bytes = without_mark.unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => Some(text),
        Err(error) => {
            diagnostics.push(not_utf8(bytes, error.valid_up_to()));
            None
        }
    }
}

/// Recognises UTF-16 by its byte order mark, or by the zero byte next to the first brace or blank.
fn utf16_byte_order(bytes: &[u8]) -> Option<&'static str> {
    match bytes {
        [0xFF, 0xFE, ..] => Some("little-endian"),
        [0xFE, 0xFF, ..] => Some("big-endian"),
        [1..=0x7F, 0, ..] => Some("little-endian"),
        [0, 1..=0x7F, ..] => Some("big-endian"),
        _ => None,
    }
}

/// The finding for the first byte that is not UTF-8. Its span counts in the text that
/// `String::from_utf8_lossy` makes of the file, in which bad bytes have a replacement character.
fn not_utf8(bytes: &[u8], valid_up_to: usize) -> Diagnostic {
    let byte = bytes.get(valid_up_to).copied().unwrap_or_default();
    let span = Span::new(valid_up_to, valid_up_to + '\u{FFFD}'.len_utf8());
    let diagnostic =
        Diagnostic::at(Code::NotUtf8, span, format!("byte 0x{byte:02X} is not UTF-8")).help("save the file as UTF-8");
    if byte >= 0xA0 {
        let latin = char::from(byte);
        return diagnostic.note(format!("in Latin-1 and Windows-1252 this byte is `{latin}`"));
    }
    diagnostic
}
