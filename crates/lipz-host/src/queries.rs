//! The queries of a dialogue, which are those of the reader.

use crate::Dialogue;
use lipz_bank::babble::Babble;
use lipz_bank::face::FaceProfile;
use lipz_bank::{Clip, ClipId, EventName, Locale, Voice};

/// The queries of [`lipz_bank::Dialogue`], under the same names.
impl Dialogue {
    /// The clip with this id, of the topmost file that has it; `None` if none does, or one above removes it.
    #[inline]
    pub fn clip(&self, id: ClipId) -> Option<Clip<'_>> {
        self.view().clip(id)
    }

    /// The clip with this key, compared whole.
    #[inline]
    pub fn clip_by_key(&self, key: &str) -> Option<Clip<'_>> {
        self.view().clip_by_key(key)
    }

    /// All clips, each once: file by file, in each in the order of their keys.
    pub fn clips(&self) -> impl Iterator<Item = Clip<'_>> + '_ {
        self.view().clips()
    }

    /// The clips whose keys start with `prefix`, in the same order: `act1/` gives those of a folder.
    pub fn clips_under<'p>(&'p self, prefix: &'p str) -> impl Iterator<Item = Clip<'p>> + 'p {
        self.view().clips_under(prefix)
    }

    /// The number of clips; counts them if there are patches.
    pub fn clip_count(&self) -> usize {
        self.view().clip_count()
    }

    /// The locale with this tag, spelled as in the files (`en-us`). Look it up once and pass it to text queries.
    pub fn locale(&self, tag: &str) -> Option<Locale> {
        self.view().locale(tag)
    }

    /// The default locale: that of the topmost file that says which one it is.
    pub fn default_locale(&self) -> Option<Locale> {
        self.view().default_locale()
    }

    /// All locales, in no order.
    pub fn locales(&self) -> impl Iterator<Item = Locale> + '_ {
        self.view().locales()
    }

    /// The tag of a locale: `en-us`. Empty for a locale of another dialogue or version.
    pub fn locale_tag(&self, locale: Locale) -> &str {
        self.view().locale_tag(locale)
    }

    /// The voice in this locale, spelled as in the files (`de-de`); `None` if there are no dubs, or the project names no such
    /// voice: play the clips as they are.
    pub fn voice(&self, tag: &str) -> Option<Voice> {
        self.view().voice(tag)
    }

    /// The voices: that of the originals first, then those of the dubs in the order of their tags.
    pub fn voices(&self) -> impl Iterator<Item = Voice> + '_ {
        self.view().voices()
    }

    /// The locale of a voice: `de-de`. Empty for a voice of another dialogue or version.
    pub fn voice_tag(&self, voice: Voice) -> &str {
        self.view().voice_tag(voice)
    }

    /// The name that events mention, spelled as there (`amy`); `None` if no event of any file does.
    pub fn event_name(&self, name: &str) -> Option<EventName<'_>> {
        self.view().event_name(name)
    }

    /// The babble profile with this name.
    pub fn babble(&self, name: &str) -> Option<Babble<'_>> {
        self.view().babble(name)
    }

    /// The babble profile of the project; [`Babble::DEFAULT`] if it has none.
    pub fn default_babble(&self) -> Babble<'_> {
        self.view().default_babble()
    }

    /// The face profile with this name.
    pub fn face_profile(&self, name: &str) -> Option<FaceProfile<'_>> {
        self.view().face_profile(name)
    }

    /// The face profile of the project; [`FaceProfile::DEFAULT`] if it has none.
    pub fn default_face_profile(&self) -> FaceProfile<'_> {
        self.view().default_face_profile()
    }
}
