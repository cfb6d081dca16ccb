//! Noisy recordings: noise does not move the mouth in a pause, and recordings of noise alone are reported.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests")]

use lipz_speech::{AlignOptions, Aligner, Alignment, Language, Model, Pronouncer, RenderRules, Sound, render};
use lipz_types::{Fps, VisemeType};

const BOBBY: &[u8] = include_bytes!("../../../fixtures/speech/bobby.wav");
const RATE_HZ: u32 = 48_000;
const TEXT: &str = "Bobby ripped the ledger.";

/// Returns the samples of the recording, which has 16-bit samples at 48,000 per second.
fn bobby() -> Vec<f32> {
    let data = BOBBY.windows(4).position(|window| window == b"data").unwrap() + 8;
    BOBBY[data..].chunks_exact(2).map(|two| f32::from(i16::from_le_bytes([two[0], two[1]])) / 32_768.0).collect()
}

/// Returns the sentence, a pause of this many milliseconds, and the sentence again.
fn with_pause(ms: usize) -> Vec<f32> {
    [bobby(), vec![0.0; ms * 48], bobby()].concat()
}

/// Returns reproducible white noise from -1 to 1.
fn white(count: usize) -> Vec<f32> {
    let mut state = 7_u32;
    let sample = |_| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f32::from((state >> 16) as u16) / 32_768.0 - 1.0
    };
    (0..count).map(sample).collect()
}

/// Returns noise whose power falls with the frequency: white noise through three poles (P. Kellet's economy filter).
fn pink(count: usize) -> Vec<f32> {
    let mut poles = [0.0_f32; 3];
    let sample = |white: f32| {
        let parts = [(0.997_65, 0.099_046), (0.963, 0.296_516_4), (0.57, 1.052_691_3)];
        for (pole, (keep, gain)) in poles.iter_mut().zip(parts) {
            *pole = keep * *pole + gain * white;
        }
        poles.iter().sum::<f32>() + 0.1848 * white
    };
    white(count).into_iter().map(sample).collect()
}

/// Returns twenty simultaneous voices, reversed so that none can be understood.
fn babble(count: usize) -> Vec<f32> {
    let voice: Vec<f32> = bobby().into_iter().rev().collect();
    let voices =
        |at: usize| (0..20).map(|number| voice[(at + number * 2_741 + number * number * 37) % voice.len()]).sum();
    (0..count).map(voices).collect()
}

/// Returns a mains hum with its harmonics.
fn hum(count: usize) -> Vec<f32> {
    let sample =
        |at: usize| (1..8).map(|k| (std::f32::consts::TAU * (at * k % 960) as f32 / 960.0).sin() / k as f32).sum();
    (0..count).map(sample).collect()
}

/// Returns noise that swells and fades, like rain and waves.
fn swelling(count: usize) -> Vec<f32> {
    let level = |at: usize| 1.0 + 0.8 * (std::f32::consts::TAU * (at % 36_923) as f32 / 36_923.0).sin();
    white(count).iter().enumerate().map(|(at, noise)| noise * level(at)).collect()
}

/// Returns chords of three tones with harmonics, each of which is struck and fades.
fn music(count: usize) -> Vec<f32> {
    let sample = |at: usize| {
        let (number, since) = (at / 16_800, at % 16_800);
        let base_hz = [220.0, 294.0, 165.0, 247.0, 330.0][number % 5];
        let tone = |hz: f32| -> f32 {
            let angle = std::f32::consts::TAU * hz * since as f32 / RATE_HZ as f32;
            (1..6).map(|harmonic| (angle * harmonic as f32).sin() / harmonic as f32).sum()
        };
        let chord: f32 = [1.0, 1.26, 1.5].map(|ratio| tone(base_hz * ratio)).iter().sum();
        chord * (-3.0 * since as f32 / RATE_HZ as f32).exp()
    };
    (0..count).map(sample).collect()
}

