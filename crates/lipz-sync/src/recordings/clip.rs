//! The parts of a Lipz file that concern recordings: its visemes, its rate, its spoken text.

use lipz_compiler::Options;
use lipz_file::text::{DELIMITER, is_white_space};
use lipz_file::{Document, JsonString, Value, rate};
use lipz_types::{Fps, VisemeType};

/// The visemes of a Lipz file. Invalid parts are missing, because the check of Lipz files reports them.
pub(crate) struct ClipMouth<'d> {
    /// The value of `visemes`.
    pub(crate) visemes: Option<&'d JsonString<'d>>,
    /// Its codes, without `|`.
    pub(crate) codes: Vec<u8>,
    /// The frame rate, from the file or the project's default.
    pub(crate) fps: Option<Fps>,
}

impl<'d> ClipMouth<'d> {
    pub(crate) fn from_document(document: &'d Document<'d>, options: &Options) -> ClipMouth<'d> {
        let visemes = string(document, "visemes");
        let codes = |string: &JsonString<'_>| {
            let is_code = |code: &char| *code != DELIMITER && !is_white_space(*code);
            string.text.chars().filter(is_code).map(|code| u8::try_from(code).unwrap_or(b'?')).collect()
        };
        let fps = match document.get("fps").map(|element| &element.value) {
            Some(Value::Number(number)) => {
                rate::parse(&number.text).and_then(|rate| Fps::new(rate.numerator, rate.denominator))
            }
            _ => options.get_default_fps(),
        };
        ClipMouth { visemes, codes: visemes.map(codes).unwrap_or_default(), fps }
    }

    /// Returns the time from the start of the first frame to the end of the last; `None` without a frame rate.
    pub(crate) fn length_us(&self) -> Option<u64> {
        Some(self.fps?.start_of_frame_us(u32::try_from(self.codes.len()).ok()?))
    }
}

/// Returns the viseme type that a Lipz file states.
pub(crate) fn own_type(document: &Document<'_>) -> Option<VisemeType> {
    string(document, "viseme_type").and_then(|name| name.text.parse().ok())
}

/// Returns the string element with this name.
pub(crate) fn string<'d>(document: &'d Document<'d>, name: &str) -> Option<&'d JsonString<'d>> {
    match &document.get(name)?.value {
        Value::String(string) => Some(string),
        _ => None,
    }
}
