//! `lipz watch`: packs, and packs again after each change.

mod alarm;
mod scope;
mod state;

use super::pack::{PackArguments, PackMemory, Plan};
use crate::Abort;
use crate::CommandResult;
use crate::Outcome;
use crate::commands::Run;
use crate::reporter::Reporter;
pub(crate) use alarm::Alarm;
use clap::{Arg, Args};
use jiff::Zoned;
use lipz_diagnostics::Report;
pub(crate) use scope::Scope;
use state::{Scent, State};
use std::collections::BTreeSet;
use std::convert::Infallible;
use std::time::{Duration, Instant};

/// Pack, and pack again whenever a Lipz file or lipz.toml changes.
///
/// The old bank is left untouched while there are errors, or if the new bank would be identical to it. Later runs read
/// only changed files; with a cache, so does the first run. Press Ctrl-C to stop. Each run prints its own document, if
/// --output-format is a format for programs.
#[derive(Args, Debug)]
#[command(mut_args(with_files_only))]
#[command(after_help = "Examples:
  lipz watch
  lipz watch voices -o dialogue.lipzbank
  lipz watch --poll=5 //server/voices -o dialogue.lipzbank")]
pub(crate) struct Watch {
    #[command(flatten)]
    pack: PackArguments,

    /// Seconds between checks of the files, for network folders; 2 without a number
    #[arg(long, value_name = "SECONDS", num_args = 0..=1, require_equals = true, default_missing_value = "2")]
    #[arg(value_parser = parse_seconds)]
    poll: Option<Duration>,
}

/// Describes the sources and the output, which cannot be standard input and output.
fn with_files_only(argument: Arg) -> Arg {
    match argument.get_id().as_str() {
        "sources" => argument.help("Folders, files or patterns [default: those of lipz.toml]"),
        "output" => argument.help("Bank to write [default: `output` of lipz.toml]"),
        _ => argument,
    }
}

impl Run for Watch {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let Err(abort) = watch(self, reporter);
        Err(abort)
    }
}

/// Packs and waits in turns until the process is interrupted. Returns only if it cannot start watching or cannot
/// continue.
fn watch(arguments: &Watch, reporter: &mut Reporter) -> Result<Infallible, Abort> {
    let sources = &arguments.pack.sources;
    let mut scope = Scope::before_settings(sources);
    let mut alarm = Alarm::new(arguments.poll);
    // Start before reading anything, so that no change is missed.
    alarm.set(&scope).map_err(|report| reporter.fail(report))?;
    let mut told = String::new();
    let mut memory = PackMemory::default();
    // The state of the files in the last run.
    let mut state: Option<State> = None;
    // Numbers of the inputs that may have changed since the remembered run; `None` if any input may have, or if there
    // are different inputs.
    let mut changed: Option<BTreeSet<usize>> = None;
    loop {
        let start = Instant::now();
        let plan = arguments.plan(reporter);
        match &plan {
            Ok(plan) => scope = Scope::new(&plan.project, sources),
            Err(abort) if told.is_empty() && abort.outcome() == Outcome::Failed => return Err(*abort),
            // The settings have errors. Those of the last run determine the watched folders.
            Err(_) => changed = None,
        }
        let now = match (state.take(), &changed) {
            (Some(mut state), Some(changed)) => {
                state.look_again(changed);
                state
            }
            _ => {
                alarm.set(&scope).map_err(|report| reporter.fail(report))?;
                scope.state()
            }
        };
        let numbers: Option<Vec<usize>> = changed.as_ref().map(|changed| changed.iter().copied().collect());
        let packed = arguments.pack_once(plan, &mut memory, (&now, numbers.as_deref()), start, reporter);
        // After a failed run, the changes are still to be packed.
        if packed.is_ok() {
            changed = Some(BTreeSet::new());
        }
        let mut outcome = packed.unwrap_or_else(|outcome| outcome);
        let place = alarm.describe(&scope);
        if place != told {
            outcome = outcome.max(arguments.say(&place, reporter));
            told = place;
        }
        reporter.finish_run(Ok(outcome));
        wait(&mut alarm, &scope, &now, &mut changed).map_err(|report| reporter.fail(report))?;
        state = Some(now);
    }
}

/// Waits until something differs from this state, and adds it to `changed`.
fn wait(alarm: &mut Alarm, scope: &Scope, state: &State, changed: &mut Option<BTreeSet<usize>>) -> Result<(), Report> {
    loop {
        let change = alarm.wait();
        match change.paths.map_or(Scent::Unknown, |paths| state.judge(&paths, scope.settings_name())) {
            Scent::Nothing => {}
            Scent::Inputs(numbers) => {
                changed.iter_mut().for_each(|changed| changed.extend(&numbers));
                return Ok(());
            }
            Scent::Unknown => {
                alarm.set(scope)?;
                if change.is_certain || scope.state() != *state {
                    *changed = None;
                    return Ok(());
                }
            }
        }
    }
}

impl Watch {
    /// Returns the plan of the next run.
    fn plan(&self, reporter: &mut Reporter) -> Result<Plan, Abort> {
        let plan = self.pack.plan(reporter)?;
        if plan.works_once() {
            let tip = "name a folder and a file, or pack once: lipz pack";
            let message = "standard input and output cannot be watched";
            return Err(reporter.usage(message, tip));
        }
        Ok(plan)
    }

    /// Packs the files in this state, if there is a plan, and reports the result. Only the files with the numbers in
    /// `changed` are read.
    ///
    /// # Errors
    /// If there is no new bank.
    fn pack_once(
        &self,
        plan: Result<Plan, Abort>,
        memory: &mut PackMemory,
        (state, changed): (&State, Option<&[usize]>),
        start: Instant,
        reporter: &mut Reporter,
    ) -> Result<Outcome, Outcome> {
        let mut old_bank = "the old bank is kept";
        let packed = plan.and_then(|plan| {
            if !plan.output.exists() {
                old_bank = "the bank does not exist yet";
            }
            plan.run_again(memory, state.found(), changed, self.pack.sources.is_quiet(), reporter)
        });
        let (outcome, message, timings) = match packed {
            Ok(packed) => {
                let took_ms = start.elapsed().as_millis();
                let timings = self.pack.timings(&packed);
                (Ok(packed.outcome), format!("{}, {took_ms} ms", packed.message()), timings)
            }
            Err(abort) => (Err(abort.outcome()), format!("not packed: {old_bank}"), String::new()),
        };
        let time = Zoned::now().strftime("%H:%M:%S");
        let said = self.say(&format!("{time}  {message}\n{timings}"), reporter);
        outcome.map(|outcome| outcome.max(said)).map_err(|outcome| outcome.max(said))
    }

    /// Prints a summary, unless only diagnostics are requested. A full disk does not end the watch.
    fn say(&self, text: &str, reporter: &mut Reporter) -> Outcome {
        if self.pack.sources.is_quiet() {
            return Outcome::Clean;
        }
        reporter.summary(text).map_or_else(Abort::outcome, |()| Outcome::Clean)
    }
}

fn parse_seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    seconds.filter(|period| !period.is_zero()).ok_or_else(|| "expected a number of seconds above 0".into())
}
