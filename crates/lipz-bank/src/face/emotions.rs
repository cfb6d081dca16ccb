//! The emotions of a character at a time: the curves of a clip that are named after the twelve attributes, alone or
//! after a character's name.

use super::Who;
use super::who::farther;
use crate::{Clip, Time};
use lipz_types::{CurveValue, Emotion, Position};

/// The values of the twelve attributes at a time. Those without a curve are 0.
///
/// ```
/// # use lipz_bank::{Clip, Micros};
/// # use lipz_bank::face::{Emotion, Who};
/// # fn draw(clip: &Clip<'_>, now: Micros) -> Option<()> {
/// let emotions = clip.emotions_at(now, Who::Speaker);
/// let sneer = emotions.get(Emotion::Anger).to_f32() / 10.0;
/// let (strongest, value) = emotions.strongest()?; // nothing on a neutral face
/// # None }
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct Emotions {
    values: [CurveValue; Emotion::ALL.len()],
}

impl Emotions {
    /// Returns these values, in the order of [`Emotion::ALL`]: for a face whose emotions are not those of a clip.
    pub const fn new(values: [CurveValue; Emotion::ALL.len()]) -> Emotions {
        Emotions { values }
    }

    /// Returns the value of an attribute, from 0 to 10 unless the file exceeds this range.
    pub fn get(&self, emotion: Emotion) -> CurveValue {
        self.values.get(emotion as usize).copied().unwrap_or_default()
    }

    /// Returns the attribute with the highest value, the first of several in the order of [`Emotion::ALL`]; `None` if
    /// none is above 0.
    pub fn strongest(&self) -> Option<(Emotion, CurveValue)> {
        let mut strongest: Option<(Emotion, CurveValue)> = None;
        for (emotion, value) in self.iter() {
            if value > strongest.map_or(CurveValue::default(), |(_, value)| value) {
                strongest = Some((emotion, value));
            }
        }
        strongest
    }

    /// Returns the sum of all values. Faces are made for at most 10.
    pub fn sum(&self) -> CurveValue {
        let sum = self.values.iter().fold(0_i32, |sum, value| sum.saturating_add(value.thousandths()));
        CurveValue::from_thousandths(sum)
    }

    /// Returns all attributes with their values.
    pub fn iter(&self) -> impl Iterator<Item = (Emotion, CurveValue)> + '_ {
        Emotion::ALL.iter().copied().zip(self.values.iter().copied())
    }
}

impl Clip<'_> {
    /// Returns the emotions of a character of the clip at `time`.
    ///
    /// For [`Who::Speaker`], these are the values of the curves that are named after the attributes of emotion. For a
    /// name, the curves have the name in front: `mara feels fear 4` is in the curve `mara.fear`. All are 0 without such
    /// curves, and without a frame rate.
    ///
    /// ```
    /// # use lipz_bank::{Clip, Micros};
    /// # use lipz_bank::face::{Emotion, Who};
    /// # fn draw(clip: &Clip<'_>, now: Micros) {
    /// let anger = clip.emotions_at(now, Who::Speaker).get(Emotion::Anger);
    /// let fright = clip.emotions_at(now, "mara").get(Emotion::Fear);
    /// # }
    /// ```
    pub fn emotions_at<'name, T: Time>(&self, time: T, who: impl Into<Who<'name>>) -> Emotions {
        self.position(time).map_or_else(Emotions::default, |position| self.emotions_in(who.into(), position))
    }

    fn emotions_in(&self, who: Who<'_>, position: Position) -> Emotions {
        let mut emotions = Emotions::default();
        for curve in self.curves() {
            let emotion = who
                .purpose(curve.name().bytes())
                .and_then(|name| Emotion::ALL.iter().copied().find(|emotion| emotion.name().as_bytes() == name));
            if let Some(place) = emotion.and_then(|emotion| emotions.values.get_mut(emotion as usize)) {
                let value = farther(place.thousandths(), curve.value_in(position).thousandths(), 0);
                *place = CurveValue::from_thousandths(value);
            }
        }
        emotions
    }
}
