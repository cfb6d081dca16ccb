//! Profiles and rigs of a dialogue, which come from one of its banks.

use super::{Answers, Dialogue};
use crate::Bank;
use crate::articulation::{ArticulationProfile, Rig};
use crate::babble::Babble;
use crate::face::FaceProfile;
use crate::file::profiles;
use lipz_layout::{LAYER_ARTICULATION, LAYER_BABBLE, LAYER_FACES, LAYER_RIGS, Tag};

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

    /// Returns the articulation profile with this name, from the topmost file that sets articulation profiles.
    pub fn articulation(&self, name: &str) -> Option<ArticulationProfile<'a>> {
        self.bank_with(LAYER_ARTICULATION)?.articulation(name)
    }

    /// Returns the project's articulation profile, or [`ArticulationProfile::DEFAULT`].
    pub fn default_articulation(&self) -> ArticulationProfile<'a> {
        self.bank_with(LAYER_ARTICULATION).map_or(ArticulationProfile::DEFAULT, Bank::default_articulation)
    }

    /// Returns all articulation profiles, ordered by name.
    pub fn articulations(&self) -> impl Iterator<Item = ArticulationProfile<'a>> + Clone + '_ {
        let contents = section(self.bank_with(LAYER_ARTICULATION), Tag::ARTICULATION);
        profiles(contents, ArticulationProfile::split_first)
    }

    /// Returns all rigs, ordered by name.
    pub fn rigs(&self) -> impl Iterator<Item = Rig<'a>> + Clone + '_ {
        profiles(section(self.bank_with(LAYER_RIGS), Tag::RIGS), Rig::split_first)
    }

    /// Returns the rig with this name, from the topmost file that sets rigs.
    pub fn rig(&self, name: &str) -> Option<Rig<'a>> {
        self.bank_with(LAYER_RIGS)?.rig(name)
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
