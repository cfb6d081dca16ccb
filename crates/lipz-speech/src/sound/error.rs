//! Why a sound file cannot be read.

use super::decode::RATES_HZ;
use std::error::Error;
use std::fmt;
use std::io;
use symphonia::core::errors as decoder;

/// Why a sound file cannot be read.
#[derive(Debug)]
#[non_exhaustive]
pub enum SoundError {
    /// The file cannot be read at all.
    Io(io::Error),
    /// The file has no bytes.
    Empty,
    /// The file is of no format that is read, or too damaged to tell.
    OtherFormat {
        /// What it is, if that is known: `an MPEG-4 file (M4A, AAC)`.
        name: Option<&'static str>,
    },
    /// The file is of a format that is read, but its samples are stored in a way that is not.
    OtherCodec,
    /// The file ends before its first sample.
    NoSamples,
    /// What comes before the samples cannot be read; the reason in the decoder's words.
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
    /// What went wrong before the first sample.
    pub(super) fn unreadable(error: decoder::Error) -> SoundError {
        match error {
            decoder::Error::IoError(error) if error.kind() == io::ErrorKind::UnexpectedEof => SoundError::NoSamples,
            decoder::Error::IoError(error) => SoundError::Io(error),
            decoder::Error::Unsupported(_) => SoundError::OtherCodec,
            decoder::Error::DecodeError(reason) => SoundError::Unreadable { reason: reason.to_owned() },
            error => SoundError::Unreadable { reason: error.to_string() },
        }
    }
}

impl fmt::Display for SoundError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SoundError::Io(error) => write!(f, "the sound cannot be read: {error}"),
            SoundError::Empty => f.write_str("the file is empty"),
            SoundError::OtherFormat { name: Some(name) } => write!(f, "this is {name}, which is not read"),
            SoundError::OtherFormat { name: None } => {
                f.write_str("this is no WAV, AIFF, FLAC, Ogg Vorbis or MP3 file, or its beginning is damaged")
            }
            SoundError::OtherCodec => f.write_str("the samples are stored in a way that is not read"),
            SoundError::NoSamples => f.write_str("the file ends before its first sample"),
            SoundError::Unreadable { reason } => write!(f, "the beginning of the file is damaged ({reason})"),
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
