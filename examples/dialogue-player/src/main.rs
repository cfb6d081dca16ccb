//! Plays a clip in the terminal: `cargo run -p dialogue-player -- de-de`.

use dialogue_player::{BANK, Player, dialogue};
use lipz_bank::files::DialogueFile;
use lipz_bank::{Dialogue, Micros};
use std::thread;
use std::time::{Duration, Instant};

/// The time between two rendered frames, at about 24 per second.
const RENDERED_FRAME: Duration = Duration::from_millis(42);

fn main() -> Result<(), String> {
    let locale = std::env::args().nth(1).unwrap_or_else(|| dialogue::locales::EN_US.into());
    let mut files = [DialogueFile::ABSENT; 1]; // one per file, such as a patch or a text bank
    let dialogue = Dialogue::open(&mut files, [BANK]).map_err(|error| error.to_string())?;
    let mut player = Player::new(dialogue, &locale).ok_or("no such locale")?;
    player.start(dialogue::act1::MARA_GOOD_EVENING);
    // A game gets this time from its audio engine.
    let start = Instant::now();
    while !player.is_over() {
        let audio = Micros(i64::try_from(start.elapsed().as_micros()).unwrap_or(i64::MAX));
        for event in player.advance_to(audio) {
            println!("* {event}");
        }
        println!("{}  {}", player.viseme(), player.subtitle());
        thread::sleep(RENDERED_FRAME);
    }
    Ok(())
}
