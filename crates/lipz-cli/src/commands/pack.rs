//! `lipz pack`: source files to a bank.

use super::{Run, with_inputs};
use crate::render::Findings;
use crate::sources::Sources;
use crate::{Outcome, console};
use clap::Args;
use lipz_compiler::{Options, compile, replace_file};
use std::mem;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Check Lipz files and pack them into a bank.
///
/// The old bank stays as it is until the new one is complete and verified. Nothing is written if
/// there are errors.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz pack voices -o dialogue.lipzbank
  lipz pack voices/act1 voices/act2 --root voices -o acts.lipzbank --default-locale en-us
  lipz pack 'voices/**/mara-*.lipz' -o mara.lipzbank --strip")]
pub(crate) struct Pack {
    #[command(flatten)]
    pub(crate) sources: Sources,

    /// The bank to write
    #[arg(short, long, value_name = "BANK")]
    pub(crate) output: PathBuf,

    /// Leave out the source section: smaller, but unpacking gives display forms only
    #[arg(long)]
    pub(crate) strip: bool,

    /// Print where the time went
    #[arg(long)]
    pub(crate) timings: bool,
}

pub(crate) fn run(arguments: &Pack, findings: &mut Findings) -> Outcome {
    let options = Options { strip: arguments.strip, ..arguments.sources.options() };
    let mut run = with_inputs(&arguments.sources, &options, compile);
    let outcome = run.outcome();
    findings.add(mem::take(&mut run.reports));
    let bank = match run.compiled.bank.take() {
        Some(bank) if outcome == Outcome::Clean => bank,
        _ => return outcome,
    };
    let start = Instant::now();
    if let Err(report) = replace_file(&arguments.output, &bank) {
        findings.add(vec![report]);
        return Outcome::Failed;
    }
    let write = start.elapsed();
    let mut text = String::new();
    if !arguments.sources.quiet {
        let (clips, bytes) = (console::counted(run.file_count, "clip"), console::grouped(bank.len()));
        text = format!("{clips} packed into {} ({bytes} bytes)\n", console::path(&arguments.output));
    }
    if arguments.timings {
        text.push_str(&timings(&run, write));
    }
    findings.summary(&text)
}

/// The time of each phase, in milliseconds.
fn timings(run: &Run, write: Duration) -> String {
    let phases = &run.compiled.phases;
    let line = |name: &str, time: Duration| format!("  {name:<22} {:>9.1} ms\n", time.as_secs_f64() * 1000.0);
    [
        line("discover", run.discover),
        line("read, parse and check", phases.files),
        line("  read (all threads)", phases.read),
        line("  parse (all threads)", phases.parse),
        line("  check (all threads)", phases.check),
        line("localise", phases.localise),
        line("lower", phases.lower),
        line("verify", phases.verify),
        line("write", write),
    ]
    .concat()
}
