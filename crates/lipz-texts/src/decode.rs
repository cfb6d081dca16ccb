//! From bytes to text: UTF-8, UTF-16, and the encoding that a file names.

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE};
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::borrow::Cow;

/// Longest file that is read, in bytes: that of Lipz files.
const MAX_BYTES: usize = lipz_file::MAX_FILE_BYTES;

/// The text of a file without a byte order mark: `named` is the encoding that it names itself, by the label of the web's
/// standard. `None` and the reason if it has none.
pub(crate) fn text<'b>(
    bytes: &'b [u8],
    named: Option<&[u8]>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Cow<'b, str>> {
    if bytes.len() > MAX_BYTES {
        diagnostics.push(Diagnostic::new(Code::FileTooLarge, Code::FileTooLarge.summary()).help("divide it"));
        return None;
    }
    let encoding = wide(bytes).or_else(|| Encoding::for_label(named?)).filter(|encoding| *encoding != UTF_8);
    let Some(encoding) = encoding else { return lipz_file::decode_marked(bytes, diagnostics).map(Cow::Borrowed) };
    let (text, has_errors) = encoding.decode_with_bom_removal(bytes);
    if has_errors {
        let message = format!("the file is not {}, as it says", encoding.name());
        diagnostics.push(Diagnostic::new(Code::NotUtf8, message).help("save it as UTF-8"));
        return None;
    }
    Some(text)
}

/// Bytes that have no text, so that all places stay where they are.
pub(crate) fn readable(bytes: &[u8]) -> String {
    Report::from_bytes("", bytes, Vec::new()).source.text
}

/// UTF-16, by its byte order mark.
fn wide(bytes: &[u8]) -> Option<&'static Encoding> {
    match bytes {
        [0xFF, 0xFE, 0, 0, ..] => None, // UTF-32
        [0xFF, 0xFE, ..] => Some(UTF_16LE),
        [0xFE, 0xFF, ..] => Some(UTF_16BE),
        _ => None,
    }
}

/// What stands behind `before` in the first bytes of a file, as far as it can be the label of an encoding.
pub(crate) fn label<'b>(bytes: &'b [u8], before: &[u8]) -> Option<&'b [u8]> {
    /// Bytes in which a header is looked for.
    const HEAD: usize = 4096;
    let head = bytes.get(..HEAD).unwrap_or(bytes);
    let start = head.windows(before.len()).position(|window| window.eq_ignore_ascii_case(before))? + before.len();
    let rest = head.get(start..)?;
    let is_part = |byte: &u8| byte.is_ascii_alphanumeric() || matches!(byte, b'-' | b'_' | b':' | b'.');
    rest.get(..rest.iter().position(|byte| !is_part(byte)).unwrap_or(rest.len()))
}
