//! Programs of other makers that tasks run, and what happens where they are missing.

use crate::Failure;
use std::path::PathBuf;
use std::process::Command;

/// Whether all `tools` are on the path. Where they are not, the task is skipped with a line that
/// says so; in continuous integration, which installs them, that is a failure.
pub(crate) fn are_installed(tools: &[&str]) -> Result<bool, Failure> {
    let missing: Vec<&str> = tools.iter().copied().filter(|tool| find(tool).is_none()).collect();
    if missing.is_empty() { Ok(true) } else { skip(&format!("needs {}", missing.join(", "))) }
}

/// Says why a step is skipped; a failure in continuous integration.
pub(crate) fn skip(reason: &str) -> Result<bool, Failure> {
    if std::env::var_os("CI").is_some() {
        return Err(format!("{reason}: .ci/install installs it"));
    }
    println!("skipped: {reason}");
    Ok(false)
}

/// The file on the path with this name.
pub(crate) fn find(tool: &str) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    std::env::split_paths(&path).map(|folder| folder.join(tool)).find(|file| file.is_file())
}

/// Runs a command to its end and gives what it printed; its errors are shown.
pub(crate) fn output(command: &mut Command) -> Result<String, Failure> {
    let shown = shown(command);
    println!("{shown}");
    let output = command.output().map_err(|error| format!("`{shown}` cannot be run: {error}"))?;
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    if output.status.success() {
        return Ok(printed);
    }
    let errors = String::from_utf8_lossy(&output.stderr);
    Err(format!("`{shown}` ended with {}:\n{printed}{errors}", output.status))
}

fn shown(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(|word| word.to_string_lossy()).collect::<Vec<_>>().join(" ")
}
