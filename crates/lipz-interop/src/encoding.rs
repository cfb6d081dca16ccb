//! Texts in legacy encodings, which tools wrote before UTF-8 was common.

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};
use lipz_diagnostics::{Code, Diagnostic};
use std::borrow::Cow;

/// Converts the bytes of a text to UTF-8. Spans of its diagnostics refer to the result.
///
/// UTF-8 stays unchanged, and UTF-16 is detected. Any other text is read in `encoding`. Without one, it is read as
/// Windows-1252 with a diagnostic if `guess` states that its tool uses the encoding of the system; otherwise it stays
/// unchanged, and the reader rejects it. UTF-8 is never read in a different `encoding`; a diagnostic reports the
/// mismatch.
///
/// ```
/// use lipz_interop::{Encoding, to_utf8};
/// let mut diagnostics = Vec::new();
/// let text = to_utf8(b"\xC4\xE0.", Encoding::for_label(b"windows-1251"), false, &mut diagnostics);
/// assert_eq!((&*text, diagnostics.len()), ("Да.".as_bytes(), 0));
/// assert_eq!(&*to_utf8("Да.".as_bytes(), Encoding::for_label(b"windows-1251"), false, &mut diagnostics), "Да.".as_bytes());
/// assert_eq!(diagnostics.len(), 1);
/// ```
pub fn to_utf8<'b>(
    bytes: &'b [u8],
    encoding: Option<&'static Encoding>,
    guess: bool,
    diagnostics: &mut Vec<Diagnostic>,
) -> Cow<'b, [u8]> {
    let named = encoding.filter(|named| *named != UTF_8);
    let read = match wide(bytes) {
        Some(wide) => wide,
        None if std::str::from_utf8(bytes).is_ok() => {
            let is_other = named.filter(|named| !bytes.is_ascii() && *named != UTF_16LE && *named != UTF_16BE);
            diagnostics.extend(is_other.map(|named| {
                Diagnostic::new(Code::ForeignOddity, format!("the file is UTF-8, not {}", named.name()))
                    .note("it is read as UTF-8")
                    .help("remove the encoding for UTF-8 files")
            }));
            return Cow::Borrowed(bytes);
        }
        None => match named {
            Some(named) => named,
            None if guess && encoding.is_none() => {
                diagnostics.push(
                    Diagnostic::new(Code::ForeignOddity, "the file is not UTF-8 and is read as Windows-1252")
                        .note("Windows-1252 includes Latin-1; older tools write in the encoding of their system")
                        .help("name the encoding, such as windows-1251 or shift_jis, if letters are wrong"),
                );
                WINDOWS_1252
            }
            None => return Cow::Borrowed(bytes),
        },
    };
    let (text, _, has_errors) = read.decode(bytes);
    if has_errors {
        let message = format!("some characters of the file are not {}", read.name());
        diagnostics.push(
            Diagnostic::new(Code::ForeignOddity, message)
                .note("they are replaced by U+FFFD")
                .help("check the encoding of the file, and whether the file is complete"),
        );
    }
    Cow::Owned(text.into_owned().into_bytes())
}

/// Detects UTF-16 by its byte order mark, or by the zero byte next to its first character.
fn wide(bytes: &[u8]) -> Option<&'static Encoding> {
    match bytes {
        [0xFF, 0xFE, 0, 0, ..] | [_, 0, 0, 0, ..] | [0, 0, ..] => None, // UTF-32, or no text
        [0xFF, 0xFE, ..] | [1..=0x7F, 0, ..] => Some(UTF_16LE),
        [0xFE, 0xFF, ..] | [0, 1..=0x7F, ..] => Some(UTF_16BE),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(bytes: &[u8], encoding: &str, guess: bool) -> (String, usize) {
        let mut diagnostics = Vec::new();
        let text = to_utf8(bytes, Encoding::for_label(encoding.as_bytes()), guess, &mut diagnostics);
        (String::from_utf8_lossy(&text).into_owned(), diagnostics.len())
    }

    #[test]
    fn texts_of_every_time() {
        let utf16 = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<u8>>();
        assert_eq!(read("né".as_bytes(), "", true), ("né".into(), 0));
        assert_eq!(read(b"n\xE9", "", true), ("né".into(), 1), "a guess is told");
        assert_eq!(read(b"n\xE9", "", false), ("n\u{fffd}".into(), 0), "a reader refuses it");
        assert_eq!(read(b"n\xE9", "windows-1252", false), ("né".into(), 0));
        assert_eq!(read(&utf16("\u{feff}né"), "", false), ("né".into(), 0));
        assert_eq!(read(&utf16("né"), "windows-1251", false), ("né".into(), 0));
        assert_eq!(read(&[0xFE, 0xFF, 0, b'a'], "", false), ("a".into(), 0));
        assert_eq!(read("né".as_bytes(), "shift_jis", false), ("né".into(), 1), "it is UTF-8");
        assert_eq!(read(b"ne", "shift_jis", false), ("ne".into(), 0));
        assert_eq!(read(b"\x81\xFF.", "shift_jis", false).1, 1, "no character");
        assert_eq!(read(&[0xFF, 0xFE, 0, 0, b'a', 0, 0, 0], "", true).1, 1);
    }
}
