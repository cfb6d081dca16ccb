//! The openness of the mouth: one query for shapes, loudness and babble.

use crate::babble::{Babble, Power, Weight};
use crate::{Clip, Time};

impl Clip<'_> {
    /// Returns how far the mouth is open at `time`; `None` if the clip has no frames, or no viseme type.
    pub fn openness_at<T: Time>(&self, time: T) -> Option<Weight> {
        match self.viseme_type() {
            Some(viseme_type) if self.frame_count() > 0 => Some(self.viseme_at(time).openness(viseme_type)),
            _ => None,
        }
    }

    /// Returns how far the mouth is open at `time`. If the clip has no openness, `babble` generates it from the power
    /// of the voice.
    ///
    /// ```
    /// use lipz_bank::babble::VoiceLevel;
    /// use lipz_bank::{Bank, Micros};
    /// # let bytes: &[u8] = include_bytes!("../examples/act1.lipzbank");
    /// let bank = Bank::open(bytes)?.verify()?;
    /// let babble = bank.default_babble();
    /// for clip in bank.clips() {
    ///     // The same question for shapes, loudness and texts alone.
    ///     let jaw = clip.openness_or_babble(Micros(250_000), &babble, VoiceLevel::UNMEASURED);
    ///     println!("{}: {}", clip.key(), jaw.to_f32());
    /// }
    /// # Ok::<(), lipz_bank::Error>(())
    /// ```
    pub fn openness_or_babble<T: Time, P: Power>(&self, time: T, babble: &Babble<'_>, power: P) -> Weight {
        self.openness_at(time).unwrap_or_else(|| babble.at(time, power).aah)
    }
}
