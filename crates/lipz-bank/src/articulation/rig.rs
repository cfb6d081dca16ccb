//! Rigs: the weights of a model's shapes, computed from articulation, emotions and the face.

use super::{Articulation, Articulator};
use crate::Bank;
use crate::face::{Emotions, Face};
use crate::file::{entries, profiles};
use core::fmt;
use core::mem::size_of;
use lipz_layout::{NO_INPUT, RigRecord, RigTermRecord, RigWeightRecord, Tag};
use lipz_types::{CurveValue, Emotion};
use zerocopy::{FromBytes, IntoBytes};

/// The shapes of a model: names, and for each a sum of terms. `[rig.NAME]` in `lipz.toml` adds one to the bank.
///
/// A term is a factor times one input or the product of two. The inputs are the articulators, the emotions (0 to 1 for
/// values from 0 to 10), `blink`, `brows` and `shrug` of the face, and the constant 1. So a smile and an "ee" add up,
/// and a shape for closed lips can follow the jaw.
#[derive(Clone, Copy)]
pub struct Rig<'data> {
    name: &'data [u8],
    weights: &'data [RigWeightRecord],
    terms: &'data [RigTermRecord],
    names: &'data [u8],
}

/// The number of inputs that come from articulators and emotions.
const FIRST_OF_FACE: usize = Articulator::ALL.len() + Emotion::ALL.len();
/// The number of inputs.
const INPUTS: usize = FIRST_OF_FACE + 4;
/// The number of thousandths in a whole.
const WHOLE: i32 = 1000;
/// The largest input, in thousandths, so that the product of two and a factor has 32 bits.
const MOST_INPUT: i32 = 4000;

impl<'data> Rig<'data> {
    /// Returns the rig at the start of `bytes`, and the bytes after it; `None` if they are cut off.
    pub(crate) fn split_first(bytes: &'data [u8]) -> Option<(Rig<'data>, &'data [u8])> {
        let (record, rest) = RigRecord::ref_from_prefix(bytes).ok()?;
        let (name, rest) = split(rest, usize::from(record.name_length_bytes.get()))?;
        let (weights, rest) = split(rest, length_bytes::<RigWeightRecord>(record.weight_count.get()))?;
        let (terms, rest) = split(rest, length_bytes::<RigTermRecord>(record.term_count.get()))?;
        let (names, rest) = split(rest, usize::from(record.names_length_bytes.get()))?;
        Some((Rig { name, weights: entries(weights), terms: entries(terms), names }, rest))
    }

    /// Whether names and terms follow each other, inputs are known, and no range is empty.
    pub(super) fn is_valid(&self) -> bool {
        let (mut terms_end, mut names_end) = (0, 0);
        let follow = self.weights.iter().all(|weight| {
            let follows = weight.terms_end.get() >= terms_end && weight.names_end.get() > names_end;
            terms_end = weight.terms_end.get();
            names_end = weight.names_end.get();
            follows && weight.least.get() < weight.most.get()
        });
        let is_input = |input: u8| usize::from(input) < INPUTS;
        let are_known =
            |term: &RigTermRecord| is_input(term.first) && (term.second == NO_INPUT || is_input(term.second));
        follow
            && usize::from(terms_end) == self.terms.len()
            && usize::from(names_end) == self.names.len()
            && self.terms.iter().all(are_known)
            && core::str::from_utf8(self.names).is_ok()
            && (0..self.weight_count()).all(|index| !self.weight_name(index).is_empty())
    }

