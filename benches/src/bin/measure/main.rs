//! `cargo xtask measure`: compares packing with reading the same files, in one run.
//!
//! Each task runs in a separate process (`work`), to measure its peak memory. The tasks take turns, so that load on the
//! machine affects all of them. The medians are printed (`table`).

mod table;
mod work;

use clap::{Args, Parser, Subcommand};
use lipz_benches::{DEFAULT_SEED, parse_locale_count, temporary_folder, write_clips};
use std::path::{Path, PathBuf};
use std::process::Command;
use work::{Measurement, Work};

/// Why a measurement failed.
type Failure = String;

/// Measure packing, compared with reading the same files.
#[derive(Parser, Debug)]
#[command(name = "cargo xtask measure", max_term_width = 100, args_conflicts_with_subcommands = true)]
struct Settings {
    #[command(subcommand)]
    piece: Option<Piece>,

    /// Numbers of clips
    #[arg(long, value_name = "N,…", value_delimiter = ',', default_value = "10000,100000")]
    clips: Vec<usize>,

    /// Number of locales in each clip
    #[arg(long, value_name = "K", default_value = "5", value_parser = parse_locale_count)]
    locales: usize,

    /// Threads of every task
    #[arg(long, value_name = "COUNT", default_value_t = 2, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: u16,
}

#[derive(Subcommand, Debug)]
enum Piece {
    /// One task, in a separate process
    #[command(hide = true)]
    Measured(Measured),
}

/// One task, as started by `measure`.
#[derive(Args, Debug)]
struct Measured {
    work: Work,
    folder: PathBuf,
    bank: PathBuf,
    threads: u16,
}

/// The number of clips from which three repetitions are enough.
const MANY_CLIPS: usize = 50_000;

fn main() -> Result<(), Failure> {
    let settings = Settings::parse();
    match &settings.piece {
        Some(Piece::Measured(measured)) => run_one(measured),
        None => run(&settings),
    }
}

fn run(settings: &Settings) -> Result<(), Failure> {
    if cfg!(debug_assertions) {
        return Err("measures of a debug build say nothing: cargo xtask measure".into());
    }
    let mut table = table::start(settings.locales, settings.threads);
    for &clips in &settings.clips {
        let repetitions = if clips >= MANY_CLIPS { 3 } else { 5 };
        let temporary = temporary_folder()?;
        let folder = temporary.path().join("clips");
        let bank = temporary.path().join("measured.lipzbank");
        eprintln!("making {clips} clips with {} locales", settings.locales);
        let json_bytes = write_clips(clips, settings.locales, DEFAULT_SEED, &folder)?;
        // The new files must not be written back to disk while they are read. Without this command, the medians have to
        // suffice.
        let _ = Command::new("sync").status();
        let mut measured: Vec<(Work, Vec<Measurement>)> = Work::ALL.map(|work| (work, Vec::new())).into();
        for repetition in 1..=repetitions {
            eprintln!("{clips} clips: round {repetition} of {repetitions}");
            for (work, measurements) in &mut measured {
                measurements.push(in_child(*work, &folder, &bank, settings.threads)?);
            }
        }
        table.push_str(&table::rows(clips, json_bytes, &measured));
    }
    print!("{table}");
    Ok(())
}

/// Runs this program again for one task.
fn in_child(work: Work, folder: &Path, bank: &Path, threads: u16) -> Result<Measurement, Failure> {
    let failed = |why: String| format!("measuring `{}`: {why}", work.name());
    let program = std::env::current_exe().map_err(|error| failed(error.to_string()))?;
    let output = Command::new(program)
        .arg("measured")
        .arg(work.argument())
        .args([folder, bank])
        .arg(threads.to_string())
        .output()
        .map_err(|error| failed(error.to_string()))?;
    if !output.status.success() {
        return Err(failed(String::from_utf8_lossy(&output.stderr).trim().to_owned()));
    }
    serde_json::from_slice(&output.stdout).map_err(|error| failed(error.to_string()))
}

/// Runs one task and prints its measurements.
fn run_one(measured: &Measured) -> Result<(), Failure> {
    let threads = usize::from(measured.threads);
    let measurement = work::run(measured.work, &measured.folder, &measured.bank, threads)?;
    let json = serde_json::to_string(&measurement).map_err(|error| error.to_string())?;
    println!("{json}");
    Ok(())
}
