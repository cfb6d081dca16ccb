//! Generates visemes from a recording and its text: `cargo run -p lip-sync-one-file`.
//!
//! For your own recording: `cargo run -p lip-sync-one-file -- mara-hello.wav "Good evening, Mara."`.

use lipz_speech::{Language, LipSync};
use std::error::Error;

const BOBBY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/speech/bobby.wav");

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let recording = arguments.next().unwrap_or_else(|| BOBBY.to_owned());
    let text = arguments.next().unwrap_or_else(|| "Bobby ripped the ledger.".to_owned());

    let line = LipSync::new(Language::ENGLISH).file(recording, &text)?;
    println!("{}", line.mouth.visemes()); // one viseme per frame, 24 per second
    for (word, time) in line.words() {
        println!("{:>5} to {:>5} ms  {}", time.start_us / 1000, time.end_us / 1000, word.text);
    }
    Ok(())
}
