//! Babble and face profiles of a dialogue, which come from one of its banks.

use super::{Answers, Dialogue};
use crate::Bank;
use crate::babble::Babble;
use crate::face::FaceProfile;
use crate::file::profiles;
use lipz_layout::{LAYER_BABBLE, LAYER_FACES, Tag};

impl<'a> Dialogue<'a> {
    /// Returns the babble profile with this name, from the topmost file that sets babble profiles.
    pub fn babble(&self, name: &str) -> Option<Babble<'a>> {
        self.bank_of_babble()?.babble(name)
    }

    /// Returns the project's babble profile, or [`Babble::DEFAULT`].
    pub fn default_babble(&self) -> Babble<'a> {
        self.bank_of_babble().map_or(Babble::DEFAULT, Bank::default_babble)
    }

    /// Returns all babble profiles, ordered by name.
    pub fn babbles(&self) -> impl Iterator<Item = Babble<'a>> + Clone + '_ {
        profiles(section(self.bank_of_babble(), Tag::BABBLE), Babble::split_first)
    }

    /// Returns the face profile with this name, from the topmost file that sets face profiles.
    pub fn face_profile(&self, name: &str) -> Option<FaceProfile<'a>> {
        self.bank_of_faces()?.face_profile(name)
    }

    /// Returns the project's face profile, or [`FaceProfile::DEFAULT`].
    pub fn default_face_profile(&self) -> FaceProfile<'a> {
        self.bank_of_faces().map_or(FaceProfile::DEFAULT, Bank::default_face_profile)
    }

    /// Returns all face profiles, ordered by name.
    pub fn face_profiles(&self) -> impl Iterator<Item = FaceProfile<'a>> + Clone + '_ {
        profiles(section(self.bank_of_faces(), Tag::FACES), FaceProfile::split_first)
    }

    fn bank_of_babble(&self) -> Option<&'a Bank<'a>> {
        self.bank_with(LAYER_BABBLE)
    }

    fn bank_of_faces(&self) -> Option<&'a Bank<'a>> {
        self.bank_with(LAYER_FACES)
    }

    fn bank_with(&self, flag: u32) -> Option<&'a Bank<'a>> {
        match self.answers {
            Answers::Alone(bank) => Some(bank),
            Answers::Together(queries) => (queries.bank_with)(self, flag),
        }
    }
}

/// Returns the section of a bank, or nothing without a bank.
fn section<'a>(bank: Option<&'a Bank<'a>>, tag: Tag) -> &'a [u8] {
    bank.map_or(&[], |bank| bank.file.section(tag))
}
