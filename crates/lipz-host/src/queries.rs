//! The queries of a dialogue, which are the same as the reader's.

use crate::Dialogue;
use lipz_bank::articulation::{ArticulationProfile, Rig};
use lipz_bank::babble::Babble;
use lipz_bank::face::FaceProfile;
use lipz_bank::{Clip, ClipId, EventName, Locale, Voice};

/// The queries of [`lipz_bank::Dialogue`], under the same names.
impl Dialogue {
    /// Returns the clip with this id, from the topmost file that has it; `None` if no file has it, or if a patch
    /// removes it.
    #[inline]
    pub fn clip(&self, id: ClipId) -> Option<Clip<'_>> {
        self.view().clip(id)
    }

    /// Returns the clip with this key, which is compared in full.
    #[inline]
    pub fn clip_by_key(&self, key: &str) -> Option<Clip<'_>> {
        self.view().clip_by_key(key)
    }

    /// Returns all clips, each once: file by file, and ordered by key in each.
    pub fn clips(&self) -> impl Iterator<Item = Clip<'_>> + '_ {
        self.view().clips()
    }

    /// Returns the clips whose keys start with `prefix`, in the same order. `act1/` selects those of a folder.
    pub fn clips_under<'p>(&'p self, prefix: &'p str) -> impl Iterator<Item = Clip<'p>> + 'p {
        self.view().clips_under(prefix)
    }

    /// Returns the number of clips. Counts them if there are patches.
    pub fn clip_count(&self) -> usize {
        self.view().clip_count()
    }

    /// Returns the locale with this tag, spelled as in the files (`en-us`). Look it up once and pass it to text
    /// queries.
    pub fn locale(&self, tag: &str) -> Option<Locale> {
        self.view().locale(tag)
    }

    /// Returns the default locale, from the topmost file that sets one.
    pub fn default_locale(&self) -> Option<Locale> {
        self.view().default_locale()
    }

    /// Returns all locales, in any order.
    pub fn locales(&self) -> impl Iterator<Item = Locale> + '_ {
        self.view().locales()
    }

    /// Returns the tag of a locale: `en-us`. Empty for a locale of another dialogue or version.
    pub fn locale_tag(&self, locale: Locale) -> &str {
        self.view().locale_tag(locale)
    }

    /// Returns the locale for texts of a variant. For the key `few-fem`, tries `few-fem`, `few` and `fem`; if no clip
    /// has any of these, returns `locale`. Look variants up once per locale.
    pub fn variant(&self, locale: Locale, key: &str) -> Locale {
        self.view().variant(locale, key)
    }

    /// Returns the voice in this locale, spelled as in the files (`de-de`). `None` if there are no dubs, or if the
    /// project does not define this voice: play the clips unchanged.
    pub fn voice(&self, tag: &str) -> Option<Voice> {
        self.view().voice(tag)
    }

    /// Returns the voices: that of the originals first, then those of the dubs, ordered by tag.
    pub fn voices(&self) -> impl Iterator<Item = Voice> + '_ {
        self.view().voices()
    }

    /// Returns the locale of a voice: `de-de`. Empty for a voice of another dialogue or version.
    pub fn voice_tag(&self, voice: Voice) -> &str {
        self.view().voice_tag(voice)
    }

    /// Returns the name as spelled in events (`amy`); `None` if no event of any file contains it.
    pub fn event_name(&self, name: &str) -> Option<EventName<'_>> {
        self.view().event_name(name)
    }

    /// Returns the babble profile with this name.
    pub fn babble(&self, name: &str) -> Option<Babble<'_>> {
        self.view().babble(name)
    }

    /// Returns the project's babble profile, or [`Babble::DEFAULT`].
    pub fn default_babble(&self) -> Babble<'_> {
        self.view().default_babble()
    }

    /// Returns the face profile with this name.
    pub fn face_profile(&self, name: &str) -> Option<FaceProfile<'_>> {
        self.view().face_profile(name)
    }

    /// Returns the project's face profile, or [`FaceProfile::DEFAULT`].
    pub fn default_face_profile(&self) -> FaceProfile<'_> {
        self.view().default_face_profile()
    }

    /// Returns the articulation profile with this name.
    pub fn articulation(&self, name: &str) -> Option<ArticulationProfile<'_>> {
        self.view().articulation(name)
    }

    /// Returns the project's articulation profile, or [`ArticulationProfile::DEFAULT`].
    pub fn default_articulation(&self) -> ArticulationProfile<'_> {
        self.view().default_articulation()
    }

    /// Returns the rig with this name.
    pub fn rig(&self, name: &str) -> Option<Rig<'_>> {
        self.view().rig(name)
    }
}
