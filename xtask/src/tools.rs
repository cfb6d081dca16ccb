//! Steps whose tools may be missing.

use crate::Failure;
use std::process::{Command, Stdio};

/// The environment variable with which `cargo xtask ci` starts its steps.
pub(crate) const IS_STEP: &str = "LIPZ_XTASK_STEP";

/// Skips a task because something that it needs is missing. Only `cargo xtask ci` may skip: whoever names a task wants
/// it to be done. Fails in continuous integration, where everything is installed and no step may be skipped unnoticed.
pub(crate) fn skip(needs: &str) -> Result<(), Failure> {
    if std::env::var_os(IS_STEP).is_none() {
        return Err(format!("nothing is done, because this needs {needs}"));
    }
    skip_rest(needs)
}

/// Skips the rest of a task, whose first part is done.
pub(crate) fn skip_rest(needs: &str) -> Result<(), Failure> {
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
