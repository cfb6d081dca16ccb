//! Queries of tools about a dialogue: sorted clips and locales, banks, and the origin of the texts of dubs.

use crate::locales::dubs::borrows;
use lipz_bank::files::{DialogueFile, FileKind, Layer};
use lipz_bank::{Bank, Clip, Dialogue, Locale};
use lipz_layout::Tag;

/// A locale of a dialogue with its tag.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TaggedLocale<'d> {
    pub(crate) tag: &'d str,
    pub(crate) locale: Locale,
    pub(crate) is_default: bool,
}

/// Returns all clips, sorted by key.
pub(crate) fn clips_by_key<'d>(dialogue: &'d Dialogue<'d>) -> Vec<Clip<'d>> {
    let mut clips: Vec<Clip<'d>> = dialogue.clips().collect();
    clips.sort_by(|one, other| one.key().cmp(other.key()));
    clips
}

/// Returns all locales, sorted by tag.
pub(crate) fn locales_by_tag<'d>(dialogue: &Dialogue<'d>) -> Vec<TaggedLocale<'d>> {
    let default = dialogue.default_locale();
    let tagged =
        |locale| TaggedLocale { tag: dialogue.locale_tag(locale), locale, is_default: default == Some(locale) };
    let mut locales: Vec<_> = dialogue.locales().map(tagged).collect();
    locales.sort_unstable_by_key(|locale| locale.tag);
    locales
}

/// Returns the banks, each with the number of its file.
pub(crate) fn banks<'d>(dialogue: &Dialogue<'d>) -> impl Iterator<Item = (usize, &'d Bank<'d>)> {
    (0..dialogue.file_count()).filter_map(|number| Some((number, dialogue.bank(number)?)))
}

/// Returns the number of the first file after the base, which is a bank, or the index of a set with its banks.
pub(crate) fn behind_base(dialogue: &Dialogue<'_>) -> usize {
    dialogue.set_index().map_or(1, |index| index.bank_count().saturating_add(1))
}

/// Returns the patches, each with the number of its file, from the topmost down.
pub(crate) fn patches<'d>(dialogue: &Dialogue<'d>) -> impl Iterator<Item = (usize, &'d Bank<'d>)> {
    (behind_base(dialogue)..dialogue.file_count()).rev().filter_map(|number| Some((number, dialogue.bank(number)?)))
}

/// Returns the bank whose profiles in a section apply: the topmost patch that replaces them, or else one of the base.
pub(crate) fn bank_of_profiles<'d>(dialogue: &Dialogue<'d>, tag: Tag) -> Option<&'d Bank<'d>> {
    let replaces = |layer: Layer<'_>| match tag {
        Tag::BABBLE => layer.has_babble(),
        Tag::FACES => layer.has_faces(),
        Tag::ARTICULATION => layer.has_articulation(),
        _ => layer.has_rigs(),
    };
    let patch = patches(dialogue).find(|(_, bank)| bank.layer().is_some_and(replaces));
    patch.or_else(|| banks(dialogue).next()).map(|(_, bank)| bank)
}

/// Returns the length in bytes of all banks, and of the index of a set.
pub(crate) fn length_bytes(dialogue: &Dialogue<'_>) -> usize {
    lengths(dialogue, |kind| kind != FileKind::Texts)
}

/// Returns the length in bytes of all text banks.
pub(crate) fn texts_bytes(dialogue: &Dialogue<'_>) -> usize {
    lengths(dialogue, |kind| kind == FileKind::Texts)
}

fn lengths(dialogue: &Dialogue<'_>, counts: impl Fn(FileKind) -> bool) -> usize {
    let files = (0..dialogue.file_count()).filter_map(|number| dialogue.file(number));
    files.filter(|file| counts(file.kind())).map(DialogueFile::length_bytes).sum()
}

/// Returns the length in bytes of each section in all banks, in the order of the first bank that has it.
#[cfg_attr(
    not(any(feature = "inspect", feature = "stats")),
    allow(dead_code, reason = "each feature uses a part of this")
)]
pub(crate) fn sections(dialogue: &Dialogue<'_>) -> Vec<(Tag, usize)> {
    let mut sections: Vec<(Tag, usize)> = Vec::new();
    for (tag, bytes) in banks(dialogue).flat_map(|(_, bank)| bank.sections()) {
        match sections.iter_mut().find(|(known, _)| known.0 == tag) {
            Some((_, sum)) => *sum += bytes.len(),
            None => sections.push((Tag(tag), bytes.len())),
        }
    }
    sections
}

/// Returns the topmost bank with a part of a clip, which contains its source record.
pub(crate) fn topmost<'d>(dialogue: &Dialogue<'d>, clip: &Clip<'_>) -> Option<(usize, Clip<'d>)> {
    let file = clip.file() as usize;
    let in_patch = patches(dialogue).take_while(|(number, _)| *number > file);
    let mut above = in_patch.filter_map(|(number, bank)| Some((number, bank.clip(clip.id())?)));
    above.next().or_else(|| Some((file, dialogue.bank(file)?.clip_at(clip.slot())?)))
}

/// The origin of the texts of a dub.
pub(crate) struct DubTexts<'d> {
    original: Clip<'d>,
    bank: &'d Bank<'d>,
    /// The clip that owns the texts in that bank: the dub, or its original.
    of_texts: Clip<'d>,
    /// The layer section of the bank, if it is a patch.
    layer: Option<Layer<'d>>,
    are_of_original: bool,
}

impl<'d> DubTexts<'d> {
    /// Returns the texts of a clip; `None` if it is not a dub, or if no bank has a text of it.
    pub(crate) fn of(dialogue: &Dialogue<'d>, clip: &Clip<'d>) -> Option<DubTexts<'d>> {
        let original = clip.original()?;
        let (file, slot) = dialogue.slot_of_texts(clip.id())?;
        let bank = dialogue.bank(file as usize)?;
        let of_texts = bank.clip_at(slot)?;
        let layer = bank.layer().filter(|_| file as usize >= behind_base(dialogue));
        let are_of_original = of_texts.id() != clip.id();
        Some(DubTexts { original, bank, of_texts, layer, are_of_original })
    }

    /// Whether the dub uses the text of its original in a locale.
    pub(crate) fn are_borrowed(&self, clip: &Clip<'d>, locale: &TaggedLocale<'_>) -> bool {
        // Independent patches may have changed one of the two.
        self.has_same_text(clip, locale.locale) && (self.are_of_original || self.is_said(clip, locale))
    }

    fn has_same_text(&self, clip: &Clip<'d>, locale: Locale) -> bool {
        // A text in a locale that the banks lack counts as the clip's own.
        let texts = |clip: &Clip<'d>| clip.segments().map(move |segment| segment.text(locale));
        clip.segment(0).is_some_and(|segment| segment.text(locale).is_some()) && texts(&self.original).eq(texts(clip))
    }

    /// Whether the bank states this.
    fn is_said(&self, clip: &Clip<'_>, locale: &TaggedLocale<'_>) -> bool {
        let is_it = |other: &Locale| self.bank.locale_tag(*other) == locale.tag;
        match (&self.layer, self.bank.locales().position(|other| is_it(&other))) {
            (Some(layer), Some(place)) => layer.borrows(self.of_texts.slot(), place),
            (Some(_), None) => false,
            (None, Some(_)) => {
                let own = self.bank.locale(locale.tag);
                own.is_some_and(|own| borrows(&self.of_texts, self.of_texts.original().as_ref(), own))
            }
            // In a text bank next to it.
            (None, None) => borrows(clip, Some(&self.original), locale.locale),
        }
    }
}
