//! A checked clip: what a Lipz file means, free of how it is written.

mod locales;
mod packed;
mod run;
mod store;

pub(crate) use locales::Locales;
pub(crate) use run::run;
pub(crate) use store::{Clip, Clips};

use crate::hashed::hash;
use crate::strings::Strings;
use lipz_bank::{Fps, VisemeType};
use std::ops::Range;

/// One clip as the check makes it. A thread fills the same one for all of its files, so that its
/// buffers are made once, and adds it to its [`Clips`].
#[derive(Debug, Default)]
pub(crate) struct ClipData {
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
    /// Texts in the order of their locales' tags.
    pub(crate) texts: Vec<ClipText>,
    /// The runs of all texts.
    pub(crate) runs: Vec<u8>,
    /// Room for the display texts of one locale, before they become a run.
    pub(crate) displays: Strings,
    /// Whether the file has an `events` element.
    pub(crate) has_events: bool,
    /// Trimmed event strings of all segments, if it has.
    pub(crate) events: Strings,
    /// Whether an element has another number of segments than the clip, and was joined to one.
    pub(crate) has_joined: bool,
    /// What the above lost of the file; see `source_record`. Empty when stripped.
    pub(crate) source: Vec<u8>,
}

/// The display texts of a clip in one locale: a run of the text pool.
#[derive(Clone, Debug)]
pub(crate) struct ClipText {
    /// Number of the locale in [`Locales`].
    pub(crate) locale: u32,
    /// Where the run lies among the clip's. A file, and so its texts, has less than 2²⁸ bytes.
    place: Range<u32>,
    /// Whether ends have four bytes instead of two.
    pub(crate) is_wide: bool,
    /// Whether it is the text of another locale, which is not packed.
    pub(crate) is_fallback: bool,
    /// Hash of the run: made while it is in the cache.
    pub(crate) hash: u64,
}

/// The largest end that two bytes of 7 bits hold.
const MAX_NARROW_END: usize = (1 << 14) - 1;

impl ClipData {
    /// Makes it a clip of nothing, and keeps its buffers.
    pub(crate) fn clear(&mut self) {
        self.frames.clear();
        self.starts.clear();
        self.texts.clear();
        self.runs.clear();
        self.displays.clear();
        self.events.clear();
        self.source.clear();
        (self.has_visemes, self.has_events, self.has_joined) = (false, false, false);
        (self.fps, self.viseme_type) = (None, None);
    }

    /// Adds `self.displays` as the texts of a locale: a table of ends, then the texts.
    pub(crate) fn add_displays(&mut self, locale: u32) {
        let is_wide = self.displays.text().len() > MAX_NARROW_END;
        let start = self.runs.len() as u32;
        for end in self.displays.ends() {
            let seven_bits = |index: u32| (end >> (7 * index)) as u8 & 0x7F;
            if is_wide {
                self.runs.extend_from_slice(&[0, 1, 2, 3].map(seven_bits));
            } else {
                self.runs.extend_from_slice(&[0, 1].map(seven_bits));
            }
        }
        self.runs.extend_from_slice(self.displays.text().as_bytes());
        self.add_text(locale, start, is_wide, false);
    }

    /// Adds a run as the texts of a locale.
    pub(crate) fn add_run(&mut self, locale: u32, run: &[u8], is_wide: bool, is_fallback: bool) {
        let start = self.runs.len() as u32;
        self.runs.extend_from_slice(run);
        self.add_text(locale, start, is_wide, is_fallback);
    }

    /// Adds what stands in `runs` from `start` on as the texts of a locale.
    fn add_text(&mut self, locale: u32, start: u32, is_wide: bool, is_fallback: bool) {
        let hash = hash(&self.runs[start as usize..]);
        let place = start..self.runs.len() as u32;
        self.texts.push(ClipText { locale, place, is_wide, is_fallback, hash });
    }

    /// Bytes of the display texts alone, without the table of ends.
    pub(crate) fn text_bytes(&self, text: &ClipText) -> usize {
        text.place.len() - self.starts.len() * if text.is_wide { 4 } else { 2 }
    }
}
