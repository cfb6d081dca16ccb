//! The certain fixes of `lipz check --fix`, made in the files or only in memory.

use crate::console;
use crate::interrupt::Files;
use crate::shared::rewriting::Rewriting;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Fixed, Input};
use lipz_diagnostics::{Report, escape};
use std::borrow::Cow;
use std::collections::HashMap;

/// What fixing gave.
#[derive(Default)]
pub(super) struct Fixing {
    /// What was fixed in each file, or the differences.
    pub(super) changes: String,
    /// Files that are to be checked as if they were fixed, by name.
    pub(super) in_memory: HashMap<String, String>,
    /// Files that could not be written.
    pub(super) unwritten: Vec<Report>,
}

/// Fixes all files, or shows what would be fixed.
pub(super) fn fix_all(settings: &Settings, quiet: bool, rewriting: Rewriting) -> Fixing {
    // What cannot be found or read is reported by the check that follows.
    let (inputs, _) = settings.discover_with_reports();
    let bar = console::progress_bar(inputs.len(), quiet);
    let compiler = Compiler::new(settings.options.clone()).progress(|count| bar.inc(count));
    let files = Files::new();
    let results = compiler.each_file(&inputs, |input, bytes| {
        let fixed = match settings.options.for_file(&input.name()) {
            Cow::Borrowed(_) => compiler.fix(bytes)?,
            Cow::Owned(options) => Compiler::new(options).fix(bytes)?,
        };
        Some(rewriting.rewrite(&files, input, bytes, &fixed.text).map(|difference| (fixed, difference)))
    });
    let unwritten = files.finish();
    bar.finish_and_clear();
    let is_written = |input: &Input| unwritten.iter().all(|report| report.source.path != input.name());
    let mut fixing = Fixing::default();
    for (input, result) in std::iter::zip(inputs, results) {
        match result {
            Ok(Some(Ok((fixed, difference)))) => {
                if rewriting == Rewriting::Diff {
                    fixing.changes.push_str(&difference);
                    fixing.in_memory.insert(input.name(), fixed.text);
                } else if !quiet && is_written(&input) {
                    fixing.changes.push_str(&format!("{}: {} fixed\n", escape::text(&input.name()), counts(&fixed)));
                }
            }
            Ok(Some(Err(report))) => fixing.unwritten.push(report),
            Ok(None) | Err(_) => {}
        }
    }
    fixing.unwritten.extend(unwritten);
    fixing
}

/// `3 diagnostics (LZ0402, LZ0501)`.
fn counts(fixed: &Fixed) -> String {
    let codes: Vec<&str> = fixed.counts.keys().map(|code| code.number()).collect();
    format!("{} ({})", console::counted(fixed.counts.values().sum(), "diagnostic"), codes.join(", "))
}
