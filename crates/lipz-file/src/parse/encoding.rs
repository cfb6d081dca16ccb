//! From bytes to text: UTF-8, with or without a byte order mark.

use super::MAX_FILE_BYTES;
use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use lipz_types::BANK_MAGIC;

/// What Windows-1252 has at 0x80 to 0x9F; blanks where it has nothing.
const WINDOWS_1252: &str = "€ ‚ƒ„…†‡ˆ‰Š‹Œ Ž  ‘’“”•–—˜™š›œ žŸ";

/// The text of a file without byte order mark, or `None` and the reason why there is none: it is not
/// UTF-8, or too large.
pub fn decode<'s>(bytes: &'s [u8], diagnostics: &mut Vec<Diagnostic>) -> Option<&'s str> {
    if bytes.len() > MAX_FILE_BYTES {
        diagnostics.push(too_large());
        return None;
    }
    if let Some(order) = utf16_byte_order(bytes) {
        diagnostics.push(
            Diagnostic::new(Code::Utf16, format!("the file is UTF-16 ({order}), not UTF-8")).help("save it as UTF-8"),
        );
        return None;
    }
    let without_mark = without_byte_order_mark(bytes);
    if without_mark.len() < bytes.len() {
        diagnostics.push(
            Diagnostic::new(Code::ByteOrderMark, "the file starts with a byte order mark")
                .note("it is skipped; JSON texts must not start with one (RFC 8259, section 8.1)")
                .help("save the file as UTF-8 without byte order mark (\"without BOM\")")
                // Spans count behind the mark, and a text that is written again has none.
                .fix(Span::default(), ""),
        );
    }
    // The fast check first; it does not tell the place.
    let text = simdutf8::basic::from_utf8(without_mark).or_else(|_| std::str::from_utf8(without_mark));
    text.map_err(|error| diagnostics.push(not_utf8(without_mark, error))).ok()
}

/// The bytes behind a UTF-8 byte order mark, from which spans count; all of them if there is none.
pub fn without_byte_order_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes)
}

/// The diagnostic for a file longer than [`MAX_FILE_BYTES`], for callers who know its length before
/// they read it.
pub fn too_large() -> Diagnostic {
    Diagnostic::new(Code::FileTooLarge, Code::FileTooLarge.summary())
        .help("one Lipz file describes one audio file: split the recording")
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

/// The diagnostic for the first byte that is not UTF-8, or for a bank, which is named by mistake. Its span counts in
/// the text that `String::from_utf8_lossy` makes of the file, in which bad bytes have a replacement character.
fn not_utf8(bytes: &[u8], error: std::str::Utf8Error) -> Diagnostic {
    if bytes.starts_with(&BANK_MAGIC) {
        return Diagnostic::new(Code::NotUtf8, "the file is a lipz bank, not text")
            .help("name a Lipz file; a bank can be verified, and unpacked to Lipz files");
    }
    let at = error.valid_up_to();
    let byte = bytes.get(at).copied().unwrap_or_default();
    let span = Span::new(at, at + '\u{FFFD}'.len_utf8());
    if error.error_len().is_none() {
        return Diagnostic::at(Code::NotUtf8, span, "the file ends in the middle of a character")
            .help("was the file cut off while it was copied? copy it again");
    }
    let diagnostic = Diagnostic::at(Code::NotUtf8, span, format!("the file is not UTF-8 (byte 0x{byte:02X})"))
        .help("save the file as UTF-8");
    match in_windows_1252(byte) {
        Some(character) if byte < 0xA0 => diagnostic.note(format!("in Windows-1252 this byte is `{character}`")),
        Some(character) => {
            diagnostic.note(format!("in Latin-1 and Windows-1252 this byte is {}", escape::character(character)))
        }
        None => diagnostic,
    }
}

/// The character that a byte above 0x7F stands for in Windows-1252.
fn in_windows_1252(byte: u8) -> Option<char> {
    match byte {
        0x80..=0x9F => WINDOWS_1252.chars().nth(usize::from(byte - 0x80)).filter(|&character| character != ' '),
        0xA0.. => Some(char::from(byte)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_1252() {
        assert_eq!(WINDOWS_1252.chars().count(), 32);
        for (byte, character) in [(0x80, '€'), (0x8E, 'Ž'), (0x93, '“'), (0x9F, 'Ÿ'), (0xF6, 'ö')] {
            assert_eq!(in_windows_1252(byte), Some(character));
        }
        for byte in [0x81, 0x8D, 0x8F, 0x90, 0x9D] {
            assert_eq!(in_windows_1252(byte), None);
        }
    }

    #[test]
    fn a_bank_is_named_as_what_it_is() {
        let bank = [&BANK_MAGIC[..], &[0; 56]].concat();
        let mut found = Vec::new();
        assert_eq!(decode(&bank, &mut found), None);
        assert_eq!(
            found.iter().map(|found| found.message.as_str()).collect::<Vec<_>>(),
            ["the file is a lipz bank, not text"]
        );
        assert!(found[0].primary.is_none(), "there is no line to show");
    }
}
