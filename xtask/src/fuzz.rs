//! `cargo xtask fuzz`: builds the fuzz targets and runs each for a while.
//!
//! It only needs Rust and a C++ compiler, because libFuzzer comes with the crate libfuzzer-sys, and this repository's
//! compiler measures coverage with stable flags.

use crate::cargo;
use crate::{Failure, paths};
use clap::Args;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Counters for every edge of the code, and comparisons for libFuzzer to learn from.
const COVERAGE: [&str; 7] = [
    "--cfg",
    "fuzzing",
    "-Cpasses=sancov-module",
    "-Cllvm-args=-sanitizer-coverage-level=4",
    "-Cllvm-args=-sanitizer-coverage-inline-8bit-counters",
    "-Cllvm-args=-sanitizer-coverage-pc-table",
    "-Cllvm-args=-sanitizer-coverage-trace-compares",
];

/// The seconds after which an input counts as too slow.
const LONGEST_SECONDS: u32 = 20;

/// Options of `fuzz`.
#[derive(Args, Debug)]
pub(crate) struct Settings {
    /// Minutes for each target
    #[arg(long, value_name = "N", default_value = "1")]
    minutes: u32,

    /// Target to run [default: all, one after the other]
    #[arg(long, value_name = "NAME")]
    target: Option<String>,
}

pub(crate) fn run(settings: &Settings) -> Result<(), Failure> {
    let folder = paths::workspace_root().join("fuzz");
    let mut chosen = targets(&folder)?;
    chosen.retain(|target| settings.target.as_ref().is_none_or(|chosen| *chosen == target.name));
    if chosen.is_empty() {
        return Err("the target does not exist in fuzz/fuzz_targets".into());
    }
    let programs = build(&folder)?;
    let mut lines = String::new();
    for target in &chosen {
        println!("\n── {}", target.name);
        let executions = fuzz(target, &folder, &programs, settings.minutes)?;
        minimise(target, &folder, &programs)?;
        lines.push_str(&format!("  {:<12} {executions:>12} executions\n", target.name));
    }
    println!("\n{} min each, without failures:\n{lines}", settings.minutes);
    Ok(())
}

/// A fuzz target: a program in `fuzz_targets`, and its options with the names of OSS-Fuzz.
struct Target {
    name: String,
    /// The greatest useful length of an input, with room for all that a check can read.
    max_len: u32,
}

/// Returns all targets, ordered by name.
fn targets(folder: &Path) -> Result<Vec<Target>, Failure> {
    let folder = folder.join("fuzz_targets");
    let failed = |error: std::io::Error| format!("`{}`: {error}", folder.display());
    let mut targets = Vec::new();
    for entry in fs::read_dir(&folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.extension().is_some_and(|extension| extension == "rs") {
            let options = fs::read_to_string(path.with_extension("options")).map_err(failed)?;
            let max_len = options.lines().find_map(|line| line.strip_prefix("max_len = ")?.parse().ok());
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            targets.push(Target { max_len: max_len.ok_or_else(|| format!("no max_len for `{name}`"))?, name });
        }
    }
    targets.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(targets)
}

/// Builds all targets. Returns their folder.
fn build(folder: &Path) -> Result<PathBuf, Failure> {
    let host = host()?;
    // With `--target`, the flags do not apply to build scripts, which could not be linked with them.
    let status = cargo::command()
        .args(["build", "--release", "--target", &host])
        .current_dir(folder)
        .env("CARGO_ENCODED_RUSTFLAGS", COVERAGE.join("\u{1f}"))
        .env("CARGO_TARGET_DIR", folder.join("target"))
        .status();
    match status {
        Ok(status) if status.success() => Ok(folder.join("target").join(host).join("release")),
        Ok(status) => Err(format!("the fuzz targets were not built: {status}")),
        Err(error) => Err(format!("cargo cannot be run: {error}")),
    }
}

/// Returns the name of this machine in rustc.
fn host() -> Result<String, Failure> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = Command::new(rustc).args(["--print", "host-tuple"]).output();
    let output = output.map_err(|error| format!("rustc cannot be run: {error}"))?;
    Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

/// Runs a target with the folders `corpus/NAME`, which grows, and `seeds/NAME`. Returns the number of inputs.
fn fuzz(target: &Target, folder: &Path, programs: &Path, minutes: u32) -> Result<u64, Failure> {
    let artifacts = made(folder.join("artifacts").join(&target.name))?;
    let output = libfuzzer(target, programs)
        .arg(format!("-max_total_time={}", minutes.saturating_mul(60)))
        .arg(format!("-max_len={}", target.max_len))
        .arg(format!("-timeout={LONGEST_SECONDS}"))
        .arg(format!("-artifact_prefix={}/", artifacts.display()))
        .arg("-print_final_stats=1")
        .arg(made(folder.join("corpus").join(&target.name))?)
        .arg(folder.join("seeds").join(&target.name))
        .stderr(Stdio::piped())
        .output()
        .map_err(|error| format!("`{}` cannot be run: {error}", target.name))?;
    let log = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        return Err(format!(
            "{log}\n`{}` failed on the input in {}. Add it to fuzz/seeds/{} with the fix.",
            target.name,
            artifacts.display(),
            target.name
        ));
    }
    let executions = log.lines().find_map(|line| line.strip_prefix("stat::number_of_executed_units:"));
    executions.and_then(|number| number.trim().parse().ok()).ok_or(format!("no statistics:\n{log}"))
}

/// Reduces the corpus without losing coverage.
fn minimise(target: &Target, folder: &Path, programs: &Path) -> Result<(), Failure> {
    let corpus = folder.join("corpus").join(&target.name);
    let smaller = made(folder.join("corpus").join(format!("{}.smaller", target.name)))?;
    let failed = |why: String| format!("the corpus of `{}` was not minimised: {why}", target.name);
    let merged = libfuzzer(target, programs).arg("-merge=1").args([&smaller, &corpus]).stderr(Stdio::piped()).output();
    let merged = merged.map_err(|error| failed(error.to_string()))?;
    if !merged.status.success() {
        return Err(failed(String::from_utf8_lossy(&merged.stderr).into_owned()));
    }
    let files = |folder: &Path| fs::read_dir(folder).map_or(0, Iterator::count);
    println!("corpus: {} files of {} are enough", files(&smaller), files(&corpus));
    fs::remove_dir_all(&corpus).and_then(|()| fs::rename(&smaller, &corpus)).map_err(|error| failed(error.to_string()))
}

/// Returns the program of a target, with one thread for the compiler, because coverage is counted for all threads
/// together.
fn libfuzzer(target: &Target, programs: &Path) -> Command {
    let mut command = Command::new(programs.join(&target.name));
    command.env("RAYON_NUM_THREADS", "1");
    command
}

fn made(folder: PathBuf) -> Result<PathBuf, Failure> {
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    Ok(folder)
}
