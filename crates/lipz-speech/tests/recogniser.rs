//! The neural network that recognises phones: its file, including hostile ones. The network is tiny, with random
//! values.
#![allow(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "tests")]

mod hama;
mod wav;

use hama::{TOKENS, hama};
use lipz_speech::{
    AlignOptions, Aligner, Language, Mismatch, MismatchKind, Model, Pronouncer, Recogniser, RecogniserError, Sound,
};
use std::io::Cursor;
use wav::{Samples, wav};

fn names() -> Vec<String> {
    TOKENS.map(str::to_owned).to_vec()
}

fn recogniser(seed: u32) -> Recogniser {
    Recogniser::from_bytes(&Recogniser::convert(&hama(seed), &names()).unwrap()).unwrap()
}

/// Returns a WAV file at 16,000 samples per second, with tones that come and go.
fn sound(seconds: f32) -> Vec<u8> {
    let count = (seconds * 16_000.0) as u32;
    let sample = |at: u32| {
        let step = (at / 1_600 % 7 + 2) as f32;
        let level = 0.1 + 0.1 * (at / 4_000 % 5) as f32;
        level * ((at % 400) as f32 * step * std::f32::consts::TAU / 400.0).sin()
    };
    let samples: Vec<f32> = (0..count).map(sample).collect();
    wav(Samples::S16, 1, 16_000, &samples)
}

fn heard(recogniser: &Recogniser, sound: &[u8]) -> String {
    let script = recogniser.hear(Cursor::new(sound), Some("wav")).unwrap().script();
    script.words.iter().map(|word| word.text.as_str()).collect::<Vec<_>>().join(" ")
}

#[test]
fn a_network_hears_what_another_implementation_of_it_hears() {
    // The result of NumPy in double precision, with its own Fourier transform.
    let expected = "auʃmauafafaʃmauamauʃmafuʃmauʃmafaʃmauʃmauʃmauʃmuauʃfafuafauʃmauʃmauʃmauʃmafuamauamauʃmafuʃmaʃfafaʃfauʃmauʃmauamauafaf\
                    aʃmauʃmaʃa";
    assert_eq!(heard(&recogniser(6), &sound(3.0)), expected);
    assert_ne!(recogniser(6).hash(), recogniser(5).hash());
}

#[test]
fn long_sounds_are_heard_in_pieces() {
    // The result depends on the whole piece, but its length does not: nothing is lost or repeated.
    let symbols = |seconds: f32| heard(&recogniser(6), &sound(seconds)).chars().count() as f32 / seconds;
    let (one, several) = (symbols(13.0), symbols(60.0));
    assert!((0.9..1.1).contains(&(several / one)), "{one} and {several} symbols a second");
}

#[test]
fn short_sounds_are_no_trouble() {
    for samples in [1_u16, 2, 199, 200, 201, 202, 399, 401, 1_000] {
        let _ = heard(&recogniser(1), &sound(f32::from(samples) / 16_000.0));
    }
    assert!(recogniser(1).hear(Cursor::new([]), Some("wav")).is_err());
}

#[test]
fn broken_files_are_refused() {
    let source = hama(1);
    for length in (0..source.len()).step_by(101).chain([source.len() - 1]) {
        assert!(Recogniser::convert(&source[..length], &names()).is_err(), "{length}");
    }
    assert_eq!(Recogniser::convert(b"RIFF", &names()).err(), Some(RecogniserError::OtherFile));
    assert_eq!(Recogniser::convert(&source, &names()[1..]).err(), Some(RecogniserError::OtherNetwork));
    assert_eq!(Recogniser::convert(&source, &vec!["a".to_owned(); 9]).err(), Some(RecogniserError::OtherNetwork));
    // Any byte of the head may be wrong.
    let head = source.windows(8).position(|bytes| bytes == b"\x06\0mel_fb").unwrap() + 1_000;
    for at in (8..head.min(source.len())).step_by(3) {
        let mut other = source.clone();
        other[at] ^= 0xff;
        let _ = Recogniser::convert(&other, &names()); // no panic
    }
    let file = Recogniser::convert(&source, &names()).unwrap();
    for length in (0..file.len()).step_by(997).chain([file.len() - 1]) {
        assert!(Recogniser::from_bytes(&file[..length]).is_err(), "{length}");
        let mut other = file.clone();
        other[length] ^= 1;
        assert!(Recogniser::from_bytes(&other).is_err(), "{length}");
    }
    assert!(Recogniser::from_bytes(&[&file[..], &[0]].concat()).is_err());
}

/// The result must be the same on every machine.
#[test]
fn the_built_in_network_recognises_a_human_voice() {
    let bobby = include_bytes!("../../../fixtures/speech/bobby.wav");
    assert_eq!(heard(Recogniser::built_in(), bobby), "bɑdiwɹɪpdʌlʌtʃ");
    assert_eq!(heard(Recogniser::built_in(), &wav(Samples::S16, 1, 16_000, &[0.0; 32_000])), "");
}

#[test]
fn the_built_in_network_compares_a_voice_with_its_words_and_with_others() {
    let bobby = include_bytes!("../../../fixtures/speech/bobby.wav");
    let heard = Recogniser::built_in().hear(Cursor::new(bobby), Some("wav")).unwrap();
    let sound = Sound::read(Cursor::new(bobby), Some("wav")).unwrap();
    let found = |text: &str| {
        let script = Pronouncer::new(Language::ENGLISH).script(text);
        let alignment = Aligner::new(Model::english(), AlignOptions::default()).align(&sound, &script);
        let words = |found: &Mismatch| (found.kind, found.words.clone());
        heard.mismatches(&script, &alignment).iter().map(words).collect::<Vec<_>>()
    };
    assert_eq!(found("Bobby ripped the ledger."), []);
    assert_eq!(found("Shoes for my young sister."), [(MismatchKind::OtherWords, 0..5)]);
}
