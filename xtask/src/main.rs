//! Tasks of this workspace: `cargo xtask <task>`. Without a task it lists them.

mod ci;
mod corpus;
mod edges;
mod generate;
mod measure;
mod place;

use clap::{Args, CommandFactory, Parser, Subcommand};
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
    /// Check Lipz files and pack them into a bank (as `lipz pack`)
    Pack(Passed),
    /// Write the clips of a bank as Lipz files (as `lipz unpack`)
    Unpack(Passed),
    /// Check every byte and every reference of banks (as `lipz verify`)
    Verify(Passed),
    /// Show what is in a bank (as `lipz inspect`)
    Inspect(Passed),
    /// Check Lipz files without packing them (as `lipz check`)
    Check(Passed),
    /// Bring Lipz files into their canonical layout (as `lipz fmt`)
    Fmt(Passed),
    /// Convert Lipz files to another viseme type (as `lipz convert`)
    Convert(Passed),
    /// Run everything that a change must pass: format, lints, documentation, tests, edges
    Ci,
    /// Check which crates depend on which
    Edges,
    /// Write a folder of made-up clips of realistic size and shape
    Generate(generate::Settings),
    /// Measure packing against reading the same files (release builds only)
    Measure(measure::Settings),
    /// Check packing, reading and unpacking against a folder of files with known contents
    Corpus(corpus::Settings),
    /// One piece of work of `measure`, in a process of its own
    #[command(hide = true)]
    Measured(measure::Measured),
}

/// Arguments of a `lipz` command. They are listed here for the help only: `lipz_cli` reads them.
#[derive(Args, Debug)]
#[command(disable_help_flag = true)]
struct Passed {
    #[arg(hide = true, trailing_var_arg = true, allow_hyphen_values = true)]
    arguments: Vec<OsString>,
}

/// The tasks that are commands of `lipz`.
const PASSED: [&str; 7] = ["pack", "unpack", "verify", "inspect", "check", "fmt", "convert"];

fn main() -> ExitCode {
    let arguments: Vec<OsString> = std::env::args_os().skip(1).collect();
    // Before clap sees them: it would take `--` and `--help` for itself.
    if arguments.first().is_some_and(|task| PASSED.iter().any(|name| task == name)) {
        return lipz_cli::run(std::iter::once("lipz".into()).chain(arguments));
    }
    let Some(task) = Arguments::parse().task else {
        return match Arguments::command().print_help() {
            Ok(()) => ExitCode::SUCCESS,
            Err(_) => ExitCode::from(2),
        };
    };
    let result = match task {
        // Only if clap knows a shorter spelling of these names than the line above.
        Task::Pack(_)
        | Task::Unpack(_)
        | Task::Verify(_)
        | Task::Inspect(_)
        | Task::Check(_)
        | Task::Fmt(_)
        | Task::Convert(_) => Err("name the task in full".into()),
        Task::Ci => ci::run(),
        Task::Edges => edges::run(),
        Task::Generate(settings) => generate::run(&settings),
        Task::Measure(settings) => measure::run(&settings),
        Task::Corpus(settings) => corpus::run(&settings),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arguments_are_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn exactly_the_commands_of_lipz_are_passed_on() {
        let command = Arguments::command();
        let hidden = |name: &str| command.find_subcommand(name).map(clap::Command::is_disable_help_flag_set);
        for name in PASSED {
            assert_eq!(hidden(name), Some(true), "{name}");
        }
        assert_eq!(command.get_subcommands().filter(|task| task.is_disable_help_flag_set()).count(), PASSED.len());
    }

    #[test]
    fn every_task_is_listed_with_one_line() {
        for task in Arguments::command().get_subcommands() {
            let about = task.get_about().map(ToString::to_string).unwrap_or_default();
            assert!(!about.is_empty() && about.len() < 90 && !about.contains('\n'), "{}: {about}", task.get_name());
        }
    }
}
