//! Arbitrary files as recordings, and as records of them.

use super::file::is_about;
use lipz_speech::{RmsRules, Sound, SoundError, rms};
use lipz_sync::SyncRecord;
use lipz_types::Fps;
use std::io::Cursor;
use std::path::Path;

/// Reads any bytes as a recording with any extension. A readable recording has a length and visemes.
pub fn sound(bytes: &[u8]) {
    let read = Sound::from_bytes(bytes, None);
    let length_us = Sound::length_us(Cursor::new(bytes), None);
    match read {
        Ok(sound) => {
            let fps = Fps::whole(24);
            let mouth = rms(&sound, fps, &RmsRules::default());
            let frames = u32::try_from(mouth.frames.len()).expect("a day has fewer frames");
            // Plus one frame that has begun.
            let longest_us = fps.start_of_frame_us(frames + 1);
            assert!(longest_us >= sound.duration_us(), "{frames} frames, {} microseconds", sound.duration_us());
            // Rounded to the nearest, and down to the last whole microsecond.
            assert!(length_us.is_ok_and(|length_us| length_us.abs_diff(sound.duration_us()) <= 1));
            sound.clipping().iter().for_each(|place| assert!(place.start_us < place.end_us));
        }
        Err(error) => {
            assert!(!matches!(error, SoundError::DecoderFailed), "the decoder panicked");
            assert!(!error.to_string().is_empty());
        }
    }
}

/// Reads any bytes as the record of visemes and recordings. Positions are in the file, and a written record is read as
/// an equal one.
pub fn sync_record(bytes: &[u8]) {
    let path = Path::new("lipz-sync.txt");
    let Ok(record) = SyncRecord::parse(path, bytes) else { return };
    for report in record.warnings() {
        report.diagnostics.iter().for_each(|found| is_about(found, &report.source.text));
    }
    let written = record.to_string();
    let again = SyncRecord::parse(path, written.as_bytes()).expect("it is a record");
    assert_eq!(again.to_string(), written);
    assert!(again.warnings().is_empty());
}
