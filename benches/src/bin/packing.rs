//! The program whose instructions `cargo xtask instructions` counts for packing: packs a folder on one thread, with a
//! compiler without features. `cargo xtask features` compares its bank with that of the command.
//!
//! `packing FOLDER BANK`

use lipz_compiler::{Compiler, Options, discover};
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let [folder, bank] = arguments.as_slice() else { return Err("usage: packing FOLDER BANK".into()) };
    let inputs = discover(std::slice::from_ref(folder), None)?;
    Compiler::new(Options::new().default_locale("en-us")?.threads(1)).pack(&inputs, bank).into_bank()?;
    Ok(())
}
