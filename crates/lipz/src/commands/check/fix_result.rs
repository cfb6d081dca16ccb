//! The certain fixes of `lipz check --fix`, made in the files or only in memory.

use crate::console;
use crate::interrupt::Files;
use crate::shared::rewrite_mode::RewriteMode;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, FixedFile, Input};
use lipz_diagnostics::{Report, escape};
use std::borrow::Cow;
use std::collections::HashMap;

/// The result of fixing.
#[derive(Default)]
pub(super) struct FixResult {
    /// The fixes made in each file, or the differences.
    pub(super) changes: String,
    /// Fixed contents of files to check instead of those on disk, by name.
    pub(super) in_memory: HashMap<String, String>,
    /// Files that could not be written.
    pub(super) unwritten: Vec<Report>,
}

/// Fixes all files, or shows the fixes.
pub(super) fn fix_all(settings: &Settings, quiet: bool, rewriting: RewriteMode) -> FixResult {
    // The check that follows reports files that cannot be found or read.
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
    let mut fixing = FixResult::default();
    for (input, result) in std::iter::zip(inputs, results) {
        match result {
            Ok(Some(Ok((fixed, difference)))) => {
                if rewriting == RewriteMode::Diff {
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

/// Formats counts by code: `3 diagnostics (LZ0402, LZ0501)`.
fn counts(fixed: &FixedFile) -> String {
    let codes: Vec<&str> = fixed.counts.keys().map(|code| code.number()).collect();
    format!("{} ({})", console::counted(fixed.counts.values().sum(), "diagnostic"), codes.join(", "))
}
