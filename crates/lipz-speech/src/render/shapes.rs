//! The shape of each phone.

use super::RenderRules;
use crate::{AlignedPhone, Phone};
use lipz_types::{Viseme, VisemeType, Weight};

/// The code of rest.
pub(super) const REST: u8 = b'-';

/// A shape, as a code of Blair's chart, and its time.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct TimedShape {
    pub(super) shape: u8,
    pub(super) start_us: u64,
    pub(super) end_us: u64,
}

impl TimedShape {
    pub(super) fn length_us(&self) -> u64 {
        self.end_us - self.start_us
    }

    /// Whether this is the shape of a consonant other than the closed ones.
    pub(super) fn is_consonant(&self) -> bool {
        matches!(self.shape, b'S' | b'L' | b'W')
    }

    /// Whether viewers must be able to see the shape: closed lips, or the lip under the teeth.
    pub(super) fn is_closed(&self) -> bool {
        matches!(self.shape, b'M' | b'F')
    }
}

/// The start of a diphthong's second shape, in tenths of its length.
const GLIDE_TENTHS: u64 = 6;

/// Returns the shapes of phones, with equal neighbours merged.
pub(super) fn of_phones(phones: &[AlignedPhone], rules: &RenderRules) -> Vec<TimedShape> {
    let mut shapes: Vec<TimedShape> = Vec::with_capacity(phones.len());
    let mut add = |shape, start_us, end_us| match shapes.last_mut() {
        Some(last) if last.shape == shape => last.end_us = end_us,
        _ if start_us == end_us => {}
        _ => shapes.push(TimedShape { shape, start_us, end_us }),
    };
    for (number, phone) in phones.iter().enumerate() {
        let AlignedPhone { start_us, end_us, .. } = *phone;
        let (first, second) = match phone.phone {
            // h has the shape of the next phone.
            Phone::Hh => (phones.get(number + 1).map_or(b'S', |next| of_phone(next.phone).0), None),
            phone => of_phone(phone),
        };
        let is_short = phone.phone.is_vowel() && end_us - start_us < rules.shortest_wide_us;
        let first = if is_short && first == b'A' { b'E' } else { first };
        match second {
            Some(second) if !is_short => {
                let glide_us = start_us + (end_us - start_us) * GLIDE_TENTHS / 10;
                add(first, start_us, glide_us);
                add(second, glide_us, end_us);
            }
            _ => add(first, start_us, end_us),
        }
    }
    shapes
}

/// Moves shapes earlier by `lead_us`, and cuts off the part before the audio.
pub(super) fn advance(shapes: &mut [TimedShape], lead_us: u64) {
    for shape in shapes {
        shape.start_us = shape.start_us.saturating_sub(lead_us);
        shape.end_us = shape.end_us.saturating_sub(lead_us);
    }
}

/// Returns the shape of a phone, and the final shape of a diphthong, from Preston Blair's chart ("Advanced Animation",
/// 1947). Phones that are not in the chart have the most similar shape of lips and teeth.
fn of_phone(phone: Phone) -> (u8, Option<u8>) {
    match phone {
        Phone::Aa | Phone::Ae | Phone::Ah => (b'A', None),
        Phone::Ay => (b'A', Some(b'E')),
        Phone::Aw => (b'A', Some(b'O')),
        Phone::Eh | Phone::Er | Phone::Ey | Phone::Ih | Phone::Iy => (b'E', None),
        Phone::Ao => (b'O', None),
        Phone::Ow => (b'O', Some(b'U')),
        Phone::Oy => (b'O', Some(b'E')),
        Phone::Uh | Phone::Uw => (b'U', None),
        Phone::W => (b'W', None),
        Phone::L => (b'L', None),
        Phone::B | Phone::M | Phone::P => (b'M', None),
        Phone::F | Phone::V => (b'F', None),
        Phone::Sil | Phone::Noise | Phone::Spoken => (REST, None),
        _ => (b'S', None),
    }
}

/// Returns the code of a shape in a viseme type.
pub(super) fn code(shape: u8, viseme_type: VisemeType) -> u8 {
    match viseme_type {
        VisemeType::Blair => shape,
        VisemeType::ToonBoom => match shape {
            b'M' => b'A',
            b'S' | b'L' => b'B',
            b'E' => b'C',
            b'A' => b'D',
            b'O' => b'E',
            b'W' | b'U' => b'F',
            b'F' => b'G',
            _ => REST,
        },
        VisemeType::Rms if shape == REST => REST,
        VisemeType::Rms => {
            let openness = Viseme::from_code(shape).openness(VisemeType::Blair).ten_thousandths();
            let mut digits = (b'0'..=b'9').rev();
            digits.find(|&digit| Weight::from_digit(digit).ten_thousandths() <= openness).unwrap_or(b'0')
        }
    }
}
