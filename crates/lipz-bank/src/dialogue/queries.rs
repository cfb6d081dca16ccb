//! Queries over all files of a dialogue.

use super::{Answers, Dialogue, FoundClip};
use crate::event::NameKey;
use crate::text::FoundText;
use crate::{Bank, Clip, ClipId, EventName, Locale, Text, Voice, VoicedClip};
use lipz_layout::ClipRecord;

/// A query for a segment's text by the record of its clip in a bank. The arguments in parentheses are the index of the
/// segment, and whether this bank has the texts of the clip.
type TextQuery = for<'a> fn(&'a Dialogue<'a>, &'a Bank<'a>, &'a ClipRecord, (u32, bool), Locale) -> Option<Text<'a>>;
/// The same for the place of the text.
type FindTextQuery =
    for<'a> fn(&'a Dialogue<'a>, &'a Bank<'a>, &'a ClipRecord, (u32, bool), Locale) -> Option<FoundText<'a>>;

/// The queries over all files of a dialogue.
pub(crate) struct Queries {
    /// Returns the location of the clip with an id.
    pub(super) find: for<'a> fn(&Dialogue<'a>, ClipId) -> Option<FoundClip<'a>>,
    /// Returns the location of the clip in a file and a slot, with the location of its texts.
    pub(super) find_at: for<'a> fn(&Dialogue<'a>, u32, u32) -> Option<FoundClip<'a>>,
    pub(super) locale: fn(&Dialogue<'_>, &str) -> Option<Locale>,
    pub(super) default_locale: fn(&Dialogue<'_>) -> Option<Locale>,
    /// Returns the bank that sets the data of a layer flag.
    pub(super) bank_with: for<'a> fn(&Dialogue<'a>, u32) -> Option<&'a Bank<'a>>,
    pub(super) has_bank: fn(&Dialogue<'_>) -> bool,
    pub(super) missing_bank: fn(&Dialogue<'_>, ClipId) -> Option<usize>,
    pub(super) event_name: for<'a> fn(&Dialogue<'a>, &str) -> Option<EventName<'a>>,
    /// Returns the voice after the given one, or the first.
    pub(super) next_voice: fn(&Dialogue<'_>, Option<Voice>) -> Option<Voice>,
    pub(super) voice_tag: for<'a> fn(&Dialogue<'a>, Voice) -> &'a str,
    pub(super) locale_tag: for<'a> fn(&Dialogue<'a>, Locale) -> &'a str,
    /// Returns the text of the segment with this index of a clip. The clip's bank may contain its texts.
    text: TextQuery,
    /// The same, without a UTF-8 check.
    find_text: FindTextQuery,
    /// Returns the name that a cursor has stored.
    pub(crate) name: for<'a> fn(&'a Dialogue<'a>, NameKey) -> Option<EventName<'a>>,
    /// Returns the clip as played in a voice.
    pub(crate) in_voice: for<'a> fn(&'a Dialogue<'a>, &Clip<'a>, Voice) -> VoicedClip<'a>,
    /// Returns the voice of the recording that a clip was made for.
    pub(crate) voice: for<'a> fn(&'a Dialogue<'a>, &Clip<'a>) -> Option<Voice>,
    /// Returns the original of a dub.
    pub(crate) original: for<'a> fn(&'a Dialogue<'a>, &Clip<'a>) -> Option<Clip<'a>>,
}

/// The one table of queries.
pub(super) static QUERIES: Queries = Queries {
    find: |dialogue, id| dialogue.find_in_files(id),
    find_at: |dialogue, file, slot| dialogue.find_at(file, slot),
    bank_with: |dialogue, flag| dialogue.bank_with_in_files(flag),
    has_bank: |dialogue| dialogue.base_levels().next().is_some(),
    missing_bank: |dialogue, id| dialogue.missing_bank_in_files(id),
    event_name: |dialogue, name| dialogue.banks().find_map(|bank| bank.event_name(name)),
    next_voice: |dialogue, before| dialogue.next_voice_in_files(before),
    voice_tag: |dialogue, voice| dialogue.voice_tag_in_files(voice),
    locale: |dialogue, tag| dialogue.locale_in_files(tag),
    default_locale: |dialogue| dialogue.default_locale_in_files(),
    locale_tag: |dialogue, locale| {
        dialogue.list_of(locale).and_then(|list| list.tag(usize::from(locale.index))).unwrap_or("")
    },
    text: |dialogue, bank, record, segment, locale| dialogue.text_of(bank, record, segment, locale)?.text(),
    find_text: |dialogue, bank, record, segment, locale| dialogue.text_of(bank, record, segment, locale),
    name: |dialogue, key| dialogue.name(key),
    in_voice: |dialogue, clip, voice| dialogue.clip_in_voice(clip, voice),
    voice: |dialogue, clip| dialogue.voice_of(clip),
    original: |dialogue, clip| dialogue.clip(dialogue.original_id(clip.id())?.1),
};

impl<'a> Dialogue<'a> {
    /// Returns the text of the segment with this index of a clip. The clip's bank may contain its texts.
    #[cfg_attr(target_pointer_width = "64", inline)]
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))]
    pub(crate) fn text(
        &'a self,
        bank: &'a Bank<'a>,
        record: &'a ClipRecord,
        segment: (u32, bool),
        locale: Locale,
    ) -> Option<Text<'a>> {
        match self.answers {
            Answers::Alone(own) => own.text_of(record, segment.0, locale)?.text(),
            Answers::Together(queries) => (queries.text)(self, bank, record, segment, locale),
        }
    }

    /// The same, without a UTF-8 check.
    #[cfg_attr(target_pointer_width = "64", inline)]
    #[cfg_attr(not(target_pointer_width = "64"), inline(never))]
    pub(crate) fn find_text(
        &'a self,
        bank: &'a Bank<'a>,
        record: &'a ClipRecord,
        segment: (u32, bool),
        locale: Locale,
    ) -> Option<FoundText<'a>> {
        match self.answers {
            Answers::Alone(own) => own.text_of(record, segment.0, locale),
            Answers::Together(queries) => (queries.find_text)(self, bank, record, segment, locale),
        }
    }

    /// Returns the loaded banks.
    fn banks(&self) -> impl Iterator<Item = &'a Bank<'a>> + '_ {
        (0..self.files.count()).filter_map(move |number| self.bank(number))
    }

    /// Returns the name that a cursor has stored, if it belongs to one of these banks.
    pub(super) fn name(&self, key: NameKey) -> Option<EventName<'a>> {
        let mut open = (0..self.files.count()).filter_map(|number| self.files.file_if_open(number)?.bank());
        EventName::numbered(open.find(|bank| bank.origin == key.bank)?, key.id)
    }

    /// Returns the voice of the recording that a clip was made for.
    fn voice_of(&self, clip: &Clip<'_>) -> Option<Voice> {
        let of_dub = self.original_id(clip.id()).map(|(voice, _)| voice);
        of_dub.or_else(|| self.voices().next())
    }
}
