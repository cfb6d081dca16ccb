//! Frame codes: white space and delimiters taken out, the rest checked against the viseme type.

mod foreign;
mod instead;
mod tally;
mod type_name;

pub(super) use instead::DELIMITER_LOOKALIKES;
pub(super) use type_name::viseme_type;

use lipz::{Code, Diagnostic, JsonString};
use lipz_bank::VisemeType;

/// What the codes are checked against.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Expected {
    /// The type that the file names.
    Named(VisemeType),
    /// The default type of the project.
    Default(VisemeType),
    /// No type is given: the codes must fit one of them.
    Any,
    /// The type is wrong and reported: the codes are not checked.
    Unknown,
}

/// Frame codes without delimiters and white space, and the start frame of each segment.
pub(super) fn frames(
    string: &JsonString<'_>,
    expected: Expected,
    diagnostics: &mut Vec<Diagnostic>,
) -> (Vec<u8>, Vec<u32>) {
    let mut frames = Vec::with_capacity(string.text.len());
    let mut starts = vec![0];
    let mut has_white_space = false;
    for &byte in string.text.as_bytes() {
        match byte {
            // A source file has less than 2²⁸ bytes.
            b'|' => starts.push(u32::try_from(frames.len()).unwrap_or(u32::MAX)),
            b' ' | b'\t' | b'\n' | b'\r' => has_white_space = true,
            code => frames.push(code),
        }
    }
    if has_white_space {
        diagnostics.extend(white_space(string));
    }
    let legal = match expected {
        Expected::Named(viseme_type) | Expected::Default(viseme_type) => viseme_type.contains_all(&frames),
        Expected::Any => VisemeType::ALL.iter().any(|viseme_type| viseme_type.contains_all(&frames)),
        Expected::Unknown => true,
    };
    if !legal {
        foreign::report(string, expected, diagnostics);
    }
    (frames, starts)
}

fn white_space(string: &JsonString<'_>) -> Option<Diagnostic> {
    let is_white_space = |c: char| matches!(c, ' ' | '\t' | '\n' | '\r');
    let start = string.text.find(is_white_space)?;
    let length = string.text[start..].find(|c| !is_white_space(c)).unwrap_or(string.text.len() - start);
    let count = string.text.chars().filter(|&c| is_white_space(c)).count();
    let finding = Diagnostic::at(
        Code::WhiteSpaceInVisemes,
        string.span_of(start..start + length),
        "white space between viseme codes is no frame and is ignored",
    )
    .help("remove it; write `-` for a frame at rest");
    Some(if count > length { finding.note(format!("{count} characters of white space in all")) } else { finding })
}
