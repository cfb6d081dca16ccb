//! `lipz pack`: source files to a bank.

mod destination;

use super::{Run, with_inputs};
use crate::render::Findings;
use crate::sources::{Sources, usage_error};
use crate::{Outcome, console, standard};
use clap::Args;
use clap::error::ErrorKind;
use destination::Destination;
use lipz_compiler::settings::Settings;
use lipz_compiler::{dependencies, depfile};
use std::mem;
use std::path::{Path, PathBuf};
use std::time::Duration;

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
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    split_locales: Option<bool>,

    /// Also write what the bank depends on, for Make, Ninja and CMake
    #[arg(long, value_name = "FILE")]
    depfile: Option<PathBuf>,

    /// Remember the Lipz files in FILE, so that the next run reads only those that changed [default:
    /// `cache` of lipz.toml]. Safe to delete. Not for text banks and standard output
    #[arg(long, value_name = "FILE")]
    cache: Option<PathBuf>,

    /// Read all files, and remember none
    #[arg(long, conflicts_with = "cache")]
    no_cache: bool,

    /// Print where the time went
    #[arg(long)]
    timings: bool,
}

impl Pack {
    /// Whether the bank goes to standard output.
    pub(crate) fn prints_bank(&self) -> bool {
        self.output.as_ref().is_some_and(|output| standard::is_meant(output))
    }

    /// The cache to use.
    fn cache<'a>(&'a self, settings: &'a Settings) -> Option<&'a Path> {
        let cache = self.cache.as_deref().or(settings.cache.as_deref());
        cache.filter(|_| !self.no_cache)
    }
}

pub(crate) fn run(arguments: &Pack, findings: &mut Findings) -> Outcome {
    let mut project = match arguments.sources.project(findings) {
        Ok(project) => project,
        Err(outcome) => return outcome,
    };
    let options = &mut project.settings.options;
    options.strip = arguments.strip.unwrap_or(options.strip);
    let settings = &project.settings;
    let Some(output) = arguments.output.as_ref().or(settings.output.as_ref()) else {
        let tip = "name a file with '--output', or set `output` in lipz.toml";
        return usage_error(ErrorKind::MissingRequiredArgument, "no bank to write is named", tip);
    };
    let destination = match Destination::of(
        output,
        arguments.split_locales.unwrap_or(settings.split_locales),
        arguments.depfile.is_some(),
        arguments.cache(settings),
    ) {
        Ok(destination) => destination,
        Err(outcome) => return outcome,
    };
    let mut run = with_inputs(settings, arguments.sources.is_quiet(), |inputs, options, progress| {
        destination.make(inputs, options, progress)
    });
    let outcome = run.outcome();
    findings.add(mem::take(&mut run.reports));
    let bank = match run.compiled.bank.take() {
        Some(bank) if outcome == Outcome::Clean => bank,
        _ => return outcome,
    };
    let written = match destination.deliver(&bank, findings) {
        Ok(written) => written,
        Err(outcome) => return outcome,
    };
    if let Some(path) = &arguments.depfile {
        let mut dependencies = dependencies(&settings.sources, &run.inputs);
        dependencies.extend(project.file.clone());
        if let Err(outcome) = destination::write(path, &depfile(output, &dependencies), findings) {
            return outcome;
        }
    }
    let mut text = String::new();
    if !arguments.sources.is_quiet() {
        text = written.summary(run.inputs.len(), run.compiled.is_unchanged);
        if let Some(file) = project.found() {
            text.push_str(&format!("with the settings of {}\n", console::path(file)));
        }
    }
    if arguments.timings {
        text.push_str(&timings(&run));
    }
    findings.summary(&text)
}

/// The time of each phase, in milliseconds, and what a cache spared.
fn timings(run: &Run) -> String {
    let phases = &run.compiled.phases;
    let line = |name: &str, time: Duration| format!("  {name:<22} {:>9.1} ms\n", time.as_secs_f64() * 1000.0);
    [
        line("discover", run.discover),
        line("cache", phases.cache),
        line("files", phases.files),
        line("  recall (all threads)", phases.recall),
        line("  read (all threads)", phases.read),
        line("  parse (all threads)", phases.parse),
        line("  check (all threads)", phases.check),
        line("localise", phases.localise),
        line("lower", phases.lower),
        line("verify and write", phases.finish),
        format!(
            "  {} of {} recalled from the bank\n",
            run.compiled.recalled,
            console::counted(run.inputs.len(), "clip")
        ),
    ]
    .concat()
}
