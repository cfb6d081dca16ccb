//! `cargo xtask scale`: measures how processor time and memory of the steps in docs/guides/many-machines.md grow with
//! the number of clips.
//!
//! Each step runs in a separate process, on one thread, to measure its time and its peak memory. Processor time is
//! used, because it does not depend on the load of the machine. The clips are those of the generator.

use clap::{Parser, Subcommand, ValueEnum};
use lipz_bank::ClipId;
use lipz_benches::{DEFAULT_SEED, parse_locale_count, temporary_folder, write_clips};
use lipz_compiler::shard::{Link, Shard, shard_of};
use lipz_compiler::{Compiled, Compiler, Input, Options, discover_with_reports};
use std::fmt::Write as _;
use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Measure how the steps of packing on several machines grow with the number of clips.
#[derive(Parser, Debug)]
#[command(name = "cargo xtask scale", max_term_width = 100, args_conflicts_with_subcommands = true)]
struct Settings {
    #[command(subcommand)]
    piece: Option<Piece>,

    /// Numbers of clips
    #[arg(long, value_name = "N,…", value_delimiter = ',', default_value = "1000,10000,100000")]
    clips: Vec<usize>,

    /// Number of locales in each clip
    #[arg(long, value_name = "K", default_value = "5", value_parser = parse_locale_count)]
    locales: usize,

    /// Number of shards
    #[arg(long, value_name = "COUNT", default_value = "64")]
    shards: NonZero<u16>,

    /// Folder for clips and banks; needs space for their files [default: the folder for temporary files]
    #[arg(long, value_name = "FOLDER")]
    folder: Option<PathBuf>,
}

#[derive(Subcommand, Debug)]
enum Piece {
    /// One step, in a separate process
    #[command(hide = true)]
    Step { step: Step, folder: PathBuf, shards: NonZero<u16> },
}

/// The measured steps.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum Step {
    /// All sources to one bank, at once.
    Pack,
    /// The objects of all shards, one after the other.
    Objects,
    /// A bank of the objects.
    Link,
    /// A set of the objects.
    LinkSet,
    /// The bytes of the objects, written to other files and synced.
    Copy,
}

const STEPS: [(Step, &str); 5] = [
    (Step::Pack, "`pack`, one go"),
    (Step::Objects, "`shard pack`, all shards"),
    (Step::Link, "`shard link` to a bank"),
    (Step::LinkSet, "`shard link` to a set"),
    (Step::Copy, "copy the objects"),
];

/// The measurements of a step.
#[derive(Clone, Copy, Debug)]
struct Took {
    processor_s: f64,
    peak_bytes: f64,
}

fn main() -> Result<(), String> {
    let settings = Settings::parse();
    match &settings.piece {
        Some(Piece::Step { step, folder, shards }) => {
            run(*step, folder, *shards)?;
            let took = taken()?;
            println!("{} {}", took.processor_s, took.peak_bytes);
            Ok(())
        }
        None => measure(&settings),
    }
}

fn measure(settings: &Settings) -> Result<(), String> {
    if cfg!(debug_assertions) {
        return Err("measures of a debug build say nothing: cargo xtask scale".into());
    }
    let mut all: Vec<(usize, Vec<Took>)> = Vec::new();
    for &clips in &settings.clips {
        let temporary = temporary_folder()?;
        let folder = settings.folder.clone().unwrap_or_else(|| temporary.path().to_owned()).join(clips.to_string());
        eprintln!("{clips} clips");
        write_clips(clips, settings.locales, DEFAULT_SEED, &folder.join("clips"))?;
        let took = STEPS.iter().map(|(step, _)| in_child(*step, &folder, settings.shards)).collect::<Result<_, _>>()?;
        fs::remove_dir_all(&folder).map_err(|error| error.to_string())?;
        all.push((clips, took));
    }
    print!("{}", table(settings, &all));
    Ok(())
}

fn in_child(step: Step, folder: &Path, shards: NonZero<u16>) -> Result<Took, String> {
    let name = step.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default();
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    let output = Command::new(program).args(["step", &name]).arg(folder).arg(shards.to_string()).output();
    let output = output.map_err(|error| error.to_string())?;
    let said = String::from_utf8_lossy(&output.stdout);
    let numbers = said.trim().split_once(' ').and_then(|(time, peak)| Some((time.parse().ok()?, peak.parse().ok()?)));
    match numbers {
        Some((processor_s, peak_bytes)) if output.status.success() => Ok(Took { processor_s, peak_bytes }),
        _ => Err(format!("`{name}`: {}", String::from_utf8_lossy(&output.stderr).trim())),
    }
}

