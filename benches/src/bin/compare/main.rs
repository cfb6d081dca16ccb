//! Compares lipz with other formats for the same clips: `cargo xtask compare`.
//!
//! Every rival writes a file with the same clips, and has to return the same answers. The rivals then make the same
//! queries in turns, and the medians are printed.

#![allow(unsafe_code, reason = "rivals that are fast without checks, and an allocator that counts")]
#![allow(
    clippy::cast_possible_truncation,
    clippy::panic,
    clippy::expect_used,
    reason = "a measurement ends where it cannot go on"
)]

mod contest;
mod corpus;
mod count;
mod heap;
mod report;
mod rival;
mod rivals;
mod table;

use clap::Parser;
use contest::{Ask, Contestant, Entry};
use corpus::{Corpus, QUESTIONS, Questions};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use table::Row;

/// Why the comparison failed.
type Failure = Box<dyn std::error::Error>;

/// Compare lipz with other formats for the same clips.
#[derive(Parser, Debug)]
#[command(name = "cargo xtask compare", max_term_width = 100)]
struct Arguments {
    /// Numbers of clips
    #[arg(long, value_name = "N,…", value_delimiter = ',', default_value = "10000")]
    clips: Vec<usize>,

    /// Numbers of locales in each clip
    #[arg(long, value_name = "K,…", value_delimiter = ',', default_value = "5")]
    locales: Vec<usize>,

    /// How often to repeat all measurements
    #[arg(long, default_value_t = 15)]
    rounds: usize,

    /// Only the rivals whose names contain one of these words
    #[arg(long, value_name = "WORD,…", value_delimiter = ',')]
    only: Vec<String>,

    /// Count instructions with valgrind instead of measuring times
    #[arg(long)]
    instructions: bool,

    /// Write the tables into this Markdown file, between the comments that name them
    #[arg(long, value_name = "FILE")]
    write: Option<PathBuf>,

    /// One part of `--instructions`
    #[command(subcommand)]
    count: Option<count::Piece>,
}

/// Writes the file of a rival into a folder.
type Build = fn(&Corpus, &Path) -> Result<(), Failure>;
/// Opens it there for questions about the locale with this tag.
type Open = fn(&Path, Questions, &str) -> Result<Box<dyn Contestant>, Failure>;

/// The functions of a rival.
struct Kind {
    name: &'static str,
    build: Build,
    open: Open,
}

const fn kind<R: rival::Rival>() -> Kind {
    Kind { name: R::NAME, build: Entry::<R>::build, open: Entry::<R>::open }
}

/// All rivals.
const KINDS: [Kind; 12] = [
    kind::<rivals::none::Nothing>(),
    kind::<rivals::lipz::Lipz>(),
    kind::<rivals::lipz::LipzSimd>(),
    kind::<rivals::limit::Limit>(),
    kind::<rivals::rkyv::Rkyv>(),
    kind::<rivals::flat::Flatbuffers>(),
    kind::<rivals::zerovec::ZeroVectors>(),
    kind::<rivals::serde::Bincode>(),
    kind::<rivals::serde::Postcard>(),
    kind::<rivals::json::ParsedOnce>(),
    kind::<rivals::json::AsSpecified>(),
    kind::<rivals::sqlite::Sqlite>(),
];

/// The locale of the queries for texts.
const LOCALE: &str = "de-de";
/// The locale if there is only one.
const FIRST_LOCALE: &str = "en-us";

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let result = match &arguments.count {
        Some(piece) => count::run(piece),
        None => compare(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("compare: {failure}");
            ExitCode::FAILURE
        }
    }
}

fn compare(arguments: &Arguments) -> Result<(), Failure> {
    for &locales in &arguments.locales {
        for &clips in &arguments.clips {
            let table = compare_one(arguments, clips, locales)?;
            let kind = if arguments.instructions { "instructions" } else { "times" };
            println!("{clips} clips, {locales} locales\n\n{table}");
            if let Some(file) = &arguments.write {
                report::write(file, &format!("{kind} {clips}×{locales}"), &table)?;
            }
        }
    }
    Ok(())
}

fn compare_one(arguments: &Arguments, clips: usize, locales: usize) -> Result<String, Failure> {
    let corpus = Corpus::new(clips, locales)?;
    let folder = tempfile::tempdir()?;
    let locale = if locales > 1 { LOCALE } else { FIRST_LOCALE };
    let questions = || Questions::about(&corpus.bank.clips, QUESTIONS);
    let known = questions();
    let mut contestants = Vec::new();
    for kind in &KINDS {
        if !arguments.only.is_empty() && !arguments.only.iter().any(|word| kind.name.contains(word)) {
            continue;
        }
        eprintln!("{clips} clips, {locales} locales: writing and checking {}", kind.name);
        (kind.build)(&corpus, folder.path())?;
        let contestant = (kind.open)(folder.path(), questions(), locale)?;
        if kind.name != KINDS[0].name {
            contestant.check(&corpus, &known)?;
        }
        contestants.push(contestant);
    }
    if arguments.instructions {
        count::prepare(&corpus.bank.clips, folder.path())?;
        let rows = contestants.iter().map(|contestant| count::row(contestant.as_ref(), folder.path(), locale));
        return Ok(table::instructions(&rows.collect::<Result<Vec<_>, _>>()?));
    }
    measure(&contestants, arguments.rounds)
}

fn measure(contestants: &[Box<dyn Contestant>], rounds: usize) -> Result<String, Failure> {
    let mut times = vec![[const { Vec::new() }; Ask::ALL.len()]; contestants.len()];
    let mut cursors = vec![0; contestants.len()];
    for round in 1..=rounds {
        eprintln!("round {round} of {rounds}");
        for ask in Ask::ALL {
            for ((contestant, times), cursor) in contestants.iter().zip(&mut times).zip(&mut cursors) {
                times[ask as usize].push(contestant.time(ask, cursor)?);
            }
        }
    }
    let rows = contestants.iter().zip(times).map(|(contestant, times)| {
        Ok(Row {
            name: contestant.name(),
            file_bytes: contestant.file_bytes(),
            heap_bytes: contestant.heap_bytes()?,
            costs: times.into_iter().map(median).collect(),
            allocations: allocations(contestant.as_ref())?,
        })
    });
    Ok(table::times(&rows.collect::<Result<Vec<Row>, Failure>>()?))
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or_default()
}

/// Returns the allocations per answer, the most of any kind of query.
fn allocations(contestant: &dyn Contestant) -> Result<f64, Failure> {
    let mut most = 0.0_f64;
    for ask in Ask::QUERIES {
        let before = heap::allocations();
        let answers = contestant.ask(ask, 0..100)?;
        most = most.max((heap::allocations() - before) as f64 / answers as f64);
    }
    Ok(most)
}
