//! `cargo xtask ci`: all checks of a change, in addition to `cargo test --workspace`.
//!
//! There are two lists of steps, which run at the same time, each in order. Builds for other machines have a separate
//! folder, and often keep only one core busy. A failure ends both lists. `.ci/run` starts the second list while the
//! tests run, which also keep only one core busy.
//!
//! Each step belongs to a tier. Everyday steps always run; slow steps run only with `--all` or by name. A step is slow
//! if it takes long and covers only code that few changes touch.

mod step;

use crate::Failure;
use clap::{Args, ValueEnum};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use step::{Program, Step, Tier};

/// The steps to run.
#[derive(Args, Debug, Default)]
pub(crate) struct Settings {
    /// Steps to run, of either tier [default: the everyday steps]
    #[arg(value_parser = names())]
    steps: Vec<String>,
    /// Add the slow steps
    #[arg(long, conflicts_with = "steps")]
    all: bool,
    /// List the steps of both tiers and the code that the slow ones cover, without running them
    #[arg(long, exclusive = true)]
    list: bool,
    /// Run only the steps of one list
    #[arg(long, value_enum, conflicts_with = "steps")]
    only: Option<List>,
}

/// A list of steps.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
enum List {
    /// Builds and runs on this machine, in one folder
    Here,
    /// Builds in separate folders, most of them for other machines
    Elsewhere,
}

impl Settings {
    /// Returns the selected steps of a list.
    fn chosen(&self, list: List) -> impl Iterator<Item = &'static Step> {
        let steps: &[Step] = match list {
            List::Here => &HERE,
            List::Elsewhere => &ELSEWHERE,
        };
        let is_left_out = self.only.is_some_and(|only| only != list);
        let is_chosen = |step: &&Step| match self.steps.is_empty() {
            true => self.all || step.tier == Tier::Everyday,
            false => self.steps.iter().any(|chosen| chosen == step.name),
        };
        steps.iter().filter(move |step| !is_left_out && is_chosen(step))
    }
}

/// The code that `recogniser` and `hearing` cover.
const RECOGNISER: &str = "the recogniser of lipz-speech, or `lipz import recogniser`";

/// The code that `accessibility` and `firefox` cover.
const PAGE: &str = "the page of `lipz preview`";

/// The packages that can be built and run on Linux.
const DIST: &str = "dist --check --target x86_64-unknown-linux-gnu --target aarch64-unknown-linux-gnu \
     --target x86_64-pc-windows-gnu";

/// Builds and runs on this machine, in one folder.
static HERE: [Step; 19] = [
    Step::cargo("format", "fmt --all --check"),
    Step::cargo("lints", "clippy --workspace --all-targets --locked -- -D warnings"),
    // Builds the rivals, including the C code of SQLite, and most crates again. `lints` covers the other benches.
    Step::cargo("benches", "clippy -p lipz-benches --all-targets --features compare --locked -- -D warnings")
        .slow("the comparison with rivals in benches, or the API of lipz-bank that it uses"),
    Step {
        program: Program::CargoWith("RUSTDOCFLAGS", "-D warnings"),
        ..Step::cargo("docs", "doc --workspace --no-deps --locked")
    },
    Step::task("edges"),
    Step::task("features"),
    // A separate workspace, which no other step builds. This checks its lock file against the current dependencies.
    Step::cargo("fuzz-lock", "tree --locked --depth 0 --manifest-path fuzz/Cargo.toml"),
    Step::task("deny"),
    Step::task("packages"),
    // Files read by other projects. `cargo test` skips this and the next step if their tools are missing.
    Step {
        program: Program::CargoWith("LIPZ_TOOLS", "required"),
        ..Step::cargo(
            "translators",
            "test --workspace --test texts_elsewhere --test year --test weights --locked --quiet",
        )
    },
    Step {
        program: Program::CargoWith("LIPZ_TOOLS", "required"),
        ..Step::cargo("engines", "test --workspace --test engines --locked --quiet")
    },
    Step::task("recogniser").slow(RECOGNISER),
    // With the network that the previous step has fetched.
    Step {
        program: Program::CargoWith("LIPZ_RECOGNISER", "required"),
        ..Step::cargo("hearing", "test --workspace --test recogniser --locked --quiet").slow(RECOGNISER)
    },
    Step::task("editors"),
    // `cargo test` already runs the page in Chromium; these two add axe and another browser.
    Step::task("accessibility").slow(PAGE),
    Step { arguments: "firefox --main", ..Step::task("firefox").slow(PAGE) },
    Step { arguments: DIST, ..Step::task("dist").slow("the packages, the profile `dist`, or a dependency") },
    // With the program that the previous step has built.
    Step { arguments: "size command", ..Step::task("size-command") }.slow("the profile `dist`, or a dependency"),
    Step::task("site").slow("the pages in docs, or their links"),
];

