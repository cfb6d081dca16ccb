//! `lipz pack`: source files to a bank.

use super::{Run, with_inputs};
use crate::sources::{Project, Sources, usage_error};
use crate::{Outcome, console, render};
use clap::Args;
use clap::error::ErrorKind;
use lipz::Level;
use lipz_compiler::{compile, count, replace_file};
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Check Lipz files and pack them into a bank.
///
/// The old bank stays as it is until the new one is complete and verified. Nothing is written if
/// there are errors.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz pack
  lipz pack voices -o dialogue.lipzbank
  lipz pack voices/act1 voices/act2 --root voices -o acts.lipzbank --default-locale en-us
  lipz pack 'voices/**/mara-*.lipz' -o mara.lipzbank --strip")]
pub(crate) struct Pack {
    #[command(flatten)]
    sources: Sources,

    /// The bank to write [default: `output` of lipz.toml]
    #[arg(short, long, value_name = "BANK")]
    output: Option<PathBuf>,

    /// Leave out the source section: smaller, but unpacking gives display forms only
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    strip: Option<bool>,

    /// Print where the time went
    #[arg(long)]
    timings: bool,
}

pub(crate) fn run(arguments: &Pack) -> Outcome {
    let Project { mut settings, found } = match arguments.sources.project() {
        Ok(project) => project,
        Err(outcome) => return outcome,
    };
    let Some(output) = arguments.output.as_ref().or(settings.output.as_ref()) else {
        let tip = "name a file with '--output', or set `output` in lipz.toml";
        return usage_error(ErrorKind::MissingRequiredArgument, "no bank to write is named", tip);
    };
    settings.options.strip = arguments.strip.unwrap_or(settings.options.strip);
    let mut run = with_inputs(&settings, arguments.sources.quiet, compile);
    render::findings(&run.reports);
    let bank = match run.compiled.bank.take() {
        Some(bank) if count(&run.reports, Level::Error) == 0 => bank,
        _ => return run.failure(),
    };
    let start = Instant::now();
    if let Err(report) = replace_file(output, &bank) {
        render::findings(&[report]);
        return Outcome::Failed;
    }
    let write = start.elapsed();
    let mut text = String::new();
    if !arguments.sources.quiet {
        let (clips, bytes) = (console::counted(run.file_count, "clip"), console::grouped(bank.len()));
        text = format!("{clips} packed into {} ({bytes} bytes)\n", console::path(output));
        if let Some(file) = found {
            text.push_str(&format!("with the settings of {}\n", console::path(&file)));
        }
    }
    if arguments.timings {
        text.push_str(&timings(&run, write));
    }
    console::print(&text)
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