/// Returns so many samples.
type Noise = fn(usize) -> Vec<f32>;

const NOISES: [(&str, Noise); 6] =
    [("white", white), ("pink", pink), ("babble", babble), ("hum", hum), ("swelling", swelling), ("music", music)];

fn power(samples: &[f32]) -> f32 {
    samples.iter().map(|sample| sample * sample).sum::<f32>() / samples.len() as f32
}

/// Returns the samples with noise that is 20 decibels below the sentence.
fn with_noise(samples: &[f32], noise: Noise) -> Sound {
    let noise = noise(samples.len());
    let gain = 0.1 * (power(&bobby()) / power(&noise)).sqrt();
    let mixed: Vec<f32> = samples.iter().zip(noise).map(|(sample, noise)| (sample + gain * noise) / 2.0).collect();
    Sound::from_samples(&mixed, RATE_HZ).unwrap()
}

fn align(sound: &Sound, text: &str) -> Alignment {
    let script = Pronouncer::new(Language::ENGLISH).script(text);
    Aligner::new(Model::english(), AlignOptions::default()).align(sound, &script)
}

/// Returns the frames in a pause of a second: from 100 milliseconds after its start to 200 before its end, when lips
/// may close for the next word.
fn frames_of_pause(alignment: &Alignment) -> String {
    let mouth = render(alignment, Fps::whole(24), VisemeType::Blair, &RenderRules::default());
    let start_ms = bobby().len() / 48 + 100;
    mouth.frames[start_ms * 24 / 1_000..(start_ms + 700) * 24 / 1_000].to_owned()
}

#[test]
fn the_mouth_rests_in_a_pause_of_a_second_in_any_noise() {
    let samples = with_pause(1_000);
    for (name, noise) in NOISES {
        let sound = with_noise(&samples, noise);
        let alignment = align(&sound, &[TEXT, TEXT].join(" "));
        let pause = frames_of_pause(&alignment);
        assert_eq!(pause, "-".repeat(pause.len()), "{name}: {alignment:?}");
        assert!(alignment.mismatches.is_empty(), "{name}: {:?}", alignment.mismatches);
        assert!(!sound.is_no_speech(), "{name}");
    }
}

#[test]
fn without_a_script_too() {
    let samples = with_pause(1_000);
    for (name, noise) in NOISES {
        let sound = with_noise(&samples, noise);
        let pause = frames_of_pause(&Aligner::new(Model::english(), AlignOptions::default()).listen(&sound));
        let moving = pause.bytes().filter(|&shape| shape != b'-').count();
        assert!(moving == 0, "{name}: {pause}");
    }
}

#[test]
fn noise_alone_is_no_speech() {
    let tone = |count: usize| {
        (0..count).map(|at| (std::f32::consts::TAU * (at * 11 % 1_200) as f32 / 1_200.0).sin()).collect()
    };
    let gated =
        |count: usize| white(count).iter().enumerate().map(|(at, noise)| noise * (at / 12_000 % 2) as f32).collect();
    let noises: [(&str, Noise); 5] =
        [("white", white), ("pink", pink), ("hum", hum), ("tone", tone), ("gated noise", gated)];
    for (name, noise) in noises {
        for count in [16_000, 144_000] {
            let samples: Vec<f32> = noise(count).iter().map(|sample| sample / 8.0).collect();
            assert!(Sound::from_samples(&samples, RATE_HZ).unwrap().is_no_speech(), "{name} {count}");
        }
    }
    let none = Sound::from_samples(&vec![0.0; 48_000], RATE_HZ).unwrap();
    assert!(none.is_silent() && !none.is_no_speech());
}

#[test]
fn a_sentence_is_speech_whole_and_in_parts() {
    let samples = bobby();
    for part in [&samples[..], &samples[..30_000], &samples[20_000..], &with_pause(3_000)] {
        assert!(!Sound::from_samples(part, RATE_HZ).unwrap().is_no_speech(), "{}", part.len());
    }
}
