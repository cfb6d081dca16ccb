//! `lipz sync --from`: the mouths of all shards go into the Lipz files.

use super::{SyncArguments, summary, table};
use crate::reporter::{Abort, Ended, Reporter};
use crate::shared::patterns;
use crate::{Outcome, console, interrupt};
use lipz_compiler::settings::Settings;
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_sync::shard::{Mouths, merge};
use lipz_sync::{SyncOptions, SyncRecord};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Merges the files that are named.
pub(super) fn run(arguments: &SyncArguments, reporter: &mut Reporter) -> Ended {
    let mouths = read(&patterns::files(&arguments.from), reporter)?;
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
    reporter.add_result("sync", || table::Table::new(&synced, 0));
    if !arguments.sources.is_quiet() {
        let folder = place.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        reporter.summary(&summary::summary(&synced, 0, folder))?;
    }
    Ok(outcome)
}

/// The mouths in these files: of each shard of one plan, once.
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
                    let message = "this is of another project";
                    faults.push(fault(path, Code::ObjectMisfit, message, "name those of one plan"));
                } else if others.is_some_and(|other| other.common != mouths.common) {
                    let message = "this was made with other settings, models or lexicons than those before it";
                    faults.push(fault(path, Code::ObjectMisfit, message, "make the mouths of all shards by one plan"));
                } else if mouths.shards != shards {
                    let message = format!("this is one of {} shards, and others are of {shards}", mouths.shards);
                    faults.push(fault(path, Code::ObjectMisfit, &message, "name those of one plan"));
                } else {
                    let shard = mouths.shard;
                    if by_shard.insert(shard, mouths).is_some() {
                        let message = format!("shard {shard} is there twice");
                        faults.push(fault(path, Code::ObjectMisfit, &message, "name each once"));
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
            format!("the mouths of shards {} of {} are missing", missing.join(", "), count.unwrap_or_default());
        let diagnostic = Diagnostic::new(Code::ObjectMissing, message).help("name those of all shards");
        faults.push(Report::about("", diagnostic));
    }
    if faults.is_empty() { Ok(by_shard.into_values().collect()) } else { Err(reporter.refuse(faults)) }
}

fn one(path: &Path) -> Result<Mouths, Report> {
    let bytes = fs::read(path).map_err(|error| {
        let message = format!("`{}` cannot be read: {error}", console::path(path));
        fault(path, Code::UnreadableFile, &message, "check the spelling of the path")
    })?;
    Mouths::parse(&bytes).map_err(|why| {
        let message = format!("`{}` has no mouths of a shard: {why}", console::path(path));
        fault(path, Code::NoObject, &message, "name what `lipz sync --shard` writes")
    })
}

fn fault(path: &Path, code: Code, message: &str, help: &str) -> Report {
    Report::about(console::path(path), Diagnostic::new(code, message).help(help))
}
