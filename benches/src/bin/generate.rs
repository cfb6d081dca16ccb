//! `cargo xtask generate`: writes a folder of generated clips of realistic size and structure.

use clap::Parser;
use lipz_benches::{DEFAULT_SEED, MAX_LOCALES, parse_locale_count, write_clips};
use std::path::PathBuf;
use std::time::Instant;

/// Write a folder of generated clips of realistic size and structure.
#[derive(Parser, Debug)]
#[command(name = "cargo xtask generate", max_term_width = 100)]
struct Arguments {
    /// Number of clips
    #[arg(long, value_name = "N")]
    clips: usize,

    /// Number of locales in each clip
    #[arg(long, value_name = "K", default_value_t = MAX_LOCALES.min(5), value_parser = parse_locale_count)]
    locales: usize,

    /// The folder to create; it must be empty if it exists
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,

    /// Seed of the clips; the same seed writes the same bytes everywhere
    #[arg(long, value_name = "SEED", default_value_t = DEFAULT_SEED)]
    seed: u64,
}

fn main() -> Result<(), String> {
    let arguments = Arguments::parse();
    let start = Instant::now();
    let bytes = write_clips(arguments.clips, arguments.locales, arguments.seed, &arguments.out)?;
    let seconds = start.elapsed().as_secs_f64();
    let (clips, locales) = (arguments.clips, arguments.locales);
    println!("{clips} clips with {locales} locales, {:.2} MB, in {seconds:.1} s", bytes as f64 / 1e6);
    Ok(())
}
