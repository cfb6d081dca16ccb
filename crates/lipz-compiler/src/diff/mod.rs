//! What a program would notice if one dialogue took the place of another.
//!
//! Compared is what the reader answers: frame rates, frames, segments, display texts, events, curves, locales,
//! babble and face profiles, voices. How the source files were spelled, and whether a bank keeps them, makes no
//! difference.

mod bank;
mod clip;
#[cfg(feature = "json")]
mod json;
mod renamed;
mod voices;

pub use bank::{BabbleChange, FaceChange, FallbackChange};
pub use clip::{ClipChange, CurveChange, EventChange, FramesChange, TextChange};
pub use renamed::Renamed;
pub use voices::DubChange;

use crate::dialogue::{TaggedLocale, clips_by_key, locales_by_tag};
use lipz_bank::{Clip, Dialogue, Locale};
use std::collections::BTreeMap;

/// An old value and the new one.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct Change<T> {
    /// In the old bank.
    pub old: T,
    /// In the new bank.
    pub new: T,
}

impl<T: PartialEq> Change<T> {
    /// The change, if there is one.
    fn between(old: T, new: T) -> Option<Change<T>> {
        (old != new).then_some(Change { old, new })
    }
}

impl<T> Change<T> {
    /// The change of what a function says about both values.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Change<U> {
        Change { old: f(self.old), new: f(self.new) }
    }
}

/// The differences of two dialogues, here called banks. Keys and locale tags are sorted.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct Difference<'d> {
    /// Locales that only the new bank has.
    pub added_locales: Vec<&'d str>,
    /// Locales that only the old bank has.
    pub removed_locales: Vec<&'d str>,
    /// The default locales, if they differ.
    pub default_locale: Option<Change<Option<&'d str>>>,
    /// Locales whose clips borrow texts from others than before.
    pub fallbacks: Vec<FallbackChange<'d>>,
    /// Babble profiles that differ, sorted by name.
    pub babble: Vec<BabbleChange<'d>>,
    /// The voices, that of the originals first, if the banks do not have the same.
    pub voices: Option<Change<Vec<&'d str>>>,
    /// Lines that are played by other clips in a voice that both banks have.
    pub dubs: Vec<DubChange<'d>>,
    /// Face profiles that differ, sorted by name.
    pub faces: Vec<FaceChange<'d>>,
    /// Keys of clips that only the new bank has.
    pub added: Vec<&'d str>,
    /// Keys of clips that only the old bank has.
    pub removed: Vec<&'d str>,
    /// Clips that are the same but for their keys. They are not among the added and removed ones.
    pub renamed: Vec<Renamed<'d>>,
    /// Clips that both banks have, and that differ.
    pub changed: Vec<ClipChange<'d>>,
    /// Number of clips that both banks have, and that do not differ.
    pub same: usize,
}

impl Difference<'_> {
    /// Whether the banks say the same.
    pub fn is_empty(&self) -> bool {
        let locales = self.added_locales.len() + self.removed_locales.len() + self.fallbacks.len();
        let clips = self.added.len() + self.removed.len() + self.renamed.len() + self.changed.len();
        locales + self.babble.len() + self.faces.len() + self.dubs.len() + clips == 0
            && self.default_locale.is_none()
            && self.voices.is_none()
    }
}

/// Compares two verified dialogues.
///
/// ```
/// use lipz_bank::Dialogue;
/// use lipz_bank::files::DialogueFile;
/// use lipz_compiler::{Compiler, Input, diff};
/// let pack = |text| Compiler::default().compile(&[Input::from_bytes("aye", text)]).bank;
/// let old = pack(r#"{ "text_en-us": "Aye." }"#).ok_or("no bank")?;
/// let new = pack(r#"{ "text_en-us": "Aye, aye." }"#).ok_or("no bank")?;
/// let mut files = [[DialogueFile::ABSENT]; 2];
/// let [old_files, new_files] = &mut files;
/// let old = Dialogue::open(old_files, [old.as_slice()])?;
/// let new = Dialogue::open(new_files, [new.as_slice()])?;
/// let difference = diff::diff(&old, &new);
/// assert_eq!(difference.changed[0].texts[0].text.new, Some("Aye, aye."));
/// assert!(diff::diff(&old, &old).is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn diff<'d>(old: &'d Dialogue<'d>, new: &'d Dialogue<'d>) -> Difference<'d> {
    let (old_locales, new_locales) = (locales_by_tag(old), locales_by_tag(new));
    let locales = LocalePair::all(&old_locales, &new_locales);
    let only_in = |other: fn(&LocalePair<'d>) -> bool| {
        let tags = locales.iter().filter(|pair| other(pair)).map(|pair| pair.tag);
        tags.collect::<Vec<_>>()
    };
    let default = |locales: &[TaggedLocale<'d>]| locales.iter().find(|locale| locale.is_default).map(|found| found.tag);
    let mut difference = Difference {
        added_locales: only_in(|pair| pair.old.is_none()),
        removed_locales: only_in(|pair| pair.new.is_none()),
        default_locale: Change::between(default(&old_locales), default(&new_locales)),
        fallbacks: bank::fallbacks(old, new, &locales),
        babble: bank::babble(old, new),
        voices: Change::between(voices::tags(old), voices::tags(new)),
        dubs: voices::dubs(old, new),
        faces: bank::faces(old, new),
        ..Difference::default()
    };
    for clip in clips_by_key(old) {
        match new.clip_by_key(clip.key()).map(|other| ClipChange::between(&clip, &other, &locales)) {
            None => difference.removed.push(clip.key()),
            Some(None) => difference.same += 1,
            Some(Some(change)) => difference.changed.push(change),
        }
    }
    let new_clips = clips_by_key(new);
    let added = new_clips.iter().filter(|clip| old.clip_by_key(clip.key()).is_none());
    difference.added = added.map(Clip::key).collect();
    renamed::find(&mut difference, old, new, &locales);
    difference
}

/// One locale in both banks.
struct LocalePair<'d> {
    tag: &'d str,
    old: Option<Locale>,
    new: Option<Locale>,
}

impl<'d> LocalePair<'d> {
    /// The locales of either bank, sorted.
    fn all(old: &[TaggedLocale<'d>], new: &[TaggedLocale<'d>]) -> Vec<LocalePair<'d>> {
        let mut pairs: BTreeMap<&str, LocalePair<'d>> = BTreeMap::new();
        let absent = |tag| LocalePair { tag, old: None, new: None };
        for locale in old {
            pairs.entry(locale.tag).or_insert_with_key(|tag| absent(tag)).old = Some(locale.locale);
        }
        for locale in new {
            pairs.entry(locale.tag).or_insert_with_key(|tag| absent(tag)).new = Some(locale.locale);
        }
        pairs.into_values().collect()
    }
}

#[cfg(test)]
mod tests;
