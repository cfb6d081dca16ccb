//! `cargo xtask ci`: all that a change must pass besides `cargo test --workspace`.
//!
//! There are two lists of steps, each done in order, and both at the same time: what is built for other
//! machines has a folder of its own, and often keeps but one core busy. A failure ends both. `.ci/run` starts
//! the second list while the tests run, which keep but one core busy, too.

mod step;

use crate::Failure;
use clap::{Args, ValueEnum};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use step::{Program, Step};

/// Which steps.
#[derive(Args, Debug)]
pub(crate) struct Settings {
    /// The steps to run; all of them, if none is named
    #[arg(value_parser = names())]
    steps: Vec<String>,
    /// Only the steps of one list
    #[arg(long, value_enum, conflicts_with = "steps")]
    only: Option<List>,
}

/// A list of steps.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
enum List {
    /// What this machine builds and runs, in one folder
    Here,
    /// What is built in folders of its own, most of it for other machines
    Elsewhere,
}

impl Settings {
    /// The steps of a list that are to be run.
    fn chosen(&self, list: List) -> impl Iterator<Item = &'static Step> {
        let steps: &[Step] = match list {
            List::Here => &HERE,
            List::Elsewhere => &ELSEWHERE,
        };
        let is_left_out = self.only.is_some_and(|only| only != list);
        let is_chosen = |step: &&Step| self.steps.is_empty() || self.steps.iter().any(|chosen| chosen == step.name);
        steps.iter().filter(move |step| !is_left_out && is_chosen(step))
    }
}

/// What this machine builds and runs, in one folder.
static HERE: [Step; 16] = [
    Step::cargo("format", "fmt --all --check"),
    Step::cargo("lints", "clippy --workspace --all-targets --locked -- -D warnings"),
    // With the rivals, which are not built otherwise.
    Step::cargo("benches", "clippy -p lipz-benches --all-targets --features compare --locked -- -D warnings"),
    Step {
        program: Program::CargoWith("RUSTDOCFLAGS", "-D warnings"),
        ..Step::cargo("docs", "doc --workspace --no-deps --locked")
    },
    Step::task("edges"),
    Step::task("features"),
    // A workspace of its own, which no other step builds: its lock file names what this one depends on now.
    Step::cargo("fuzz-lock", "tree --locked --depth 0 --manifest-path fuzz/Cargo.toml"),
    Step::task("deny"),
    Step::task("packages"),
    // `cargo test` leaves this and the next out where their tools are missing.
    Step {
        program: Program::CargoWith("LIPZ_TOOLS", "required"),
        ..Step::cargo("translators", "test --workspace --test texts_elsewhere --locked --quiet")
    },
    Step {
        program: Program::CargoWith("LIPZ_TOOLS", "required"),
        ..Step::cargo("engines", "test --workspace --test engines --locked --quiet")
    },
    Step::task("recogniser"),
    // With the network that the step before has fetched.
    Step {
        program: Program::CargoWith("LIPZ_RECOGNISER", "required"),
        ..Step::cargo("hearing", "test --workspace --test recogniser --locked --quiet")
    },
    Step::task("editors"),
    Step::task("accessibility"),
    Step { arguments: "firefox --main", ..Step::task("firefox") },
];

/// What is built for other machines, for C, by an old compiler or for speed: each in a folder of its own.
static ELSEWHERE: [Step; 7] = [
    Step::task("size"),
    Step::task("targets"),
    Step::task("web"),
    Step::task("windows"),
    Step::task("msrv"),
    Step::task("capi"),
    Step::task("instructions"),
];

/// The names of all steps.
fn names() -> Vec<&'static str> {
    HERE.iter().chain(&ELSEWHERE).map(|step| step.name).collect()
}

/// What steps took.
type Times = Vec<(&'static str, Duration)>;

pub(crate) fn run(settings: &Settings) -> Result<(), Failure> {
    let has_failed = AtomicBool::new(false);
    let mut printed = String::new();
    let (here, elsewhere) = std::thread::scope(|scope| {
        let steps = settings.chosen(List::Elsewhere);
        let elsewhere = scope.spawn(|| in_order(steps, &has_failed, |step| step.run_into(&mut printed)));
        (in_order(settings.chosen(List::Here), &has_failed, Step::run), elsewhere.join())
    });
    print!("{printed}");
    let times = [here?, elsewhere.map_err(|_| "the steps for other machines panicked")??].concat();
    println!("\nall steps passed:");
    for (name, time) in times {
        println!("  {name:<20} {:>7.1} s", time.as_secs_f64());
    }
    Ok(())
}

/// Does the steps until one fails, here or in the other list.
fn in_order<'a>(
    steps: impl Iterator<Item = &'a Step>,
    has_failed: &AtomicBool,
    mut run: impl FnMut(&Step) -> Result<Duration, Failure>,
) -> Result<Times, Failure> {
    let mut times = Vec::new();
    for step in steps {
        if has_failed.load(Ordering::Relaxed) {
            break;
        }
        let time = run(step).inspect_err(|_| has_failed.store(true, Ordering::Relaxed))?;
        times.push((step.name, time));
    }
    Ok(times)
}
