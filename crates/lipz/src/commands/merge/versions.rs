//! Three versions of a Lipz file, merged as Git's merge driver.

use crate::reporter::{CommandResult, Reporter};
use crate::shared::input_file::{read, unreadable};
use crate::shared::{output_file, stdio};
use crate::{Abort, Outcome, console};
use lipz_compiler::settings::Settings;
use lipz_diagnostics::{Code, Diagnostic, Report};
use lipz_file::decode;
use lipz_file::merge::{MergedFile, Versions, merge};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The common ancestor, our version and that of the other branch.
pub(super) type VersionPaths = [PathBuf; 3];

/// Merges the versions into `output`. `name` is the path of the file in the project.
pub(super) fn run(versions: &VersionPaths, output: &Path, name: &Path, reporter: &mut Reporter) -> CommandResult {
    if stdio::is_meant(output) {
        let tip = "name our version, as in a merge driver of Git, or a new file";
        return Err(reporter.usage("a merged Lipz file cannot go to standard output", tip));
    }
    let [_, ours, _] = versions;
    let is_same =
        |other: &Path| matches!((ours.canonicalize(), other.canonicalize()), (Ok(one), Ok(other)) if one == other);
    if let Some(report) = output_file::in_the_way(output, "name our version or a new file").filter(|_| !is_same(output))
    {
        return Err(reporter.refuse(vec![report]));
    }
    let mut files = Vec::new();
    for path in versions {
        files.push(read(path).map_err(|error| reporter.fail(unreadable(path, &error)))?);
    }
    let shown = console::path(name);
    let MergedFile { text, conflicts } = match merged(&files, name) {
        Some(merged) => merged,
        None => {
            reporter.remark(&format!("{shown} is merged by lines, because a version is not a valid Lipz file\n"));
            by_lines(versions, &shown, reporter)?
        }
    };
    output_file::write(output, text.as_bytes(), reporter)?;
    if conflicts.is_empty() {
        return Ok(Outcome::Clean);
    }
    let conflict =
        |element: String| Diagnostic::new(Code::MergeConflict, format!("both branches have changed {element}"));
    let help = "choose a version in the file, and delete the lines that start with `<<<<<<<`, `=======` and `>>>>>>>`";
    let conflicts = conflicts.into_iter().map(|element| Report::about(&*shown, conflict(element).help(help)));
    let reports: Vec<Report> = conflicts.collect();
    reporter.add(reports);
    Ok(Outcome::Errors)
}

/// Merges three Lipz files; `None` if one of them has errors.
fn merged(files: &[Vec<u8>], name: &Path) -> Option<MergedFile> {
    let [base, ours, theirs] = files else { return None };
    let text = |bytes| decode(bytes, &mut Vec::new());
    let versions = Versions { base: text(base)?, ours: text(ours)?, theirs: text(theirs)? };
    // Settings with errors are reported by other commands. Here, they only determine the first text.
    let settings = Settings::find_of(&[name.to_owned()]).map(|file| Settings::read_with_report(&file).0);
    let default_locale = settings.as_ref().and_then(|settings| settings.options.get_default_locale());
    let mut merged = merge(versions, default_locale)?;
    merged.conflicts.iter_mut().for_each(|element| *element = format!("`{element}`"));
    Some(merged)
}

/// Merges the versions line by line, as Git does without a driver.
fn by_lines(versions: &VersionPaths, shown: &str, reporter: &mut Reporter) -> Result<MergedFile, Abort> {
    let [base, ours, theirs] = versions;
    let mut git = Command::new("git");
    git.args(["merge-file", "-p", "-L", "ours", "-L", "base", "-L", "theirs"]).args([ours, base, theirs]);
    let failed = |why: String| {
        let message = format!("`{shown}` cannot be merged by lines: {why}");
        Report::failure(shown, Code::UnreadableFile, message, "fix the errors in each version, or install Git")
    };
    let output = git.stdin(Stdio::null()).output();
    let output = output.map_err(|error| reporter.fail(failed(format!("`git merge-file` cannot run: {error}"))))?;
    // The status is the number of conflicts, up to 127.
    let count = output.status.code().filter(|count| (0..=127).contains(count));
    let why = || String::from_utf8_lossy(&output.stderr).trim().to_owned();
    let count = count.ok_or_else(|| reporter.fail(failed(why())))?;
    let text = String::from_utf8(output.stdout).map_err(|_| reporter.fail(failed("it is not UTF-8".to_owned())))?;
    let conflicts = if count == 0 { Vec::new() } else { vec![console::counted(count as usize, "part")] };
    Ok(MergedFile { text, conflicts })
}
