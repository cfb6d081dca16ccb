//! Changes as JSON, where it differs from their fields.

use super::Change;
use crate::views::json::{Face, KnownRecording, Profile, ratio};
use lipz_bank::babble::Babble;
use lipz_bank::face::FaceProfile;
use lipz_bank::{Fps, Recording, VisemeType};
use serde::{Serialize, Serializer};

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
