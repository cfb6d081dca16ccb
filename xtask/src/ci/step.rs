//! A step of `cargo xtask ci`: a command that must succeed.

use crate::Failure;
use crate::cargo;
use crate::paths::workspace_root;
use crate::tools::{IS_STEP, succeed};
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// The path of this program.
static PROGRAM: LazyLock<io::Result<PathBuf>> = LazyLock::new(std::env::current_exe);

/// Returns the path of this program. Must be called before the first step, because the system forgets the path if Cargo
/// replaces the file, as tests beside the steps do.
///
/// # Errors
/// If the system does not know it.
pub(super) fn this_program() -> Result<&'static Path, Failure> {
    PROGRAM.as_deref().map_err(|error| format!("where is this program? {error}"))
}

/// The program of a step.
pub(super) enum Program {
    Cargo,
    /// Cargo with an environment variable and its value.
    CargoWith(&'static str, &'static str),
    /// Another task of this program.
    Task,
}

/// The tier of a step.
#[derive(PartialEq, Eq)]
pub(super) enum Tier {
    /// Runs every time, including in `.ci/run`.
    Everyday,
    /// Only with `--all`. The text names what the step covers; it completes "run this after a change to".
    Slow(&'static str),
}

/// One step.
pub(super) struct Step {
    pub(super) name: &'static str,
    pub(super) tier: Tier,
    pub(super) program: Program,
    /// As typed on a command line. No argument contains a space.
    pub(super) arguments: &'static str,
}

impl Step {
    pub(super) const fn cargo(name: &'static str, arguments: &'static str) -> Step {
        Step { name, tier: Tier::Everyday, program: Program::Cargo, arguments }
    }

    /// Returns a step for another task, which gives the step its name.
    pub(super) const fn task(name: &'static str) -> Step {
        Step { name, tier: Tier::Everyday, program: Program::Task, arguments: name }
    }

    /// Moves the step to the slow tier.
    pub(super) const fn slow(self, covers: &'static str) -> Step {
        Step { tier: Tier::Slow(covers), ..self }
    }

    /// Runs the step and returns its time. Its output is printed immediately.
    pub(super) fn run(&self) -> Result<Duration, Failure> {
        let start = Instant::now();
        print!("{}", self.heading());
        succeed(&mut self.command()?, self.name)?;
        print!("{}", self.took(start));
        Ok(start.elapsed())
    }

    /// The same, with its output added to `printed`.
    pub(super) fn run_into(&self, printed: &mut String) -> Result<Duration, Failure> {
        let start = Instant::now();
        printed.push_str(&self.heading());
        let output = self.command()?.output().map_err(|error| format!("{} cannot be run: {error}", self.name))?;
        for stream in [output.stdout, output.stderr] {
            printed.push_str(&String::from_utf8_lossy(&stream));
        }
        if !output.status.success() {
            return Err(format!("{} ended with {}", self.name, output.status));
        }
        printed.push_str(&self.took(start));
        Ok(start.elapsed())
    }

    fn command(&self) -> Result<Command, Failure> {
        let mut command = match self.program {
            Program::Cargo | Program::CargoWith(..) => cargo::command(),
            Program::Task => Command::new(this_program()?),
        };
        if let Program::CargoWith(variable, value) = self.program {
            command.env(variable, value);
        }
        command.args(self.arguments.split_whitespace()).current_dir(workspace_root()).env(IS_STEP, "1");
        Ok(command)
    }

    /// Returns the name, and the command as typed on a command line.
    fn heading(&self) -> String {
        let arguments = self.arguments;
        let shown = match self.program {
            Program::Cargo => format!("cargo {arguments}"),
            Program::CargoWith(variable, value) => format!("{variable}=\"{value}\" cargo {arguments}"),
            Program::Task => format!("cargo xtask {arguments}"),
        };
        format!("\n── {}\n{shown}\n", self.name)
    }

    fn took(&self, start: Instant) -> String {
        format!("{}: {:.1} s\n", self.name, start.elapsed().as_secs_f64())
    }
}
