//! The command `lipz`: parses the command line, runs a command, and ends with its exit code.
//!
//! This is the only crate that prints, queries the terminal and chooses exit codes. It is a library only so that the
//! published program can be optimised in two ways: this code for size, and the last pass over all crates, which has the
//! level of `main.rs`, for speed. Programs use `lipz-compiler` and the crates below it instead.

// Help comes from doc comments, in which [sync] is a table of lipz.toml.
#![allow(rustdoc::broken_intra_doc_links)]

mod args;
mod commands;
mod console;
mod help;
mod interrupt;
mod memory;
mod outcome;
mod renamed;
mod reporter;
mod shared;
mod usage;

use outcome::Outcome;
use reporter::{Abort, CommandResult, Reporter};
use std::process::ExitCode;

/// Runs the command line of this process, and returns its exit code.
#[must_use]
pub fn main() -> ExitCode {
    memory::give_back();
    let arguments = match help::parse() {
        Ok(arguments) => arguments,
        Err(error) => return usage::end(&error, std::env::args_os()).into(),
    };
    arguments.color.write_global();
    interrupt::listen();
    let command = arguments.command.task();
    let mut reporter = Reporter::new(arguments.output_format, command.prints_result());
    let ended = command.run(&mut reporter);
    reporter.finish(ended).into()
}
