//! The files of every package: the program, its manual pages, completions, licences and notices.

use super::archive::Entry;
use super::notices::notices;
use super::platform::{EMULATORS, Platform};
use crate::Failure;
use crate::paths::{temporary_folder, workspace_root};
use std::fs;
use std::path::Path;
use std::process::Command;

/// Shells with the names that they require for files of completions.
const SHELLS: [(&str, &str); 5] = [
    ("bash", "lipz.bash"),
    ("elvish", "lipz.elv"),
    ("fish", "lipz.fish"),
    ("powershell", "_lipz.ps1"),
    ("zsh", "_lipz"),
];

/// Everything that packages for one platform contain.
pub(super) struct Contents {
    pub(super) program: Vec<u8>,
    /// The page for users, with absolute links.
    pub(super) readme: String,
    pub(super) changelog: Vec<u8>,
    /// Licences and notices.
    pub(super) licences: Vec<Entry>,
    /// By the name that the shell requires.
    pub(super) completions: Vec<Entry>,
    pub(super) manual: Vec<Entry>,
}

impl Contents {
    /// Collects the files. Runs the program, in an emulator if it is for a different machine.
    pub(super) fn of(platform: &Platform, program: &Path) -> Result<Contents, Failure> {
        let run = || {
            let needs = || format!("lipz for {} does not run here: needs {EMULATORS}", platform.target);
            platform.runner(program).ok_or_else(needs)
        };
        let mut completions = Vec::new();
        for (shell, name) in SHELLS {
            completions.push(Entry::file(name, printed(run()?.args(["print", "completions", shell]))?));
        }
        let root = workspace_root();
        Ok(Contents {
            program: read(program)?,
            readme: String::from_utf8_lossy(&read(&root.join("crates/lipz/README.md"))?).into_owned(),
            changelog: read(&root.join("CHANGELOG.md"))?,
            licences: licences("lipz", platform.target)?,
            completions,
            manual: manual(run()?)?,
        })
    }
}

/// Returns the licences of lipz, and the notices of a crate of this workspace with all dependencies.
pub(super) fn licences(package: &str, target: &str) -> Result<Vec<Entry>, Failure> {
    let mut entries = Vec::new();
    for name in ["LICENSE-APACHE", "LICENSE-MIT"] {
        entries.push(Entry::file(name, read(&workspace_root().join(name))?));
    }
    entries.push(Entry::file("NOTICES.txt", notices(package, target)?));
    Ok(entries)
}

/// Returns the manual pages that the program writes.
fn manual(mut run: Command) -> Result<Vec<Entry>, Failure> {
    let folder = temporary_folder()?;
    // Relative, because an emulator of Windows has different absolute paths.
    printed(run.args(["print", "man", "--output", "man"]).current_dir(folder.path()))?;
    let failed = |error: std::io::Error| format!("manual pages: {error}");
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder.path().join("man")).map_err(failed)? {
        paths.push(entry.map_err(failed)?.path());
    }
    paths.sort();
    let entry = |path: &std::path::PathBuf| {
        Ok(Entry::file(path.file_name().unwrap_or_default().to_string_lossy(), read(path)?))
    };
    paths.iter().map(entry).collect()
}

/// Returns the output of a command that must succeed.
fn printed(command: &mut Command) -> Result<Vec<u8>, Failure> {
    let output = command.output().map_err(|error| format!("{command:?} cannot be run: {error}"))?;
    match output.status.success() {
        true => Ok(output.stdout),
        false => Err(format!("{command:?} ended with {}: {}", output.status, String::from_utf8_lossy(&output.stderr))),
    }
}

/// Returns the bytes of a file.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    fs::read(path).map_err(|error| format!("`{}`: {error}", path.display()))
}
