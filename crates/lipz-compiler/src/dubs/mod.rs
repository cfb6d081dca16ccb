//! Dubs: clips that are played instead of others in their voices.

mod compare;
mod coverage;
mod kept;

pub(crate) use compare::compare;
pub use coverage::{VoiceCoverage, voice_coverage, voice_coverage_of};
pub(crate) use kept::KeptDubs;

use crate::clip::Clip;
use crate::fallback::Fallbacks;
use crate::{Options, Voices};
use lipz_bank::{Clip as BankClip, Locale, Segment};

/// Which of the clips of a bank are dubs.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Dubs {
    /// The locales of the voices: the original's first, then the others in the order of their bytes. Empty without dubs.
    pub(crate) voices: Vec<String>,
    /// For each clip the one that it dubs; empty without dubs.
    of: Vec<Option<Dub>>,
    /// The dubs that are missing where the voice falls back to another one, each with the index of the dub there.
    pub(crate) others: Vec<(Dub, usize)>,
}

/// What a clip is a dub of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Dub {
    /// The number of the voice.
    pub(crate) voice: usize,
    /// The index of the original.
    pub(crate) original: usize,
}

impl Dubs {
    /// These dubs, if there are any.
    pub(crate) fn new(voices: Vec<String>, of: Vec<Option<Dub>>, others: Vec<(Dub, usize)>) -> Dubs {
        if of.iter().all(Option::is_none) { Dubs::default() } else { Dubs { voices, of, others } }
    }

    /// The dubs among `clips`, which are in the order of their keys. One with other segments than its original is none:
    /// [`compare`] has refused it. Those of a bank below stay dubs, unless the project says otherwise.
    pub(crate) fn find(clips: &[Clip<'_>], options: &Options, kept: &KeptDubs) -> Dubs {
        let voices = kept.with_voices(options.voices.locales().map(str::to_owned).collect());
        if voices.len() < 2 {
            return Dubs::default();
        }
        let found = |clip| dub(clip, clips, &options.voices, &voices).or_else(|| kept.dub(clip, clips, &voices));
        let found: Vec<Option<Dub>> = clips.iter().map(found).collect();
        // A dub is no original: the patterns of an addition can say so of one that is below.
        let of = found.iter().map(|dub| dub.filter(|dub| found[dub.original].is_none())).collect();
        let mut dubs = Dubs::new(voices, of, Vec::new());
        dubs.others = dubs.fallbacks(options);
        kept.restore(&mut dubs, clips);
        dubs
    }

    /// What is played where a voice has no dub: that in the first voice that it falls back to.
    fn fallbacks(&self, options: &Options) -> Vec<(Dub, usize)> {
        if self.voices.is_empty() {
            return Vec::new();
        }
        let mut by_original: Vec<(usize, usize, usize)> =
            self.iter().map(|(at, dub)| (dub.original, dub.voice, at)).collect();
        by_original.sort_unstable();
        let mut fallbacks = Fallbacks::new(&self.voices, options);
        let mut found = Vec::new();
        for line in by_original.chunk_by(|(one, ..), (other, ..)| one == other) {
            let own = || [0].into_iter().chain(line.iter().map(|(_, voice, _)| *voice));
            let missing: Vec<usize> = (1..self.voices.len()).filter(|voice| !own().any(|own| own == *voice)).collect();
            fallbacks.resolve(own(), missing.into_iter(), |voice, other| {
                let other = line.iter().find(|(_, voice, _)| *voice == other);
                found.extend(other.map(|(original, _, at)| (Dub { voice, original: *original }, *at)));
            });
        }
        found
    }

    /// What the clip with this index is a dub of.
    pub(crate) fn dub(&self, at: usize) -> Option<Dub> {
        self.of.get(at).copied().flatten()
    }

    /// All dubs, each with its index.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (usize, Dub)> {
        self.of.iter().enumerate().filter_map(|(at, dub)| Some((at, (*dub)?)))
    }
}

fn dub(clip: &Clip<'_>, clips: &[Clip<'_>], voices: &Voices, tags: &[String]) -> Option<Dub> {
    let place = |key: &str| clips.binary_search_by(|other| other.key().cmp(key)).ok();
    let original = place(&voices.original_of(clip.key(), |key| place(key).is_some())?)?;
    let (locale, _) = voices.of_key(clip.key())?;
    let voice = tags.iter().position(|tag| tag == locale)?;
    (clips[original].starts().len() == clip.starts().len()).then_some(Dub { voice, original })
}

/// Whether a clip of a bank has no text of its own in `locale`, but that of its original, if it is a dub.
pub(crate) fn borrows(clip: &BankClip<'_>, original: Option<&BankClip<'_>>, locale: Locale) -> bool {
    let Some(original) = original else { return false };
    // A dub's own texts have a place of their own, even if they are the original's letter by letter.
    let place = |segment: Segment<'_>| segment.text_bytes(locale).map(<[u8]>::as_ptr_range);
    original.segments().map(place).eq(clip.segments().map(place))
}
