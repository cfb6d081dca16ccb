//! `lipz shard merge`: merges the visemes of all shards into the Lipz files.

use crate::commands::Run;
use crate::reporter::{Abort, CommandResult, Reporter};
use crate::shared::input_file::{self, unreadable};
use crate::shared::patterns;
use crate::shared::run_flags::QuietFlag;
use crate::shared::sync_summary::summary;
use crate::shared::sync_table::SyncDocument;
use crate::{Outcome, console, interrupt};
use clap::Args;
use lipz_compiler::settings::Settings;
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_sync::shard::{Mouths, merge};
use lipz_sync::{SyncOptions, SyncRecord};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Write the visemes of all shards into the Lipz files.
#[derive(Args, Debug)]
#[command(after_help = "Example:
  lipz shard merge '*-of-64.lipzmouths'")]
pub(super) struct MergeShards {
    /// Results of `lipz shard sync`, for all shards of a plan
    #[arg(value_name = "FILES", required = true, num_args = 1..)]
    files: Vec<PathBuf>,

    #[command(flatten)]
    quiet: QuietFlag,
}

impl Run for MergeShards {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        run(self, reporter)
    }
}

/// Merges the files that the arguments name.
fn run(arguments: &MergeShards, reporter: &mut Reporter) -> CommandResult {
    let mouths = read(&patterns::files(&arguments.files), reporter)?;
    let (settings, record) =
        mouths.first().map(|first| (first.settings.clone(), first.record.clone())).unwrap_or_default();
    let settings = settings.map(Settings::read).transpose().map_err(|report| reporter.refuse(vec![report]))?;
    let settings = settings.unwrap_or_default();
    let (_, problems) = SyncOptions::new_with_report(&settings).map_err(|report| reporter.fail(report))?;
    let place = PathBuf::from(record);
    let mut record = SyncRecord::read(&place).map_err(|report| reporter.fail(report))?;
    let mut synced = merge(mouths, &mut record, &|write| interrupt::whole(write));
    let mut reports = record.warnings().to_vec();
    reports.iter_mut().for_each(|report| settings.options.get_levels().apply(&mut report.diagnostics));
    reports.extend(problems.into_iter().chain(std::mem::take(&mut synced.reports)));
    lipz_diagnostics::reports::sort(&mut reports);
    let outcome = Outcome::from_reports(&reports);
    reporter.add(reports);
    reporter.add_result("sync", || SyncDocument::new(&synced, 0));
    if !arguments.quiet.is_set() {
        let folder = place.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        reporter.summary(&summary(&synced, 0, folder))?;
    }
    Ok(outcome)
}

/// Reads the visemes in these files: one file for each shard of one plan.
fn read(files: &[PathBuf], reporter: &mut Reporter) -> Result<Vec<Mouths>, Abort> {
    let mut by_shard: BTreeMap<u16, Mouths> = BTreeMap::new();
    let (mut count, mut faults) = (None, Vec::new());
    for path in files {
        match one(path) {
            Err(report) => faults.push(report),
            Ok(mouths) => {
                let shards = *count.get_or_insert(mouths.shards);
                let others = by_shard.values().next();
                let is_of_project =
                    |other: &Mouths| (&other.settings, &other.record) == (&mouths.settings, &mouths.record);
                if others.is_some_and(|other| !is_of_project(other)) {
                    let message = "the file belongs to a different project";
                    faults.push(fault(path, Code::ObjectMisfit, message, "name the results of one plan"));
                } else if others.is_some_and(|other| other.common != mouths.common) {
                    let message =
                        "the file was made with different settings, models or lexicons than the previous files";
                    faults.push(fault(
                        path,
                        Code::ObjectMisfit,
                        message,
                        "run `lipz shard sync` again for all shards of one plan",
                    ));
                } else if mouths.shards != shards {
                    let message =
                        format!("the file is one of {} shards, but the previous files are of {shards}", mouths.shards);
                    faults.push(fault(path, Code::ObjectMisfit, &message, "name the results of one plan"));
                } else {
                    let shard = mouths.shard;
                    if by_shard.insert(shard, mouths).is_some() {
                        let message = format!("shard {shard} is named twice");
                        faults.push(fault(path, Code::ObjectMisfit, &message, "name each file once"));
                    }
                }
            }
        }
    }
    let missing: Vec<String> = (0..count.unwrap_or_default())
        .filter(|shard| !by_shard.contains_key(shard))
        .map(|shard| shard.to_string())
        .collect();
    if faults.is_empty() && !missing.is_empty() {
        let message =
            format!("the visemes of shards {} of {} are missing", missing.join(", "), count.unwrap_or_default());
        let diagnostic = Diagnostic::new(Code::ObjectMissing, message).help("name the results of all shards");
        faults.push(Report::about("", diagnostic));
    }
    if faults.is_empty() { Ok(by_shard.into_values().collect()) } else { Err(reporter.refuse(faults)) }
}

fn one(path: &Path) -> Result<Mouths, Report> {
    let bytes = input_file::read(path).map_err(|error| unreadable(path, &error))?;
    Mouths::parse(&bytes).map_err(|why| {
        let message = format!("`{}` does not contain the visemes of a shard: {why}", console::path(path));
        fault(path, Code::NoObject, &message, "name files written by `lipz shard sync`")
    })
}

fn fault(path: &Path, code: Code, message: &str, help: &str) -> Report {
    Report::about(console::path(path), Diagnostic::new(code, message).help(help))
}
