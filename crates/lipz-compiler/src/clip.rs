//! A checked clip: what a Lipz file means, free of how it is written.

use lipz_bank::{Fps, VisemeType};
use std::ops::Range;

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
    /// The runs of all texts.
    pub(crate) runs: Vec<u8>,
    /// Trimmed event strings of all segments, if the file has an `events` element.
    pub(crate) events: Option<Vec<Box<str>>>,
    /// What the above lost of the file; see `source_record`. Empty when stripped.
    pub(crate) source: Vec<u8>,
}

/// The display texts of a clip in one locale: a run of the text pool.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct ClipText {
    /// The locale, `en-us`.
    pub(crate) locale: Box<str>,
    /// Where the run lies in `ClipData::runs`. A file, and so its texts, has less than 2²⁸ bytes.
    place: Range<u32>,
    /// Whether ends have four bytes instead of two.
    pub(crate) is_wide: bool,
}

/// The largest end that two bytes of 7 bits hold.
const MAX_NARROW_END: usize = (1 << 14) - 1;

impl ClipData {
    /// Makes room for so many texts with so many bytes.
    pub(crate) fn reserve_texts(&mut self, count: usize, bytes: usize) {
        self.texts.reserve_exact(count);
        self.runs.reserve(bytes);
    }

    /// Adds the display texts of a locale: a table of ends, then the texts.
    pub(crate) fn add_texts<T: AsRef<str>>(&mut self, locale: Box<str>, texts: &[T]) {
        let total: usize = texts.iter().map(|text| text.as_ref().len()).sum();
        let is_wide = total > MAX_NARROW_END;
        let start = self.runs.len() as u32;
        let mut end = 0;
        for text in texts {
            end += text.as_ref().len();
            let seven_bits = |index: u32| (end >> (7 * index)) as u8 & 0x7F;
            if is_wide {
                self.runs.extend_from_slice(&[0, 1, 2, 3].map(seven_bits));
            } else {
                self.runs.extend_from_slice(&[0, 1].map(seven_bits));
            }
        }
        for text in texts {
            self.runs.extend_from_slice(text.as_ref().as_bytes());
        }
        self.texts.push(ClipText { locale, place: start..self.runs.len() as u32, is_wide });
    }

    /// The run of one of the clip's texts.
    pub(crate) fn run(&self, text: &ClipText) -> &[u8] {
        &self.runs[text.place.start as usize..text.place.end as usize]
    }

    /// Bytes of the display texts alone, without the table of ends.
    pub(crate) fn text_bytes(&self, text: &ClipText) -> usize {
        self.run(text).len() - self.starts.len() * if text.is_wide { 4 } else { 2 }
    }
}
