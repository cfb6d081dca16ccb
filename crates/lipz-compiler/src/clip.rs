//! A checked clip: what a Lipz file means, free of how it is written.

use lipz_bank::{Fps, VisemeType};

/// One clip, checked, ready to be localised and lowered.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct ClipData {
    /// Key of the clip.
    pub(crate) key: String,
    /// Frame rate, of the file or the project's default.
    pub(crate) fps: Option<Fps>,
    /// Viseme type, of the file or the project's default.
    pub(crate) viseme_type: Option<VisemeType>,
    /// Whether the file has a `visemes` element.
    pub(crate) has_visemes: bool,
    /// Frame codes, without delimiters.
    pub(crate) frames: Vec<u8>,
    /// Start frames of all segments; the first is 0.
    pub(crate) starts: Vec<u32>,
    /// Texts in the order of their locales.
    pub(crate) texts: Vec<ClipText>,
    /// Trimmed event strings of all segments, if the file has an `events` element.
    pub(crate) events: Option<Vec<Box<str>>>,
    /// What the above lost of the file; see `source_record`. Empty when stripped.
    pub(crate) source: Vec<u8>,
}

/// The display texts of a clip in one locale.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct ClipText {
    /// The locale, `en-us`.
    pub(crate) locale: Box<str>,
    /// The run of the text pool: ends, then texts.
    pub(crate) run: TextRun,
}

/// A run of the text pool: a table of ends, then the display texts of a clip's segments.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(crate) struct TextRun {
    /// The bytes of the run.
    pub(crate) bytes: Box<[u8]>,
    /// Whether ends have four bytes instead of two.
    pub(crate) is_wide: bool,
}

/// The largest end that two bytes of 7 bits hold.
const MAX_NARROW_END: usize = (1 << 14) - 1;

impl TextRun {
    /// The run for these display texts. Their lengths add up to less than 2²⁸ bytes, the limit of a
    /// source file.
    pub(crate) fn new<T: AsRef<str>>(texts: &[T]) -> TextRun {
        let total: usize = texts.iter().map(|text| text.as_ref().len()).sum();
        let is_wide = total > MAX_NARROW_END;
        let width = if is_wide { 4 } else { 2 };
        let mut bytes = Vec::with_capacity(texts.len() * width + total);
        let mut end = 0;
        for text in texts {
            end += text.as_ref().len();
            bytes.extend((0..width).map(|index| (end >> (7 * index)) as u8 & 0x7F));
        }
        for text in texts {
            bytes.extend_from_slice(text.as_ref().as_bytes());
        }
        TextRun { bytes: bytes.into_boxed_slice(), is_wide }
    }
}

impl TextRun {
    /// Bytes of the texts alone, given their number.
    pub(crate) fn text_bytes(&self, segment_count: usize) -> usize {
        self.bytes.len() - segment_count * if self.is_wide { 4 } else { 2 }
    }
}
