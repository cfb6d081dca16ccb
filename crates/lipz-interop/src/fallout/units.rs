//! The units of marker positions: bytes of decoded audio. Their number per second is the one assumed by the engine, or
//! by the tool that made the file.

use crate::Time;
use lipz_diagnostics::{Code, Diagnostic};

/// The units per second of the game's files: the engine plays all audio as mono, with 16 bits at 22,050 Hz.
pub const USUAL: u32 = 44_100;

/// All known units per second, the usual one first. The game's documentation has "4 x 22100", a stereo rate with a
/// typing error. The second entry is the rate that it probably means.
pub const KNOWN: [u32; 3] = [USUAL, 88_200, 88_400];

/// The largest distance between the last marker and the end of the recording, as a fraction (1/100) of its length.
const TOLERANCE: u64 = 100;

/// Returns the known unit with which `last_position` is nearest to the end of a recording of this length, and a warning
/// if no unit comes close.
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
    let message = format!("the last marker is at {end}, but the sound file ends at {sound}");
    let diagnostic = Diagnostic::new(Code::LipTimeBase, message)
        .note(format!("at {units} units per second, the closest match"))
        .help("check whether the sound file belongs to this LIP file, or name its units per second: --file-rate");
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
        let message = "the last marker is at 1.000 s, but the sound file ends at 3.000 s";
        assert_eq!(warning.map(|diagnostic| diagnostic.message).as_deref(), Some(message));
        assert!(nearest(u32::MAX, Time::ZERO).1.is_some());
    }
}
