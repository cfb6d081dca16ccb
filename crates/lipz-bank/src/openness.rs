//! How far a mouth is open: one question for shapes, loudness and babble.

use crate::{Babble, Clip, Power, Time, Viseme, VisemeType, Weight};

impl Viseme {
    /// How far the mouth is open that this code of type `viseme_type` shows.
    ///
    /// The digits of `rms` say so themselves. The shapes of the other types are open as far as these
    /// digits: A and I 9, E and O 6, L 4, most consonants 3, U, W and Q 2, F and V 1, and M, B, P and rest 0.
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
        Weight::of_digit(digit)
    }
}

impl Clip<'_, '_> {
    /// How far the mouth is open at `time`; `None` if the clip does not say: it has no frames, or no viseme
    /// type.
    pub fn openness_at<T: Time>(&self, time: T) -> Option<Weight> {
        match self.viseme_type() {
            Some(viseme_type) if self.frame_count() > 0 => Some(self.viseme_at(time).openness(viseme_type)),
            _ => None,
        }
    }

    /// How far the mouth is open at `time`; as `babble` says it if the clip does not, at the power of the voice.
    ///
    /// ```
    /// use lipz_bank::{Babble, Bank, Level, Micros};
    /// # let bytes: &[u8] = include_bytes!("../../../fixtures/banks/v1/small.lipzbank");
    /// let bank = Bank::open(bytes)?.verify()?;
    /// let babble = bank.default_babble();
    /// for clip in bank.clips() {
    ///     // The same question for shapes, loudness and texts alone.
    ///     let jaw = clip.openness_or_babble(Micros(250_000), &babble, Level::STEADY);
    ///     println!("{}: {}", clip.key(), jaw.to_f32());
    /// }
    /// # Ok::<(), lipz_bank::Error>(())
    /// ```
    pub fn openness_or_babble<T: Time, P: Power>(&self, time: T, babble: &Babble<'_>, power: P) -> Weight {
        self.openness_at(time).unwrap_or_else(|| babble.at(time, power).aah)
    }
}
