//! Curves: numbers that change while a clip plays, such as a character's anger.

mod check;
mod cursor;
mod curves;
pub(crate) mod table;

pub(crate) use check::check;
pub use cursor::CurveCursor;
pub use curves::CurveName;
pub use lipz_types::CurveValue;

use crate::origin::Origin;
use crate::{Clip, EventName, Time};
use core::fmt;
use lipz_types::{Position, StoredFps};
use table::Keys;

/// A key of a curve: its value at the start of a frame.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub struct CurveKey {
    /// The frame.
    pub frame: u32,
    /// The value.
    pub value: CurveValue,
}

/// A curve of a clip: a name, and keys ordered by frame.
///
/// Between two keys, the value changes linearly. Before the first key and after the last one it is constant, also
/// outside of the clip.
///
/// ```
/// # use lipz_bank::{Clip, Micros};
/// # fn draw(clip: &Clip<'_>, now: Micros) -> Option<()> {
/// let jaw = clip.curve("jawOpen")?; // a few searches: the clip's curves, and the name
/// let open = jaw.value_at(now)?.to_f32(); // a search among its keys
/// # None }
/// ```
#[derive(Clone, Copy)]
pub struct Curve<'a> {
    name: EventName<'a>,
    keys: Keys<'a>,
    fps: Option<StoredFps>,
    place: u32,
}

impl<'a> Curve<'a> {
    /// Returns the name.
    pub const fn name(&self) -> EventName<'a> {
        self.name
    }

    /// Returns the place of the curve among all curves of the bank, for [`Clip::curve_in_place`].
    pub const fn place(&self) -> u32 {
        self.place
    }

    /// Returns the number of keys, at least 1 in a verified bank.
    pub fn key_count(&self) -> u32 {
        self.keys.count()
    }

    /// Returns the key with this index.
    pub fn key(&self, index: u32) -> Option<CurveKey> {
        self.keys.get(index)
    }

    /// Returns all keys, ordered by frame.
    pub fn keys(&self) -> impl Iterator<Item = CurveKey> + 'a {
        let keys = self.keys;
        (0..keys.count()).filter_map(move |index| keys.get(index))
    }

    /// Returns the value at the start of a frame.
    pub fn value(&self, frame: u32) -> CurveValue {
        CurveCursor::new().value(self, frame)
    }

    /// Returns the value at `time`; `None` without a frame rate.
    ///
    /// The value is that at exactly ⌊time · fps · 65536⌋ / 65536 frames, rounded to the nearest thousandth, a half away
    /// from the key before. Takes time in proportion to the logarithm of the number of keys; a [`CurveCursor`] is
    /// faster from one rendered frame to the next.
    pub fn value_at<T: Time>(&self, time: T) -> Option<CurveValue> {
        CurveCursor::new().value_at(self, time)
    }

    /// Returns the value at a point in time.
    pub(crate) fn value_in(&self, position: Position) -> CurveValue {
        CurveCursor::new().value_of(self, position)
    }

    /// Returns the index of the last key at or before a frame, or 0.
    pub(crate) fn index_at(&self, frame: u32) -> u32 {
        CurveCursor::new().index_at(self, frame)
    }

    /// Returns the value between the key with this index and the next one.
    fn value_between(&self, index: u32, position: Position) -> CurveValue {
        let key = match self.keys.get(index) {
            Some(key) => key,
            None => return CurveValue::default(),
        };
        let next = match self.keys.get(index.wrapping_add(1)) {
            Some(next) if position.frame >= key.frame && next.frame > position.frame => next,
            _ => return key.value,
        };
        let frames = u64::from(position.frame.wrapping_sub(key.frame));
        let done = frames << FRACTION_BITS | u64::from(position.sixteen_bits);
        key.value.towards(next.value, done, u64::from(next.frame.wrapping_sub(key.frame)) << FRACTION_BITS)
    }
}

impl Clip<'_> {
    /// Returns a time as a position in frames; `None` without a frame rate.
    pub(crate) fn position<T: Time>(&self, time: T) -> Option<Position> {
        Some(time.position(self.stored_fps()?))
    }
}

/// The bits of a position that hold the fraction of a frame.
const FRACTION_BITS: u32 = 16;

/// Two curves are equal if they are the same curve of equal clips.
impl PartialEq for Curve<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.identity() == other.identity()
    }
}
impl Eq for Curve<'_> {}

impl Curve<'_> {
    /// Returns the values to compare. The origin is that of the name's bank.
    fn identity(&self) -> (Origin, u32, Option<StoredFps>) {
        (self.name.key().bank, self.place, self.fps)
    }
}

/// Prints the name and the number of keys.
impl fmt::Debug for Curve<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Curve")
            .field("name", &self.name.as_str())
            .field("key_count", &self.key_count())
            .finish_non_exhaustive()
    }
}

/// Prints the keys as in a Lipz file: `0:0 12:2.2`.
impl fmt::Display for Curve<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, key) in self.keys().enumerate() {
            write!(f, "{}{}:{}", if index == 0 { "" } else { " " }, key.frame, key.value)?;
        }
        Ok(())
    }
}
