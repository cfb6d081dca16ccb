//! `cargo xtask ci`: everything that a change must pass, in order, until something fails.

use crate::{Failure, edges, instructions};
use std::process::Command;
use std::time::{Duration, Instant};

/// Targets without std that the reader is built for, the first that is installed.
const BARE_METAL: [&str; 3] = ["thumbv7em-none-eabi", "thumbv6m-none-eabi", "riscv32imc-unknown-none-elf"];

/// One step: a cargo command.
struct Step {
    name: &'static str,
    arguments: &'static [&'static str],
    environment: Option<(&'static str, &'static str)>,
}

const STEPS: [Step; 4] = [
    Step { name: "format", arguments: &["fmt", "--all", "--check"], environment: None },
    Step {
        name: "lints",
        arguments: &["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"],
        environment: None,
    },
    Step {
        name: "documentation",
        arguments: &["doc", "--workspace", "--no-deps", "--locked"],
        environment: Some(("RUSTDOCFLAGS", "-D warnings")),
    },
    Step { name: "tests", arguments: &["test", "--workspace", "--locked"], environment: None },
];

pub(crate) fn run() -> Result<(), Failure> {
    let mut times = Vec::new();
    for step in &STEPS {
        timed(step.name, &mut times, || cargo(step.arguments, step.environment))?;
    }
    timed("edges", &mut times, edges::run)?;
    timed("reader without std", &mut times, bare_metal)?;
    timed("instructions of the reader", &mut times, || instructions::run(&instructions::Settings::default()))?;
    println!("\nall steps passed:");
    for (name, time) in times {
        println!("  {name:<20} {:>7.1} s", time.as_secs_f64());
    }
    Ok(())
}

fn timed(
    name: &'static str,
    times: &mut Vec<(&'static str, Duration)>,
    step: impl FnOnce() -> Result<(), Failure>,
) -> Result<(), Failure> {
    println!("\n── {name}");
    let start = Instant::now();
    step()
        .map_err(|failure| format!("step `{name}` failed after {:.1} s: {failure}", start.elapsed().as_secs_f64()))?;
    println!("{name}: {:.1} s", start.elapsed().as_secs_f64());
    times.push((name, start.elapsed()));
    Ok(())
}

/// The cargo that runs this task, or else the one on the path.
pub(crate) fn cargo_command() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

fn cargo(arguments: &[&str], environment: Option<(&str, &str)>) -> Result<(), Failure> {
    let shown = format!("cargo {}", arguments.join(" "));
    println!("{}{shown}", environment.map_or(String::new(), |(name, value)| format!("{name}=\"{value}\" ")));
    let status = cargo_command().args(arguments).envs(environment).status();
    match status {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("`{shown}` ended with {status}")),
        Err(error) => Err(format!("`{shown}` cannot be run: {error}")),
    }
}

/// Builds the reader for a target without std, if there is one: `no_std` on a target with std does
/// not show that a dependency needs it.
fn bare_metal() -> Result<(), Failure> {
    match BARE_METAL.into_iter().find(|target| is_installed(target)) {
        Some(target) => {
            cargo(&["build", "--package", "lipz-bank", "--no-default-features", "--locked", "--target", target], None)
        }
        None => {
            println!("skipped: no target without std is installed (rustup target add {})", BARE_METAL[0]);
            Ok(())
        }
    }
}

fn is_installed(target: &str) -> bool {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let output = Command::new(rustc).args(["--print", "target-libdir", "--target", target]).output();
    output.is_ok_and(|output| {
        let folder = String::from_utf8_lossy(&output.stdout).trim().to_owned();
        output.status.success() && std::fs::read_dir(folder).is_ok_and(|mut files| files.next().is_some())
    })
}
