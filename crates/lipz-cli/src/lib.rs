//! The command `lipz` as a library, so that other drivers (`cargo xtask`) run the same commands.
//!
//! This is the only crate that prints, looks at the terminal and chooses exit codes.

mod args;
mod bank_file;
mod commands;
mod console;
mod render;
mod rewriting;
mod sources;
mod timeline;

use args::{Arguments, Command};
use std::ffi::OsString;
use std::process::ExitCode;

/// How a command ended, as its exit code.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Outcome {
    /// 0: nothing at error level.
    Clean,
    /// 1: findings at error level.
    Findings,
    /// 2: the tool could not run.
    Failed,
}

impl From<Outcome> for ExitCode {
    fn from(outcome: Outcome) -> ExitCode {
        ExitCode::from(match outcome {
            Outcome::Clean => 0,
            Outcome::Findings => 1,
            Outcome::Failed => 2,
        })
    }
}

/// Runs the command line `arguments`, the first of which is the program's name.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let arguments = match Arguments::read(arguments) {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help goes to standard output with code 0, usage errors to standard error with 2.
            let _ = error.print();
            return if error.use_stderr() { Outcome::Failed.into() } else { Outcome::Clean.into() };
        }
    };
    let outcome = match arguments.command {
        Command::Pack(pack) => commands::pack::run(&pack),
        Command::Check(check) => commands::check::run(&check),
        Command::Fmt(fmt) => commands::fmt::run(&fmt),
        Command::Convert(convert) => commands::convert::run(&convert),
        Command::Unpack(unpack) => commands::unpack::run(&unpack),
        Command::Verify(verify) => commands::verify::run(&verify),
        Command::Inspect(inspect) => commands::inspect::run(&inspect),
    };
    outcome.into()
}
