//! The numbered inventory of phones (`docs/reference/bank-format.md`, "Phones").

use crate::UnknownName;
use core::fmt;
use core::str::FromStr;

/// A unit of speech: silence, a phone of the CMU Pronouncing Dictionary, or a phone of another language.
///
/// The numbers are part of the bank format, so new phones get new numbers. The inventory is wide enough for the mouth:
/// it distinguishes phones by lips, jaw and tongue, but neither by voice quality nor by length.
///
/// ```
/// use lipz_types::Phone;
/// let dh: Phone = "DH".parse()?;
/// assert_eq!((dh.ipa(), "ð".parse()), ("ð", Ok(dh)));
/// let front: Phone = "ø".parse()?; // as in German *schön*: not in the CMU Pronouncing Dictionary
/// assert_eq!((front.name(), front.arpabet()), ("ø", None));
/// # Ok::<(), lipz_types::UnknownName>(())
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Phone(u8);

/// The ARPAbet name and the IPA symbol of each phone. The first is empty where ARPAbet has no name.
const NAMES: [(&str, &str); 118] = [
    ("SIL", ""),
    // The CMU Pronouncing Dictionary, sorted by name.
    ("AA", "ɑ"),
    ("AE", "æ"),
    ("AH", "ʌ"),
    ("AO", "ɔ"),
    ("AW", "aʊ"),
    ("AY", "aɪ"),
    ("B", "b"),
    ("CH", "tʃ"),
    ("D", "d"),
    ("DH", "ð"),
    ("EH", "ɛ"),
    ("ER", "ɝ"),
    ("EY", "eɪ"),
    ("F", "f"),
    ("G", "ɡ"),
    ("HH", "h"),
    ("IH", "ɪ"),
    ("IY", "i"),
    ("JH", "dʒ"),
    ("K", "k"),
    ("L", "l"),
    ("M", "m"),
    ("N", "n"),
    ("NG", "ŋ"),
    ("OW", "oʊ"),
    ("OY", "ɔɪ"),
    ("P", "p"),
    ("R", "ɹ"),
    ("S", "s"),
    ("SH", "ʃ"),
    ("T", "t"),
    ("TH", "θ"),
    ("UH", "ʊ"),
    ("UW", "u"),
    ("V", "v"),
    ("W", "w"),
    ("Y", "j"),
    ("Z", "z"),
    ("ZH", "ʒ"),
    // Vowels: close to open.
    ("", "y"),
    ("", "ʏ"),
    ("", "ɨ"),
    ("", "ʉ"),
    ("", "ɯ"),
    ("", "e"),
    ("", "ø"),
    ("", "ɘ"),
    ("", "ɵ"),
    ("", "ɤ"),
    ("", "o"),
    ("AX", "ə"),
    ("", "œ"),
    ("", "ɜ"),
    ("", "ɞ"),
    ("AXR", "ɚ"),
    ("", "ɐ"),
    ("", "a"),
    ("", "ɶ"),
    ("", "ɒ"),
    // Nasal vowels.
    ("", "ɛ̃"),
    ("", "œ̃"),
    ("", "ɔ̃"),
    ("", "ɑ̃"),
    ("", "ɐ̃"),
    ("", "ẽ"),
    ("", "ĩ"),
    ("", "õ"),
    ("", "ũ"),
    // Lips.
    ("", "ɸ"),
    ("", "β"),
    ("", "ʙ"),
    ("", "ɱ"),
    ("", "ʋ"),
    ("", "pf"),
    ("WH", "ʍ"),
    ("", "ɥ"),
    // Tip and blade of the tongue.
    ("", "ts"),
    ("", "dz"),
    ("DX", "ɾ"),
    ("", "r"),
    ("", "ɬ"),
    ("", "ɮ"),
    ("", "ɕ"),
    ("", "ʑ"),
    ("", "tɕ"),
    ("", "dʑ"),
    ("", "ʂ"),
    ("", "ʐ"),
    ("", "tʂ"),
    ("", "dʐ"),
    ("", "ʈ"),
    ("", "ɖ"),
    ("", "ɳ"),
    ("", "ɭ"),
    ("", "ɽ"),
    ("", "ɻ"),
    ("", "ɫ"),
    // Body of the tongue, and throat.
    ("", "c"),
    ("", "ɟ"),
    ("", "ɲ"),
    ("", "ç"),
    ("", "ʝ"),
    ("", "ʎ"),
    ("", "x"),
    ("", "ɣ"),
    ("", "ɰ"),
    ("", "q"),
    ("", "ɢ"),
    ("", "ɴ"),
    ("", "χ"),
    ("", "ʁ"),
    ("", "ʀ"),
    ("", "ħ"),
    ("", "ʕ"),
    ("Q", "ʔ"),
    ("", "ɦ"),
    ("", "ɧ"),
];

