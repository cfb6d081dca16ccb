//! Conversion of a tier's labels to symbols of a mapping table.

use super::Tier;
use super::phones::{is_noise, is_silence, is_spoken_noise, plain_ipa, plain_xsampa, without_stress};
use crate::{Map, find_map};
use lipz_file::text::trim;
use lipz_types::VisemeType;

/// Tables for phones, then those for codes.
pub(super) const ARPABET: &str = "cmu";
pub(super) const IPA: &str = "ipa";
pub(super) const XSAMPA: &str = "xsampa";
/// The symbols for speech whose phones are unknown.
const SPOKEN_NOISE_IN_ARPABET: &str = "AH";
const SPOKEN_NOISE_ELSEWHERE: &str = "spn";

/// The conversion of a tier's labels to symbols of a table.
#[derive(Clone, Copy)]
pub(super) enum Symbols<'m> {
    Codes(VisemeType),
    Arpabet,
    Ipa,
    XSampa,
    /// A custom table, with its own symbols.
    Own(&'m Map),
}

/// The kind of sound that a label stands for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Sound {
    /// A phone, silence, or a label that is unknown.
    Phone,
    /// Speech whose phones are unknown.
    Spoken,
    /// A noise, during which the mouth rests.
    Noise,
}

impl<'m> Symbols<'m> {
    /// Returns the custom table, or the alphabet that more labels of the tier belong to. Other labels do not decide.
    pub(super) fn of_phones(phones: &Tier, own: Option<&'m Map>) -> Symbols<'m> {
        if let Some(map) = own {
            return Symbols::Own(map);
        }
        let labels = || phones.intervals.iter().map(|interval| trim(&interval.label));
        let has_phone = |label: &&str| !(is_silence(label) || is_noise(label) || is_spoken_noise(label));
        let known = |symbols: &Symbols<'_>| {
            let map = find_map(symbols.table());
            labels()
                .filter(has_phone)
                .filter(|label| map.is_some_and(|map| map.code(&symbols.plain(label)).is_some()))
                .count()
        };
        // `max_by_key` returns the last one of several with the same number.
        [Symbols::XSampa, Symbols::Ipa, Symbols::Arpabet].into_iter().max_by_key(known).unwrap_or(Symbols::Arpabet)
    }

    /// Returns a label without the details that its alphabet adds to a phone.
    fn plain(self, label: &str) -> String {
        match self {
            Symbols::Arpabet => without_stress(label).to_owned(),
            Symbols::XSampa => plain_xsampa(label),
            _ => plain_ipa(label),
        }
    }

    pub(super) fn table(self) -> &'static str {
        match self {
            Symbols::Codes(VisemeType::Blair) => "blair",
            Symbols::Codes(VisemeType::ToonBoom) => "toonboom",
            Symbols::Codes(VisemeType::Rms) => "rms",
            Symbols::Arpabet => ARPABET,
            Symbols::XSampa => XSAMPA,
            Symbols::Ipa | Symbols::Own(_) => IPA,
        }
    }

    /// Returns the symbol for a label.
    pub(super) fn symbol(self, label: &str) -> String {
        let label = trim(label);
        let rest = || find_map(self.table()).and_then(|map| map.symbol(b'-')).unwrap_or("sil").to_owned();
        match self {
            Symbols::Own(map) if map.code(label).is_some() => label.to_owned(),
            Symbols::Own(map) if is_silence(label) || self.sound(label) == Sound::Noise => {
                map.symbol(b'-').unwrap_or(label).to_owned()
            }
            Symbols::Own(map) if map.code(without_stress(label)).is_some() => without_stress(label).to_owned(),
            Symbols::Own(map) => known(&plain_ipa(label), map).unwrap_or_else(|| label.to_owned()),
            _ if is_silence(label) || self.sound(label) == Sound::Noise => rest(),
            Symbols::Codes(_) => label.to_owned(),
            Symbols::Arpabet if self.sound(label) == Sound::Spoken => SPOKEN_NOISE_IN_ARPABET.to_owned(),
            Symbols::Arpabet => self.plain(label),
            _ if self.sound(label) == Sound::Spoken => SPOKEN_NOISE_ELSEWHERE.to_owned(),
            Symbols::Ipa | Symbols::XSampa => find_map(self.table())
                .and_then(|map| known(&self.plain(label), map))
                .unwrap_or_else(|| label.to_owned()),
        }
    }

    /// Returns the kind of sound of a trimmed label.
    pub(super) fn sound(self, label: &str) -> Sound {
        match self {
            Symbols::Codes(_) => Sound::Phone,
            Symbols::Own(map) if map.code(label).is_some() => Sound::Phone,
            _ if is_noise(label) => Sound::Noise,
            _ if is_spoken_noise(label) => Sound::Spoken,
            _ => Sound::Phone,
        }
    }
}

/// The most letters of a phone that are looked up. No symbol of a table has more.
const MOST_LETTERS: usize = 8;

/// Returns the symbol for a phone in IPA, in the built-in table or in a custom one.
pub(crate) fn phone_symbol(label: &str, own: Option<&Map>) -> String {
    own.map_or(Symbols::Ipa, Symbols::Own).symbol(label)
}

/// Returns the symbol of a table for a phone: the whole phone, or its first letters.
fn known(phone: &str, map: &Map) -> Option<String> {
    let ends = phone.char_indices().map(|(at, _)| at).skip(1).chain([phone.len()]).take(MOST_LETTERS);
    let prefixes = ends.collect::<Vec<_>>().into_iter().rev().filter_map(|end| phone.get(..end));
    prefixes.filter(|prefix| !prefix.is_empty()).find(|prefix| map.code(prefix).is_some()).map(str::to_owned)
}
