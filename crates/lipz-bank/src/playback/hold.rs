//! Consonant hold: keeps consonants long enough to be seen.

use crate::{Clip, Fps, VisemeType};

/// The minimal duration of consonants.
///
/// "You must have two frames to be able to read it": consonants last two frames at 24 fps or longer, and take the time
/// from their neighbours (Talking Heads, "Hold your consonants"). A hold as long as one rendered frame also keeps
/// consonants from being skipped between two rendered frames.
///
/// A consonant that is too short extends into the vowels and rests after it. If the next consonant leaves too few of
/// those, it begins early and takes frames from before it. Consonants take nothing from each other, and at least one
/// frame of vowels and rests remains between two consonants.
/// The shapes of loudness (`rms`) are not consonants: nothing is held there, nor if the viseme type is unspecified.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct ConsonantHold {
    frames: u8,
}

impl ConsonantHold {
    /// Every frame as in the clip.
    pub const NONE: ConsonantHold = ConsonantHold { frames: 0 };

    /// Returns a hold of this number of frames of the clip.
    pub const fn frames(count: u8) -> ConsonantHold {
        ConsonantHold { frames: count }
    }

    /// Returns the number of frames.
    pub const fn frame_count(self) -> u8 {
        self.frames
    }

    /// Returns the number of frames of `fps` nearest to two frames at 24 fps, the minimum for reading.
    ///
    /// ```
    /// use lipz_bank::Fps;
    /// use lipz_bank::playback::ConsonantHold;
    /// assert_eq!(ConsonantHold::readable(Fps::whole(24)), ConsonantHold::frames(2));
    /// assert_eq!(ConsonantHold::readable(Fps::whole(60)), ConsonantHold::frames(5));
    /// ```
    #[allow(clippy::arithmetic_side_effects)] // the sum fits 64 bits
    pub const fn readable(fps: Fps) -> ConsonantHold {
        let twelfths = 12 * fps.denominator() as u64;
        // No rate has a denominator of zero. Checked division keeps a panic out of the machine code.
        match (fps.numerator() as u64 + twelfths / 2).checked_div(twelfths) {
            Some(frames) => ConsonantHold::at_most(frames),
            None => ConsonantHold::NONE,
        }
    }

    /// Returns the length of one rendered frame in frames of `fps`. Every consonant with enough room is then in at
    /// least one rendered frame.
    #[allow(clippy::arithmetic_side_effects)] // the products fit 64 bits
    pub const fn for_display(picture_us: u32, fps: Fps) -> ConsonantHold {
        let (frames, second) = (picture_us as u64 * fps.numerator() as u64, fps.denominator() as u64 * 1_000_000);
        match (frames.checked_div(second), frames.checked_rem(second)) {
            (Some(whole), Some(rest)) => ConsonantHold::at_most(whole + (rest != 0) as u64),
            _ => ConsonantHold::NONE,
        }
    }

    const fn at_most(frames: u64) -> ConsonantHold {
        ConsonantHold { frames: if frames < u8::MAX as u64 { frames as u8 } else { u8::MAX } }
    }

    /// Returns the frame whose shape shows at `frame`. `or` is the viseme type of clips without one.
    #[inline]
    pub(super) fn frame(self, clip: &Clip<'_>, or: Option<VisemeType>, frame: u32) -> u32 {
        match clip.viseme_type().or(or) {
            Some(kind) if self.frames > 1 => self.shown(kind, clip.frames(), frame as usize) as u32,
            _ => frame,
        }
    }

    /// Returns the frame whose shape shows at `at`. Reads at most a few times the hold around it.
    fn shown(self, kind: VisemeType, codes: &[u8], at: usize) -> usize {
        let hold = usize::from(self.frames);
        let (before, behind) = match (codes.get(..at), codes.get(at..)) {
            (Some(before), Some([code, behind @ ..])) if !is_consonant(kind, *code) => (before, behind),
            _ => return at,
        };
        let is_open = |code: &&u8| !is_consonant(kind, **code);
        // The stretch of vowels and rests around `at`, as far as the hold of a neighbour reaches.
        let open_before = before.iter().rev().take(hold).take_while(is_open).count();
        let open_behind = behind.iter().take(hold).take_while(is_open).count();
        let spare = open_before.saturating_add(open_behind);

        let mut rest = before.iter().rev().skip(open_before);
        let missing_before = if open_before < hold { missing(hold, &mut rest) } else { 0 };
        let taken_before = missing_before.min(spare);
        if open_before < taken_before {
            return at.saturating_sub(open_before).saturating_sub(1);
        }

        let mut rest = behind.iter().skip(open_behind);
        let missing_behind = if open_behind < hold { missing(hold, &mut rest) } else { 0 };
        let run = hold.saturating_sub(missing_behind);
        let room = behind.iter().skip(open_behind).skip(run).take(hold).take_while(is_open).count();
        let early = missing_behind.saturating_sub(room.saturating_sub(1));
        if open_behind < early.min(spare.saturating_sub(taken_before)) {
            return at.saturating_add(open_behind).saturating_add(1);
        }
        at
    }
}

