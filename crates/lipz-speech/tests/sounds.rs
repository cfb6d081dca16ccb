//! Audio files in every format, with every kind of damage. Nothing panics, and no file is read in a wrong format.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests")]

mod random;
mod wav;

use lipz_speech::{RmsRules, Sound, SoundError, rms};
use lipz_types::Fps;
use random::Random;
use std::io::Cursor;
use wav::{Samples, aiff, wav};

const TONES: [(&str, &[u8]); 3] = [
    ("flac", include_bytes!("../../../fixtures/speech/tone.flac")),
    ("mp3", include_bytes!("../../../fixtures/speech/tone.mp3")),
    ("ogg", include_bytes!("../../../fixtures/speech/tone.ogg")),
];

/// Returns a tone of 440 hertz, from -1 to 1.
fn tone(rate_hz: u32, length_ms: u32) -> Vec<f32> {
    let sample = |i: u32| (std::f32::consts::TAU * (i * 440 % rate_hz) as f32 / rate_hz as f32).sin() * 0.4;
    (0..rate_hz * length_ms / 1000).map(sample).collect()
}

fn duration_ms(sound: &Sound) -> u64 {
    (sound.duration_us() + 500) / 1_000
}

/// Returns the lip-sync track of a recording from its loudness. A tone opens the mouth wide.
fn mouth(sound: &Sound) -> String {
    rms(sound, Fps::whole(24), &RmsRules::default()).frames
}

#[test]
fn every_format_holds_the_same_tone() {
    for (name, bytes) in TONES {
        for hint in [None, Some(name), Some("wav")] {
            let sound = Sound::from_bytes(bytes, hint).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert_eq!(sound.rate_hz(), 16_000, "{name}");
            // MP3 has whole frames, and does not always state how many of their samples count.
            assert!((300..=400).contains(&duration_ms(&sound)), "{name}: {}", sound.duration_us());
            assert!(mouth(&sound).contains("9999"), "{name}: {}", mouth(&sound));
            assert_eq!((sound.is_truncated(), sound.is_altered(), sound.damage().places), (false, false, 0), "{name}");
        }
    }
}

#[test]
fn every_kind_of_wav_and_aiff_at_every_rate_is_read() {
    for samples in Samples::ALL {
        for channels in [1, 2, 6] {
            for rate_hz in [8_000, 11_025, 16_000, 22_050, 44_100, 48_000, 96_000] {
                let name = format!("{samples:?}, {channels} channels, {rate_hz} Hz");
                for (extension, make) in [("wav", wav as fn(_, _, _, &_) -> _), ("aif", aiff)] {
                    let file = make(samples, channels, rate_hz, &tone(rate_hz, 200));
                    let sound = Sound::from_bytes(&file, Some(extension))
                        .unwrap_or_else(|error| panic!("{extension}, {name}: {error}"));
                    assert_eq!((duration_ms(&sound), sound.rate_hz()), (200, rate_hz), "{extension}, {name}");
                    assert!(mouth(&sound).contains("99"), "{extension}, {name}: {}", mouth(&sound));
                }
            }
        }
    }
}

#[test]
fn a_file_gives_what_its_samples_give() {
    let samples = tone(22_050, 500);
    let file = Sound::from_bytes(&wav(Samples::F32, 1, 22_050, &samples), None).unwrap();
    let direct = Sound::from_samples(&samples, 22_050).unwrap();
    assert_eq!((mouth(&file), file.duration_us()), (mouth(&direct), direct.duration_us()));
}

