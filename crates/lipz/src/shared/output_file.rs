//! Output files: written completely or not at all, and never over sources.

use crate::Abort;
use crate::interrupt::Files;
use crate::reporter::Reporter;
use crate::shared::text_record::from_root;
use crate::{console, interrupt};
use lipz_compiler::settings::FILE_NAME;
use lipz_compiler::{key, replace_file};
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::path::{Path, PathBuf};
use std::{env, io};

/// Refuses an output with the name of a Lipz file or of settings, so that a typing error does not replace a clip by a
/// bank.
pub(crate) fn refuse_source(path: &Path, reporter: &mut Reporter) -> Result<(), Abort> {
    if path.file_name().is_some_and(|name| name.eq_ignore_ascii_case(FILE_NAME)) {
        let message = format!("`{}` is the name of a settings file, not of an output", console::path(path));
        return Err(reporter.usage(message, "give the output a different name"));
    }
    if path.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case(key::EXTENSION)) {
        return Ok(());
    }
    let message = format!("`{}` is the name of a Lipz file, not of an output", console::path(path));
    Err(reporter.usage(message, "give the output a different extension"))
}

/// Refuses outputs that are the same file, or that would replace an input. Each path comes with its description.
pub(crate) fn refuse_same(files: &[(&str, &Path)], reporter: &mut Reporter) -> Result<(), Abort> {
    let places: Vec<PathBuf> = files.iter().map(|(_, path)| place(path)).collect();
    for (index, (what, path)) in files.iter().enumerate() {
        let Some(other) = places.iter().take(index).position(|place| Some(place) == places.get(index)) else {
            continue;
        };
        let other = files.get(other).map_or("", |(what, _)| what);
        let message = format!("{what} and {other} are the same file: `{}`", console::path(path));
        return Err(reporter.usage(message, "give them different paths"));
    }
    Ok(())
}

/// Returns the actual path of a file, which may not exist yet.
fn place(path: &Path) -> PathBuf {
    let folder = || {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Some(folder.canonicalize().ok()?.join(path.file_name()?))
    };
    path.canonicalize().ok().or_else(folder).unwrap_or_else(|| path.to_owned())
}

/// Returns the report about a folder that cannot be created.
pub(crate) fn unwritable(folder: &Path, error: &io::Error) -> Report {
    let shown = console::path(folder);
    let message = format!("`{shown}` cannot be created: {error}");
    Report::failure(shown, Code::OutputFailed, message, "check that you may write there")
}

/// Refuses a folder that cannot be created because it, or a folder above it, is a file.
pub(crate) fn refuse_file(folder: &Path, reporter: &mut Reporter) -> Result<(), Abort> {
    let current = env::current_dir().unwrap_or_default();
    let whole = from_root(&current, folder);
    let existing = whole.ancestors().find(|path| path.exists());
    let Some(file) = existing.filter(|path| !path.is_dir()) else { return Ok(()) };
    let (file, folder) = (console::path(file.strip_prefix(&current).unwrap_or(file)), console::path(folder));
    let message = format!("the folder `{folder}` cannot be created, because `{file}` is a file");
    Err(reporter.fail(Report::failure(file, Code::OutputFailed, message, "name a different folder, or move the file")))
}

/// Replaces the file at `path` completely, even if the run is interrupted. Reports errors.
pub(crate) fn write(path: &Path, bytes: &[u8], reporter: &mut Reporter) -> Result<(), Abort> {
    interrupt::whole(|| replace_file(path, bytes)).map_err(|report| reporter.fail(report))
}

/// The help for an existing file that `--overwrite` replaces.
pub(crate) const OVERWRITE: &str = "write into another folder, or replace files with --overwrite";

/// Returns the diagnostic for an existing output file.
pub(crate) fn in_the_way(path: &Path, help: &str) -> Option<Report> {
    path.symlink_metadata().ok()?;
    let shown = console::path(path);
    let diagnostic = Diagnostic::new(Code::WouldOverwrite, format!("`{shown}` already exists"));
    Some(Report::about(shown, diagnostic.note("nothing was written").help(help)))
}

/// Whether no error about the output files was found. Otherwise, no file is written.
pub(crate) fn may_write(reports: &[Report]) -> bool {
    let mut found = reports.iter().flat_map(|report| &report.diagnostics);
    found.all(|found| {
        !matches!(found.code, Code::WouldOverwrite | Code::RefusedKey | Code::DuplicateKey | Code::KeyClash)
            || !found.is_error()
    })
}

/// Writes the files. Returns the number of those written, and adds the problems of the others to `reports`.
pub(crate) fn write_all<'f>(files: impl IntoIterator<Item = (PathBuf, &'f [u8])>, reports: &mut Vec<Report>) -> usize {
    let waiting = Files::new();
    let mut count = 0;
    for (path, bytes) in files {
        match waiting.replace(&path, bytes) {
            Ok(()) => count += 1,
            Err(report) => reports.push(report),
        }
    }
    let unwritten = waiting.finish();
    count -= unwritten.len();
    reports.extend(unwritten);
    count
}
