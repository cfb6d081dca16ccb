//! Counts instructions per query with valgrind. The counts do not depend on the load of the machine.
//!
//! Files are written and checked as for times. A program takes fifty times as long under valgrind, so only opening a
//! file and a few queries run under it, and only the queries are counted.

use crate::contest::{Ask, Contestant};
use crate::corpus::{Clip, Questions};
use crate::table::Row;
use crate::{Failure, KINDS};
use clap::Subcommand;
use lipz_benches::callgrind;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The number of counted queries of each kind.
const COUNTED: usize = 1000;
/// The number of counted openings, which are all the same.
const OPENINGS: usize = 2;
/// The function whose calls are counted, by its name in valgrind.
const COUNTED_FUNCTION: &str = concat!(module_path!(), "::asked");
/// The file of the questions.
const QUESTIONS: &str = "questions";

/// The hidden command.
#[derive(Subcommand, Debug)]
pub(crate) enum Piece {
    /// Ask a rival whose file is there
    #[command(hide = true)]
    Count { rival: String, folder: PathBuf, locale: String },
}

/// Makes queries of each kind in turn.
pub(crate) fn run(piece: &Piece) -> Result<(), Failure> {
    let Piece::Count { rival, folder, locale } = piece;
    let kind = KINDS.iter().find(|kind| kind.name == rival).ok_or("no such rival")?;
    let questions = std::fs::read(folder.join(QUESTIONS))?;
    let (questions, _) = bincode::decode_from_slice(&questions, bincode::config::standard())?;
    let contestant = (kind.open)(folder, questions, locale)?;
    for ask in Ask::ALL {
        // Preparations for the first query, such as a prepared statement, are not counted.
        contestant.ask(ask, 0..1)?;
        asked(contestant.as_ref(), ask)?;
    }
    Ok(())
}

/// Makes queries, and returns the number of answers.
#[inline(never)]
fn asked(contestant: &dyn Contestant, ask: Ask) -> Result<usize, Failure> {
    let times = if matches!(ask, Ask::Open | Ask::Validate) { OPENINGS } else { COUNTED };
    contestant.ask(ask, 0..times)
}

/// Writes the queries about `clips` into `folder`, which contains the files of the rivals.
pub(crate) fn prepare(clips: &[Clip], folder: &Path) -> Result<(), Failure> {
    let questions = bincode::encode_to_vec(Questions::about(clips, COUNTED), bincode::config::standard())?;
    Ok(std::fs::write(folder.join(QUESTIONS), questions)?)
}

/// Counts for all kinds of queries.
pub(crate) fn row(contestant: &dyn Contestant, folder: &Path, locale: &str) -> Result<Row, Failure> {
    let mut program = Command::new(std::env::current_exe()?);
    program.arg("count").arg(contestant.name()).arg(folder).arg(locale);
    let counts = callgrind::instructions_of_calls(&program, COUNTED_FUNCTION, Ask::ALL.len(), folder)?;
    let costs = Ask::ALL.into_iter().zip(counts).map(|(ask, count)| Ok(count as f64 / asked(contestant, ask)? as f64));
    Ok(Row {
        name: contestant.name(),
        file_bytes: contestant.file_bytes(),
        heap_bytes: 0,
        costs: costs.collect::<Result<_, Failure>>()?,
        allocations: 0.0,
    })
}
