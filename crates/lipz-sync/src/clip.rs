//! A Lipz file as far as recordings are concerned: its mouth, its rate, what is spoken.

use lipz_compiler::Options;
use lipz_file::text::{DELIMITER, is_white_space};
use lipz_file::{Document, JsonString, Value, rate};
use lipz_types::Fps;

/// What a Lipz file says about its mouth. Errors in it are for the check of Lipz files: what is wrong is not there.
pub(crate) struct Clip<'d> {
    /// The value of `visemes`.
    pub(crate) visemes: Option<&'d JsonString<'d>>,
    /// Its codes, without `|`.
    pub(crate) codes: Vec<u8>,
    /// The frame rate, of the file or the project's default.
    pub(crate) fps: Option<Fps>,
}

impl<'d> Clip<'d> {
    pub(crate) fn from_document(document: &'d Document<'d>, options: &Options) -> Clip<'d> {
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
        Clip { visemes, codes: visemes.map(codes).unwrap_or_default(), fps }
    }

    /// The time from the start of the first frame to the end of the last; `None` without a frame rate.
    pub(crate) fn length_us(&self) -> Option<u64> {
        Some(self.fps?.start_of_frame_us(u32::try_from(self.codes.len()).ok()?))
    }
}

/// The string element with this name.
pub(crate) fn string<'d>(document: &'d Document<'d>, name: &str) -> Option<&'d JsonString<'d>> {
    match &document.get(name)?.value {
        Value::String(string) => Some(string),
        _ => None,
    }
}
