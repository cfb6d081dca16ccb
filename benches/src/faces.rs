//! A bank of lines with faces: emotions, gestures, and a jaw with a key in each frame.

use crate::random::Random;
use lipz_compiler::{Compiler, Input, Options};
use std::fmt::Write;

const FPS: usize = 24;
/// The number of frames in each line: twelve seconds, like the longest of the generator.
const FRAMES: usize = 12 * FPS;
/// Curves with a key in each second, and their range, in tenths.
const SLOW: [(&str, [usize; 2]); 6] = [
    ("anger", [0, 50]),
    ("fear", [0, 50]),
    ("joy", [0, 30]),
    ("nod", [30, 70]),
    ("breath", [0, 20]),
    ("brows", [0, 10]),
];

/// Packs this many lines.
///
/// # Errors
/// If the compiler reports an error in them.
pub fn bank(seed: u64, lines: usize) -> Result<Vec<u8>, String> {
    let inputs: Vec<Input> =
        (0..lines).map(|index| Input::from_bytes(crate::clip_key(index), json(seed, index).into_bytes())).collect();
    Compiler::new(Options::new().strip(true)).compile(&inputs).bank.ok_or_else(|| "the lines have errors".to_owned())
}

fn json(seed: u64, index: usize) -> String {
    let mut random = Random::new(seed, index as u64);
    let mut json = format!("{{ \"fps\": {FPS}, \"viseme_type\": \"blair\", \"visemes\": \"");
    json.extend((0..FRAMES).map(|_| char::from(random.one_of(b"-MSWFLAEOU"))));
    json.push_str("\", \"curves\": { ");
    for (name, [least, most]) in SLOW {
        keys(&mut random, &mut json, (name, FPS), [least, most]);
        json.push_str(", ");
    }
    keys(&mut random, &mut json, ("jawOpen", 1), [0, 10]);
    json.push_str(" } }");
    json
}

/// Writes a curve with a key every `step` frames.
fn keys(random: &mut Random, json: &mut String, (name, step): (&str, usize), [least, most]: [usize; 2]) {
    let _ = write!(json, "\"{name}\": \"");
    for frame in (0..FRAMES).step_by(step) {
        let tenths = random.between(least, most);
        let _ = write!(json, "{}{frame}:{}.{}", if frame == 0 { "" } else { " " }, tenths / 10, tenths % 10);
    }
    json.push('"');
}
