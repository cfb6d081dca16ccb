//! Links entry points with only the code that they call.

use super::elf::{Sizes, sizes};
use crate::Failure;
use crate::paths::temporary_folder;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

/// A linker for one library of entry points.
pub(super) struct Linker {
    program: PathBuf,
    library: PathBuf,
    folder: TempDir,
}

impl Linker {
    pub(super) fn new(program: &Path, library: &Path) -> Result<Linker, Failure> {
        Ok(Linker { program: program.to_owned(), library: library.to_owned(), folder: temporary_folder()? })
    }

    /// Returns the size of the entry points with all code that they call. Fails with an undefined symbol if that
    /// includes a panic or an allocation.
    pub(super) fn link(&self, entries: &[&str]) -> Result<Sizes, Failure> {
        let (output, program) = self.run(entries)?;
        if !output.status.success() {
            return Err(format!("{} do not link:\n{}", entries.join(", "), String::from_utf8_lossy(&output.stderr)));
        }
        let bytes = std::fs::read(&program).map_err(|error| error.to_string())?;
        sizes(&bytes).map_err(|error| format!("the linked program: {error}"))
    }

    /// The negative control: checks that an entry point fails to link because of `symbol`.
    pub(super) fn must_not_link(&self, entry: &str, symbol: &str) -> Result<(), Failure> {
        let (output, _) = self.run(&[entry])?;
        let errors = String::from_utf8_lossy(&output.stderr);
        if output.status.success() || !errors.contains(&format!("undefined symbol: {symbol}")) {
            return Err(format!("`{entry}` does not fail with an undefined `{symbol}`, so the proof is invalid"));
        }
        Ok(())
    }

    fn run(&self, entries: &[&str]) -> Result<(Output, PathBuf), Failure> {
        let program = self.folder.path().join("linked");
        let mut command = Command::new(&self.program);
        command.args(["-flavor", "gnu", "--gc-sections"]);
        for entry in entries {
            command.args(["-e", entry, "-u", entry]);
        }
        let output = command.arg("-o").arg(&program).arg(&self.library).output();
        Ok((output.map_err(|error| format!("`{}`: {error}", self.program.display()))?, program))
    }
}
