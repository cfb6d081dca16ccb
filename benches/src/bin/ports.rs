//! Measures the reader in Rust with the questions of docs/inside/ports.md, for the table of all readers: `ports FOLDER`,
//! with the folder of the golden banks.

use lipz_bank::curve::CurveValue;
use lipz_bank::face::{LookAt, Who};
use lipz_bank::{Bank, Cursor, Micros};
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

const ROUNDS: usize = 40;
const CALLS: usize = 200_000;
const FRAMES_PER_SECOND: usize = 60;
/// The rendered frames of a clip, which repeat.
const CLIP_FRAMES: usize = 4 * FRAMES_PER_SECOND;
const SPOKEN_FRAMES: usize = 84;

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let folder = std::env::args().nth(1).ok_or("usage: ports FOLDER")?;
    let read = |name: &str| std::fs::read(Path::new(&folder).join(name));
    playback(&read("drama.lipzbank")?)?;
    weights(&read("phones.lipzbank")?)
}

fn playback(bytes: &[u8]) -> Result<(), Failure> {
    let bank = Bank::open(bytes)?.verify()?;
    let clip = bank.clip_by_key("act1/mara-good-evening").ok_or("no clip")?;
    let german = bank.locale("de-de").ok_or("no German")?;
    measure("viseme", CALLS, |number| _ = black_box(clip.viseme_at(frame_time(number % CLIP_FRAMES))));
    let mut cursor = Cursor::new(&clip).ok_or("no frame rate")?.with_speaker(bank.event_name("mara"));
    measure("tick", CALLS, |number| {
        let time = frame_time(number % CLIP_FRAMES);
        if number % CLIP_FRAMES == 0 {
            cursor.seek(&clip, time);
        }
        for event in cursor.advance_to(&clip, time).events() {
            black_box(event);
        }
        black_box((cursor.viseme(&clip), cursor.segment(&clip).and_then(|segment| segment.text(german))));
    });
    Ok(())
}

fn weights(bytes: &[u8]) -> Result<(), Failure> {
    let bank = Bank::open(bytes)?.verify()?;
    let spoken = bank.clip_by_key("spoken").ok_or("no clip")?;
    let rig = bank.rig("arkit").ok_or("no rig")?;
    let (articulation, profile) = (bank.default_articulation(), bank.default_face_profile());
    let mut weights = [CurveValue::default(); 64];
    measure("weights", CALLS / 10, |number| {
        let time = frame_time(number % SPOKEN_FRAMES);
        let mouth = spoken.articulation_at(time, &articulation);
        let emotions = spoken.emotions_at(time, Who::Speaker);
        let face = spoken.face_at(time, Who::Speaker, &profile, LookAt::AHEAD);
        rig.weights(&mouth, &emotions, &face, &mut weights);
        black_box(&weights);
    });
    Ok(())
}

fn frame_time(frame: usize) -> Micros {
    Micros((frame * 1_000_000 / FRAMES_PER_SECOND) as i64)
}

/// Prints the least nanoseconds of several rounds. The reader has no allocator.
fn measure(name: &str, calls: usize, mut call: impl FnMut(usize)) {
    let mut least = f64::INFINITY;
    for _ in 0..ROUNDS {
        let start = Instant::now();
        (0..calls).for_each(&mut call);
        least = least.min(start.elapsed().as_nanos() as f64 / calls as f64);
    }
    println!("bench {name}_ns {least:.1} Rust");
    println!("bench {name}_bytes 0 Rust");
}
