//! Plays a clip in the terminal: `cargo run -p dialogue-player -- de-de`.

use dialogue_player::{BANK, Player, dialogue};
use lipz_bank::Bank;
use std::time::Duration;

/// Time between two pictures: 24 a second.
const PICTURE_US: i64 = 41_667;

fn main() -> Result<(), String> {
    let locale = std::env::args().nth(1).unwrap_or_else(|| dialogue::locales::EN_US.into());
    let bank = Bank::open(BANK).and_then(Bank::verify).map_err(|error| error.to_string())?;
    let mut player = Player::start(&bank, dialogue::act1::MARA_GOOD_EVENING, &locale).ok_or("no such locale")?;
    while !player.is_over() {
        while let Some(event) = player.next_event() {
            println!("* {event}");
        }
        println!("{}  {}", player.mouth(), player.subtitle());
        std::thread::sleep(Duration::from_micros(PICTURE_US.unsigned_abs()));
        player.advance(PICTURE_US);
    }
    Ok(())
}
