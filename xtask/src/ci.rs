//! `cargo xtask ci`: everything that a change must pass, in order, until something fails.

use crate::{Failure, capi, edges, instructions, msrv, place, size, targets, web};
use std::process::Command;
use std::time::{Duration, Instant};

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

/// Workspaces of their own, which no other step builds.
const OTHER_WORKSPACES: [&str; 2] = ["benches/compare", "fuzz"];

pub(crate) fn run() -> Result<(), Failure> {
    let mut times = Vec::new();
    for step in &STEPS {
        timed(step.name, &mut times, || cargo(step.arguments, step.environment))?;
    }
    timed("edges", &mut times, edges::run)?;
    timed("lock files", &mut times, lock_files)?;
    timed("oldest compiler", &mut times, msrv::run)?;
    timed("size", &mut times, size::run)?;
    timed("targets", &mut times, targets::run_all)?;
    timed("C and C++", &mut times, capi::run)?;
    timed("web", &mut times, web::run)?;
    timed("instructions of the reader", &mut times, || instructions::run(&instructions::Settings::default()))?;
    println!("\nall steps passed:");
    for (name, time) in times {
        println!("  {name:<20} {:>7.1} s", time.as_secs_f64());
    }
    Ok(())
}

/// Lock files name what the crates of this workspace depend on now.
fn lock_files() -> Result<(), Failure> {
    for folder in OTHER_WORKSPACES {
        let manifest = place::workspace_root().join(folder).join("Cargo.toml");
        cargo(&["tree", "--locked", "--depth", "0", "--manifest-path", &manifest.to_string_lossy()], None)?;
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
