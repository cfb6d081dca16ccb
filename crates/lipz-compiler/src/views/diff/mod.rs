//! The differences that a program would notice between two dialogues.
//!
//! It compares the answers of the reader: frame rates, frames, segments, display texts, events, curves, locales, babble
//! and face profiles, voices. It ignores the spelling of the source files, and whether a bank contains source records.

mod bank;
mod change;
mod clip;
#[cfg(feature = "json")]
mod json;
#[cfg(feature = "json")]
mod json_fields;
mod locale_pair;
mod renamed_clip;
mod voices;

pub use bank::{BabbleChange, FaceChange, FallbackChange};
pub use change::Change;
pub use clip::{ClipChange, CurveChange, EventChange, FramesChange, TextChange};
pub use renamed_clip::RenamedClip;
pub use voices::DubChange;

use crate::bank::dialogue::{TaggedLocale, clips_by_key, locales_by_tag};
use lipz_bank::{Clip, Dialogue};
use locale_pair::LocalePair;

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
    /// Locales whose clips borrow texts from different locales than before.
    pub fallbacks: Vec<FallbackChange<'d>>,
    /// Babble profiles that differ, sorted by name.
    pub babble: Vec<BabbleChange<'d>>,
    /// The voices, with that of the originals first, if they differ.
    pub voices: Option<Change<Vec<&'d str>>>,
    /// Lines that play a different clip in a voice that both banks have.
    pub dubs: Vec<DubChange<'d>>,
    /// Face profiles that differ, sorted by name.
    pub faces: Vec<FaceChange<'d>>,
    /// Names of articulation profiles that differ, or that only one bank has, sorted.
    pub articulation: Vec<&'d str>,
    /// Names of rigs that differ, or that only one bank has, sorted.
    pub rigs: Vec<&'d str>,
    /// Keys of clips that only the new bank has.
    pub added: Vec<&'d str>,
    /// Keys of clips that only the old bank has.
    pub removed: Vec<&'d str>,
    /// Clips that differ only in their keys. They are not among the added and removed ones.
    pub renamed: Vec<RenamedClip<'d>>,
    /// Clips in both banks that differ.
    pub changed: Vec<ClipChange<'d>>,
    /// The number of clips in both banks that do not differ.
    pub same: usize,
}

impl Difference<'_> {
    /// Whether there are no differences.
    pub fn is_empty(&self) -> bool {
        let locales = self.added_locales.len() + self.removed_locales.len() + self.fallbacks.len();
        let clips = self.added.len() + self.removed.len() + self.renamed.len() + self.changed.len();
        let profiles = self.babble.len() + self.faces.len() + self.articulation.len() + self.rigs.len();
        locales + profiles + self.dubs.len() + clips == 0 && self.default_locale.is_none() && self.voices.is_none()
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
        articulation: bank::articulation(old, new),
        rigs: bank::rigs(old, new),
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
    renamed_clip::find(&mut difference, old, new, &locales);
    difference
}

#[cfg(test)]
mod tests;
