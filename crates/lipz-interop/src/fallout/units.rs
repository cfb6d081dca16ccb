//! What the positions of markers count: bytes of decoded sound, of which a second has as many as the engine, or
//! the tool that made the file, thought.

use crate::Time;
use lipz_diagnostics::{Code, Diagnostic};

/// Units in a second of the game's files: the engine plays every sound as one channel of 16 bits at 22,050 Hz.
pub const USUAL: u32 = 44_100;

/// Units in a second that are known, the usual one first. The document has "4 x 22100", which is a stereo rate
/// with a slip; the one before it is the rate that it probably means.
pub const KNOWN: [u32; 3] = [USUAL, 88_200, 88_400];

/// How far the last marker may be from the end of the sound, as a part of its length.
const TOLERANCE: u64 = 100;

/// The known units by which `last_position` is nearest to the end of a sound of this length, and a warning
/// if it is not near by any of them.
///
/// ```
/// use lipz_interop::{Time, fallout::units::nearest};
/// let (units_per_second, warning) = nearest(203_320, Time::new(23, 10));
/// assert_eq!((units_per_second, warning), (88_400, None));
/// ```
pub fn nearest(last_position: u32, sound: Time) -> (u32, Option<Diagnostic>) {
    let sound_us = sound.in_units(MICROSECONDS);
    let distance_us = |units: u32| Time::new(u64::from(last_position), units).in_units(MICROSECONDS).abs_diff(sound_us);
    let units = KNOWN.into_iter().min_by_key(|&units| distance_us(units)).unwrap_or(USUAL);
    if distance_us(units) <= sound_us / TOLERANCE {
        return (units, None);
    }
    let end = Time::new(u64::from(last_position), units);
    let message = format!("the last marker is at {end}, but the sound ends at {sound}");
    let diagnostic = Diagnostic::new(Code::LipTimeBase, message)
        .note(format!("at {units} units a second, which comes nearest"))
        .help("is it the sound of this file? set the right `units-per-second`");
    (units, Some(diagnostic))
}

const MICROSECONDS: u32 = 1_000_000;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_length_of_the_sound_chooses() {
        for units in KNOWN {
            let two_seconds = units * 2;
            assert_eq!(nearest(two_seconds, Time::new(2, 1)), (units, None));
        }
        assert_eq!(nearest(0, Time::ZERO), (KNOWN[0], None), "the usual one of several that are as near");
    }

    #[test]
    fn the_sound_of_another_file_is_told() {
        let (units, warning) = nearest(44_100, Time::new(3, 1));
        assert_eq!(units, 44_100);
        let message = "the last marker is at 1.000 s, but the sound ends at 3.000 s";
        assert_eq!(warning.map(|diagnostic| diagnostic.message).as_deref(), Some(message));
        assert!(nearest(u32::MAX, Time::ZERO).1.is_some());
    }
}
