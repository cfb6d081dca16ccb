//! The command `lipz` as a library, so that other drivers (`cargo xtask`) run the same commands.
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
mod render;
mod rewriting;
mod settings_file;
mod sources;
mod standard;
mod text_banks;
mod timeline;

use args::{Arguments, Command};
use clap::{CommandFactory, Parser};
use outcome::{Ended, Outcome};
use render::Findings;
use std::ffi::OsString;
use std::process::ExitCode;

/// Runs the command line `arguments`, the first of which is the program's name.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help goes to standard output with code 0, usage errors to standard error with 2.
            let _ = error.print();
            return if error.use_stderr() { Outcome::Failed.into() } else { Outcome::Clean.into() };
        }
    };
    arguments.color.write_global();
    interrupt::listen();
    let mut findings = Findings::new(arguments.format, arguments.command.prints_result());
    let ended = match arguments.command {
        Command::Pack(pack) => commands::pack::run(&pack, &mut findings),
        // Each of its runs shows what it found.
        Command::Watch(watch) => return commands::watch::run(&watch, &findings).into(),
        Command::Check(check) => commands::check::run(&check, &mut findings),
        Command::Fmt(fmt) => commands::fmt::run(&fmt, &mut findings),
        Command::Convert(convert) => commands::convert::run(&convert, &mut findings),
        Command::Import(import) => commands::import::run(&import, &mut findings),
        Command::Export(export) => commands::export::run(&export, &mut findings),
        Command::Subtitles(subtitles) => commands::subtitles::run(&subtitles, &mut findings),
        Command::Init(init) => commands::init::run(&init, &mut findings),
        Command::Unpack(unpack) => commands::unpack::run(&unpack, &mut findings),
        Command::Verify(verify) => commands::verify::run(&verify, &mut findings),
        Command::Inspect(inspect) => commands::inspect::run(&inspect, &mut findings),
        Command::Coverage(coverage) => commands::coverage::run(&coverage, &mut findings),
        Command::Diff(diff) => commands::diff::run(&diff, &mut findings),
        Command::Stats(stats) => commands::stats::run(&stats, &mut findings),
        Command::Man(man) => commands::man::run(&man, &mut findings),
        Command::Ids(ids) => commands::ids::run(&ids, &mut findings),
        Command::Babble(babble) => commands::babble::run(&babble, &mut findings),
        Command::Fallout(fallout) => commands::fallout::run(&fallout, &mut findings),
        // These have no findings, and so no document about them.
        Command::Schema(schema) => return commands::schema::run(&schema).into(),
        Command::Completions(completions) => return commands::completions::run(&completions).into(),
        Command::Maps(maps) => return commands::maps::run(&maps).into(),
        Command::Explain(explain) => return commands::explain::run(&explain).into(),
    };
    findings.finish(ended.unwrap_or_else(|outcome| outcome)).into()
}

/// The names of the commands.
pub fn commands() -> impl Iterator<Item = String> {
    let names: Vec<_> = Arguments::command().get_subcommands().map(|command| command.get_name().to_owned()).collect();
    names.into_iter()
}