/// Returns how many frames the run at the start of `codes` lacks for the whole hold; 0 if there is no run.
fn missing<'c>(hold: usize, codes: &mut impl Iterator<Item = &'c u8>) -> usize {
    match codes.next() {
        None => 0,
        Some(code) => {
            let more = codes.take(hold).take_while(|other| *other == code).count();
            hold.saturating_sub(more.saturating_add(1))
        }
    }
}

/// Whether the shape is that of a consonant (Lipz specification, "Visemes").
const fn is_consonant(kind: VisemeType, code: u8) -> bool {
    match kind {
        VisemeType::Blair => matches!(code, b'M' | b'S' | b'W' | b'F' | b'L'),
        VisemeType::ToonBoom => matches!(code, b'A' | b'B' | b'F' | b'G'),
        VisemeType::Rms => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::string::String;
    use std::vec::Vec;

    fn held(kind: VisemeType, codes: &str, frames: u8) -> String {
        let codes = codes.as_bytes();
        (0..codes.len()).map(|at| codes[ConsonantHold { frames }.shown(kind, codes, at)] as char).collect()
    }

    #[test]
    fn consonants_take_from_their_neighbours() {
        for (codes, frames, shown) in [
            ("-MAAA-", 1, "-MAAA-"),
            ("-MAAA-", 2, "-MMAA-"),
            ("-MAAA-", 3, "-MMMA-"),
            ("-MMMA-", 3, "-MMMA-"),   // long enough
            ("AAMSAA", 2, "AMMSSA"),   // S follows M: M begins early
            ("AAAMA", 3, "AMMMA"),     // one frame of the vowel after it is left
            ("MAM", 2, "MAM"),         // the single frame of a vowel stays
            ("MAAM", 2, "MMAM"),       // one of two goes to the first
            ("MAAAMS", 3, "MMMAMS"),   // and all that can be spared, if it needs them
            ("MAAAAMS", 3, "MMMAMMS"), // then to the one after
            ("M", 2, "M"),
            ("MSFL", 2, "MSFL"),
            ("----", 2, "----"),
            ("AAAAAAM", 4, "AAAMMMM"), // at the end, it takes frames from before
            ("MUUUUUU", 4, "MMMMUUU"),
        ] {
            assert_eq!(held(VisemeType::Blair, codes, frames), shown, "{codes} {frames}");
        }
    }

    #[test]
    fn consonants_are_those_of_the_viseme_type() {
        assert_eq!(held(VisemeType::ToonBoom, "-ADDD-", 2), "-AADD-");
        assert_eq!(held(VisemeType::Rms, "0123A0", 2), "0123A0");
    }

    #[test]
    fn times_become_frames() {
        let frames = |fps| ConsonantHold::readable(Fps::whole(fps)).frames;
        assert_eq!([1, 12, 24, 25, 30, 60, 1000].map(frames), [0, 1, 2, 2, 3, 5, 83]);
        let frames = |us| ConsonantHold::for_display(us, Fps::whole(24)).frames;
        assert_eq!([0, 1, 41_666, 41_667, 83_333, 100_000, u32::MAX].map(frames), [0, 1, 1, 2, 2, 3, 255]);
    }

    proptest! {
        #[test]
        fn nothing_vanishes(codes in "[AMOSWEFLU-]{0,40}", frames in 0_u8..9) {
            let shown = held(VisemeType::Blair, &codes, frames);
            let is_open = |code: char| !is_consonant(VisemeType::Blair, code as u8);
            for (own, code) in codes.chars().zip(shown.chars()) {
                prop_assert!(is_open(own) || code == own, "{} {}", codes, shown);
            }
            let mut at = 0;
            while let Some(start) = codes[at..].find(is_open).map(|start| at + start) {
                let end = codes[start..].find(|code| !is_open(code)).map_or(codes.len(), |end| start + end);
                prop_assert!(shown[start..end].contains(is_open), "{} {}", codes, shown);
                at = end;
            }
        }

        /// Alone between vowels, a consonant lasts for the whole hold.
        #[test]
        fn the_hold_is_kept(run in 1_usize..6, frames in 0_u8..9, start in 1_usize..20) {
            let (vowels, run) = ("A".repeat(start), "M".repeat(run));
            let shown = held(VisemeType::Blair, &std::format!("{vowels}{run}{}", "O".repeat(20)), frames);
            let lasted: Vec<_> = shown.match_indices('M').map(|(at, _)| at).collect();
            prop_assert_eq!(lasted.len(), run.len().max(usize::from(frames)));
            prop_assert_eq!(lasted[0], start);
        }
    }
}
