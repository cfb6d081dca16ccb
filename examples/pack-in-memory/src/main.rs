//! Packs Lipz files from strings and reads the bank: `cargo run -p pack-in-memory`.

use lipz_bank::files::DialogueFile;
use lipz_bank::{Dialogue, Fps, Micros};
use lipz_compiler::{Compiler, Input, Options};
use std::error::Error;

const MAYOR: &str = r#"{
  "visemes" :     "MAAAEO----|MAAAAEEO--",
  "text_en-us" :  "Mayor?    |{louder} Mayor!",
  "text_de-de" :  "Meister?  |Meister!",
  "events" :      "          |points door",
  "viseme_type" : "blair"
}"#;

fn main() -> Result<(), Box<dyn Error>> {
    // The options correspond to the settings in `lipz.toml`.
    let compiler = Compiler::new(Options::new().default_fps(Fps::whole(24)));
    let inputs = [Input::from_bytes("act1/mayor", MAYOR.as_bytes())];
    let bank = compiler.compile(&inputs).into_bank()?;

    let mut files = [DialogueFile::ABSENT; 1];
    let dialogue = Dialogue::open(&mut files, [&bank[..]])?;
    let clip = dialogue.clip_by_key("act1/mayor").ok_or("no such clip")?;
    let german = dialogue.locale("de-de").ok_or("no German")?;
    for segment in clip.segments() {
        let text = segment.text(german).map_or("", |text| text.as_str());
        println!("{:>4} to {:>4} frames: {text}", segment.start_frame(), segment.end_frame());
    }
    println!("after half a second: {}", clip.viseme_at(Micros(500_000)));

    // An error in a file is returned with its position and a fix.
    let broken = [Input::from_bytes("act1/broken", br#"{ "visemes": "MAZ", "viseme_type": "blair", "fps": 24 }"#)];
    if let Err(why) = compiler.compile(&broken).into_bank() {
        println!("{why}");
    }
    Ok(())
}
