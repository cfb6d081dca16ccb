//! `lipz pack`: source files to a bank.

use super::{Run, with_inputs};
use crate::sources::Sources;
use crate::{Outcome, console, render};
use clap::Args;
use lipz_compiler::{Options, pack};
use std::path::PathBuf;
use std::time::Duration;

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

pub(crate) fn run(arguments: &Pack) -> Outcome {
    let options = Options { strip: arguments.strip, ..arguments.sources.options() };
    let run = with_inputs(&arguments.sources, &options, |inputs, options, progress| {
        pack(inputs, options, &arguments.output, progress)
    });
    render::findings(&run.reports);
    let Some(bank) = &run.compiled.bank else { return run.failure() };
    let mut text = String::new();
    if !arguments.sources.quiet {
        let (clips, bytes) = (console::counted(run.file_count, "clip"), console::grouped(bank.len()));
        text = format!("{clips} packed into {} ({bytes} bytes)\n", console::path(&arguments.output));
    }
    if arguments.timings {
        text.push_str(&timings(&run));
    }
    console::print(&text)
}

/// The time of each phase, in milliseconds.
fn timings(run: &Run) -> String {
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
        line("verify and write", phases.finish),
    ]
    .concat()
}
