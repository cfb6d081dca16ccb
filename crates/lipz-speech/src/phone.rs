//! Phones: the units of speech that the acoustic model distinguishes.

use std::error::Error;
use std::fmt;
use std::str::FromStr;

/// A unit of speech that the acoustic model distinguishes: one of the 39 phones of the CMU Pronouncing Dictionary
/// (ARPAbet without stress), silence, or noise.
///
/// Phones of other languages are mapped to the nearest of these.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[repr(u8)]
pub enum Phone {
    /// As in *father*.
    Aa,
    /// As in *cat*.
    Ae,
    /// As in *hut*, and the weak vowel of *about*.
    Ah,
    /// As in *law*.
    Ao,
    /// As in *cow*.
    Aw,
    /// As in *my*.
    Ay,
    /// As in *boy*.
    B,
    /// As in *chair*.
    Ch,
    /// As in *day*.
    D,
    /// As in *then*.
    Dh,
    /// As in *bed*.
    Eh,
    /// As in *bird*.
    Er,
    /// As in *say*.
    Ey,
    /// As in *far*.
    F,
    /// As in *go*.
    G,
    /// As in *hat*.
    Hh,
    /// As in *sit*.
    Ih,
    /// As in *see*.
    Iy,
    /// As in *joy*.
    Jh,
    /// As in *key*.
    K,
    /// As in *low*.
    L,
    /// As in *my*.
    M,
    /// As in *no*.
    N,
    /// As in *sing*.
    Ng,
    /// As in *go*.
    Ow,
    /// As in *toy*.
    Oy,
    /// As in *pay*.
    P,
    /// As in *red*.
    R,
    /// As in *so*.
    S,
    /// As in *she*.
    Sh,
    /// As in *to*.
    T,
    /// As in *thin*.
    Th,
    /// As in *book*.
    Uh,
    /// As in *too*.
    Uw,
    /// As in *voice*.
    V,
    /// As in *we*.
    W,
    /// As in *yes*.
    Y,
    /// As in *zoo*.
    Z,
    /// As in *vision*.
    Zh,
    /// Silence, `SIL`.
    Sil,
    /// A noise not made by the speaker, `+NSN+`.
    Noise,
    /// A sound of the speaker other than a word, `+SPN+`: a breath, a cough, a laugh.
    Spoken,
}

impl Phone {
    /// The number of phones.
    pub const COUNT: usize = Phone::ALL.len();

    /// All phones, in the order of their indices: those of speech sorted by name, then silence and noise.
    pub const ALL: [Phone; 42] = [
        Phone::Aa,
        Phone::Ae,
        Phone::Ah,
        Phone::Ao,
        Phone::Aw,
        Phone::Ay,
        Phone::B,
        Phone::Ch,
        Phone::D,
        Phone::Dh,
        Phone::Eh,
        Phone::Er,
        Phone::Ey,
        Phone::F,
        Phone::G,
        Phone::Hh,
        Phone::Ih,
        Phone::Iy,
        Phone::Jh,
        Phone::K,
        Phone::L,
        Phone::M,
        Phone::N,
        Phone::Ng,
        Phone::Ow,
        Phone::Oy,
        Phone::P,
        Phone::R,
        Phone::S,
        Phone::Sh,
        Phone::T,
        Phone::Th,
        Phone::Uh,
        Phone::Uw,
        Phone::V,
        Phone::W,
        Phone::Y,
        Phone::Z,
        Phone::Zh,
        Phone::Sil,
        Phone::Noise,
        Phone::Spoken,
    ];