/// Some stereo recordings have one inverted channel, so the mean of both is silent.
#[test]
fn channels_that_cancel_each_other_are_not_silent() {
    let samples = tone(16_000, 500);
    let both: Vec<f32> = samples.iter().flat_map(|&sample| [0.5 * sample, -sample]).collect();
    let mut file = wav(Samples::S16, 1, 16_000, &both);
    // Two channels, 64,000 bytes per second, and 4 bytes for both.
    (file[22], file[32]) = (2, 4);
    file[28..32].copy_from_slice(&64_000_u32.to_le_bytes());
    let (stereo, mono) = (Sound::from_bytes(&file, None).unwrap(), Sound::from_samples(&samples, 16_000).unwrap());
    assert!(mouth(&stereo).contains("99"), "half of the louder channel is left");
    let inverted: Vec<f32> = samples.iter().flat_map(|&sample| [sample, -sample]).collect();
    let mut whole = wav(Samples::S16, 1, 16_000, &inverted);
    whole[..44].copy_from_slice(&file[..44]);
    let cancelled = Sound::from_bytes(&whole, None).unwrap();
    assert_eq!((mouth(&cancelled), cancelled.duration_us()), (mouth(&mono), mono.duration_us()));
}

#[test]
fn a_recording_that_is_too_loud_says_where() {
    let mut samples = tone(16_000, 1_000);
    for sample in &mut samples[8_000..10_000] {
        *sample = (*sample * 10.0).clamp(-1.0, 1.0);
    }
    for kind in Samples::ALL {
        let sound = Sound::from_bytes(&wav(kind, 2, 16_000, &samples), None).unwrap();
        let [found] = sound.clipping() else { panic!("{kind:?}: {:?}", sound.clipping()) };
        assert!((490_000..510_000).contains(&found.start_us), "{kind:?}: {found:?}");
        assert!((615_000..635_000).contains(&found.end_us), "{kind:?}: {found:?}");
    }
    assert!(Sound::from_bytes(&wav(Samples::U8, 1, 16_000, &tone(16_000, 500)), None).unwrap().clipping().is_empty());
}

#[test]
fn what_has_no_sound_is_an_error() {
    assert!(matches!(Sound::from_bytes(b"", None), Err(SoundError::Empty)));
    assert!(matches!(Sound::from_samples(&[], 16_000), Err(SoundError::NoSound)));
    assert!(matches!(Sound::from_samples(&[0.0], 0), Err(SoundError::Rate { rate_hz: 0 })));
    assert!(matches!(Sound::from_bytes(&wav(Samples::S16, 1, 16_000, &[]), None), Err(SoundError::NoSound)));
    let rate = Sound::from_bytes(&wav(Samples::S16, 1, 3, &[0.0; 100]), None);
    assert!(matches!(rate, Err(SoundError::Rate { rate_hz: 3 })), "{rate:?}");
    for (text, told) in [
        ("{ \"fps\": 24 }", "this is not a WAV, AIFF, FLAC, Ogg Vorbis or MP3 file, or its beginning is damaged"),
        ("RIFF", "this is not a WAV, AIFF, FLAC, Ogg Vorbis or MP3 file, or its beginning is damaged"),
        ("RIFF@\0\0\0WAVE", "the file ends before its first sample"),
        ("\0\0\0\x1cftypM4A ", "this is an MPEG-4 file (M4A, AAC), which is not supported"),
    ] {
        let error = Sound::from_bytes(text.as_bytes(), Some("wav")).expect_err(text);
        assert_eq!(error.to_string(), told, "{text}");
    }
}

/// Returns files of every format, as short as possible.
fn files() -> Vec<(String, Vec<u8>)> {
    let mut files: Vec<_> = TONES.iter().map(|(name, bytes)| (name.to_string(), bytes.to_vec())).collect();
    for samples in Samples::ALL {
        files.push((format!("WAV, {samples:?}"), wav(samples, 2, 8_000, &tone(8_000, 20))));
        files.push((format!("AIFF, {samples:?}"), aiff(samples, 2, 8_000, &tone(8_000, 20))));
    }
    files
}

#[test]
fn a_file_that_is_cut_anywhere_is_read_or_refused() {
    for (name, bytes) in files() {
        let whole = Sound::from_bytes(&bytes, None).unwrap();
        for length in 0..bytes.len() {
            match Sound::from_bytes(&bytes[..length], None) {
                Ok(sound) => assert!(sound.duration_us() <= whole.duration_us(), "{name} cut at {length}"),
                Err(error) => assert!(!matches!(error, SoundError::DecoderFailed), "{name} cut at {length}"),
            }
        }
    }
}

