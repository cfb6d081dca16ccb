//! `cargo xtask instructions`: counts the instructions of the reader's queries and of packing, and checks them against
//! limits.
//!
//! Times vary with the load of the machine, instruction counts do not, so they can fail a build. The limits are in
//! `benches/instructions.txt`; `--bless` writes the current counts.

use clap::Parser;
use lipz_benches::{DEFAULT_SEED, callgrind, faces, layers, mouths, temporary_folder, write_clips};
use lipz_compiler::shard::{Link, Shard, shard_of_key};
use lipz_compiler::{Compiler, Input, Options};
use std::collections::HashMap;
use std::fmt::Write as _;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Count the instructions of the reader's queries and of packing, and check them against their limits.
#[derive(Parser, Debug)]
#[command(name = "cargo xtask instructions", max_term_width = 100)]
struct Settings {
    /// The program that makes queries, in a release build
    #[arg(long, value_name = "PROGRAM", hide = true)]
    queries: PathBuf,

    /// The program that packs, in a release build
    #[arg(long, value_name = "PROGRAM", hide = true)]
    packing: PathBuf,

    /// Use the current counts as the limits
    #[arg(long)]
    bless: bool,
}

/// Why counting failed.
type Failure = String;

/// The file of limits.
const LIMITS: &str = "benches/instructions.txt";
/// The percentage above its limit at which a count fails, because a different patch version of the compiler may change
/// counts.
const TOLERANCE_PERCENT: u64 = 5;
/// The number of clips in the bank for queries, which hardly affects the counts.
const CLIPS: usize = 1000;
/// The number of lines in the banks for queries about curves, faces and mouths.
const LINES_WITH_FACES: usize = 100;
/// The number of locales in each clip.
const LOCALES: usize = 5;
/// Queries about the whole bank, which take millions of instructions, and are repeated less often.
const WHOLE_BANK: [&str; 2] = ["verify", "verify with simdutf8"];
/// The measurement of packing, which is not a query of a bank.
const PACKING: &str = "pack a file";
/// The number of banks in the set for queries.
const SHARDS: NonZero<u16> = NonZero::new(64).expect("not 0");
/// The kinds of dialogues, and the greatest cost of a query in them, in percent of that in one bank.
const RATIOS: [(&str, u64); 3] = [("one bank", 120), ("stack", 150), ("set", 130)];

