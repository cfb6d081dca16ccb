//! `lipz pack`: source files to a bank.

use super::{Run, with_inputs};
use crate::sources::Sources;
use crate::{Outcome, console, render};
use clap::Args;
use lipz::Level;
use lipz_compiler::{Options, Report, Split, compile, count, replace_file, split};
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

    /// Write the texts of each locale into a text bank of its own, BANK with the locale before the
    /// extension .lipztexts; the bank has all the rest
    #[arg(long)]
    pub(crate) split_locales: bool,

    /// Print where the time went
    #[arg(long)]
    pub(crate) timings: bool,
}

pub(crate) fn run(arguments: &Pack) -> Outcome {
    let options = Options { strip: arguments.strip, ..arguments.sources.options() };
    let mut run = with_inputs(&arguments.sources, &options, compile);
    render::findings(&run.reports);
    let bank = match run.compiled.bank.take() {
        Some(bank) if count(&run.reports, Level::Error) == 0 => bank,
        _ => return run.failure(),
    };
    let start = Instant::now();
    let files = match written(arguments, bank) {
        Ok(files) => files,
        Err(report) => {
            render::findings(&[report]);
            return Outcome::Failed;
        }
    };
    let write = start.elapsed();
    let mut text = String::new();
    if !arguments.sources.quiet {
        let clips = console::counted(run.file_count, "clip");
        for (index, (path, length_bytes)) in files.iter().enumerate() {
            let what = if index == 0 { format!("{clips} packed into") } else { "texts packed into".to_owned() };
            let (path, bytes) = (console::path(path), console::grouped(*length_bytes));
            text.push_str(&format!("{what} {path} ({bytes} bytes)\n"));
        }
    }
    if arguments.timings {
        text.push_str(&timings(&run, write));
    }
    console::print(&text)
}

/// Writes the bank and its text banks; their paths and lengths, the bank first.
fn written(arguments: &Pack, bank: Vec<u8>) -> Result<Vec<(PathBuf, usize)>, Report> {
    let output = &arguments.output;
    let Split { base, texts } =
        if arguments.split_locales { split(&bank)? } else { Split { base: bank, texts: Vec::new() } };
    let mut files = vec![(output.clone(), base)];
    let text_bank = |(tag, texts)| (output.with_extension(format!("{tag}.lipztexts")), texts);
    files.extend(texts.into_iter().map(text_bank));
    // The bank last: whoever finds it finds its texts, too.
    for (path, bytes) in files.iter().rev() {
        replace_file(path, bytes)?;
    }
    Ok(files.into_iter().map(|(path, bytes)| (path, bytes.len())).collect())
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