#[test]
fn a_wav_that_is_cut_in_its_samples_says_so() {
    let bytes = wav(Samples::S16, 1, 8_000, &tone(8_000, 100));
    let sound = Sound::from_bytes(&bytes[..bytes.len() / 2], None).unwrap();
    assert!(sound.is_truncated());
    assert!(sound.duration_us() < 60_000);
}

#[test]
fn a_wav_of_a_writer_that_did_not_know_its_length_ends_where_it_ends() {
    let mut bytes = wav(Samples::S16, 1, 8_000, &tone(8_000, 100));
    for length in [u32::MAX, 0x7fff_fff6] {
        bytes[4..8].copy_from_slice(&length.to_le_bytes());
        bytes[40..44].copy_from_slice(&(length - 0x24).to_le_bytes());
        let sound = Sound::from_bytes(&bytes, None).unwrap();
        assert_eq!((sound.is_truncated(), duration_ms(&sound)), (false, 100));
    }
}

#[test]
fn a_file_with_any_byte_changed_is_read_or_refused() {
    let mut random = Random(1);
    for (name, bytes) in files() {
        // All bytes of headers, and a sample of the rest.
        let bytes_at = (0..bytes.len().min(200)).chain((0..200).map(|_| random.below(bytes.len())));
        for at in bytes_at.collect::<Vec<_>>() {
            for change in [0x01, 0x80, 0xff, random.byte()] {
                let mut changed = bytes.clone();
                changed[at] ^= change;
                check(&changed, &format!("{name}, byte {at} ^ {change}"));
            }
        }
    }
}

#[test]
fn random_bytes_are_read_or_refused() {
    let mut random = Random(2);
    for (name, bytes) in files() {
        for round in 0..60 {
            let from = random.below(bytes.len());
            let changed: Vec<u8> =
                bytes.iter().enumerate().map(|(at, &byte)| if at < from { byte } else { random.byte() }).collect();
            check(&changed, &format!("{name}, random from {from}, round {round}"));
        }
    }
    for length in [1, 100, 5_000] {
        let bytes: Vec<u8> = (0..length).map(|_| random.byte()).collect();
        check(&bytes, "random");
    }
}

/// Reads a file, and renders it if it can be read.
fn check(bytes: &[u8], name: &str) {
    match Sound::from_bytes(bytes, None) {
        Ok(sound) => assert!(rms(&sound, Fps::whole(24), &RmsRules::default()).frames.is_ascii(), "{name}"),
        Err(error) => assert!(!matches!(error, SoundError::DecoderFailed), "{name}"),
    }
}

/// The last block of ADPCM is full, even if the recording ends in the middle of it.
#[test]
fn adpcm_ends_where_its_header_says() {
    let file = |fact: u32| {
        let coefficients = [256_i16, 0, 512, -256, 0, 0, 192, 64, 240, 0, 460, -208, 392, -232];
        let format: Vec<u8> = [&[2, 0, 1, 0, 0x80, 0x3e, 0, 0, 0, 0x20, 0, 0, 0, 1, 4, 0, 32, 0, 0xf4, 1, 7, 0][..]]
            .concat()
            .into_iter()
            .chain(coefficients.iter().flat_map(|number| number.to_le_bytes()))
            .collect();
        let chunk = |name: &[u8], content: &[u8]| {
            [name, &u32::try_from(content.len()).unwrap().to_le_bytes(), content].concat()
        };
        let chunks = [chunk(b"fmt ", &format), chunk(b"fact", &fact.to_le_bytes()), chunk(b"data", &[0; 512])].concat();
        chunk(b"RIFF", &[b"WAVE", &chunks[..]].concat())
    };
    // Two blocks of 500 samples at 16,000 per second.
    for (fact, duration_us) in [(600, 37_500), (1_000, 62_500), (0, 62_500), (5_000, 62_500)] {
        assert_eq!(Sound::read(Cursor::new(file(fact)), Some("wav")).unwrap().duration_us(), duration_us, "{fact}");
    }
}