fn main() -> Result<(), Failure> {
    let settings = Settings::parse();
    let limits_path = Path::new(env!("CARGO_MANIFEST_DIR")).join("instructions.txt");
    let limits = std::fs::read_to_string(&limits_path).map_err(|error| format!("`{LIMITS}`: {error}"))?;
    let folder = temporary_folder()?;
    let bank = folder.path().join("counted.lipzbank");
    write_banks(&bank)?;

    let (mut counted, mut counts, mut too_many) = (String::new(), HashMap::new(), Vec::new());
    println!("{:<43} {:>9} {:>9}", "question", "counted", "limit");
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
        println!("{question:<43} {count:>9} {limit:>9}");
        let _ = writeln!(counted, "{question}: {count}");
        counts.insert(question, count);
        if is_too_much(count, limit) {
            too_many.push(question.to_owned());
        }
    }
    let slow = slow_among(&counts);
    if !slow.is_empty() {
        return Err(slow.join("\n"));
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

/// Parses a line of the file of limits, `question: limit`; other lines are comments.
fn limit_of(line: &str) -> Option<(&str, u64)> {
    let (question, limit) = line.rsplit_once(": ")?;
    Some((question, limit.parse().ok()?))
}

/// Returns the queries whose cost in a dialogue exceeds their share of that in one bank.
fn slow_among(counts: &HashMap<&str, u64>) -> Vec<String> {
    let ratio = |(asked, count): (&&str, &u64)| {
        let (of, question) = asked.split_once(": ")?;
        let (_, percent) = RATIOS.iter().find(|(dialogue, _)| *dialogue == of)?;
        let in_bank = counts.get(question)?;
        let is_slow = count * 100 > in_bank * percent;
        is_slow.then(|| format!("`{asked}` takes {count}, more than {percent} % of `{question}`, {in_bank}"))
    };
    let mut slow: Vec<String> = counts.iter().filter_map(ratio).collect();
    slow.sort_unstable();
    slow
}

/// Writes the bank, the patches on top of it, a set of the same clips, and the banks with faces and mouths.
fn write_banks(bank: &Path) -> Result<(), Failure> {
    let files = lipz_benches::files(CLIPS, LOCALES);
    let bytes = compiler().compile(&inputs_of(&files)).into_bank().map_err(|error| error.to_string())?;
    let (patch, addition) = layers::over(&bytes, CLIPS)?;
    let faces = faces::bank(DEFAULT_SEED, LINES_WITH_FACES)?;
    let mouths = mouths::bank(DEFAULT_SEED, LINES_WITH_FACES)?;
    let write = |extension: &str, bytes: &[u8]| std::fs::write(bank.with_extension(extension), bytes);
    let single = [("lipzbank", &bytes), ("patch", &patch), ("mod", &addition), ("faces", &faces), ("mouths", &mouths)];
    for (extension, bytes) in single {
        write(extension, bytes).map_err(|error| error.to_string())?;
    }
    write_set(bank, &inputs_of(&files))
}

/// Writes the set as `lipz shard link` does, and its banks again under names with their numbers.
fn write_set(bank: &Path, inputs: &[Input]) -> Result<(), Failure> {
    let compiler = compiler();
    let shard_of = |input: &Input| shard_of_key(&input.key, compiler.options().get_voices(), SHARDS);
    let mut objects = Vec::new();
    for shard in 0..SHARDS.get() {
        let own: Vec<Input> = inputs.iter().filter(|input| shard_of(input) == shard).cloned().collect();
        let object =
            compiler.object(&own, &Shard::new(shard, SHARDS.get())).into_bank().map_err(|error| error.to_string())?;
        let path = bank.with_extension(format!("object{shard}"));
        std::fs::write(&path, object).map_err(|error| error.to_string())?;
        objects.push(path);
    }
    let link = Link::open(&objects).map_err(|reports| reports.iter().map(ToString::to_string).collect::<String>())?;
    let linked = compiler.link_to_set(&link, &bank.with_extension("lipzset"));
    let files = linked.files.ok_or("the generated clips have errors")?;
    for (shard, file) in files.banks.iter().enumerate() {
        std::fs::copy(&file.path, bank.with_extension(format!("shard{shard}"))).map_err(|error| error.to_string())?;
    }
    Ok(())
}

fn compiler() -> Compiler<'static> {
    Compiler::new(Options::new().strip(true))
}

fn inputs_of(files: &[(String, String)]) -> Vec<Input> {
    files.iter().map(|(key, json)| Input::from_bytes(key, json.as_bytes())).collect()
}

/// Returns the instructions of one answer, from the difference to twice as many.
fn count(program: &Path, bank: &Path, question: &str) -> Result<u64, Failure> {
    let times = if WHOLE_BANK.contains(&question) { 2 } else { 10_000 };
    let ask =
        |times: u64| callgrind::instructions(Command::new(program).arg(bank).arg(question).arg(times.to_string()));
    Ok(ask(2 * times)?.saturating_sub(ask(times)?) / times)
}

/// Returns the instructions of packing one file, from the difference to twice as many.
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
        assert_eq!(limit_of("face: emotions: 7"), Some(("face: emotions", 7)));
        assert_eq!(limit_of("# a comment: not a number"), None);
        assert!(!is_too_much(105, 100));
        assert!(is_too_much(106, 100));
    }

    #[test]
    fn many_banks_take_little_more_than_one() {
        let counts = |stack| HashMap::from([("find by id", 100), ("stack: find by id", stack), ("face: whole", 900)]);
        assert_eq!(slow_among(&counts(150)), Vec::<String>::new());
        let found = "`stack: find by id` takes 151, more than 150 % of `find by id`, 100";
        assert_eq!(slow_among(&counts(151)), [found]);
    }
}
