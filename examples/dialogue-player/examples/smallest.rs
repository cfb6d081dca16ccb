//! The program on docs/guides/build-scripts.md: `cargo run -p dialogue-player --example smallest`.

use lipz_bank::Dialogue;
use lipz_bank::files::{DialogueError, DialogueFile};

static BANK: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/dialogue.lipzbank"));

mod dialogue {
    include!(concat!(env!("OUT_DIR"), "/dialogue.rs"));
}

fn main() -> Result<(), DialogueError> {
    let mut files = [DialogueFile::ABSENT; 1]; // one per file, such as a patch or a text bank
    let opened = Dialogue::open_unverified(&mut files, [BANK])?; // packed by the build script
    let clip = opened.clip(dialogue::act1::MARA_GOOD_EVENING);
    let english = opened.locale(dialogue::locales::EN_US);
    if let Some(text) = clip.zip(english).and_then(|(clip, english)| clip.segment(0)?.text(english)) {
        println!("{text}");
    }
    Ok(())
}
