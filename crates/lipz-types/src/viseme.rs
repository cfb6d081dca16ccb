//! Visemes and viseme types: the codes of the Lipz specification.

use crate::{UnknownName, Weight};
use core::convert::TryFrom;
use core::fmt;
use core::str::FromStr;

/// The set of mouth shapes that a clip's codes belong to (Lipz specification, "Visemes").
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[repr(u8)]
pub enum VisemeType {
    /// Preston Blair's chart: nine shapes and rest.
    Blair = 1,
    /// Toon Boom's chart: seven shapes and rest.
    ToonBoom = 2,
    /// Loudness of the frame: ten degrees of openness, and rest.
    Rms = 3,
}

impl VisemeType {
    /// The three types, in the order of their numbers.
    pub const ALL: [VisemeType; 3] = [VisemeType::Blair, VisemeType::ToonBoom, VisemeType::Rms];

    /// Returns the name as written in the `viseme_type` element.
    pub const fn name(self) -> &'static str {
        match self {
            VisemeType::Blair => "blair",
            VisemeType::ToonBoom => "toonboom",
            VisemeType::Rms => "rms",
        }
    }

    /// Returns every valid code, rest first, in the order of the specification's tables.
    pub const fn codes(self) -> &'static str {
        match self {
            VisemeType::Blair => "-AMOSWEFLU",
            VisemeType::ToonBoom => "-ABCDEFG",
            VisemeType::Rms => "-0123456789",
        }
    }

    /// Whether `code` is one of [`VisemeType::codes`].
    #[inline]
    pub const fn contains(self, code: u8) -> bool {
        match self {
            VisemeType::Blair => matches!(code, b'-' | b'A' | b'M' | b'O' | b'S' | b'W' | b'E' | b'F' | b'L' | b'U'),
            VisemeType::ToonBoom => matches!(code, b'-' | b'A'..=b'G'),
            VisemeType::Rms => matches!(code, b'-' | b'0'..=b'9'),
        }
    }

    /// Whether every byte of `codes` is a valid code.
    #[inline]
    pub fn contains_all(self, codes: &[u8]) -> bool {
        if !cfg!(target_pointer_width = "64") {
            return codes.iter().all(|&code| self.contains(code));
        }
        // One loop per type, without early exit, so that each is vectorised.
        match self {
            VisemeType::Blair => all(codes, |code| VisemeType::Blair.contains(code)),
            VisemeType::ToonBoom => all(codes, |code| VisemeType::ToonBoom.contains(code)),
            VisemeType::Rms => all(codes, |code| VisemeType::Rms.contains(code)),
        }
    }

    /// Returns the type with this number, as stored in banks; `None` for 0, which is "unspecified", and for any other
    /// number.
    #[inline]
    pub const fn from_number(number: u8) -> Option<VisemeType> {
        match number {
            1 => Some(VisemeType::Blair),
            2 => Some(VisemeType::ToonBoom),
            3 => Some(VisemeType::Rms),
            _ => None,
        }
    }
}

#[inline(always)]
fn all(codes: &[u8], legal: impl Fn(u8) -> bool) -> bool {
    codes.iter().fold(true, |so_far, &code| so_far & legal(code))
}

impl fmt::Display for VisemeType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Parses the name, which must match [`VisemeType::name`] exactly.
impl FromStr for VisemeType {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<VisemeType, UnknownName> {
        let found = VisemeType::ALL.iter().copied().find(|viseme_type| viseme_type.name() == name);
        found.ok_or(UnknownName::new("viseme type", "`blair`, `toonboom` or `rms`"))
    }
}

/// Converts the number, as stored in banks.
impl TryFrom<u8> for VisemeType {
    type Error = UnknownName;

    fn try_from(number: u8) -> Result<VisemeType, UnknownName> {
        VisemeType::from_number(number).ok_or(UnknownName::new("viseme type", "1, 2 or 3"))
    }
}

/// One mouth shape: the code of one frame.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Viseme(u8);

impl Viseme {
    /// The resting mouth, `-` in every viseme type: the speaker is not speaking.
    pub const REST: Viseme = Viseme(b'-');

    /// Returns the viseme with this code.
    #[inline]
    pub const fn from_code(code: u8) -> Viseme {
        Viseme(code)
    }

    /// Returns the Lipz code, an ASCII character in any bank that passes verification.
    #[inline]
    pub const fn code(self) -> u8 {
        self.0
    }

    /// Returns the Lipz code as a character.
    #[inline]
    pub const fn to_char(self) -> char {
        self.0 as char
    }

    /// Whether this is [`Viseme::REST`].
    #[inline]
    pub const fn is_rest(self) -> bool {
        self.0 == b'-'
    }
}

impl Viseme {
    /// Returns how far the mouth is open for this code of type `viseme_type`.
    ///
    /// The digits of `rms` state it directly. The shapes of the other types correspond to these digits: A and I 9, E
    /// and O 6, L 4, most consonants 3, U, W and Q 2, F and V 1, and M, B, P and rest 0.
    pub const fn openness(self, viseme_type: VisemeType) -> Weight {
        let digit = match viseme_type {
            VisemeType::Rms => self.code(),
            VisemeType::Blair => match self.code() {
                b'A' => b'9',
                b'E' | b'O' => b'6',
                b'L' => b'4',
                b'S' => b'3',
                b'U' | b'W' => b'2',
                b'F' => b'1',
                _ => b'0',
            },
            VisemeType::ToonBoom => match self.code() {
                b'D' => b'9',
                b'C' | b'E' => b'6',
                b'B' => b'3',
                b'F' => b'2',
                b'G' => b'1',
                _ => b'0',
            },
        };
        Weight::from_digit(digit)
    }
}

impl fmt::Debug for Viseme {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Viseme({:?})", self.to_char())
    }
}

impl fmt::Display for Viseme {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.to_char())
    }
}
