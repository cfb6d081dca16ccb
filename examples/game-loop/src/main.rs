//! Plays a clip in the terminal: `cargo run -p game-loop`. With `--fast`, it does not wait between rendered frames.

use lipz_bank::babble::Weight;
use lipz_bank::playback::Lead;
use lipz_bank::{ClipId, Cursor, Micros};
use lipz_host::Dialogue;
use std::error::Error;
use std::thread;
use std::time::Duration;

const BANK: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../crates/lipz-bank/examples/act1.lipzbank");
const GOOD_EVENING: ClipId = ClipId::from_key("act1/mara-good-evening");
/// Microseconds between two rendered frames.
const STEP_US: u32 = 100_000;

fn main() -> Result<(), Box<dyn Error>> {
    let is_fast = std::env::args().any(|argument| argument == "--fast");

    // When the game starts.
    let dialogue = Dialogue::open([BANK])?;
    let english = dialogue.locale("en-us").ok_or("no English")?;

    // When the line starts.
    let clip = dialogue.clip(GOOD_EVENING).ok_or("no such clip")?;
    let mut cursor = Cursor::new(&clip)
        .ok_or("no frame rate")?
        .with_speaker(dialogue.event_name("mara"))
        .with_lead(Lead::one_frame(clip.fps().ok_or("no frame rate")?)); // visemes a little ahead of the audio

    // Once per rendered frame. A game gets the time from its audio engine.
    let mut audio = Micros(0);
    while !cursor.is_over() {
        for event in cursor.advance_to(&clip, audio).events() {
            println!("     * {event}");
        }
        let subtitle = cursor.segment(&clip).and_then(|segment| segment.text(english));
        let open = cursor.openness(&clip).map_or(0.0, Weight::to_f32);
        let (mouth, subtitle) = (mouth(open), subtitle.map_or("", |text| text.as_str()));
        println!("{}", format!("{} {mouth}  {subtitle}", cursor.viseme(&clip)).trim_end());
        if !is_fast {
            thread::sleep(Duration::from_micros(STEP_US.into()));
        }
        audio.0 += i64::from(STEP_US);
    }
    Ok(())
}

/// Draws a mouth that is this far open, from 0 to 1.
fn mouth(open: f32) -> &'static str {
    match open {
        0.7.. => "(OO)",
        0.4.. => "(oo)",
        0.1.. => "(--)",
        _ => "(__)",
    }
}
