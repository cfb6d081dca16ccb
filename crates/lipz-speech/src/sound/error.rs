//! Why a sound file cannot be read.

use super::decode::RATES_HZ;
use std::error::Error;
use std::fmt;
use std::io;

/// Why a sound file cannot be read.
#[derive(Debug)]
#[non_exhaustive]
pub enum SoundError {
    /// The file cannot be read at all.
    Io(io::Error),
    /// The file has no bytes.
    Empty,
    /// The file is of no format that is read, or too damaged to tell; the reason in the decoder's words.
    Unreadable {
        /// The decoder's words.
        reason: String,
    },
    /// The file has no track of sound, or its track has no samples.
    NoSound,
    /// The rate is none at which speech is recorded.
    Rate {
        /// Samples per second.
        rate_hz: u32,
    },
    /// The decoder failed: a fault in it, which this file brought out.
    DecoderFailed,
    /// The rate changes in the middle of the file.
    RateChanges,
    /// The sound is longer than [`Sound::LONGEST_S`](super::Sound::LONGEST_S).
    TooLong,
}

impl SoundError {
    pub(super) fn unreadable(error: symphonia::core::errors::Error) -> SoundError {
        match error {
            symphonia::core::errors::Error::IoError(error) if error.kind() != io::ErrorKind::UnexpectedEof => {
                SoundError::Io(error)
            }
            error => SoundError::Unreadable { reason: error.to_string() },
        }
    }
}

impl fmt::Display for SoundError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SoundError::Io(error) => write!(f, "the sound cannot be read: {error}"),
            SoundError::Empty => f.write_str("the file is empty"),
            SoundError::Unreadable { reason } => {
                write!(f, "this is no WAV, FLAC, Ogg Vorbis or MP3 file that can be read: {reason}")
            }
            SoundError::NoSound => f.write_str("the file has no sound in it"),
            SoundError::Rate { rate_hz } => write!(
                f,
                "{rate_hz} samples per second is not a rate for speech: {} to {} are",
                RATES_HZ.start(),
                RATES_HZ.end()
            ),
            SoundError::DecoderFailed => f.write_str("the decoder fails with this file"),
            SoundError::RateChanges => f.write_str("the rate of the samples changes in the middle of the file"),
            SoundError::TooLong => {
                write!(f, "the sound is longer than {} hours", super::Sound::LONGEST_S / 3600)
            }
        }
    }
}

impl Error for SoundError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        match self {
            SoundError::Io(error) => Some(error),
            _ => None,
        }
    }
}
