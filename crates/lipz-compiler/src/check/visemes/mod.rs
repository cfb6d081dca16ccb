//! The frame codes: removes white space and delimiters, and checks the codes against the viseme type.

mod instead;
mod never_opens;
mod tally;
mod type_name;
mod wrong_code;

pub(super) use instead::DELIMITER_LOOKALIKES;
pub(super) use never_opens::{CHECKS, are_legal};
pub(super) use type_name::viseme_type;

use crate::clip::ClipData;
use lipz_bank::VisemeType;
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::{JsonString, text};

/// The expected codes of a file.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum ExpectedCodes {
    /// The type that the file names.
    Named(VisemeType),
    /// The default type of the project.
    Default(VisemeType),
    /// The codes must fit one of the types because none is given.
    Any,
    /// The codes are not checked because a wrong type has been reported.
    Unknown,
}

/// Adds the frame codes, without delimiters and white space, and the start frame of each segment to the clip.
pub(super) fn frames(
    string: &JsonString<'_>,
    expected: ExpectedCodes,
    clip: &mut ClipData,
    diagnostics: &mut Vec<Diagnostic>,
) {
    // The search covers the whole string without a branch per code, because white space is rare.
    let has_white_space = string.text.bytes().fold(false, |found, byte| found | is_white_space(byte));
    text::segments(&string.text).for_each(|range| add_segment(&string.text[range], clip));
    if has_white_space {
        clip.frames.clear();
        clip.starts.clear();
        for range in text::segments(&string.text) {
            clip.starts.push(clip.frames.len() as u32);
            clip.frames.extend(string.text.as_bytes()[range].iter().filter(|code| !is_white_space(**code)));
        }
    }
    let frames = &clip.frames;
    let legal = match expected {
        ExpectedCodes::Named(viseme_type) | ExpectedCodes::Default(viseme_type) => viseme_type.contains_all(frames),
        ExpectedCodes::Any => VisemeType::ALL.iter().any(|viseme_type| viseme_type.contains_all(frames)),
        ExpectedCodes::Unknown => true,
    };
    if has_white_space {
        diagnostics.extend(white_space(string, legal));
    }
    if !legal {
        wrong_code::report(string, expected, diagnostics);
    }
}

/// Adds a segment with these codes to the clip.
pub(super) fn add_segment(codes: &str, clip: &mut ClipData) {
    clip.starts.push(clip.frames.len() as u32); // a source file has less than 2²⁸ bytes
    clip.frames.extend_from_slice(codes.as_bytes());
}

fn is_white_space(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\n' | b'\r')
}

fn white_space(string: &JsonString<'_>, codes_are_legal: bool) -> Option<Diagnostic> {
    let is_white_space = text::is_white_space;
    let start = string.text.find(is_white_space)?;
    let length = string.text[start..].find(|c| !is_white_space(c)).unwrap_or(string.text.len() - start);
    let count = string.text.chars().filter(|&c| is_white_space(c)).count();
    let mut diagnostic = Diagnostic::at(
        Code::WhiteSpaceInVisemes,
        string.span_of(start..start + length),
        "whitespace between viseme codes is ignored",
    )
    .help("remove it; write `-` for a frame at rest");
    // With illegal codes, the string may be something else, for example a text.
    if codes_are_legal {
        diagnostic = diagnostic.fix(string.span(), lipz_file::literal(&string.text.replace(is_white_space, "")));
    }
    Some(if count > length { diagnostic.note(format!("{count} whitespace characters in total")) } else { diagnostic })
}
