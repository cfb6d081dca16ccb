//! What a clip asks of the dialogue that it was found in.

use super::Dialogue;
use crate::event::NameKey;
use crate::text::FoundText;
use crate::{Bank, Clip, EventName, Locale, Text, Voice, VoicedClip};
use lipz_layout::ClipRecord;

/// A query for the text of the segment with an index, of the clip with a record of a bank, which may have its texts there.
type TextQuery = for<'a> fn(&'a Dialogue<'a>, &'a Bank<'a>, &'a ClipRecord, (u32, bool), Locale) -> Option<Text<'a>>;
/// The same for the place of the text.
type FindTextQuery =
    for<'a> fn(&'a Dialogue<'a>, &'a Bank<'a>, &'a ClipRecord, (u32, bool), Locale) -> Option<FoundText<'a>>;

/// The queries of a clip that its dialogue answers.
pub(crate) struct Queries {
    /// The text of the segment with this index of a clip, which may have its texts in its bank.
    pub(crate) text: TextQuery,
    /// The same, not checked to be UTF-8.
    pub(crate) find_text: FindTextQuery,
    /// The name that a cursor has kept.
    pub(crate) name: for<'a> fn(&'a Dialogue<'a>, NameKey) -> Option<EventName<'a>>,
    /// The clip as it is played in a voice.
    pub(crate) in_voice: for<'a> fn(&'a Dialogue<'a>, &Clip<'a>, Voice) -> VoicedClip<'a>,
    /// The voice whose recording the mouth of a clip belongs to.
    pub(crate) voice: for<'a> fn(&'a Dialogue<'a>, &Clip<'a>) -> Option<Voice>,
    /// The clip of which this one is a dub.
    pub(crate) original: for<'a> fn(&'a Dialogue<'a>, &Clip<'a>) -> Option<Clip<'a>>,
}

/// The only ones.
pub(super) static QUERIES: Queries = Queries {
    text: |dialogue, bank, record, segment, locale| dialogue.text_of(bank, record, segment, locale)?.text(),
    find_text: |dialogue, bank, record, segment, locale| dialogue.text_of(bank, record, segment, locale),
    name: |dialogue, key| dialogue.name(key),
    in_voice: |dialogue, clip, voice| dialogue.clip_in_voice(clip, voice),
    voice: |dialogue, clip| dialogue.voice_of(clip),
    original: |dialogue, clip| dialogue.clip(dialogue.original_id(clip.id())?.1),
};

impl<'a> Dialogue<'a> {
    /// The name that a cursor has kept, if it is one of these banks.
    pub(super) fn name(&self, key: NameKey) -> Option<EventName<'a>> {
        let mut open = (0..self.files.count()).filter_map(|number| self.files.file_if_open(number)?.bank());
        EventName::numbered(open.find(|bank| bank.origin == key.bank)?, key.id)
    }

    /// The voice whose recording the mouth of a clip belongs to.
    fn voice_of(&self, clip: &Clip<'_>) -> Option<Voice> {
        let of_dub = self.original_id(clip.id()).map(|(voice, _)| voice);
        of_dub.or_else(|| self.voices().next())
    }
}
