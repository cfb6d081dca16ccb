//! Errors of reading audio files.

use super::decode::RATES_HZ;
use std::error::Error;
use std::fmt;
use std::io;
use symphonia::core::errors as decoder;

/// The reason why an audio file cannot be read.
#[derive(Debug)]
#[non_exhaustive]
pub enum SoundError {
    /// The file cannot be read at all.
    Io(io::Error),
    /// The file is empty.
    Empty,
    /// The file has an unsupported format, or is too damaged to detect its format.
    OtherFormat {
        /// The format, if it is known: `an MPEG-4 file (M4A, AAC)`.
        name: Option<&'static str>,
    },
    /// The file has a supported format, but an unsupported encoding of samples.
    OtherCodec,
    /// The file ends before its first sample.
    NoSamples,
    /// The data before the samples cannot be read.
    Unreadable {
        /// The decoder's message.
        reason: String,
    },
    /// The file has no audio track, or its track has no samples.
    NoSound,
    /// The sample rate is unsuitable for speech.
    Rate {
        /// Samples per second.
        rate_hz: u32,
    },
    /// The decoder panicked, because of a bug that this file triggers.
    DecoderFailed,
    /// The rate changes in the middle of the file.
    RateChanges,
    /// The audio is longer than [`Sound::LONGEST_S`](super::Sound::LONGEST_S).
    TooLong,
}

impl SoundError {
    /// Returns the error for a failure before the first sample.
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
            SoundError::Io(error) => write!(f, "the audio cannot be read: {error}"),
            SoundError::Empty => f.write_str("the file is empty"),
            SoundError::OtherFormat { name: Some(name) } => write!(f, "this is {name}, which is not supported"),
            SoundError::OtherFormat { name: None } => {
                f.write_str("this is not a WAV, AIFF, FLAC, Ogg Vorbis or MP3 file, or its beginning is damaged")
            }
            SoundError::OtherCodec => f.write_str("the encoding of the samples is not supported"),
            SoundError::NoSamples => f.write_str("the file ends before its first sample"),
            SoundError::Unreadable { reason } => write!(f, "the beginning of the file is damaged ({reason})"),
            SoundError::NoSound => f.write_str("the file contains no audio"),
            SoundError::Rate { rate_hz } => {
                write!(f, "{rate_hz} samples per second are outside {} to {}", RATES_HZ.start(), RATES_HZ.end())
            }
            SoundError::DecoderFailed => f.write_str("the audio cannot be decoded"),
            SoundError::RateChanges => f.write_str("the sample rate changes within the file"),
            SoundError::TooLong => {
                write!(f, "the audio is longer than {} hours", super::Sound::LONGEST_S / 3600)
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
