//! The memory that an audio file can make lipz allocate is bounded by its content, not by its headers.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests")]

mod wav;

use cap::Cap;
use lipz_speech::{AlignOptions, Aligner, Language, Model, Pronouncer, Sound};
use std::alloc::System;
use wav::{Samples, aiff, wav};

#[global_allocator]
static ALLOCATOR: Cap<System> = Cap::new(System, usize::MAX);

/// Runs `run`, which may allocate `bytes` at a time. A larger allocation fails, and the test with it.
fn within(bytes: usize, run: impl FnOnce()) {
    ALLOCATOR.set_limit(ALLOCATOR.allocated() + bytes).unwrap();
    run();
    ALLOCATOR.set_limit(usize::MAX).unwrap();
}

#[test]
fn memory_is_that_of_what_is_in_the_file() {
    // Load the model, which happens once.
    let model = Model::english();
    let four_gigabytes = 0xffff_fff0_u32.to_le_bytes();
    let lies = |mut file: Vec<u8>, places: &[usize]| {
        for &place in places {
            file[place..place + 4].copy_from_slice(&four_gigabytes);
        }
        file
    };
    let honest = wav(Samples::S16, 1, 16_000, &[0.1; 1_000]);
    let aiff = aiff(Samples::S16, 1, 16_000, &[0.1; 1_000]);
    let big_endian = [0xff, 0xff, 0xff, 0xf0];
    let files = [
        [&aiff[..4], &big_endian, &aiff[8..]].concat(),
        // The length of the form, and of a chunk with notes, a marker or the samples.
        [&aiff[..4], &big_endian, &aiff[8..12], b"APPL", &big_endian, &aiff[12..]].concat(),
        [&aiff[..4], &big_endian, &aiff[8..12], b"ANNO", &big_endian, &aiff[12..]].concat(),
        [&aiff[..4], &big_endian, &aiff[8..12], b"MARK", &big_endian, &[0xff; 100]].concat(),
        [&aiff[..4], &big_endian, &aiff[8..42], &big_endian, &aiff[46..]].concat(),
        lies(honest.clone(), &[4]),
        lies(honest.clone(), &[4, 40]),
        lies(honest.clone(), &[16]),
        // A different chunk of the greatest length before the samples.
        [&honest[..12], b"LIST", &four_gigabytes, &honest[12..]].concat(),
        [&honest[..12], b"id3 ", &four_gigabytes, &honest[12..]].concat(),
        // A tag of 256 megabytes, and a picture of 16.
        [b"ID3\x04\x00\x00\x7f\x7f\x7f\x7f".as_slice(), &[0; 100]].concat(),
        [b"fLaC\x06\xff\xff\xff".as_slice(), &[0; 100]].concat(),
    ];
    for file in &files {
        // The decoder accepts four megabytes at first.
        within(6 << 20, || drop(Sound::from_bytes(file, None)));
    }
    // Two minutes of speech-like audio with a script: a few bytes per frame, and nothing that grows with both.
    let sound = syllables(120);
    let script = Pronouncer::new(Language::ENGLISH).script(&"The map shows a hidden valley. ".repeat(30));
    within(6 << 20, || {
        let sound = Sound::from_bytes(&sound, None).unwrap();
        let alignment = Aligner::new(model, AlignOptions::default()).align(&sound, &script);
        assert_eq!(alignment.phones.last().unwrap().end_us, 120_000_000);
    });
}

/// Returns a file with bursts of a buzz, and pauses between them.
fn syllables(seconds: usize) -> Vec<u8> {
    let sample = |i: usize| {
        let loud = if i / 2_000 % 3 < 2 { 0.3 } else { 0.001 };
        ((i * (90 + i / 8_000 % 40)) % 8_000) as f32 / 8_000.0 * loud
    };
    wav(Samples::S16, 1, 8_000, &(0..seconds * 8_000).map(sample).collect::<Vec<_>>())
}
