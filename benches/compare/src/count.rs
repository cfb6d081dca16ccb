//! Instructions per question, counted by valgrind: the same on a busy machine as on a quiet one.

use crate::contest::{Ask, Contestant};
use crate::corpus::{Corpus, Questions};
use crate::table::Row;
use crate::{FIRST_LOCALE, Failure, KINDS, LOCALE};
use clap::{Subcommand, ValueEnum};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Questions that are counted.
const COUNTED: usize = 1000;

/// The hidden command.
#[derive(Subcommand, Debug)]
pub enum Piece {
    /// Ask a rival whose file is there
    #[command(hide = true)]
    Count { rival: String, ask: Ask, times: usize, folder: PathBuf, clips: usize, locales: usize },
}

/// Does the work.
pub fn run(piece: &Piece) -> Result<(), Failure> {
    let Piece::Count { rival, ask, times, folder, clips, locales } = piece;
    let kind = KINDS.iter().find(|kind| kind.name == rival).ok_or("no such rival")?;
    let corpus = Corpus::new(*clips, *locales)?;
    let locale = if *locales > 1 { LOCALE } else { FIRST_LOCALE };
    let contestant = (kind.open)(folder, Questions::about(&corpus.bank.clips), locale)?;
    contestant.ask(*ask, 0..*times)?;
    Ok(())
}

/// Counts for all kinds of questions: what asking more often takes more.
pub fn row(contestant: &dyn Contestant, folder: &Path, clips: usize, locales: usize) -> Result<Row, Failure> {
    let mut costs = Vec::new();
    for ask in Ask::ALL {
        let times = if matches!(ask, Ask::Open | Ask::Validate) { 2 } else { COUNTED };
        let count = |times: usize| -> Result<f64, Failure> {
            let mut program = Command::new(std::env::current_exe()?);
            program.arg("count").arg(contestant.name());
            program.arg(ask.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned()));
            program.arg(times.to_string()).arg(folder).arg(clips.to_string()).arg(locales.to_string());
            Ok(lipz_benches::callgrind::instructions(&program)? as f64)
        };
        let answers = contestant.ask(ask, 0..2 * times)? - contestant.ask(ask, 0..times)?;
        costs.push((count(2 * times)? - count(times)?) / answers as f64);
    }
    Ok(Row { name: contestant.name(), file_bytes: contestant.file_bytes(), heap_bytes: 0, costs, allocations: 0.0 })
}
