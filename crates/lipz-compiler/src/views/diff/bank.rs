//! The differences of banks as a whole, which belong to no single clip.

use super::Change;
use super::locale_pair::LocalePair;
use crate::bank::{Coverage, coverage};
use lipz_bank::Dialogue;
use lipz_bank::babble::Babble;
use lipz_bank::face::FaceProfile;
use std::collections::{BTreeSet, HashMap};

/// A difference in the fallbacks of a locale that both banks have.
#[derive(Clone, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct FallbackChange<'d> {
    /// The locale.
    pub locale: &'d str,
    /// The locales whose texts its clips show instead of missing ones; with an empty tag for locales that are not in
    /// the bank.
    #[cfg_attr(feature = "json", serde(flatten))]
    pub from: Change<BTreeSet<String>>,
}

/// A difference in a babble profile.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct BabbleChange<'d> {
    /// The name of the profile.
    pub name: &'d str,
    /// The profiles; `None` in a bank without this profile.
    #[cfg_attr(feature = "json", serde(flatten, serialize_with = "super::json_fields::babble"))]
    pub profile: Change<Option<Babble<'d>>>,
}

/// A difference in a face profile.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "json", derive(serde::Serialize))]
pub struct FaceChange<'d> {
    /// The name of the profile.
    pub name: &'d str,
    /// The profiles; `None` in a bank without this profile.
    #[cfg_attr(feature = "json", serde(flatten, serialize_with = "super::json_fields::face"))]
    pub profile: Change<Option<FaceProfile<'d>>>,
}

pub(super) fn fallbacks<'d>(
    old: &Dialogue<'_>,
    new: &Dialogue<'_>,
    locales: &[LocalePair<'d>],
) -> Vec<FallbackChange<'d>> {
    let by_tag = |found: Vec<Coverage>| -> HashMap<String, BTreeSet<String>> {
        found.into_iter().map(|locale| (locale.tag, locale.fallbacks.into_keys().collect())).collect()
    };
    let (mut old, mut new) = (by_tag(coverage(old)), by_tag(coverage(new)));
    let mut change = |pair: &LocalePair<'d>| {
        let from = Change::between(old.remove(pair.tag)?, new.remove(pair.tag)?)?;
        Some(FallbackChange { locale: pair.tag, from })
    };
    locales.iter().filter_map(&mut change).collect()
}

pub(super) fn babble<'d>(old: &Dialogue<'d>, new: &Dialogue<'d>) -> Vec<BabbleChange<'d>> {
    let names: BTreeSet<&'d str> = old.babbles().chain(new.babbles()).map(|babble| babble.name()).collect();
    let change = |name: &'d str| {
        let profile = Change::between(old.babble(name), new.babble(name))?;
        Some(BabbleChange { name, profile })
    };
    names.into_iter().filter_map(change).collect()
}

pub(super) fn faces<'d>(old: &Dialogue<'d>, new: &Dialogue<'d>) -> Vec<FaceChange<'d>> {
    let names: BTreeSet<&'d str> = old.face_profiles().chain(new.face_profiles()).map(|face| face.name()).collect();
    let change = |name: &'d str| {
        let profile = Change::between(old.face_profile(name), new.face_profile(name))?;
        Some(FaceChange { name, profile })
    };
    names.into_iter().filter_map(change).collect()
}

pub(super) fn articulation<'d>(old: &Dialogue<'d>, new: &Dialogue<'d>) -> Vec<&'d str> {
    let names: BTreeSet<&'d str> = old.articulations().chain(new.articulations()).map(|found| found.name()).collect();
    names.into_iter().filter(|name| old.articulation(name) != new.articulation(name)).collect()
}

pub(super) fn rigs<'d>(old: &Dialogue<'d>, new: &Dialogue<'d>) -> Vec<&'d str> {
    let names: BTreeSet<&'d str> = old.rigs().chain(new.rigs()).map(|rig| rig.name()).collect();
    names.into_iter().filter(|name| old.rig(name) != new.rig(name)).collect()
}
