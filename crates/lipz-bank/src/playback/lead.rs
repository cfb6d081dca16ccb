//! Lead: how far the mouth is ahead of the audio.

use crate::Fps;

/// How far visemes are shown ahead of the audio.
///
/// "Before you can utter a sound you must first make the mouth shape": the animators of "The Getaway" animated one or
/// two frames ahead of the dialogue, and never behind it (Talking Heads, "Never animate behind synch"). The same value
/// compensates for the latency of a display.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Lead {
    us: u32,
}

impl Lead {
    /// Visemes without a lead.
    pub const NONE: Lead = Lead { us: 0 };

    /// Returns a lead in microseconds.
    pub const fn micros(us: u32) -> Lead {
        Lead { us }
    }

    /// Returns a lead of one frame of a clip.
    ///
    /// ```
    /// use lipz_bank::Fps;
    /// use lipz_bank::playback::Lead;
    /// const FILM: Lead = Lead::one_frame(Fps::whole(24));
    /// assert_eq!(FILM.us(), 41_667);
    /// ```
    pub const fn one_frame(fps: Fps) -> Lead {
        Lead::frames(1, fps)
    }

    /// Returns a lead of two frames of a clip.
    pub const fn two_frames(fps: Fps) -> Lead {
        Lead::frames(2, fps)
    }

    /// Rounds up, so that a time at the start of a frame leads to the start of another frame.
    #[allow(clippy::arithmetic_side_effects)] // the products fit 64 bits, and a rate is at least 1: at most two seconds
    const fn frames(count: u64, fps: Fps) -> Lead {
        let (micros, rate) = (count * fps.denominator() as u64 * 1_000_000, fps.numerator() as u64);
        // No rate is zero. Checked division keeps a panic out of the machine code.
        match (micros + rate - 1).checked_div(rate) {
            Some(us) => Lead { us: us as u32 },
            None => Lead::NONE,
        }
    }

    /// Returns the lead in microseconds.
    pub const fn us(self) -> u32 {
        self.us
    }
}
