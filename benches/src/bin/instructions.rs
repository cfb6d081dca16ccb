//! `cargo xtask instructions`: what the reader's queries and packing cost in instructions, held to limits.
//!
//! Times jitter with the machine, instruction counts do not: they can fail a build. The limits are in
//! `benches/instructions.txt`; `--bless` writes what is counted now.

use clap::Parser;
use lipz_benches::{DEFAULT_SEED, callgrind, layers, temporary_folder, write_clips};
use lipz_compiler::{Compiler, Input, Options};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Count the instructions of the reader's queries and of packing, and hold them to their limits.
#[derive(Parser, Debug)]
#[command(name = "cargo xtask instructions", max_term_width = 100)]
struct Settings {
    /// The program that asks, as a release has it
    #[arg(long, value_name = "PROGRAM", hide = true)]
    queries: PathBuf,

    /// The program that packs, as a release has it
    #[arg(long, value_name = "PROGRAM", hide = true)]
    packing: PathBuf,

    /// Make what is counted now the limits
    #[arg(long)]
    bless: bool,
}

/// Why counting failed.
type Failure = String;

/// The file of limits.
const LIMITS: &str = "benches/instructions.txt";
/// Percent above its limit at which a count fails: another patch version of the compiler may move it
/// so far.
const TOLERANCE_PERCENT: u64 = 5;
/// Clips of the bank that is asked: what is counted hardly depends on it.
const CLIPS: usize = 1000;
/// Locales of each clip.
const LOCALES: usize = 5;
/// Questions about the whole bank, which take millions of instructions, and are asked less often.
const WHOLE_BANK: [&str; 1] = ["verify"];
/// The one that is about no bank, but about files on their way into one.
const PACKING: &str = "pack a file";

fn main() -> Result<(), Failure> {
    let settings = Settings::parse();
    let limits_path = Path::new(env!("CARGO_MANIFEST_DIR")).join("instructions.txt");
    let limits = std::fs::read_to_string(&limits_path).map_err(|error| format!("`{LIMITS}`: {error}"))?;
    let folder = temporary_folder()?;
    let bank = folder.path().join("counted.lipzbank");
    let bytes = bank_bytes()?;
    let (patch, addition) = layers::over(&bytes, CLIPS)?;
    for (extension, bytes) in [("lipzbank", &bytes), ("patch", &patch), ("mod", &addition)] {
        std::fs::write(bank.with_extension(extension), bytes).map_err(|error| error.to_string())?;
    }

    let (mut counted, mut too_many) = (String::new(), Vec::new());
    println!("{:<20} {:>9} {:>9}", "question", "counted", "limit");
    for line in limits.lines() {
        let Some((question, limit)) = limit_of(line) else {
            counted.push_str(line);
            counted.push('\n');
            continue;
        };
        let count = match question {
            PACKING => count_packing(&settings.packing, folder.path())?,
            _ => count(&settings.queries, &bank, question)?,
        };
        println!("{question:<20} {count:>9} {limit:>9}");
        let _ = writeln!(counted, "{question}: {count}");
        if is_too_much(count, limit) {
            too_many.push(question);
        }
    }
    if settings.bless {
        return std::fs::write(&limits_path, counted).map_err(|error| format!("`{LIMITS}`: {error}"));
    }
    if too_many.is_empty() {
        return Ok(());
    }
    Err(format!("more instructions than `{LIMITS}` allows: {}", too_many.join(", ")))
}

fn is_too_much(count: u64, limit: u64) -> bool {
    count * 100 > limit * (100 + TOLERANCE_PERCENT)
}

/// A line of the file of limits, `question: limit`; other lines are comments.
fn limit_of(line: &str) -> Option<(&str, u64)> {
    let (question, limit) = line.split_once(": ")?;
    Some((question, limit.parse().ok()?))
}

fn bank_bytes() -> Result<Vec<u8>, Failure> {
    let files = lipz_benches::files(CLIPS, LOCALES);
    let inputs: Vec<Input> = files.iter().map(|(key, json)| Input::from_bytes(key, json.as_bytes())).collect();
    let options = Options::new().strip(true);
    Compiler::new(options.clone()).compile(&inputs).bank.ok_or_else(|| "the generated clips have errors".to_owned())
}

/// Instructions of one answer: what twice as many take more.
fn count(program: &Path, bank: &Path, question: &str) -> Result<u64, Failure> {
    let times = if WHOLE_BANK.contains(&question) { 2 } else { 10_000 };
    let ask =
        |times: u64| callgrind::instructions(Command::new(program).arg(bank).arg(question).arg(times.to_string()));
    Ok(ask(2 * times)?.saturating_sub(ask(times)?) / times)
}

/// Instructions of packing one file: what twice as many take more.
fn count_packing(program: &Path, folder: &Path) -> Result<u64, Failure> {
    let pack = |clips: usize| {
        let files = folder.join(format!("{clips} clips"));
        write_clips(clips, LOCALES, DEFAULT_SEED, &files)?;
        callgrind::instructions(Command::new(program).arg(&files).arg(files.with_extension("lipzbank")))
    };
    Ok(pack(2 * CLIPS)?.saturating_sub(pack(CLIPS)?) / CLIPS as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_allow_a_little_more() {
        assert_eq!(limit_of("find by id: 100"), Some(("find by id", 100)));
        assert_eq!(limit_of("# a comment: not a number"), None);
        assert!(!is_too_much(105, 100));
        assert!(is_too_much(106, 100));
    }
}
