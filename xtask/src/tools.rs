//! Steps whose tools may be missing.

use crate::Failure;
use std::process::{Command, Stdio};

/// Skips a step because something that it needs is missing. Fails in continuous integration, where everything is
/// installed and no step may be skipped unnoticed.
pub(crate) fn skip(needs: &str) -> Result<(), Failure> {
    if std::env::var_os("CI").is_some() {
        return Err(format!("needs {needs}"));
    }
    println!("skipped: needs {needs}");
    Ok(())
}

/// Whether a program is installed, so that it prints its version.
pub(crate) fn has_program(name: &str) -> bool {
    let status = Command::new(name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    status.is_ok_and(|status| status.success())
}

/// Runs a command that must succeed.
pub(crate) fn succeed(command: &mut Command, what: &str) -> Result<(), Failure> {
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{what} ended with {status}")),
        Err(error) => Err(format!("{what} cannot be run: {error}")),
    }
}
