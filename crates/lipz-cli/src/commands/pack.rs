//! `lipz pack`: source files to a bank.

use super::{Run, with_inputs};
use crate::render::Findings;
use crate::sources::{Sources, usage_error};
use crate::{Outcome, console, interrupt, standard};
use clap::Args;
use clap::error::ErrorKind;
use lipz_compiler::{Report, Split, compile, dependencies, depfile, replace_file, split};
use std::io::{self, IsTerminal};
use std::mem;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Check Lipz files and pack them into a bank.
///
/// The old bank stays as it is until the new one is complete and verified. Nothing is written if
/// there are errors, or if the run is interrupted.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz pack
  lipz pack voices -o dialogue.lipzbank
  lipz pack voices/act1 voices/act2 --root voices -o acts.lipzbank --default-locale en-us
  lipz pack 'voices/**/mara-*.lipz' -o mara.lipzbank --strip")]
pub(crate) struct Pack {
    #[command(flatten)]
    sources: Sources,

    /// The bank to write; `-` writes it to standard output [default: `output` of lipz.toml]
    #[arg(short, long, value_name = "BANK")]
    output: Option<PathBuf>,

    /// Leave out the source section: smaller, but unpacking gives display forms only
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    strip: Option<bool>,

    /// Write the texts of each locale into a text bank of its own, BANK with the locale before the
    /// extension .lipztexts; the bank has all the rest
    #[arg(long)]
    split_locales: bool,

    /// Also write what the bank depends on, for Make, Ninja and CMake
    #[arg(long, value_name = "FILE")]
    depfile: Option<PathBuf>,

    /// Print where the time went
    #[arg(long)]
    timings: bool,
}

impl Pack {
    /// Whether the bank goes to standard output.
    pub(crate) fn prints_bank(&self) -> bool {
        self.output.as_ref().is_some_and(|output| standard::is_meant(output))
    }
}

pub(crate) fn run(arguments: &Pack, findings: &mut Findings) -> Outcome {
    let mut project = match arguments.sources.project(findings) {
        Ok(project) => project,
        Err(outcome) => return outcome,
    };
    let settings = &mut project.settings;
    settings.options.strip = arguments.strip.unwrap_or(settings.options.strip);
    let settings = &project.settings;
    let Some(output) = arguments.output.as_ref().or(settings.output.as_ref()) else {
        let tip = "name a file with '--output', or set `output` in lipz.toml";
        return usage_error(ErrorKind::MissingRequiredArgument, "no bank to write is named", tip);
    };
    let is_standard = standard::is_meant(output);
    if is_standard && io::stdout().is_terminal() {
        console::remark("error: a bank is not for a terminal\nhelp: name a file, or send standard output to one\n");
        return Outcome::Failed;
    }
    if is_standard && (arguments.split_locales || arguments.depfile.is_some()) {
        let tip =
            "name a file with '--output': text banks are written beside it, and a depfile tells what it depends on";
        return usage_error(ErrorKind::ArgumentConflict, "standard output holds one bank and has no name", tip);
    }
    let mut run = with_inputs(settings, arguments.sources.is_quiet(), compile);
    let outcome = run.outcome();
    findings.add(mem::take(&mut run.reports));
    let bank = match run.compiled.bank.take() {
        Some(bank) if outcome == Outcome::Clean => bank,
        _ => return outcome,
    };
    let start = Instant::now();
    let files = match files(output, bank, arguments.split_locales) {
        Ok(files) => files,
        Err(report) => {
            findings.add(vec![report]);
            return Outcome::Failed;
        }
    };
    let mut written = match files.as_slice() {
        [(_, bank)] if is_standard => console::print_bytes(bank),
        _ => write(&files, findings),
    };
    if let (Outcome::Clean, Some(path)) = (written, &arguments.depfile) {
        let mut dependencies = dependencies(&settings.sources, &run.inputs);
        dependencies.extend(project.file.clone());
        written = write(&[(path.clone(), depfile(output, &dependencies))], findings);
    }
    if written != Outcome::Clean {
        return written;
    }
    let mut text = String::new();
    if !arguments.sources.is_quiet() {
        text = summary(&files, run.inputs.len(), is_standard);
        if let Some(file) = project.found() {
            text.push_str(&format!("with the settings of {}\n", console::path(file)));
        }
    }
    if arguments.timings {
        text.push_str(&timings(&run, start.elapsed()));
    }
    findings.summary(&text)
}

/// The bank and its text banks with their paths, the bank first.
fn files(output: &Path, bank: Vec<u8>, split_locales: bool) -> Result<Vec<(PathBuf, Vec<u8>)>, Report> {
    let Split { base, texts } = if split_locales { split(&bank)? } else { Split { base: bank, texts: Vec::new() } };
    let mut files = vec![(output.to_owned(), base)];
    let text_bank = |(tag, texts)| (output.with_extension(format!("{tag}.lipztexts")), texts);
    files.extend(texts.into_iter().map(text_bank));
    Ok(files)
}

/// Writes the files, the bank last: whoever finds it finds its texts, too.
fn write(files: &[(PathBuf, Vec<u8>)], findings: &mut Findings) -> Outcome {
    let written = interrupt::whole(|| files.iter().rev().try_for_each(|(path, bytes)| replace_file(path, bytes)));
    match written {
        Ok(()) => Outcome::Clean,
        Err(report) => {
            findings.add(vec![report]);
            Outcome::Failed
        }
    }
}

/// What was written.
fn summary(files: &[(PathBuf, Vec<u8>)], clip_count: usize, is_standard: bool) -> String {
    let line = |(index, (path, bytes)): (usize, &(PathBuf, Vec<u8>))| {
        let what = if index == 0 { console::counted(clip_count, "clip") } else { "texts".to_owned() };
        let path = if is_standard { "standard output".into() } else { console::path(path) };
        format!("{what} packed into {path} ({} bytes)\n", console::grouped(bytes.len()))
    };
    files.iter().enumerate().map(line).collect()
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
