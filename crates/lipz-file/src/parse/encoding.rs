//! Decodes bytes to text: UTF-8, with or without a byte order mark.

use super::MAX_FILE_BYTES;
use lipz_diagnostics::{Code, Diagnostic, Severity, Span, escape};
use lipz_types::BANK_MAGIC;

/// U+FEFF in UTF-8.
const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

/// Windows-1252 from 0x80 to 0x9F, with spaces for undefined codes.
const WINDOWS_1252: &str = "€ ‚ƒ„…†‡ˆ‰Š‹Œ Ž  ‘’“”•–—˜™š›œ žŸ";

/// Returns the text of a file without its byte order mark. Returns `None` and reports the reason if it is not UTF-8 or
/// too large.
pub fn decode<'s>(bytes: &'s [u8], diagnostics: &mut Vec<Diagnostic>) -> Option<&'s str> {
    if bytes.len() > MAX_FILE_BYTES {
        diagnostics.push(too_large());
        return None;
    }
    if let Some((encoding, order)) = wide_encoding(bytes) {
        diagnostics.push(
            Diagnostic::new(Code::Utf16, format!("the file is {encoding} ({order}), not UTF-8"))
                .help("save it as UTF-8"),
        );
        return None;
    }
    let without_mark = without_byte_order_mark(bytes);
    if without_mark.len() < bytes.len() {
        diagnostics.push(
            Diagnostic::new(Code::ByteOrderMark, "the file starts with a byte order mark")
                .note("it is skipped; JSON texts must not start with one (RFC 8259, section 8.1)")
                .help("save the file as UTF-8 without a byte order mark (\"without BOM\")")
                // Spans count from after the mark, and rewritten text has none.
                .fix(Span::default(), ""),
        );
    }
    // The fast check first, which does not return the position.
    let text = simdutf8::basic::from_utf8(without_mark).or_else(|_| std::str::from_utf8(without_mark));
    text.map_err(|error| diagnostics.push(not_utf8(without_mark, error))).ok()
}

/// Returns the text of a file in which a byte order mark is usual, such as those of other tools: the mark is skipped.
/// Returns `None` and reports the reason if [`decode`] does, or if there is more than one mark: parsers of other
/// formats skip the second one as well, and their positions would differ.
pub fn decode_marked<'s>(bytes: &'s [u8], diagnostics: &mut Vec<Diagnostic>) -> Option<&'s str> {
    let bytes = without_byte_order_mark(bytes);
    if bytes.starts_with(BYTE_ORDER_MARK) {
        let span = Span::new(0, BYTE_ORDER_MARK.len());
        let mut diagnostic =
            Diagnostic::at(Code::ByteOrderMark, span, "the file starts with more than one byte order mark")
                .help("delete all marks but the first; check whether the file was joined from several files");
        diagnostic.severity = Severity::Error;
        diagnostics.push(diagnostic);
        return None;
    }
    decode(bytes, diagnostics)
}

/// Returns the bytes after a UTF-8 byte order mark, from which spans count, or all bytes without a mark.
pub fn without_byte_order_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes)
}

/// Returns the diagnostic for a file longer than [`MAX_FILE_BYTES`], for callers who check the length before reading.
pub fn too_large() -> Diagnostic {
    Diagnostic::new(Code::FileTooLarge, Code::FileTooLarge.summary())
        .help("split the recording; one Lipz file describes one audio file")
}

/// Recognises UTF-16 and UTF-32, with their byte order: by the byte order mark, or by the zero bytes next to the first
/// brace or space.
fn wide_encoding(bytes: &[u8]) -> Option<(&'static str, &'static str)> {
    match bytes {
        [0xFF, 0xFE, 0, 0, ..] | [1..=0x7F, 0, 0, 0, ..] => Some(("UTF-32", "little-endian")),
        [0, 0, 0xFE, 0xFF, ..] | [0, 0, 0, 1..=0x7F, ..] => Some(("UTF-32", "big-endian")),
        [0xFF, 0xFE, ..] | [1..=0x7F, 0, ..] => Some(("UTF-16", "little-endian")),
        [0xFE, 0xFF, ..] | [0, 1..=0x7F, ..] => Some(("UTF-16", "big-endian")),
        _ => None,
    }
}

