//! Clips of a stack that stay unless its layer replaces them.

use super::content::{Records, ShownText, ShownTexts, take_clip, take_texts};
use super::links::TextOwner;
use super::merge::profiles;
use crate::clip::{Clip, ClipData, Clips};
use crate::locales::dubs::KeptDubs;
use crate::locales::localise::{LocalisedTexts, TextSubstitute};
use crate::project::Options;
use crate::sources::Input;
use lipz_bank::{Bank, Locale};
use lipz_diagnostics::{Code, Report, escape};
use lipz_layout::Tag;
use std::collections::HashSet;

/// The kept clips, and the texts that they show in the existing locales.
pub(crate) struct KeptClips {
    /// Moved out when they are added to a run.
    pub(crate) clips: Clips,
    /// The section of babble profiles.
    pub(crate) babble: Vec<u8>,
    /// The section of face profiles.
    pub(crate) faces: Vec<u8>,
    /// The dubs of the bank.
    pub(crate) dubs: KeptDubs,
    /// Dubs whose originals are not kept.
    orphans: HashSet<usize>,
    /// Tags of the locales.
    tags: Vec<String>,
    /// For each clip, in the order of the keys, the origin of its text in each locale.
    shown: Vec<Vec<ShownText>>,
}

impl KeptClips {
    /// Collects the clips of `bank` that are not among the inputs.
    pub(crate) fn new(bank: &Bank<'_>, inputs: &[Input]) -> KeptClips {
        let replaced: HashSet<&str> = inputs.iter().map(|input| input.key.as_str()).collect();
        let locales: Vec<Locale> = bank.locales().collect();
        let (mut clips, mut data) = (Clips::default(), ClipData::default());
        let numbers: Vec<u32> =
            locales.iter().map(|locale| clips.locales.number(bank.locale_tag(*locale), false)).collect();
        let records = Records::of(bank);
        let (mut shown, mut orphans) = (Vec::new(), HashSet::new());
        for clip in bank.clips().filter(|clip| !replaced.contains(clip.key())) {
            let texts = ShownTexts::of(&clip, &locales);
            take_clip(Some(&clip), clip.segment_count(), &mut data);
            take_texts(&texts, &TextOwner::of(&clip, &locales), |locale| numbers[locale], &mut data);
            data.source.extend_from_slice(records.get(&clip));
            clips.push(clip.key(), &data);
            if clip.original().is_some_and(|original| replaced.contains(original.key())) {
                orphans.insert(shown.len());
            }
            shown.push(texts.shown);
        }
        let tags = locales.iter().map(|locale| bank.locale_tag(*locale).to_owned()).collect();
        let [babble, faces] = [Tag::BABBLE, Tag::FACES].map(|tag| profiles(bank, tag).to_vec());
        KeptClips { clips, babble, faces, dubs: KeptDubs::of(bank), orphans, tags, shown }
    }

    /// Sets those of the `options` that the clips of `bank` determine and the project does not.
    ///
    /// # Errors
    /// If the project states a different language of its originals than the bank.
    pub(crate) fn add_options(bank: &Bank<'_>, options: &mut Options) -> Result<(), Report> {
        if let Some(original) = bank.voices().next().map(|voice| bank.voice_tag(voice)) {
            let own = options.voices.original.get_or_insert_with(|| original.to_owned());
            if own != original {
                let (own, tag) = (escape::text(own), escape::text(original));
                let message = format!("the originals are in `{own}`, but those of the bank below are in `{tag}`");
                let help = format!(
                    "set `default-locale` or `locale` of [audio] to `{tag}`, or pack all sources without `--keep-others`"
                );
                return Err(Report::failure("", Code::OtherOriginal, message, &help));
            }
        }
        if options.default_locale.is_none() {
            options.default_locale = bank.default_locale().map(|locale| bank.locale_tag(locale).to_owned());
        }
        for clip in bank.clips() {
            if let Some(recording) = clip.recording() {
                options.recordings.entry(clip.key().to_owned()).or_insert(recording);
            }
        }
        Ok(())
    }

    /// Restores the texts that the clips of this batch showed, because the fallbacks of a mod apply only to its own
    /// texts.
    pub(crate) fn restore(&self, batch: usize, clips: &[Clip<'_>], tags: &[Box<str>], localised: &mut LocalisedTexts) {
        let number = |tag: &String| tags.iter().position(|other| **other == **tag);
        let numbers: Vec<Option<usize>> = self.tags.iter().map(number).collect();
        for (at, clip) in clips.iter().enumerate() {
            let (of_batch, index) = clip.place();
            // The texts of a dub with a new original are determined again.
            if of_batch != batch || self.orphans.contains(&index) {
                continue;
            }
            for (shown, locale) in std::iter::zip(&self.shown[index], &numbers) {
                let Some(column) = locale.and_then(|locale| localised.locales.get_mut(locale)) else { continue };
                match shown {
                    ShownText::Nothing => column.set(at, None),
                    ShownText::Fallback(other) => {
                        column.set(at, numbers[*other].map(|other| TextSubstitute::Fallback(other as u32)));
                    }
                    ShownText::Own | ShownText::Borrowed => {}
                }
            }
        }
    }
}
