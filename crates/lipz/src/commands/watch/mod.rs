//! `lipz watch`: packs, and packs again when something changes.

mod alarm;
mod scope;

use super::pack::{Pack, Plan, Remembered};
use crate::Abort;
use crate::Ended;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::{Outcome, console};
pub(crate) use alarm::{Alarm, Change};
use clap::Args;
use jiff::Zoned;
pub(crate) use scope::Scope;
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
    loop {
        if !arguments.pack.may_remember() {
            memory = Remembered::default();
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
            Err(_) => {}
        }
        alarm.set(&scope).map_err(|report| reporter.fail(report))?;
        let state = scope.state();
        let mut outcome = arguments.pack_once(plan, &mut memory, start, reporter);
        let place = alarm.describe(&scope);
        if place != told {
            outcome = outcome.max(arguments.say(&place, reporter));
            told = place;
        }
        reporter.finish_run(Ok(outcome));
        while alarm.wait() == Change::Perhaps {
            alarm.set(&scope).map_err(|report| reporter.fail(report))?;
            if scope.state() != state {
                break;
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

    /// Packs if there is a plan, and says how it went.
    fn pack_once(
        &self,
        plan: Result<Plan, Abort>,
        memory: &mut Remembered,
        start: Instant,
        reporter: &mut Reporter,
    ) -> Outcome {
        let mut old_bank = "the old bank is kept";
        let packed = plan.and_then(|plan| {
            if !plan.output.exists() {
                old_bank = "there is no bank yet";
            }
            plan.run(Some(memory), self.pack.sources.is_quiet(), reporter)
        });
        let (outcome, message, timings) = match packed {
            Ok(packed) => {
                let took_ms = start.elapsed().as_millis();
                (packed.outcome, format!("{}, {took_ms} ms", packed.message()), self.pack.timings(&packed))
            }
            Err(abort) => (abort.outcome(), format!("not packed: {old_bank}"), String::new()),
        };
        let time = Zoned::now().strftime("%H:%M:%S");
        outcome.max(self.say(&format!("{time}  {message}\n{timings}"), reporter))
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
