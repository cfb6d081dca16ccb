//! Truncated and damaged audio files: the damage is reported, and the audio after it keeps its time.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

mod random;
mod wav;

use lipz_speech::{RmsRules, Sound, rms};
use lipz_types::Fps;
use random::Random;
use std::ops::Range;
use wav::{Samples, aiff, wav};

/// Files of eight seconds, each of which begins with a beep of 0.3 seconds. One of them lacks the header with the
/// number of frames.
fn files() -> [(&'static str, Vec<u8>); 5] {
    let mp3 = include_bytes!("../../../fixtures/speech/beeps.mp3");
    [
        ("flac", include_bytes!("../../../fixtures/speech/beeps.flac").to_vec()),
        ("ogg", include_bytes!("../../../fixtures/speech/beeps.ogg").to_vec()),
        ("mp3", mp3.to_vec()),
        ("mp3 without a header", mp3[MP3_FRAME_BYTES..].to_vec()),
        ("mp3 of variable rate", include_bytes!("../../../fixtures/speech/beeps-vbr.mp3").to_vec()),
    ]
}

/// The size of a frame of `beeps.mp3`.
const MP3_FRAME_BYTES: usize = 216;
const LENGTH_MS: u64 = 8_000;

fn length_ms(sound: &Sound) -> u64 {
    sound.duration_us() / 1000
}

fn is_told(sound: &Sound) -> bool {
    sound.is_truncated() || sound.is_altered() || sound.damage().places > 0
}

/// Returns the starts of the beeps, in hundredths of a second.
fn beeps(sound: &Sound) -> Vec<usize> {
    let mut rules = RmsRules::default();
    rules.lead_us = 0;
    let frames = rms(sound, Fps::whole(100), &rules).frames.into_bytes();
    let is_loud = |at: usize| frames.get(at).is_some_and(|&code| code > b'3' && code != b'-');
    let is_long = |at: usize| (at..at + 15).all(is_loud);
    let is_start = |&at: &usize| is_long(at) && !(at.saturating_sub(5)..at).any(is_loud);
    (0..frames.len()).filter(is_start).collect()
}

/// Returns the largest deviation of the beeps from those of the whole file, in hundredths of a second, except for those
/// near the damage.
fn worst(sound: &Sound, whole: &Sound, near: Range<usize>) -> usize {
    let whole = beeps(whole);
    let off = |beep: usize| whole.iter().map(|whole| whole.abs_diff(beep)).min().unwrap_or(usize::MAX);
    let beeps = beeps(sound).into_iter().filter(|beep| !near.contains(beep));
    beeps.map(off).max().unwrap_or(usize::MAX)
}

#[test]
fn whole_files_have_nothing_to_tell() {
    for (name, bytes) in files() {
        let sound = Sound::from_bytes(&bytes, None).unwrap();
        assert!(!is_told(&sound), "{name}: {:?}", sound.damage());
        assert!(length_ms(&sound).abs_diff(LENGTH_MS) < 300, "{name}: {}", length_ms(&sound));
        let beeps = beeps(&sound);
        let most_off = if name.contains("without") { 16 } else { 3 };
        let is_right = |second: usize| beeps[second].abs_diff(second * 100) <= most_off;
        assert!(beeps.len() == 8 && (0..8).all(is_right), "{name}: {beeps:?}");
    }
}

#[test]
fn mp3_files_that_were_put_behind_each_other_are_heard_to_the_end() {
    let [_, _, (_, mp3), ..] = files();
    // Each copy begins with a tag, here of four bytes.
    let tagged = [&b"ID3\x04\0\0\0\0\0\x04none"[..], &mp3].concat();
    let sound = Sound::from_bytes(&tagged.repeat(2), Some("mp3")).unwrap();
    assert!(length_ms(&sound).abs_diff(2 * LENGTH_MS) < 600, "{}", length_ms(&sound));
}

#[test]
fn a_file_that_is_cut_says_so() {
    for (name, bytes) in files() {
        let whole = Sound::from_bytes(&bytes, None).unwrap();
        for percent in (30..100).step_by(3) {
            let length = bytes.len() * percent / 100;
            let sound = Sound::from_bytes(&bytes[..length], None).unwrap();
            // At the end of a frame, only the header shows that there should be more.
            let is_known = !name.contains("without") || length % MP3_FRAME_BYTES >= 4;
            assert!(sound.is_truncated() || !is_known, "{name}, {percent} %: {} ms", length_ms(&sound));
            assert!(length_ms(&sound) < length_ms(&whole), "{name}, {percent} %");
            assert!(worst(&sound, &whole, 0..0) <= 3, "{name}, {percent} %: {:?}", beeps(&sound));
        }
    }
}

#[test]
fn behind_what_is_damaged_sounds_keep_their_time() {
    let mut random = Random(3);
    for (name, bytes) in files() {
        let whole = Sound::from_bytes(&bytes, None).unwrap();
        // The length of missing frames of variable size is estimated, and beeps have longer ones than silence.
        let most_off = if name.contains("variable") { 40 } else { 3 };
        for length in [50, 500, 1_500, 3_000] {
            for round in 0..12 {
                let start = bytes.len() * 4 / 10 + random.below(bytes.len() / 10);
                let mut damaged = bytes.clone();
                damaged[start..start + length].fill_with(|| random.byte());
                let name = format!("{name}, {length} bytes at {start}, round {round}");
                let sound = Sound::from_bytes(&damaged, None).unwrap_or_else(|error| panic!("{name}: {error}"));
                // A frame of MP3 has no checksum.
                assert!(is_told(&sound) || name.starts_with("mp3") && length == 50, "{name}");
                let off_ms = length_ms(&sound).abs_diff(length_ms(&whole));
                assert!(off_ms <= 10 * most_off as u64 + 100, "{name}: {}", length_ms(&sound));
                let last: Vec<usize> = beeps(&sound).into_iter().filter(|&beep| beep > 650).collect();
                assert_eq!(last.len(), 1, "{name}: {last:?}");
                assert!(worst(&sound, &whole, 250..650) <= most_off, "{name}: {:?}", beeps(&sound));
            }
        }
    }
}

#[test]
fn what_is_gone_is_missing_for_as_long_as_it_lasted() {
    for (name, bytes) in files().into_iter().filter(|(name, _)| !name.contains("variable")) {
        let whole = Sound::from_bytes(&bytes, None).unwrap();
        // More than two pages of the Ogg file.
        let gone = bytes.len() * 30 / 100..bytes.len() * 55 / 100;
        let damaged = [&bytes[..gone.start], &bytes[gone.end..]].concat();
        let sound = Sound::from_bytes(&damaged, None).unwrap();
        if name.starts_with("mp3") {
            // Frames have no numbers.
            assert!(is_told(&sound) || name.contains("without"), "{name}");
        } else {
            assert!(sound.damage().missing_us > 1_500_000, "{name}: {:?}", sound.damage());
            assert!(worst(&sound, &whole, 200..500) <= 3, "{name}: {:?}", beeps(&sound));
        }
    }
}

#[test]
fn lengths_in_headers_are_not_believed() {
    let samples: Vec<f32> = (0..4_000).map(|at| (at % 40) as f32 / 80.0).collect();
    let mut file = wav(Samples::S16, 1, 8_000, &samples);
    for (whole, data, is_truncated) in [
        (100, 8_000, false),
        (u32::MAX - 10, u32::MAX - 2, false),
        (8_036, 9_000, true),
        (0xf000_0000, 0xff00_0000, false),
    ] {
        file[4..8].copy_from_slice(&u32::to_le_bytes(whole));
        file[40..44].copy_from_slice(&u32::to_le_bytes(data));
        let sound = Sound::from_bytes(&file, None).unwrap_or_else(|error| panic!("{whole}, {data}: {error}"));
        assert_eq!((length_ms(&sound), sound.is_truncated()), (500, is_truncated), "{whole}, {data}");
    }
    let file = aiff(Samples::S16, 1, 8_000, &samples);
    let sound = Sound::from_bytes(&file[..file.len() - 4_000], None).unwrap();
    assert_eq!((length_ms(&sound), sound.is_truncated()), (250, true));
}

/// A cue sheet that is not that of a CD, and tags that are cut off: players decode such files.
#[test]
fn metadata_of_flac_files_do_not_matter() {
    let whole = include_bytes!("../../../fixtures/speech/tone.flac");
    let expected = Sound::from_bytes(whole, None).unwrap();
    // After the magic number and the properties of the samples.
    let at = 4 + 4 + 34;
    assert_eq!((&whole[..4], whole[4] & 0x7f), (b"fLaC".as_slice(), 0));
    let block = |kind: u8, content: &[u8]| {
        let [_, length @ ..] = u32::try_from(content.len()).unwrap().to_be_bytes();
        [&[kind], &length[..], content].concat()
    };
    let mut cue_sheet = vec![0; 396 + 36];
    cue_sheet[136] = 0x80; // of a CD
    cue_sheet[395] = 1; // one track,
    cue_sheet[403] = 1; // which starts in the middle of a frame of the CD
    for blocks in [block(5, &cue_sheet), block(4, &[255; 8]), block(6, &[255; 40]), block(2, &[])] {
        let mut file = [&whole[..at], &blocks, &whole[at..]].concat();
        file[4] &= 0x7f;
        let sound = Sound::from_bytes(&file, None).unwrap();
        assert_eq!((sound.duration_us(), is_told(&sound)), (expected.duration_us(), false));
        let tagged = [b"ID3\x04\0\0\0\0\0\x05".as_slice(), &[0; 5], &file].concat();
        assert_eq!(Sound::from_bytes(&tagged, None).unwrap().duration_us(), expected.duration_us());
    }
}

#[test]
fn lengths_that_were_never_written() {
    let samples: Vec<f32> = (0..8000_u16).map(|n| if n % 40 < 20 { 0.4 } else { -0.4 }).collect();
    let whole = wav(Samples::S16, 1, 8000, &samples);
    let expected = Sound::from_bytes(&whole, None).unwrap();
    let with = |changes: &[(usize, &[u8])]| {
        let mut file = whole.clone();
        changes.iter().for_each(|(at, bytes)| file[*at..*at + bytes.len()].copy_from_slice(bytes));
        file
    };
    let ds64 = [b"ds64".as_slice(), &28_u32.to_le_bytes(), &[0; 28]].concat();
    let rf64 = with(&[(0, b"RF64"), (4, &[255; 4]), (40, &[255; 4])]);
    let rf64 = [&rf64[..12], &ds64, &rf64[12..]].concat();
    for (name, file) in [
        ("0 and 0", with(&[(4, &[0; 4]), (40, &[0; 4])])),
        ("36 and 0", with(&[(4, &36_u32.to_le_bytes()), (40, &[0; 4])])),
        ("RF64", rf64),
    ] {
        let sound = Sound::from_bytes(&file, None).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!((sound.duration_us(), is_told(&sound)), (expected.duration_us(), false), "{name}");
    }
}
