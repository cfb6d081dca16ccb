//! Rendering: converts phones with times to a viseme for every frame.
//!
//! The rules follow G. Moore, "Talking Heads: Facial Animation in The Getaway" (Game Developer, 2001): viewers see
//! closed lips, and the lip under the teeth, only if they stay for two frames at 24 frames per second, and that time
//! comes from the phone before them. The mouth is ahead of the audio, rests only in pauses, and does not open wide for
//! a short vowel.

mod frames;
mod hold;
mod looks;
mod rms;
mod shapes;

pub(crate) use looks::LOOKS;
pub use rms::{RmsRules, rms};

use crate::Alignment;
use lipz_types::{Fps, VisemeType};

/// The rules with which [`render`] converts phones to visemes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct RenderRules {
    /// The time by which a viseme precedes its phone, in microseconds. The default is 40 milliseconds, a frame at 24
    /// frames per second: sensors on lips detect that they close 30 to 55 milliseconds before a p, b or m is audible.
    pub lead_us: u64,
    /// The least time for which closed lips (p, b, m) and the lip under the teeth (f, v) stay, in microseconds. It is
    /// rounded to the nearest number of frames, but at least one. The default is two frames at 24 frames per second.
    pub hold_us: u64,
    /// Vowels shorter than this, in microseconds, do not open the mouth wide. The default is a frame at 24 frames per
    /// second.
    pub shortest_wide_us: u64,
    /// Whether other consonants stay as long, if the adjacent vowels keep a frame. Off by default, because a fast mouth
    /// that stops for each t looks choppy.
    pub hold_consonants: bool,
}

impl Default for RenderRules {
    fn default() -> RenderRules {
        RenderRules { lead_us: 40_000, hold_us: 83_333, shortest_wide_us: 41_667, hold_consonants: false }
    }
}

/// A lip-sync track: a viseme for every frame.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Mouth {
    /// The codes of the frames, one ASCII character each, without `|`.
    pub frames: String,
    /// The first frame of each segment: 0, and one for each `|` of the script, ascending.
    pub segment_starts: Vec<usize>,
}

impl Mouth {
    /// Returns the `visemes` element of a Lipz file: the frames, with `|` between segments.
    pub fn visemes(&self) -> String {
        let mut visemes = String::with_capacity(self.frames.len() + self.segment_starts.len());
        let mut from = 0;
        for &start in self.segment_starts.iter().skip(1) {
            visemes.push_str(self.frames.get(from..start).unwrap_or_default());
            visemes.push('|');
            from = start;
        }
        visemes.push_str(self.frames.get(from..).unwrap_or_default());
        visemes
    }
}

/// Returns the lip-sync track of an alignment. It has as many frames as the audio; the last one may be incomplete.
///
/// For [`VisemeType::Rms`], the frames show how open the shapes are. To follow the loudness instead, use [`rms`].
pub fn render(alignment: &Alignment, fps: Fps, viseme_type: VisemeType, rules: &RenderRules) -> Mouth {
    let mut shapes = shapes::of_phones(&alignment.phones, rules);
    // The lead comes first, because closed lips at the start of the audio must still be visible.
    shapes::advance(&mut shapes, rules.lead_us);
    let (hold_us, frame_us) = (frames::hold_us(rules.hold_us, fps), frames::hold_us(0, fps));
    if rules.hold_consonants {
        hold::hold_consonants(&mut shapes, hold_us, frame_us);
    }
    hold::hold(&mut shapes, hold_us, frame_us, frames::least_us(fps));
    let count = frames::count(alignment.duration_us, fps);
    let mut shapes = shapes.iter().peekable();
    let code = |frame| {
        let time_us = frames::centre_us(frame, fps);
        while shapes.next_if(|shape| shape.end_us <= time_us).is_some() {}
        let shape = shapes.peek().map_or(shapes::REST, |shape| shape.shape);
        char::from(shapes::code(shape, viseme_type))
    };
    let frames = (0..count).map(code).collect();
    let start = |&break_us: &u64| frames::first_at(break_us.saturating_sub(rules.lead_us), fps).min(count);
    let segment_starts = std::iter::once(0).chain(alignment.breaks_us.iter().map(start)).collect();
    Mouth { frames, segment_starts }
}

#[cfg(test)]
mod tests;
