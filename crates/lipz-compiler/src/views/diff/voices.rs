//! The differences of voices: the clips that replace others.

use super::Change;
use crate::bank::dialogue::clips_by_key;
use lipz_bank::{Dialogue, VoiceSource};
use std::collections::BTreeSet;

/// A difference in the clip of a line in a voice that both banks have.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct DubChange<'d> {
    /// The locale of the voice.
    pub voice: &'d str,
    /// The key of the original.
    pub key: &'d str,
    /// The key of the clip that replaces it; `None` for the original.
    #[cfg_attr(feature = "json", serde(flatten))]
    pub clip: Change<Option<&'d str>>,
}

/// Returns the locales of the voices of a dialogue, with that of the originals first.
pub(super) fn tags<'d>(dialogue: &Dialogue<'d>) -> Vec<&'d str> {
    dialogue.voices().map(|voice| dialogue.voice_tag(voice)).collect()
}

/// Returns the lines that play a different clip, voice by voice, sorted by key. Clips that only one bank has are
/// reported separately.
pub(super) fn dubs<'d>(old: &'d Dialogue<'d>, new: &'d Dialogue<'d>) -> Vec<DubChange<'d>> {
    let voices: BTreeSet<&'d str> = tags(old).into_iter().chain(tags(new)).collect();
    let played = |dialogue: &'d Dialogue<'d>, key: &str, tag: &str| {
        let voiced = dialogue.clip_by_key(key)?.in_voice(dialogue.voice(tag)?);
        (voiced.spoken != VoiceSource::Original).then(|| voiced.clip.key())
    };
    let (mut found, clips) = (Vec::new(), clips_by_key(old));
    for voice in voices.into_iter().filter(|voice| old.voice(voice).is_some() && new.voice(voice).is_some()) {
        for clip in clips.iter().filter(|clip| clip.original().is_none() && new.clip_by_key(clip.key()).is_some()) {
            let (key, change) =
                (clip.key(), Change::between(played(old, clip.key(), voice), played(new, clip.key(), voice)));
            found.extend(change.map(|clip| DubChange { voice, key, clip }));
        }
    }
    found
}
