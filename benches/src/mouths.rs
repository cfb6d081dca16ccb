//! A bank of lines with phones, every second one without, and a rig.

use crate::RIG;
use crate::random::Random;
use lipz_compiler::rigs::built_in;
use lipz_compiler::{Compiler, Input, Options};
use std::fmt::Write;

const FPS: usize = 24;
/// The number of frames in each line: twelve seconds, like the longest of the generator.
const FRAMES: usize = 12 * FPS;
/// The phones that are drawn: consonants and vowels alternate.
const CONSONANTS: [&str; 10] = ["B", "D", "F", "K", "L", "M", "N", "R", "S", "T"];
const VOWELS: [&str; 8] = ["AA", "AE", "AH", "AY", "EH", "IY", "OW", "UW"];
/// The length of a phone in milliseconds: 12 in a second on average, like in recordings.
const PHONE_MS: [usize; 2] = [40, 125];

/// Packs this many lines.
///
/// # Errors
/// If the compiler reports an error in them.
pub fn bank(seed: u64, lines: usize) -> Result<Vec<u8>, String> {
    let inputs: Vec<Input> =
        (0..lines).map(|index| Input::from_bytes(crate::clip_key(index), json(seed, index).into_bytes())).collect();
    let rigs = built_in(RIG).into_iter().map(|weights| (RIG.to_owned(), weights)).collect();
    let compiler = Compiler::new(Options::new().strip(true).rigs(rigs));
    compiler.compile(&inputs).bank.ok_or_else(|| "the lines have errors".to_owned())
}

fn json(seed: u64, index: usize) -> String {
    let mut random = Random::new(seed, index as u64);
    let mut json = format!("{{ \"fps\": {FPS}, \"viseme_type\": \"blair\", \"visemes\": \"");
    json.extend((0..FRAMES / 2).flat_map(|_| [char::from(random.one_of(b"-MSWFLAEOU")); 2]));
    json.push('"');
    if index.is_multiple_of(2) {
        json.push_str(", \"phones\": \"-20dB sil@0");
        let (mut start_ms, mut is_vowel) = (200, false);
        while start_ms + 200 < FRAMES * 1000 / FPS {
            let phones: &[&str] = if is_vowel { &VOWELS } else { &CONSONANTS };
            let _ = write!(json, " {}@{start_ms}", phones[random.between(0, phones.len() - 1)]);
            start_ms += random.between(PHONE_MS[0], PHONE_MS[1]);
            is_vowel = !is_vowel;
        }
        let _ = write!(json, " sil@{start_ms}\"");
    }
    json.push_str(" }");
    json
}
