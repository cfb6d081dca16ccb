//! Tasks of this workspace: `cargo xtask <task>`. Without a task it lists them.

mod capi;
mod ci;
mod compare;
mod corpus;
mod docs;
mod edges;
mod fuzz;
mod generate;
mod instructions;
mod measure;
mod msrv;
mod needs;
mod place;
mod size;
mod targets;
mod toolchain;
mod web;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use std::ffi::OsString;
use std::process::ExitCode;

/// Why a task failed, as its last line.
type Failure = String;

/// Tasks of the lipz workspace.
#[derive(Parser, Debug)]
#[command(name = "xtask", bin_name = "cargo xtask", max_term_width = 100, disable_help_subcommand = true)]
struct Arguments {
    #[command(subcommand)]
    task: Option<Task>,
}

#[derive(Subcommand, Debug)]
enum Task {
    /// Run everything that a change must pass: format, lints, documentation, tests, edges
    Ci,
    /// Build the libraries for C in target/capi, and run programs in C and C++ with them
    Capi,
    /// Build the npm package for browsers and node in target/web, and test it in both
    Web,
    /// Check which crates depend on which
    Edges,
    /// Run the reader on other machines: bare metal, big-endian, 32-bit, wasm
    Targets(targets::Settings),
    /// Count the reader's code on a Cortex-M, and prove that it cannot panic or allocate
    Size,
    /// Build the reader with the oldest compiler that it promises
    Msrv,
    /// Write docs/DIAGNOSTICS.md, whose contents are in the code
    Docs,
    /// Write a folder of made-up clips of realistic size and shape
    Generate(generate::Settings),
    /// Measure packing against reading the same files (release builds only)
    Measure(measure::Settings),
    /// Compare the reader with other ways to keep clips in a file, as a Markdown table
    Compare(compare::Settings),
    /// Count the instructions of the reader's queries and hold them to their limits
    Instructions(instructions::Settings),
    /// Check packing, reading and unpacking against a folder of files with known contents
    Corpus(corpus::Settings),
    /// Look for inputs on which something does not hold that must hold for any bytes
    Fuzz(fuzz::Settings),
    /// One piece of work of `measure`, in a process of its own
    #[command(hide = true)]
    Measured(measure::Measured),
}

fn main() -> ExitCode {
    let arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    // Before clap sees them: it would take `--` and `--help` for itself.
    if arguments.first().is_some_and(|task| lipz_cli::commands().any(|name| *task == *name)) {
        return lipz_cli::run(std::iter::once("lipz".into()).chain(arguments));
    }
    let matches = command().get_matches();
    let Some(task) = Arguments::from_arg_matches(&matches).unwrap_or_else(|error| error.exit()).task else {
        return match command().print_help() {
            Ok(()) => ExitCode::SUCCESS,
            Err(_) => ExitCode::from(2),
        };
    };
    let result = match task {
        Task::Ci => ci::run(),
        Task::Capi => capi::run(),
        Task::Web => web::run(),
        Task::Edges => edges::run(),
        Task::Targets(settings) => targets::run(&settings),
        Task::Size => size::run(),
        Task::Msrv => msrv::run(),
        Task::Docs => docs::run(),
        Task::Generate(settings) => generate::run(&settings),
        Task::Measure(settings) => measure::run(&settings),
        Task::Compare(settings) => compare::run(&settings),
        Task::Instructions(settings) => instructions::run(&settings),
        Task::Corpus(settings) => corpus::run(&settings),
        Task::Fuzz(settings) => fuzz::run(&settings),
        Task::Measured(measured) => measure::run_one(&measured),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("xtask: {failure}");
            ExitCode::FAILURE
        }
    }
}

/// The command line of this program; its help tells that the commands of `lipz` are tasks, too.
fn command() -> clap::Command {
    let names: Vec<String> = lipz_cli::commands().collect();
    Arguments::command().after_help(format!("The commands of lipz are tasks, too: {}", names.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_are_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn no_task_hides_a_command_of_lipz() {
        assert!(lipz_cli::commands().all(|name| Arguments::command().find_subcommand(name).is_none()));
        let help = command().render_help().to_string();
        assert!(lipz_cli::commands().all(|name| help.contains(&name)), "{help}");
    }

    #[test]
    fn every_task_is_listed_with_one_line() {
        for task in Arguments::command().get_subcommands() {
            let about = task.get_about().map(ToString::to_string).unwrap_or_default();
            assert!(!about.is_empty() && about.len() < 90 && !about.contains('\n'), "{}: {about}", task.get_name());
        }
    }
}
