//! `cargo xtask ci`: everything that a change must pass.
//!
//! There are two lists of steps, each done in order, and both at the same time: what is built for other
//! machines has a folder of its own, and often keeps but one core busy. A failure ends both.

mod step;

use crate::Failure;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use step::{Program, Step};

/// What this machine builds and runs.
const HERE: [Step; 11] = [
    Step { name: "format", program: Program::Cargo, arguments: &["fmt", "--all", "--check"] },
    Step {
        name: "lints",
        program: Program::Cargo,
        arguments: &["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"],
    },
    Step {
        name: "documentation",
        program: Program::CargoWith("RUSTDOCFLAGS", "-D warnings"),
        arguments: &["doc", "--workspace", "--no-deps", "--locked"],
    },
    Step { name: "tests", program: Program::Cargo, arguments: &["test", "--workspace", "--locked"] },
    Step { name: "edges", program: Program::Task, arguments: &["edges"] },
    Step { name: "features", program: Program::Task, arguments: &["features"] },
    // A workspace of its own, which no other step builds: its lock file names what this one depends on now.
    Step { name: "lock file of fuzz", program: Program::Cargo, arguments: &lock_file("fuzz/Cargo.toml") },
    Step { name: "oldest compiler", program: Program::Task, arguments: &["msrv"] },
    Step { name: "packages", program: Program::Task, arguments: &["packages"] },
    Step { name: "C and C++", program: Program::Task, arguments: &["capi"] },
    Step { name: "instructions", program: Program::Task, arguments: &["instructions"] },
];

/// What is built for other machines, in `target/machines`.
const ELSEWHERE: [Step; 3] = [
    Step { name: "size", program: Program::Task, arguments: &["size"] },
    Step { name: "targets", program: Program::Task, arguments: &["targets"] },
    Step { name: "web", program: Program::Task, arguments: &["web"] },
];

const fn lock_file(manifest: &str) -> [&str; 6] {
    ["tree", "--locked", "--depth", "0", "--manifest-path", manifest]
}

/// What steps took.
type Times = Vec<(&'static str, Duration)>;

pub(crate) fn run() -> Result<(), Failure> {
    let has_failed = AtomicBool::new(false);
    let mut printed = String::new();
    let (here, elsewhere) = std::thread::scope(|scope| {
        let elsewhere = scope.spawn(|| in_order(&ELSEWHERE, &has_failed, |step| step.run_into(&mut printed)));
        (in_order(&HERE, &has_failed, Step::run), elsewhere.join())
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
fn in_order(
    steps: &[Step],
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
