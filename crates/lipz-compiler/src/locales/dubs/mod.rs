//! Dubs: clips that replace others in their voices.

mod compare;
mod kept;

pub(crate) use compare::compare;
pub(crate) use kept::KeptDubs;

use crate::clip::Clip;
use crate::locales::fallback::Fallbacks;
use crate::project::{Options, Voices};
use lipz_bank::{Clip as BankClip, Locale, Segment};

/// The dubs among the clips of a bank.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Dubs {
    /// The locales of the voices: that of the originals first, then the others in byte order. Empty without dubs.
    pub(crate) voices: Vec<String>,
    /// For each clip, the one that it dubs; empty without dubs.
    of: Vec<Option<Dub>>,
    /// Missing dubs whose voice falls back to a different one, each with the index of the dub played instead.
    pub(crate) others: Vec<(Dub, usize)>,
}

/// The original and the voice of a dub.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Dub {
    /// The number of the voice.
    pub(crate) voice: usize,
    /// The index of the original.
    pub(crate) original: usize,
}

impl Dubs {
    /// Creates the dubs of these clips. Without any dub, the list of voices is empty, too.
    pub(crate) fn new(voices: Vec<String>, of: Vec<Option<Dub>>, others: Vec<(Dub, usize)>) -> Dubs {
        if of.iter().all(Option::is_none) { Dubs::default() } else { Dubs { voices, of, others } }
    }

    /// Finds the dubs among `clips`, which are sorted by key. Clips with different segments than their original are
    /// excluded, because [`compare`] has refused them. Those of a bank below stay dubs, unless the project decides
    /// otherwise.
    pub(crate) fn find(clips: &[Clip<'_>], options: &Options, kept: &KeptDubs) -> Dubs {
        let voices = kept.with_voices(options.voices.locales().map(str::to_owned).collect());
        if voices.len() < 2 {
            return Dubs::default();
        }
        let found = |clip| dub(clip, clips, &options.voices, &voices).or_else(|| kept.dub(clip, clips, &voices));
        let found: Vec<Option<Dub>> = clips.iter().map(found).collect();
        // A dub is never an original, although the patterns of an addition may declare one of the bank below as such.
        let of = found.iter().map(|dub| dub.filter(|dub| found[dub.original].is_none())).collect();
        let mut dubs = Dubs::new(voices, of, Vec::new());
        dubs.others = dubs.fallbacks(options);
        kept.restore(&mut dubs, clips);
        dubs
    }

    /// Returns the clips played where a voice has no dub: those of the first voice that it falls back to.
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

    /// Returns the original and the voice of the clip with this index, if it is a dub.
    pub(crate) fn dub(&self, at: usize) -> Option<Dub> {
        self.of.get(at).copied().flatten()
    }

    /// Returns all dubs, each with its index.
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

/// Whether a clip of a bank is a dub that uses the text of its original in `locale`.
pub(crate) fn borrows(clip: &BankClip<'_>, original: Option<&BankClip<'_>>, locale: Locale) -> bool {
    let Some(original) = original else { return false };
    // A dub's own texts are stored separately, even if they equal those of the original exactly.
    let place = |segment: Segment<'_>| segment.text_bytes(locale).map(<[u8]>::as_ptr_range);
    original.segments().map(place).eq(clip.segments().map(place))
}
