//! `lipz watch`: packs, and packs again when something changes.

mod alarm;
mod scope;
mod state;

use super::pack::{Pack, Plan, Remembered};
use crate::Abort;
use crate::Ended;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::{Outcome, console};
pub(crate) use alarm::Alarm;
use clap::Args;
use jiff::Zoned;
use lipz_diagnostics::Report;
pub(crate) use scope::Scope;
use state::{Scent, State};
use std::collections::BTreeSet;
use std::convert::Infallible;
use std::time::{Duration, Instant};

/// Pack, and pack again whenever a Lipz file or lipz.toml changes.
///
/// The old bank stays as it is while there are errors, and also when a change leaves its bytes the
/// same. Only files that changed are read again; with a cache, this applies to the first run, too. Ctrl-C ends
/// it. With a --format for programs, each run prints its own document.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz watch
  lipz watch voices -o dialogue.lipzbank
  lipz watch voices -o dialogue.lipzbank --clear
  lipz watch --poll=5 //server/voices -o dialogue.lipzbank")]
pub(crate) struct Watch {
    #[command(flatten)]
    pack: Pack,

    /// Look at the files every so many seconds (2 if not given), for network folders, which do
    /// not report changes made elsewhere
    #[arg(long, value_name = "SECONDS", num_args = 0..=1, require_equals = true, default_missing_value = "2")]
    #[arg(value_parser = parse_seconds)]
    poll: Option<Duration>,

    /// Clear the terminal before each run
    #[arg(long)]
    clear: bool,
}

impl Run for Watch {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let Err(abort) = watch(self, reporter);
        Err(abort)
    }
}

/// Packs and waits, in turns, until the process is interrupted; returns only if it cannot start to watch,
/// or cannot go on.
fn watch(arguments: &Watch, reporter: &mut Reporter) -> Result<Infallible, Abort> {
    let sources = &arguments.pack.sources;
    let mut scope = Scope::before_settings(sources);
    let mut alarm = Alarm::new(arguments.poll);
    // Before anything is read, so that no change is missed.
    alarm.set(&scope).map_err(|report| reporter.fail(report))?;
    let mut told = String::new();
    let mut memory = Remembered::default();
    // The state in which the last run found the files.
    let mut state: Option<State> = None;
    // Numbers of the inputs that can have changed since the run that is remembered; `None` if they can be any, or others.
    let mut changed: Option<BTreeSet<usize>> = None;
    loop {
        if !arguments.pack.may_remember() {
            memory = Remembered::default();
            changed = None;
        }
        if arguments.clear {
            console::clear();
        }
        let start = Instant::now();
        let plan = arguments.plan(reporter);
        match &plan {
            Ok(plan) => scope = Scope::new(&plan.project, sources),
            Err(abort) if told.is_empty() && abort.outcome() == Outcome::Failed => return Err(*abort),
            // Settings with errors: those of the last run say where to look.
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
        // What could not be packed has changed still.
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

/// Waits until something is another than in this state, and adds what it is to what has `changed`.
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
    /// What the next run works with.
    fn plan(&self, reporter: &mut Reporter) -> Result<Plan, Abort> {
        let plan = self.pack.plan(reporter)?;
        if plan.works_once() {
            let tip = "name a folder and a file, or pack once: lipz pack";
            let message = "standard input and output cannot be watched";
            return Err(reporter.usage(message, tip));
        }
        Ok(plan)
    }

    /// Packs if there is a plan, the files in this state, of which only those with these numbers can have changed; and says how
    /// it went. An error if there is no new bank.
    fn pack_once(
        &self,
        plan: Result<Plan, Abort>,
        memory: &mut Remembered,
        (state, changed): (&State, Option<&[usize]>),
        start: Instant,
        reporter: &mut Reporter,
    ) -> Result<Outcome, Outcome> {
        let mut old_bank = "the old bank is kept";
        let packed = plan.and_then(|plan| {
            if !plan.output.exists() {
                old_bank = "there is no bank yet";
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

    /// Prints a summary, unless only diagnostics are wanted. A full disk does not end the watch.
    fn say(&self, text: &str, reporter: &mut Reporter) -> Outcome {
        if self.pack.sources.is_quiet() {
            return Outcome::Clean;
        }
        reporter.summary(text).map_or_else(Abort::outcome, |()| Outcome::Clean)
    }
}

fn parse_seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    seconds.filter(|period| !period.is_zero()).ok_or_else(|| "it must be a number of seconds above 0".into())
}
