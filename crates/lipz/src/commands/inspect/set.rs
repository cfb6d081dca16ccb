//! `lipz inspect` of a set of banks.

use crate::reporter::{CommandResult, Reporter};
use crate::shared::set_file::SetFile;
use crate::{Outcome, console};
use lipz_bank::files::SetIndex;
use lipz_diagnostics::escape;
use serde::Serialize;
use std::fmt::Write;

/// The contents of the index.
#[derive(Serialize)]
struct SetSummary<'d> {
    clips: u64,
    /// The number of clips in a different bank than their ids imply.
    moved_clips: usize,
    bytes: u64,
    fingerprint: String,
    checksum: String,
    banks: Vec<BankOfSet<'d>>,
}

/// The entry of the index about a bank.
#[derive(Serialize)]
struct BankOfSet<'d> {
    file: &'d str,
    clips: u32,
    bytes: u32,
    checksum: String,
    fingerprint: String,
}

/// Shows the index of a set, after verifying its banks.
pub(super) fn inspect(set: &SetFile, reporter: &mut Reporter) -> CommandResult {
    let index = set.index(reporter)?;
    for number in 0..index.bank_count() {
        let file = set.bank(number, reporter)?;
        set.verify_bank(number, &file, reporter)?;
    }
    summary(&SetSummary::new(&index), set.name(), reporter.wants_json(), reporter)
}

impl<'d> SetSummary<'d> {
    fn new(index: &SetIndex<'d>) -> SetSummary<'d> {
        let hexadecimal = |number: u64| format!("{number:016x}");
        let banks: Vec<BankOfSet<'d>> = index
            .banks()
            .map(|bank| BankOfSet {
                file: bank.file_name,
                clips: bank.clip_count,
                bytes: bank.length_bytes,
                checksum: hexadecimal(bank.checksum),
                fingerprint: hexadecimal(bank.fingerprint),
            })
            .collect();
        SetSummary {
            clips: index.clip_count(),
            moved_clips: index.moved_count(),
            bytes: banks.iter().map(|bank| u64::from(bank.bytes)).sum::<u64>() + index.length_bytes() as u64,
            fingerprint: hexadecimal(index.fingerprint()),
            checksum: hexadecimal(index.checksum()),
            banks,
        }
    }
}

fn summary(summary: &SetSummary<'_>, path: &str, json: bool, reporter: &mut Reporter) -> CommandResult {
    if json {
        reporter.print_json(summary)?;
        return Ok(Outcome::Clean);
    }
    let number = |number: u64| console::grouped(usize::try_from(number).unwrap_or(usize::MAX));
    let mut text = String::new();
    let banks = console::counted(summary.banks.len(), "bank");
    let _ = writeln!(text, "{path}: set of {banks}, {} bytes", number(summary.bytes));
    let moved = match summary.moved_clips {
        0 => String::new(),
        moved => format!(", {} in the bank of their line", console::grouped(moved)),
    };
    let _ = writeln!(text, "  {} clips{moved}", number(summary.clips));
    let _ = writeln!(text, "  fingerprint {}, checksum {}", summary.fingerprint, summary.checksum);
    let _ = writeln!(text, "\n  {:>5} {:>12} {:>14}  file", "bank", "clips", "bytes");
    for (place, bank) in summary.banks.iter().enumerate() {
        let (clips, bytes) = (number(bank.clips.into()), number(bank.bytes.into()));
        let _ = writeln!(text, "  {place:>5} {clips:>12} {bytes:>14}  {}", escape::text(bank.file));
    }
    reporter.print(&text)?;
    Ok(Outcome::Clean)
}