    /// Returns the index of the phone in [`Phone::ALL`].
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Returns the ARPAbet name in capitals, without stress; `SIL`, `+NSN+` and `+SPN+` as in CMU Sphinx.
    pub const fn name(self) -> &'static str {
        match self {
            Phone::Aa => "AA",
            Phone::Ae => "AE",
            Phone::Ah => "AH",
            Phone::Ao => "AO",
            Phone::Aw => "AW",
            Phone::Ay => "AY",
            Phone::B => "B",
            Phone::Ch => "CH",
            Phone::D => "D",
            Phone::Dh => "DH",
            Phone::Eh => "EH",
            Phone::Er => "ER",
            Phone::Ey => "EY",
            Phone::F => "F",
            Phone::G => "G",
            Phone::Hh => "HH",
            Phone::Ih => "IH",
            Phone::Iy => "IY",
            Phone::Jh => "JH",
            Phone::K => "K",
            Phone::L => "L",
            Phone::M => "M",
            Phone::N => "N",
            Phone::Ng => "NG",
            Phone::Ow => "OW",
            Phone::Oy => "OY",
            Phone::P => "P",
            Phone::R => "R",
            Phone::S => "S",
            Phone::Sh => "SH",
            Phone::T => "T",
            Phone::Th => "TH",
            Phone::Uh => "UH",
            Phone::Uw => "UW",
            Phone::V => "V",
            Phone::W => "W",
            Phone::Y => "Y",
            Phone::Z => "Z",
            Phone::Zh => "ZH",
            Phone::Sil => "SIL",
            Phone::Noise => "+NSN+",
            Phone::Spoken => "+SPN+",
        }
    }

    /// Whether the phone is a vowel or a diphthong.
    pub const fn is_vowel(self) -> bool {
        matches!(
            self,
            Phone::Aa
                | Phone::Ae
                | Phone::Ah
                | Phone::Ao
                | Phone::Aw
                | Phone::Ay
                | Phone::Eh
                | Phone::Er
                | Phone::Ey
                | Phone::Ih
                | Phone::Iy
                | Phone::Ow
                | Phone::Oy
                | Phone::Uh
                | Phone::Uw
        )
    }

    /// Whether the phone is part of a word, rather than silence or noise.
    pub const fn is_speech(self) -> bool {
        !matches!(self, Phone::Sil | Phone::Noise | Phone::Spoken)
    }
}

/// Prints [`Phone::name`].
impl fmt::Display for Phone {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Parses a name in letters of either case, with or without the digit of the stress: `AA`, `aa` or `AA1`.
impl FromStr for Phone {
    type Err = ParsePhoneError;

    fn from_str(name: &str) -> Result<Phone, ParsePhoneError> {
        let plain = name.strip_suffix(['0', '1', '2']).unwrap_or(name);
        let same = |phone: &Phone| match phone.is_vowel() {
            true => plain.eq_ignore_ascii_case(phone.name()),
            false => name.eq_ignore_ascii_case(phone.name()), // consonants have no stress
        };
        Phone::ALL.into_iter().find(same).ok_or(ParsePhoneError)
    }
}

/// The error for a name that is not the name of a [`Phone`].
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ParsePhoneError;

impl fmt::Display for ParsePhoneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("unknown phone; expected one of the CMU Pronouncing Dictionary, such as `AA` or `CH`")
    }
}

impl Error for ParsePhoneError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_names_lead_back_to_the_phone() {
        for (index, phone) in Phone::ALL.into_iter().enumerate() {
            assert_eq!(phone.index(), index);
            assert_eq!(phone.to_string().parse(), Ok(phone));
            assert_eq!(phone.name().to_lowercase().parse(), Ok(phone));
        }
    }

    #[test]
    fn vowels_have_a_stress_and_nothing_else_has() {
        assert_eq!("AH0".parse(), Ok(Phone::Ah));
        assert_eq!("er1".parse(), Ok(Phone::Er));
        for bad in ["", "B1", "AH3", "AH00", "SIL0", "A", "AX", "Ä"] {
            assert_eq!(bad.parse::<Phone>(), Err(ParsePhoneError), "{bad}");
        }
    }

    #[test]
    fn fifteen_phones_are_vowels_and_three_are_not_speech() {
        assert_eq!(Phone::ALL.into_iter().filter(|phone| phone.is_vowel()).count(), 15);
        assert_eq!(Phone::ALL.into_iter().filter(|phone| !phone.is_speech()).count(), 3);
    }
}
