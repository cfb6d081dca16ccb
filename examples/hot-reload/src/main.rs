//! Replaces a bank while a clip plays: `cargo run -p hot-reload`.

use lipz_bank::{ClipId, Cursor, Micros};
use lipz_compiler::{Compiler, Input};
use lipz_host::Dialogue;
use std::error::Error;
use std::fs;
use std::path::Path;

const MAYOR: ClipId = ClipId::from_key("act1/mayor");

fn main() -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("dialogue.lipzbank");
    replace(&path, &pack("Mayor?", "Mayor!")?)?;

    let mut dialogue = Dialogue::open([&path])?;
    let mut cursor = Cursor::new(&dialogue.clip(MAYOR).ok_or("no such clip")?).ok_or("no frame rate")?;
    draw(&dialogue, &mut cursor, Micros(0));

    // A writer packs again, with `lipz pack` or `lipz watch`. The cursor continues with the new version.
    replace(&path, &pack("Mayor?", "Open the door!")?)?;
    refresh(&mut dialogue);
    draw(&dialogue, &mut cursor, Micros(450_000));

    // Damaged files are ignored.
    replace(&path, b"not a bank")?;
    refresh(&mut dialogue);
    draw(&dialogue, &mut cursor, Micros(600_000));
    Ok(())
}

/// A game calls this between rendered frames.
fn refresh(dialogue: &mut Dialogue) {
    match dialogue.refresh() {
        Ok(changes) if changes.is_empty() => println!("nothing new"),
        Ok(changes) => println!("new version of {} file", changes.files().len()),
        // `{why}` also prints the path and a fix.
        Err(why) => {
            let problem = why.bank_error().map_or(String::new(), |error| error.to_string());
            println!("the old version stays in use: {problem}");
        }
    }
}

/// A game calls this once per rendered frame. It looks up clip and locale in the current version.
fn draw(dialogue: &Dialogue, cursor: &mut Cursor, audio: Micros) {
    let Some(clip) = dialogue.clip(MAYOR) else { return };
    for event in cursor.advance_to(&clip, audio).events() {
        println!("  * {event}");
    }
    let english = dialogue.locale("en-us");
    let subtitle = english.and_then(|english| cursor.segment(&clip)?.text(english));
    println!("  {} {}", cursor.viseme(&clip), subtitle.map_or("", |text| text.as_str()));
}

fn pack(first: &str, second: &str) -> Result<Vec<u8>, Box<dyn Error>> {
    let file = format!(
        r#"{{ "fps": 24, "viseme_type": "blair", "visemes": "MAAAEO----|MAAAAEEO--",
              "text_en-us": "{first}|{second}", "events": "|points door" }}"#
    );
    Ok(Compiler::default().compile(&[Input::from_bytes("act1/mayor", file.as_bytes())]).into_bank()?)
}

/// Writes a new file and renames it over the old one, as `lipz pack` does.
fn replace(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let new = path.with_extension("new");
    fs::write(&new, bytes)?;
    fs::rename(&new, path)
}
