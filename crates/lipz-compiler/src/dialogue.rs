//! What tools ask of a dialogue beside its queries: clips and locales in order, its banks, and whose the texts of a dub are.

use crate::dubs::borrows;
use lipz_bank::files::{DialogueFile, FileKind, Layer};
use lipz_bank::{Bank, Clip, Dialogue, Locale};
use lipz_layout::Tag;

/// A locale of a dialogue with what tools show of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TaggedLocale<'d> {
    pub(crate) tag: &'d str,
    pub(crate) locale: Locale,
    pub(crate) is_default: bool,
}

/// All clips in the order of their keys.
pub(crate) fn clips_by_key<'d>(dialogue: &'d Dialogue<'d>) -> Vec<Clip<'d>> {
    let mut clips: Vec<Clip<'d>> = dialogue.clips().collect();
    clips.sort_by(|one, other| one.key().cmp(other.key()));
    clips
}

/// All locales in the order of their tags.
pub(crate) fn locales_by_tag<'d>(dialogue: &Dialogue<'d>) -> Vec<TaggedLocale<'d>> {
    let default = dialogue.default_locale();
    let tagged =
        |locale| TaggedLocale { tag: dialogue.locale_tag(locale), locale, is_default: default == Some(locale) };
    let mut locales: Vec<_> = dialogue.locales().map(tagged).collect();
    locales.sort_unstable_by_key(|locale| locale.tag);
    locales
}

/// The banks, each with the number of its file.
pub(crate) fn banks<'d>(dialogue: &Dialogue<'d>) -> impl Iterator<Item = (usize, &'d Bank<'d>)> {
    (0..dialogue.file_count()).filter_map(|number| Some((number, dialogue.bank(number)?)))
}

/// The number of the first file that is not of the base: a bank, or the index of a set and its banks.
pub(crate) fn behind_base(dialogue: &Dialogue<'_>) -> usize {
    dialogue.set_index().map_or(1, |index| index.bank_count().saturating_add(1))
}

/// The patches, each with the number of its file, the topmost first.
pub(crate) fn patches<'d>(dialogue: &Dialogue<'d>) -> impl Iterator<Item = (usize, &'d Bank<'d>)> {
    (behind_base(dialogue)..dialogue.file_count()).rev().filter_map(|number| Some((number, dialogue.bank(number)?)))
}

/// The bank whose profiles count, those of babble or of faces: the topmost patch that says so, or else one of the base.
pub(crate) fn bank_of_profiles<'d>(dialogue: &Dialogue<'d>, tag: Tag) -> Option<&'d Bank<'d>> {
    let says = |layer: Layer<'_>| if tag == Tag::BABBLE { layer.has_babble() } else { layer.has_faces() };
    let patch = patches(dialogue).find(|(_, bank)| bank.layer().is_some_and(says));
    patch.or_else(|| banks(dialogue).next()).map(|(_, bank)| bank)
}

/// Bytes of all banks, and of the index of a set.
pub(crate) fn length_bytes(dialogue: &Dialogue<'_>) -> usize {
    lengths(dialogue, |kind| kind != FileKind::Texts)
}

/// Bytes of all text banks.
pub(crate) fn texts_bytes(dialogue: &Dialogue<'_>) -> usize {
    lengths(dialogue, |kind| kind == FileKind::Texts)
}

fn lengths(dialogue: &Dialogue<'_>, counts: impl Fn(FileKind) -> bool) -> usize {
    let files = (0..dialogue.file_count()).filter_map(|number| dialogue.file(number));
    files.filter(|file| counts(file.kind())).map(DialogueFile::length_bytes).sum()
}

/// Bytes per section of all banks, in the order of the first bank that has it.
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

/// The topmost bank that has something of a clip: what is kept of its source is there.
pub(crate) fn topmost<'d>(dialogue: &Dialogue<'d>, clip: &Clip<'_>) -> Option<(usize, Clip<'d>)> {
    let file = clip.file() as usize;
    let in_patch = patches(dialogue).take_while(|(number, _)| *number > file);
    let mut above = in_patch.filter_map(|(number, bank)| Some((number, bank.clip(clip.id())?)));
    above.next().or_else(|| Some((file, dialogue.bank(file)?.clip_at(clip.slot())?)))
}

/// Whose the texts of a dub are.
pub(crate) struct DubTexts<'d> {
    original: Clip<'d>,
    bank: &'d Bank<'d>,
    /// The clip that has the texts in that bank: the dub, or its original.
    of_texts: Clip<'d>,
    /// What the bank says of it, if it is a patch.
    layer: Option<Layer<'d>>,
    are_of_original: bool,
}

impl<'d> DubTexts<'d> {
    /// Those of a clip; `None` if it is not a dub, or no bank has a text of it.
    pub(crate) fn of(dialogue: &Dialogue<'d>, clip: &Clip<'d>) -> Option<DubTexts<'d>> {
        let original = clip.original()?;
        let (file, slot) = dialogue.slot_of_texts(clip.id())?;
        let bank = dialogue.bank(file as usize)?;
        let of_texts = bank.clip_at(slot)?;
        let layer = bank.layer().filter(|_| file as usize >= behind_base(dialogue));
        let are_of_original = of_texts.id() != clip.id();
        Some(DubTexts { original, bank, of_texts, layer, are_of_original })
    }

    /// Whether the text of the dub in a locale is that of its original.
    pub(crate) fn are_borrowed(&self, clip: &Clip<'d>, locale: &TaggedLocale<'_>) -> bool {
        // Patches that do not know each other may have changed one of the two.
        self.has_same_text(clip, locale.locale) && (self.are_of_original || self.is_said(clip, locale))
    }

    fn has_same_text(&self, clip: &Clip<'d>, locale: Locale) -> bool {
        // A text of a locale that the banks do not have is the clip's own for them.
        let texts = |clip: &Clip<'d>| clip.segments().map(move |segment| segment.text(locale));
        clip.segment(0).is_some_and(|segment| segment.text(locale).is_some()) && texts(&self.original).eq(texts(clip))
    }

    /// Whether the bank says so.
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
