//! Clips of a stack that stay where its layer does not have them.

use super::content::{Records, Shown, Texts, take_clip, take_texts};
use super::links::Whose;
use super::merge::profiles;
use crate::clip::{Clip, ClipData, Clips};
use crate::dubs::KeptDubs;
use crate::localise::{Localised, Other};
use crate::{Input, Options};
use lipz_bank::{Bank, Locale};
use lipz_diagnostics::{Code, Report, escape};
use lipz_layout::Tag;
use std::collections::HashSet;

/// The clips that stay, and what they show in the locales that there were.
pub(crate) struct Kept {
    /// Taken out when they are added to a run.
    pub(crate) clips: Clips,
    /// The section of babble profiles.
    pub(crate) babble: Vec<u8>,
    /// The section of face profiles.
    pub(crate) faces: Vec<u8>,
    /// The dubs of the bank.
    pub(crate) dubs: KeptDubs,
    /// Dubs of which the originals are not kept.
    orphans: HashSet<usize>,
    /// Tags of the locales.
    tags: Vec<String>,
    /// For each clip, in the order of the keys, what it shows in each of them.
    shown: Vec<Vec<Shown>>,
}

impl Kept {
    /// The clips of `bank` that are not among the inputs.
    pub(super) fn new(bank: &Bank<'_>, inputs: &[Input]) -> Kept {
        let replaced: HashSet<&str> = inputs.iter().map(|input| input.key.as_str()).collect();
        let locales: Vec<Locale> = bank.locales().collect();
        let (mut clips, mut data) = (Clips::default(), ClipData::default());
        let numbers: Vec<u32> =
            locales.iter().map(|locale| clips.locales.number(bank.locale_tag(*locale), false)).collect();
        let records = Records::of(bank);
        let (mut shown, mut orphans) = (Vec::new(), HashSet::new());
        for clip in bank.clips().filter(|clip| !replaced.contains(clip.key())) {
            let texts = Texts::of(&clip, &locales);
            take_clip(Some(&clip), clip.segment_count(), &mut data);
            take_texts(&texts, &Whose::of(&clip, &locales), |locale| numbers[locale], &mut data);
            data.source.extend_from_slice(records.get(&clip));
            clips.push(clip.key(), &data);
            if clip.original().is_some_and(|original| replaced.contains(original.key())) {
                orphans.insert(shown.len());
            }
            shown.push(texts.shown);
        }
        let tags = locales.iter().map(|locale| bank.locale_tag(*locale).to_owned()).collect();
        let [babble, faces] = [Tag::BABBLE, Tag::FACES].map(|tag| profiles(bank, tag).to_vec());
        Kept { clips, babble, faces, dubs: KeptDubs::of(bank), orphans, tags, shown }
    }

    /// Gives `options` what the clips of `bank` bring with them, where the project does not decide.
    ///
    /// # Errors
    /// If the project says that its originals are in another language than those of the bank.
    pub(super) fn add_options(bank: &Bank<'_>, options: &mut Options) -> Result<(), Report> {
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

    /// Has the clips of this batch show what they did: a mod knows the fallbacks of its own texts only.
    pub(crate) fn restore(&self, batch: usize, clips: &[Clip<'_>], tags: &[Box<str>], localised: &mut Localised) {
        let number = |tag: &String| tags.iter().position(|other| **other == **tag);
        let numbers: Vec<Option<usize>> = self.tags.iter().map(number).collect();
        for (at, clip) in clips.iter().enumerate() {
            let (of_batch, index) = clip.place();
            // What a dub of a new original shows is decided anew.
            if of_batch != batch || self.orphans.contains(&index) {
                continue;
            }
            for (shown, locale) in std::iter::zip(&self.shown[index], &numbers) {
                let Some(column) = locale.and_then(|locale| localised.locales.get_mut(locale)) else { continue };
                match shown {
                    Shown::Nothing => column.set(at, None),
                    Shown::Fallback(other) => {
                        column.set(at, numbers[*other].map(|other| Other::Fallback(other as u32)));
                    }
                    Shown::Own | Shown::Borrowed => {}
                }
            }
        }
    }
}
