//! The facts about a recording's file.

use crate::recordings::paths::shown;
use lipz_diagnostics::{Code, Report};
use lipz_speech::{Sound, SoundError};
use std::fs::File;
use std::hash::Hasher;
use std::io::{self, BufReader, Read};
use std::path::Path;
use twox_hash::XxHash3_64;

/// The number of bytes that are read at a time.
const BLOCK_BYTES: usize = 1 << 16;

/// The length of a recording, and the hash of its file.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct FileFacts {
    /// Length in microseconds.
    pub length_us: u64,
    /// XXH3-64 of all bytes of the file, as `docs/reference/bank-format.md` describes it.
    pub content_hash: u64,
}

impl FileFacts {
    /// Reads the recording at `path` completely.
    ///
    /// # Errors
    /// If it cannot be read, or is not audio.
    pub fn read(path: &Path) -> Result<FileFacts, Report> {
        let content_hash = File::open(path).and_then(content_hash).map_err(|error| unreadable(path, &error))?;
        Ok(FileFacts { length_us: length_us(path)?, content_hash })
    }

    /// Returns the length of the recording at `path` in microseconds, without reading all of the file if its head states
    /// the length.
    ///
    /// # Errors
    /// If it cannot be read, or is not audio.
    pub fn length_us(path: &Path) -> Result<u64, Report> {
        length_us(path)
    }
}

impl From<FileFacts> for lipz_bank::Recording {
    fn from(facts: FileFacts) -> Self {
        lipz_bank::Recording::new(facts.length_us, facts.content_hash)
    }
}

/// Returns the content hash of a recording: XXH3-64 with seed 0 of all bytes of `file`.
///
/// # Errors
/// Those of `file`.
pub fn content_hash(mut file: impl Read) -> io::Result<u64> {
    let mut hasher = XxHash3_64::with_seed(0);
    let mut block = vec![0; BLOCK_BYTES];
    loop {
        match file.read(&mut block) {
            Ok(0) => return Ok(hasher.finish()),
            Ok(length) => hasher.write(block.get(..length).unwrap_or_default()),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}

/// Returns the length of the audio, to the microsecond.
pub(crate) fn length_us(path: &Path) -> Result<u64, Report> {
    let file = File::open(path).map_err(|error| unreadable(path, &error))?;
    Sound::length_us(BufReader::new(file), extension(path)).map_err(|error| no_sound(path, &error))
}

/// Returns the extension of a path, for decoders.
pub(crate) fn extension(path: &Path) -> Option<&str> {
    path.extension()?.to_str()
}

pub(crate) fn unreadable(path: &Path, error: &io::Error) -> Report {
    let path = shown(path);
    let message = format!("`{path}` cannot be read: {error}");
    Report::failure(path, Code::UnreadableFile, message, "check its permissions")
}

/// Returns the report about a recording that is not audio.
pub(crate) fn no_sound(path: &Path, why: &SoundError) -> Report {
    if let SoundError::Io(error) = why {
        return unreadable(path, error);
    }
    let message = format!("the recording cannot be used: {why}");
    Report::failure(
        shown(path),
        Code::UnreadableSound,
        message,
        "save the recording as WAV, AIFF, FLAC, Ogg Vorbis or MP3",
    )
}

/// Returns the content hash of a recording.
pub(crate) fn hash_of(recording: &Path) -> Result<u64, Report> {
    File::open(recording).and_then(content_hash).map_err(|error| unreadable(recording, &error))
}