/// Returns the diagnostic for the first bytes that are not UTF-8, or for a bank in place of a Lipz file.
fn not_utf8(bytes: &[u8], error: std::str::Utf8Error) -> Diagnostic {
    if bytes.starts_with(&BANK_MAGIC) {
        return Diagnostic::new(Code::NotUtf8, "the file is a lipz bank, not text")
            .help("pass a Lipz file; to restore the Lipz files of a bank, use `lipz unpack`");
    }
    let at = error.valid_up_to();
    let byte = bytes.get(at).copied().unwrap_or_default();
    let span = Span::new(at, error.error_len().map_or(bytes.len(), |length| at + length));
    if error.error_len().is_none() {
        return Diagnostic::at(Code::NotUtf8, span, "the file ends in the middle of a character")
            .help("copy the file again; it may have been cut off");
    }
    let diagnostic = Diagnostic::at(Code::NotUtf8, span, format!("the file is not UTF-8 (byte 0x{byte:02X})"))
        .help("save the file as UTF-8");
    if let Some(why) = forbidden(bytes.get(at..).unwrap_or_default()) {
        return diagnostic.note(why);
    }
    match in_windows_1252(byte) {
        Some(character) if byte < 0xA0 => diagnostic.note(format!("in Windows-1252 this byte is `{character}`")),
        Some(character) => {
            diagnostic.note(format!("in Latin-1 and Windows-1252 this byte is {}", escape::character(character)))
        }
        None => diagnostic,
    }
}

/// Explains why bytes that look like UTF-8 are not. Programs that write these forms also call them UTF-8.
fn forbidden(bytes: &[u8]) -> Option<&'static str> {
    match bytes {
        [0xED, 0xA0..=0xBF, 0x80..=0xBF, ..] => {
            Some("this is half of a surrogate pair in CESU-8, which some databases and Java programs write")
        }
        [0xC0 | 0xC1, 0x80..=0xBF, ..]
        | [0xE0, 0x80..=0x9F, 0x80..=0xBF, ..]
        | [0xF0, 0x80..=0x8F, 0x80..=0xBF, ..] => Some("this is an overlong form, which UTF-8 does not allow"),
        [0xF4, 0x90..=0xBF, 0x80..=0xBF, ..] | [0xF5..=0xF7, 0x80..=0xBF, ..] => {
            Some("these bytes encode a number above U+10FFFF, the last code point of Unicode")
        }
        _ => None,
    }
}

/// Returns the character of a byte above 0x7F in Windows-1252.
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
    fn encodings_are_called_by_their_names() {
        let told = |bytes: &[u8]| {
            let mut found = Vec::new();
            assert_eq!(decode(bytes, &mut found), None);
            let notes = found[0].notes.first().map_or("", String::as_str);
            let place = found[0].primary.as_ref().map_or(0..0, |label| label.span.range());
            (format!("{}; {notes}", found[0].message), place)
        };
        for (bytes, expected) in [
            (&b"\xFF\xFE\0\0{\0\0\0"[..], "UTF-32 (little-endian)"),
            (b"\0\0\xFE\xFF\0\0\0{", "UTF-32 (big-endian)"),
            (b"{\0\0\0}\0\0\0", "UTF-32 (little-endian)"),
            (b"{\0}\0", "UTF-16 (little-endian)"),
            (b"\xFE\xFF\0{", "UTF-16 (big-endian)"),
        ] {
            assert!(told(bytes).0.contains(expected), "{bytes:?}");
        }
        assert_eq!(
            told(b"{\xC0\xAF}"),
            ("the file is not UTF-8 (byte 0xC0); this is an overlong form, which UTF-8 does not allow".into(), 1..2)
        );
        assert!(told(b"{\xED\xA0\xBD}").0.contains("CESU-8"));
        assert!(told(b"{\xF4\x90\x80\x80}").0.contains("U+10FFFF"));
        assert!(told(b"{\xC0 caf\xE9}").0.contains("`\u{c0}`"), "a letter of Latin-1");
        assert_eq!(told(b"{\xE7\x81"), ("the file ends in the middle of a character; ".into(), 1..3));
    }

    #[test]
    fn one_mark_is_skipped_and_two_are_refused() {
        let mut found = Vec::new();
        assert_eq!(decode_marked(b"\xEF\xBB\xBFx", &mut found), Some("x"));
        assert!(found.is_empty());
        assert_eq!(decode_marked(b"\xEF\xBB\xBF\xEF\xBB\xBFx", &mut found), None);
        assert!(found[0].is_error());
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
