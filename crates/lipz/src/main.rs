//! The command `lipz`: reads the command line, runs a command, and ends with its exit code.
//!
//! This is the only crate that prints, looks at the terminal and chooses exit codes.

mod args;
mod bank_file;
mod commands;
mod console;
mod interrupt;
mod lint_flags;
mod outcome;
mod output_file;
mod page;
mod patterns;
mod project;
mod reporter;
mod rewriting;
mod settings_file;
mod sources;
mod standard;
mod text_banks;
mod timeline;

use args::{Arguments, Command};
use clap::Parser;
use outcome::{Ended, Outcome};
use reporter::Reporter;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help goes to standard output with code 0, usage errors to standard error with 2.
            let _ = error.print();
            return if error.use_stderr() { Outcome::Failed.into() } else { Outcome::Clean.into() };
        }
    };
    arguments.color.write_global();
    interrupt::listen();
    let mut reporter = Reporter::new(arguments.format, arguments.command.prints_result());
    let ended = match arguments.command {
        Command::Pack(pack) => commands::pack::run(&pack, &mut reporter),
        // Each of its runs shows what it found.
        Command::Watch(watch) => return commands::watch::run(&watch, &reporter).into(),
        Command::Check(check) => commands::check::run(&check, &mut reporter),
        Command::Fmt(fmt) => commands::fmt::run(&fmt, &mut reporter),
        Command::Convert(convert) => commands::convert::run(&convert, &mut reporter),
        Command::Import(import) => commands::import::run(&import, &mut reporter),
        Command::Export(export) => commands::export::run(&export, &mut reporter),
        Command::Subtitles(subtitles) => commands::subtitles::run(&subtitles, &mut reporter),
        Command::Init(init) => commands::init::run(&init, &mut reporter),
        Command::Unpack(unpack) => commands::unpack::run(&unpack, &mut reporter),
        Command::Verify(verify) => commands::verify::run(&verify, &mut reporter),
        Command::Inspect(inspect) => commands::inspect::run(&inspect, &mut reporter),
        Command::Coverage(coverage) => commands::coverage::run(&coverage, &mut reporter),
        Command::Diff(diff) => commands::diff::run(&diff, &mut reporter),
        Command::Stats(stats) => commands::stats::run(&stats, &mut reporter),
        Command::Man(man) => commands::man::run(&man, &mut reporter),
        Command::Ids(ids) => commands::ids::run(&ids, &mut reporter),
        Command::Babble(babble) => commands::babble::run(&babble, &mut reporter),
        Command::Fallout(fallout) => commands::fallout::run(&fallout, &mut reporter),
        // These have no findings, and so no document about them.
        Command::Schema(schema) => return commands::schema::run(&schema).into(),
        Command::Completions(completions) => return commands::completions::run(&completions).into(),
        Command::Maps(maps) => return commands::maps::run(&maps).into(),
        Command::Explain(explain) => return commands::explain::run(&explain).into(),
    };
    reporter.finish(ended.unwrap_or_else(|outcome| outcome)).into()
}
