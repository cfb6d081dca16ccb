//! Opens a patch, and adds the texts of a language: `cargo run -p patch-and-text-bank`.

use lipz_host::{Dialogue, OpenError};
use std::path::{Path, PathBuf};

fn main() -> Result<(), OpenError> {
    // The bank that was shipped. `lipz pack --over small.lipzbank -o patch.lipzbank` made the patch.
    let shipped = Dialogue::open([fixture("small.lipzbank")])?;
    let patched = Dialogue::open([fixture("small.lipzbank"), fixture("patch.lipzbank")])?;
    for clip in patched.clips() {
        let (old, new) = (text(&shipped, clip.key(), "en-us"), text(&patched, clip.key(), "en-us"));
        if old != new {
            println!("{}: {} -> {}", clip.key(), old.unwrap_or("(new)"), new.unwrap_or("(none)"));
        }
    }
    for clip in shipped.clips().filter(|clip| patched.clip(clip.id()).is_none()) {
        println!("{}: removed", clip.key());
    }

    // `lipz pack --config split-locales=true` wrote the texts of each language to a separate file.
    let mut dialogue = Dialogue::open([fixture("split.lipzbank"), fixture("split.en-us.lipztexts")])?;
    println!("English: {:?}", text(&dialogue, "act1/blair", "en-us"));
    println!("German:  {:?}", text(&dialogue, "act1/blair", "de-de"));
    dialogue.add(fixture("split.de-de.lipztexts"))?; // the player has chosen German
    dialogue.remove(fixture("split.en-us.lipztexts"))?;
    println!("German:  {:?}", text(&dialogue, "act1/blair", "de-de"));

    // A file that does not match is rejected, and the dialogue is unchanged.
    let error = dialogue.add(fixture("patch.lipzbank")).err().and_then(|error| error.bank_error());
    println!("the patch of another bank: {}", error.map_or(String::new(), |error| error.to_string()));
    Ok(())
}

/// Returns the text of the first segment.
fn text<'a>(dialogue: &'a Dialogue, key: &str, locale: &str) -> Option<&'a str> {
    let locale = dialogue.locale(locale)?; // a game looks it up once
    Some(dialogue.clip_by_key(key)?.segment(0)?.text(locale)?.as_str())
}

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/banks/v1").join(name)
}