fn run(step: Step, folder: &Path, shards: NonZero<u16>) -> Result<(), String> {
    let compiler = Compiler::new(Options::new().default_locale("en-us").map_err(|error| error.to_string())?.threads(1));
    let object = |shard: u16| folder.join(format!("{shard}-of-{shards}.lipzobj"));
    let objects = || -> Vec<PathBuf> { (0..shards.get()).map(object).collect() };
    let link = || Link::open(&objects()).map_err(|reports| format!("{reports:?}"));
    match step {
        Step::Pack => of(&compiler.pack(&inputs(folder), &folder.join("pack.lipzbank"))),
        Step::Objects => {
            let mut of_shards = vec![Vec::new(); usize::from(shards.get())];
            for input in inputs(folder) {
                of_shards[usize::from(shard_of(ClipId::from_key(&input.key), shards))].push(input);
            }
            for (number, own) in (0..).zip(of_shards) {
                let made = compiler.object(&own, &Shard::new(number, shards.get()));
                of(&made)?;
                fs::write(object(number), made.bank.unwrap_or_default()).map_err(|error| error.to_string())?;
            }
            Ok(())
        }
        Step::Link => of(&compiler.link(&link()?, &folder.join("link.lipzbank"))),
        Step::LinkSet => {
            let linked = compiler.link_to_set(&link()?, &folder.join("link.lipzset"));
            linked.files.map(drop).ok_or_else(|| format!("{:?}", linked.reports))
        }
        Step::Copy => objects().iter().try_for_each(|path| {
            let copied =
                fs::read(path).and_then(|bytes| lipz_benches::write_synced(&path.with_extension("copy"), &bytes));
            copied.map_err(|error| error.to_string())
        }),
    }
}

fn inputs(folder: &Path) -> Vec<Input> {
    discover_with_reports(&[folder.join("clips")], None).0
}

fn of<B>(compiled: &Compiled<B>) -> Result<(), String> {
    if compiled.bank.is_some() { Ok(()) } else { Err(format!("{:?}", compiled.reports)) }
}

/// Returns processor time and peak memory of this process, on Linux.
fn taken() -> Result<Took, String> {
    let read = |path: &str| fs::read_to_string(path).map_err(|error| format!("`{path}`: {error}"));
    let (stat, status) = (read("/proc/self/stat")?, read("/proc/self/status")?);
    // After the name of the program, which may contain spaces: the times of user and system, in hundredths of a second.
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace();
    let ticks: f64 = fields.skip(11).take(2).filter_map(|ticks| ticks.parse::<f64>().ok()).sum();
    let peak =
        status.lines().find_map(|line| line.strip_prefix("VmHWM:")).and_then(|peak| peak.trim().strip_suffix("kB"));
    let peak_kib: f64 = peak.and_then(|peak| peak.trim().parse().ok()).ok_or("no peak memory is told")?;
    Ok(Took { processor_s: ticks / 100.0, peak_bytes: peak_kib * 1024.0 })
}

/// Returns a row for each step: time and memory for each number of clips, and the exponents of their growth from 10,000
/// clips on.
fn table(settings: &Settings, all: &[(usize, Vec<Took>)]) -> String {
    let mut text = format!("{} locales, {} shards, one thread\n\n| step |", settings.locales, settings.shards);
    all.iter().for_each(|(clips, _)| _ = write!(text, " {clips} clips |"));
    text.push_str(" exponent of time | of memory |\n|---|");
    all.iter().for_each(|_| text.push_str("--:|"));
    text.push_str("--:|--:|\n");
    for (row, (_, name)) in STEPS.iter().enumerate() {
        let _ = write!(text, "| {name} |");
        for (_, took) in all {
            let _ = write!(text, " {:.2} s, {:.0} MB |", took[row].processor_s, took[row].peak_bytes / 1e6);
        }
        let points = |of: fn(&Took) -> f64| -> Vec<(f64, f64)> {
            let large = all.iter().filter(|(clips, _)| *clips >= 10_000);
            large.map(|(clips, took)| (*clips as f64, of(&took[row]))).collect()
        };
        let shown = |exponent: Option<f64>| exponent.map_or("".to_owned(), |exponent| format!("{exponent:.2}"));
        let (time, memory) = (points(|took| took.processor_s), points(|took| took.peak_bytes));
        let _ = writeln!(text, " {} | {} |", shown(exponent(&time)), shown(exponent(&memory)));
    }
    text
}

/// Returns the exponent of the power of x that fits y best, by least squares of the logarithms.
fn exponent(points: &[(f64, f64)]) -> Option<f64> {
    let logs: Vec<(f64, f64)> = points.iter().filter(|(_, y)| *y > 0.0).map(|(x, y)| (x.ln(), y.ln())).collect();
    let count = logs.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| logs.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(|log| log.0), mean(|log| log.1));
    let (above, below) =
        logs.iter().fold((0.0, 0.0), |sums, log| (sums.0 + (log.0 - x) * (log.1 - y), sums.1 + (log.0 - x).powi(2)));
    (logs.len() > 1 && below > 0.0).then_some(above / below)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_are_those_of_powers() {
        let points = [10.0_f64, 100.0, 1000.0].map(|x| (x, 3.0 * x.powf(1.5)));
        assert!(exponent(&points).is_some_and(|exponent| (exponent - 1.5).abs() < 1e-9));
        assert_eq!(exponent(&points[..1]), None);
    }
}
