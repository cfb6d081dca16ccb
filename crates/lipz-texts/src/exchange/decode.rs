//! Decoding of files: UTF-8, UTF-16, and the encoding that a file names.

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE};
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use std::borrow::Cow;

/// The first bytes of archives, such as `.xlsx` and `.ods` files.
const ZIP: &[u8] = b"PK\x03\x04";

/// The greatest size of a file in bytes, as for Lipz files.
const MAX_BYTES: usize = lipz_file::MAX_FILE_BYTES;

/// Returns the text of a file without a byte order mark, or `None` with a diagnostic if it cannot be decoded. `named`
/// is the encoding that the file names, by its label in the WHATWG Encoding Standard.
pub(crate) fn text<'b>(
    bytes: &'b [u8],
    named: Option<&[u8]>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Cow<'b, str>> {
    if bytes.len() > MAX_BYTES {
        diagnostics.push(Diagnostic::new(Code::FileTooLarge, Code::FileTooLarge.summary()).help("split the file"));
        return None;
    }
    if bytes.starts_with(ZIP) {
        let found = Diagnostic::new(Code::ExchangeSyntax, "the file is a spreadsheet or an archive, despite its name");
        diagnostics.push(found.help("name it after its format, such as .xlsx or .ods, or save it as text"));
        return None;
    }
    if let Some(label) = named.filter(|label| wide(bytes).is_none() && !is_known(label)) {
        let label = escape::quoted(&String::from_utf8_lossy(label)).to_string();
        let message = format!("the file states the unknown encoding {label}");
        diagnostics.push(Diagnostic::new(Code::NotUtf8, message).help("save it as UTF-8"));
        return None;
    }
    let encoding = wide(bytes).or_else(|| Encoding::for_label(named?)).filter(|encoding| *encoding != UTF_8);
    let Some(encoding) = encoding else { return lipz_file::decode_marked(bytes, diagnostics).map(Cow::Borrowed) };
    let (text, has_errors) = encoding.decode_with_bom_removal(bytes);
    if has_errors {
        let message = format!("the file is not {}, the encoding that it states", encoding.name());
        diagnostics.push(Diagnostic::new(Code::NotUtf8, message).help("save it as UTF-8"));
        return None;
    }
    Some(text)
}

/// Whether a label is that of an encoding, or missing. Templates of gettext have `CHARSET` in its place.
fn is_known(label: &[u8]) -> bool {
    label.is_empty() || label == b"CHARSET" || Encoding::for_label(label).is_some()
}

/// Returns a readable form of undecodable bytes, in which positions stay the same.
pub(crate) fn readable(bytes: &[u8]) -> String {
    Report::from_bytes("", bytes, Vec::new()).source.text
}

/// Detects UTF-16 by its byte order mark.
fn wide(bytes: &[u8]) -> Option<&'static Encoding> {
    match bytes {
        [0xFF, 0xFE, 0, 0, ..] => None, // UTF-32
        [0xFF, 0xFE, ..] => Some(UTF_16LE),
        [0xFE, 0xFF, ..] => Some(UTF_16BE),
        _ => None,
    }
}

/// Returns the bytes after `before` near the start of a file, as far as they can be the label of an encoding.
pub(crate) fn label<'b>(bytes: &'b [u8], before: &[u8]) -> Option<&'b [u8]> {
    /// The number of bytes that are searched for a header.
    const HEAD: usize = 4096;
    let head = bytes.get(..HEAD).unwrap_or(bytes);
    let start = head.windows(before.len()).position(|window| window.eq_ignore_ascii_case(before))? + before.len();
    let rest = head.get(start..)?;
    let is_part = |byte: &u8| byte.is_ascii_alphanumeric() || matches!(byte, b'-' | b'_' | b':' | b'.');
    rest.get(..rest.iter().position(|byte| !is_part(byte)).unwrap_or(rest.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_encoding_is_refused() {
        let read = |label: &'static str| {
            let mut found = Vec::new();
            let text = text(b"caf\xe9", Some(label.as_bytes()), &mut found).map(Cow::into_owned);
            (text, found.into_iter().map(|found| found.message).collect::<Vec<_>>())
        };
        assert_eq!(read("latin1"), (Some("café".to_owned()), Vec::new()));
        assert_eq!(read("KLINGON"), (None, vec!["the file states the unknown encoding `KLINGON`".to_owned()]));
        let mut found = Vec::new();
        assert_eq!(text(b"Hi", Some(b"CHARSET"), &mut found).as_deref(), Some("Hi"), "a template of gettext");
    }
}