    /// Returns the name of the rig. Empty only in a damaged bank.
    pub fn name(&self) -> &'data str {
        core::str::from_utf8(self.name).unwrap_or("")
    }

    pub(super) const fn name_bytes(&self) -> &'data [u8] {
        self.name
    }

    /// Returns the number of weights.
    pub const fn weight_count(&self) -> usize {
        self.weights.len()
    }

    /// Returns the name of the weight with this index, or an empty string.
    pub fn weight_name(&self, index: usize) -> &'data str {
        let start = |index: usize| {
            let before = index.checked_sub(1).and_then(|before| self.weights.get(before));
            before.map_or(0, |before| usize::from(before.names_end.get()))
        };
        let end = self.weights.get(index).map_or(0, |weight| usize::from(weight.names_end.get()));
        self.names.get(start(index)..end).and_then(|name| core::str::from_utf8(name).ok()).unwrap_or("")
    }

    /// Returns the names of all weights, in the order of [`Rig::weights`].
    pub fn weight_names(&self) -> impl Iterator<Item = &'data str> {
        let rig = *self;
        (0..rig.weight_count()).map(move |index| rig.weight_name(index))
    }

    /// Stores the weights in `out`, in the order of their names. Places of `out` without a weight keep their values.
    ///
    /// ```
    /// use lipz_bank::articulation::{Articulation, Rig};
    /// use lipz_bank::face::{Emotions, Face};
    /// use lipz_bank::curve::CurveValue;
    /// /// Moves the shapes of a model whose names were looked up before.
    /// fn apply(rig: &Rig<'_>, mouth: &Articulation, set: impl Fn(&str, f32)) {
    ///     let mut weights = [CurveValue::default(); 64];
    ///     rig.weights(mouth, &Emotions::default(), &Face::default(), &mut weights);
    ///     for (name, weight) in rig.weight_names().zip(weights) {
    ///         set(name, weight.to_f32());
    ///     }
    /// }
    /// ```
    pub fn weights(&self, articulation: &Articulation, emotions: &Emotions, face: &Face, out: &mut [CurveValue]) {
        let inputs = inputs(articulation, emotions, face);
        let mut start = 0;
        for (weight, value) in self.weights.iter().zip(out) {
            let end = usize::from(weight.terms_end.get());
            let terms = self.terms.get(start..end).unwrap_or(&[]);
            start = end;
            let sum = terms.iter().fold(0_i32, |sum, term| sum.saturating_add(product(term, &inputs)));
            let (least, most) = (i32::from(weight.least.get()), i32::from(weight.most.get()));
            *value = CurveValue::from_thousandths(sum.max(least).min(most));
        }
    }
}

/// Returns the inputs in the order of their numbers, in thousandths, limited so that a term has 32 bits.
fn inputs(articulation: &Articulation, emotions: &Emotions, face: &Face) -> [i32; INPUTS] {
    let mouth = articulation.0.iter().map(|value| i32::from(*value));
    let emotions = Emotion::ALL.iter().map(|emotion| emotions.get(*emotion).thousandths() / 10);
    let face = [face.blink, face.brows, face.shrug, CurveValue::from_thousandths(WHOLE)];
    let mut inputs = [0; INPUTS];
    let values = mouth.chain(emotions).chain(face.iter().map(|value| value.thousandths()));
    for (input, value) in inputs.iter_mut().zip(values) {
        *input = value.clamp(-MOST_INPUT, MOST_INPUT);
    }
    inputs
}

/// Returns the value of a term in thousandths, rounded towards zero. An unknown input is 0.
fn product(term: &RigTermRecord, inputs: &[i32; INPUTS]) -> i32 {
    let input = |number: u8| inputs.get(usize::from(number)).copied().unwrap_or(0);
    let first = i32::from(term.factor_thousandths.get()).wrapping_mul(input(term.first)) / WHOLE;
    match term.second {
        NO_INPUT => first,
        second => first.wrapping_mul(input(second)) / WHOLE,
    }
}

/// Returns the length of this number of records.
fn length_bytes<T>(count: u16) -> usize {
    usize::from(count).wrapping_mul(size_of::<T>())
}

fn split(bytes: &[u8], length: usize) -> Option<(&[u8], &[u8])> {
    Some((bytes.get(..length)?, bytes.get(length..)?))
}

/// Two rigs are equal if they have the same name, weights and terms.
impl PartialEq for Rig<'_> {
    fn eq(&self, other: &Self) -> bool {
        (self.name, self.names) == (other.name, other.names)
            && self.weights.as_bytes() == other.weights.as_bytes()
            && self.terms.as_bytes() == other.terms.as_bytes()
    }
}
impl Eq for Rig<'_> {}

impl fmt::Debug for Rig<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Rig").field(&self.name()).finish()
    }
}

impl<'data> Bank<'data> {
    /// Returns the rig with this name.
    pub fn rig(&self, name: &str) -> Option<Rig<'data>> {
        self.rigs().find(|rig| rig.name == name.as_bytes())
    }

    /// Returns all rigs of the bank, ordered by name.
    pub fn rigs(&self) -> impl Iterator<Item = Rig<'data>> + Clone {
        profiles(self.file.section(Tag::RIGS), Rig::split_first)
    }
}