/// Builds for other machines, for C, with an old compiler or for speed, each in a separate folder.
static ELSEWHERE: [Step; 11] = [
    Step::task("size"),
    // These share the standard library built for `size` and `web`. All of them are 32-bit.
    Step { arguments: "targets no-std cortex-m4 cortex-m0 wasm", ..Step::task("targets") },
    // Each of these two builds the standard library and the reader's tests, and one runs them in an emulator.
    Step { arguments: "targets big-endian 32-bit", ..Step::task("suites") }
        .slow("lipz-types, lipz-layout or lipz-bank"),
    Step::task("web"),
    Step::task("ports"),
    Step::task("web-engines").slow("packages/lipz-web, or its examples for engines"),
    Step::task("windows").slow("code for Windows, or a dependency"),
    Step::task("msrv"),
    Step::task("capi"),
    Step { arguments: "ports godot blender bevy unreal renpy python", ..Step::task("engine-ports") }
        .slow("packages/bevy_lipz, lipz-blender, lipz-godot, lipz-python, lipz-renpy or lipz-unreal"),
    Step::task("instructions"),
];

/// Returns the names of all steps.
fn names() -> Vec<&'static str> {
    HERE.iter().chain(&ELSEWHERE).map(|step| step.name).collect()
}

/// Returns the steps of each tier, as printed by `--list`.
fn listing() -> String {
    let (mut everyday, mut slow) = (String::new(), String::new());
    for Step { name, tier, .. } in HERE.iter().chain(&ELSEWHERE) {
        match tier {
            Tier::Everyday => everyday.push_str(&format!("  {name}\n")),
            Tier::Slow(covers) => slow.push_str(&format!("  {name:<14}{covers}\n")),
        }
    }
    format!("everyday:\n{everyday}\nslow; run them with --all before a release, or by name after a change to:\n{slow}")
}

/// The times of steps.
type Times = Vec<(&'static str, Duration)>;

pub(crate) fn run(settings: &Settings) -> Result<(), Failure> {
    if settings.list {
        print!("{}", listing());
        return Ok(());
    }
    step::this_program()?;
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

/// Runs the steps until one fails, here or in the other list.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the names of the steps that would run, in order.
    fn chosen(settings: &Settings) -> Vec<&'static str> {
        let lists = [List::Here, List::Elsewhere];
        lists.iter().flat_map(|list| settings.chosen(*list)).map(|step| step.name).collect()
    }

    #[test]
    fn the_everyday_tier_leaves_out_exactly_the_slow_steps() {
        let (everyday, slow): (Vec<_>, Vec<_>) =
            HERE.iter().chain(&ELSEWHERE).partition(|step| step.tier == Tier::Everyday);
        assert!(!slow.is_empty());
        let everyday: Vec<_> = everyday.iter().map(|step| step.name).collect();
        assert_eq!(chosen(&Settings::default()), everyday);
        assert_eq!(chosen(&Settings { all: true, ..Settings::default() }), names());
    }

    #[test]
    fn the_two_lists_make_up_each_tier() {
        let only = |list, all| chosen(&Settings { only: Some(list), all, ..Settings::default() });
        for all in [false, true] {
            let both = [only(List::Here, all), only(List::Elsewhere, all)].concat();
            assert_eq!(both, chosen(&Settings { all, ..Settings::default() }));
        }
    }

    #[test]
    fn a_named_step_runs_in_either_tier() {
        for name in names() {
            assert_eq!(chosen(&Settings { steps: vec![name.to_owned()], ..Settings::default() }), [name]);
        }
    }
}
