//! `lipz pack`: source files to a bank.

use super::{Run, with_inputs};
use crate::sources::Sources;
use crate::{Outcome, console, interrupt, render, standard};
use clap::Args;
use lipz_compiler::{Options, compile, replace_file};
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Check Lipz files and pack them into a bank.
///
/// The old bank stays as it is until the new one is complete and verified. Nothing is written if
/// there are errors, or if the run is interrupted.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz pack voices -o dialogue.lipzbank
  lipz pack voices/act1 voices/act2 --root voices -o acts.lipzbank --default-locale en-us
  lipz pack 'voices/**/mara-*.lipz' -o mara.lipzbank --strip")]
pub(crate) struct Pack {
    #[command(flatten)]
    pub(crate) sources: Sources,

    /// The bank to write; `-` writes it to standard output
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
    let Sources { places, project } = &arguments.sources;
    let is_standard = standard::is_meant(&arguments.output);
    if is_standard && io::stdout().is_terminal() {
        console::remark("error: a bank is not for a terminal\nhelp: name a file, or send standard output to one\n");
        return Outcome::Failed;
    }
    let options = Options { strip: arguments.strip, ..project.options() };
    let mut run = with_inputs(places, project.quiet, &options, compile);
    render::findings(&run.reports);
    let bank = match run.compiled.bank.take() {
        Some(bank) if !run.has_errors() => bank,
        _ => return run.failure(),
    };
    let start = Instant::now();
    let written = if is_standard { console::print_bytes(&bank) } else { write_bank(&arguments.output, &bank) };
    if written != Outcome::Clean {
        return written;
    }
    let write = start.elapsed();
    let mut text = String::new();
    if !project.quiet {
        let (clips, bytes) = (console::counted(run.file_count, "clip"), console::grouped(bank.len()));
        let output = if is_standard { "standard output".into() } else { console::path(&arguments.output) };
        text = format!("{clips} packed into {output} ({bytes} bytes)\n");
    }
    if arguments.timings {
        text.push_str(&timings(&run, write));
    }
    if is_standard {
        console::remark(&text);
        return Outcome::Clean;
    }
    console::print(&text)
}

fn write_bank(path: &Path, bank: &[u8]) -> Outcome {
    match interrupt::whole(|| replace_file(path, bank)) {
        Ok(()) => Outcome::Clean,
        Err(report) => {
            render::findings(&[report]);
            Outcome::Failed
        }
    }
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