impl Phone {
    /// Silence, with number 0.
    pub const SILENCE: Phone = Phone(0);

    /// The number of phones in the inventory.
    pub const COUNT: usize = NAMES.len();

    /// Returns the phone with this number, if there is one.
    pub const fn from_number(number: u8) -> Option<Phone> {
        if (number as usize) < Phone::COUNT { Some(Phone(number)) } else { None }
    }

    /// Returns the number, less than [`Phone::COUNT`].
    pub const fn number(self) -> u8 {
        self.0
    }

    /// Returns the ARPAbet name without stress, if ARPAbet has one; `SIL` for silence.
    pub fn arpabet(self) -> Option<&'static str> {
        Some(self.names().0).filter(|name| !name.is_empty())
    }

    /// Returns the symbol of the International Phonetic Alphabet; empty for silence.
    pub fn ipa(self) -> &'static str {
        self.names().1
    }

    /// Returns the name in Lipz files: `sil` for silence, the ARPAbet name if there is one, or else the IPA symbol.
    pub fn name(self) -> &'static str {
        match self.names() {
            ("SIL", _) => "sil",
            ("", ipa) => ipa,
            (arpabet, _) => arpabet,
        }
    }

    /// Returns all phones, in the order of their numbers.
    pub fn all() -> impl Iterator<Item = Phone> {
        (0..Phone::COUNT as u8).map(Phone)
    }

    fn names(self) -> (&'static str, &'static str) {
        NAMES.get(usize::from(self.0)).copied().unwrap_or_default()
    }
}

/// Prints [`Phone::name`].
impl fmt::Display for Phone {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl fmt::Debug for Phone {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Phone").field(&self.name()).finish()
    }
}

/// Parses an ARPAbet name in capitals without stress, an IPA symbol, or `sil`. Letters of the two alphabets differ: `Y`
/// is IPA `j`, and `y` is a vowel.
impl FromStr for Phone {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Phone, UnknownName> {
        const UNKNOWN: UnknownName = UnknownName::new("phone", "ARPAbet in capitals such as `AA`, IPA, or `sil`");
        let is_same = |phone: &Phone| {
            let (arpabet, ipa) = phone.names();
            name == phone.name() || name == arpabet || name == ipa
        };
        Phone::all().find(is_same).filter(|_| !name.is_empty()).ok_or(UNKNOWN)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::string::ToString;

    #[test]
    fn numbers_and_names_lead_back_to_the_phone() {
        for (number, phone) in (0..).zip(Phone::all()) {
            assert_eq!(Phone::from_number(number), Some(phone));
            assert_eq!(phone.to_string().parse(), Ok(phone));
            assert!(phone == Phone::SILENCE || phone.ipa().parse() == Ok(phone), "{phone}");
            assert!(phone.arpabet().is_none_or(|name| name.parse() == Ok(phone)), "{phone}");
        }
        assert_eq!(Phone::from_number(Phone::COUNT as u8), None);
        assert_eq!("sil".parse(), Ok(Phone::SILENCE));
    }

    #[test]
    fn letters_of_the_two_alphabets_differ() {
        let number = |name: &str| name.parse::<Phone>().map(Phone::number).ok();
        assert_ne!(number("Y"), number("y"));
        assert_ne!(number("R"), number("r"));
        assert_eq!(number("B"), number("b"));
        for bad in ["", "aa", "AH1", "Ä", "SP"] {
            assert!(bad.parse::<Phone>().is_err(), "{bad}");
        }
    }
}
