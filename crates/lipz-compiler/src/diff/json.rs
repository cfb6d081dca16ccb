//! Differences as JSON, where that differs from their fields.

use super::{Change, Difference};
use crate::json::{Face, KnownRecording, Profile, ratio};
use lipz_bank::babble::Babble;
use lipz_bank::face::FaceProfile;
use lipz_bank::{Fps, Recording, VisemeType};
use serde::ser::{Serialize, SerializeStruct, Serializer};

/// With whether there is any difference, which is no field.
impl Serialize for Difference<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut json = serializer.serialize_struct("Difference", 14)?;
        json.serialize_field("is_same", &self.is_empty())?;
        json.serialize_field("added_locales", &self.added_locales)?;
        json.serialize_field("removed_locales", &self.removed_locales)?;
        json.serialize_field("default_locale", &self.default_locale)?;
        json.serialize_field("fallbacks", &self.fallbacks)?;
        json.serialize_field("babble", &self.babble)?;
        json.serialize_field("voices", &self.voices)?;
        json.serialize_field("dubs", &self.dubs)?;
        json.serialize_field("faces", &self.faces)?;
        json.serialize_field("added", &self.added)?;
        json.serialize_field("removed", &self.removed)?;
        json.serialize_field("renamed", &self.renamed)?;
        json.serialize_field("changed", &self.changed)?;
        json.serialize_field("same", &self.same)?;
        json.end()
    }
}

pub(super) fn fps<S: Serializer>(change: &Option<Change<Option<Fps>>>, serializer: S) -> Result<S::Ok, S::Error> {
    change.map(|change| change.map(ratio)).serialize(serializer)
}

pub(super) fn viseme_type<S: Serializer>(
    change: &Option<Change<Option<VisemeType>>>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    change.map(|change| change.map(|kind| kind.map(VisemeType::name))).serialize(serializer)
}

pub(super) fn babble<S: Serializer>(change: &Change<Option<Babble<'_>>>, serializer: S) -> Result<S::Ok, S::Error> {
    change.map(|babble| babble.map(Profile::from)).serialize(serializer)
}

pub(super) fn face<S: Serializer>(change: &Change<Option<FaceProfile<'_>>>, serializer: S) -> Result<S::Ok, S::Error> {
    change.map(|profile| profile.map(Face::from)).serialize(serializer)
}

pub(super) fn recording<S: Serializer>(
    change: &Option<Change<Option<Recording>>>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    change.map(|change| change.map(|recording| recording.map(KnownRecording::from))).serialize(serializer)
}
