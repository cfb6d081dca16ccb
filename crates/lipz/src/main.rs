//! The command `lipz`: reads the command line, runs a command, and ends with its exit code.
//!
//! This is the only crate that prints, looks at the terminal and chooses exit codes.

mod args;
mod commands;
mod console;
mod help;
mod interrupt;
mod memory;
mod outcome;
mod reporter;
mod shared;
mod usage;

use outcome::Outcome;
use reporter::{Abort, Ended, Reporter};
use std::process::ExitCode;

fn main() -> ExitCode {
    memory::give_back();
    let arguments = match help::parse() {
        Ok(arguments) => arguments,
        Err(error) => return usage::end(&error, std::env::args_os()).into(),
    };
    arguments.color.write_global();
    interrupt::listen();
    let command = arguments.command.task();
    let mut reporter = Reporter::new(arguments.format, command.prints_result());
    let ended = command.run(&mut reporter);
    reporter.finish(ended).into()
}
