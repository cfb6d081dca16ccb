//! Events and meta without diagnostics, so that each string is checked only once.

use crate::check::emotions::{self, Feeling};
use crate::check::{events, gestures};
use crate::project::Options;
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};
use lipz_file::text;
use memchr::memchr2;

/// The maximum number of strings of a kind to remember, because games repeat few strings often.
const MOST_KNOWN: usize = 1 << 12;

/// The strings that a thread has found clean. They do not have diagnostics, and do not become curves, except for
/// emotions in events.
pub(super) struct CleanStrings {
    /// Events, with their emotions.
    events: HashMap<Box<str>, Box<[Feeling]>>,
    metas: HashSet<Box<str>>,
    /// A buffer for a text without its meta.
    shown: String,
}

impl CleanStrings {
    pub(super) fn new() -> CleanStrings {
        CleanStrings { events: HashMap::new(), metas: HashSet::new(), shown: String::new() }
    }

    /// Whether the events of a segment are clean. Passes their emotions to `each`.
    pub(super) fn has_events(&mut self, segment: &str, options: &Options, each: impl FnMut(&Feeling)) -> bool {
        if segment.is_empty() {
            return true;
        }
        if let Some(feelings) = self.events.get(segment) {
            feelings.iter().for_each(each);
            return true;
        }
        let is_clean = events::is_clean(segment, options)
            && emotions::is_clean(segment, options)
            && !gestures::are_in_events(segment);
        if is_clean {
            let feelings = emotions::feelings_of(segment, options);
            feelings.iter().for_each(each);
            if self.events.len() < MOST_KNOWN {
                self.events.insert(segment.into(), feelings.into());
            }
        }
        is_clean
    }

    /// Returns the displayed part of a segment with braces, or `None` if a brace is not part of clean meta: unpaired,
    /// or nested.
    pub(super) fn without_meta(&mut self, segment: &str, options: &Options) -> Option<&str> {
        self.shown.clear();
        let brace = |text: &str| memchr2(b'{', b'}', text.as_bytes());
        let mut rest = segment;
        while let Some(start) = brace(rest) {
            let meta = &rest[start..];
            let meta = &meta[..=1 + brace(&meta[1..])?];
            if !meta.starts_with('{') || !meta.ends_with('}') || !self.has_meta(meta, options) {
                return None;
            }
            text::push_after_meta(&mut self.shown, &rest[..start]);
            rest = &rest[start + meta.len()..];
        }
        text::push_after_meta(&mut self.shown, rest);
        Some(text::trim(&self.shown))
    }

    /// Whether meta, including its braces, is clean. The result is remembered because the check for names of emotions
    /// takes longer than reading a file.
    fn has_meta(&mut self, meta: &str, options: &Options) -> bool {
        known_or(&mut self.metas, meta, || !emotions::are_in_text(meta, options))
    }
}

/// Whether a string is clean. Clean strings are remembered.
fn known_or(known: &mut HashSet<Box<str>>, string: &str, is_clean: impl FnOnce() -> bool) -> bool {
    if known.contains(string) {
        return true;
    }
    let is_clean = is_clean();
    if is_clean && known.len() < MOST_KNOWN {
        known.insert(string.into());
    }
    is_clean
}
