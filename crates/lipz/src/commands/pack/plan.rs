//! One run of packing: what it works with, and what it gave.

use super::Pack;
use super::destination::{self, Destination, Made, Split};
use super::layer;
use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::inputs::{Found, Worked, with_found, with_inputs};
use crate::shared::settings_file::Project;
use crate::shared::{output_file, stdio};
use crate::{Outcome, console};
use lipz_compiler::{Compiled, Compiler, Delivered, Input, Memory, Phases, Replace, dependencies, depfile};
use lipz_sync::KnownRecordings;
use std::mem;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// What a run works with: the project as it is now, under the command line's arguments.
pub(crate) struct Plan {
    pub(crate) project: Project,
    pub(crate) output: PathBuf,
    destination: Destination,
    depfile: Option<PathBuf>,
    /// The folder in which a settings file would apply that is not there yet.
    settings_folder: Option<PathBuf>,
}

/// What one of many runs leaves to the next, which reads only what changed.
#[derive(Default)]
pub(crate) struct Remembered {
    clips: Memory,
    recordings: KnownRecordings,
}

/// What a run made.
pub(crate) struct Packed {
    pub(super) clip_count: usize,
    /// Clips that a cache spared.
    pub(super) recalled: usize,
    delivered: Delivered,
    /// What a layer changes.
    layer: Option<String>,
    /// Failed if the cache or the depfile could not be written: the bank is where it belongs all the same.
    pub(crate) outcome: Outcome,
    /// The time it took to find the files.
    pub(super) discover: Duration,
    /// The times of all that followed.
    pub(super) phases: Phases,
}

impl Plan {
    /// The plan that the arguments and the settings file give. What is wrong with them is printed, and
    /// how the run ends is returned.
    pub(super) fn new(arguments: &Pack, reporter: &mut Reporter) -> Result<Plan, Abort> {
        let mut project = arguments.sources.project(reporter)?;
        let settings = &mut project.settings;
        arguments.audio.apply(&mut settings.audio);
        let strip = arguments.strip.unwrap_or(settings.options.get_strip());
        settings.options = mem::take(&mut settings.options).strip(strip);
        let output = match (&arguments.output, &settings.output) {
            (Some(output), _) => output.clone(),
            (None, Some(output)) if stdio::is_meant(output) => {
                let tip = "name a file there; only `--output -` means standard output";
                return Err(reporter.usage("`output` in lipz.toml is `-`", tip));
            }
            (None, Some(output)) => output.clone(),
            (None, None) => {
                let tip = "name a file with `--output`, or set `output` in lipz.toml";
                return Err(reporter.usage("no bank to write is named", tip));
            }
        };
        let cache = arguments.cache(settings).map(Path::to_owned);
        for path in std::iter::once(&output).chain(&arguments.depfile) {
            output_file::refuse_source(path, reporter)?;
        }
        let bank = Some(("the bank", output.as_path())).filter(|(_, path)| !stdio::is_meant(path));
        let depfile = arguments.depfile.as_deref().map(|path| ("the depfile", path));
        let settings_file = project.file.as_deref().map(|path| ("the settings", path));
        // A cache replaces nothing but a cache.
        let cache_file = cache.as_deref().map(|path| ("the cache", path));
        for read_or_cache in [settings_file, cache_file] {
            let files: Vec<_> = read_or_cache.into_iter().chain(bank).chain(depfile).collect();
            output_file::refuse_same(&files, reporter)?;
        }
        let settings = &project.settings;
        let settings_folder = match project.file {
            None if arguments.sources.settings_file().is_some() => beside(&settings.sources),
            _ => None,
        };
        let split = Split {
            locales: arguments.split_locales.unwrap_or(settings.split_locales),
            voices: arguments.split_voices.unwrap_or(settings.split_voices),
        };
        let cache = cache.as_deref();
        if !arguments.over.is_empty() {
            let destination = layer::destination(arguments, &output, split, reporter)?;
            return Ok(Plan { project, output, destination, depfile: arguments.depfile.clone(), settings_folder });
        }
        split.refuse_both(reporter)?;
        let destination = Destination::new(&output, split, arguments.depfile.is_some(), cache, reporter)?;
        Ok(Plan { project, output, destination, depfile: arguments.depfile.clone(), settings_folder })
    }

    /// Whether standard input is read or standard output has the bank: that works once.
    pub(crate) fn works_once(&self) -> bool {
        let mut sources = self.project.settings.sources.iter();
        self.destination.is_standard_output() || sources.any(|path| stdio::is_meant(path))
    }

    /// Packs once. Diagnostics are shown; if there are errors, nothing is written.
    pub(super) fn run(&self, quiet: bool, reporter: &mut Reporter) -> Result<Packed, Abort> {
        let work = |compiler: &Compiler<'_>, inputs: &[Input]| self.destination.make(compiler, inputs);
        let mut run = with_inputs(&self.project.settings, None, quiet, work);
        let made = made(&mut run, reporter)?;
        self.packed(&run, made, Replace::Always, Ok(()), reporter)
    }

    /// Packs once of many times, the inputs that were found: what is remembered is not made again, and files are replaced by
    /// other bytes only. If it is known which files can have `changed` since the run that is remembered, no other is
    /// looked at.
    pub(crate) fn run_again(
        &self,
        memory: &mut Remembered,
        found: Found<'_>,
        changed: Option<&[usize]>,
        quiet: bool,
        reporter: &mut Reporter,
    ) -> Result<Packed, Abort> {
        let Remembered { clips, recordings } = memory;
        let mut run = with_found(&self.project.settings, found, Some(recordings), quiet, |compiler, inputs| {
            self.destination.make_again(clips, compiler, inputs, changed)
        });
        let made = made(&mut run, reporter)?;
        let remembered = self.destination.remember(clips, reporter);
        self.packed(&run, made, Replace::IfDifferent, remembered, reporter)
    }

    /// Brings the bank to where it is not yet, and writes what belongs to it.
    fn packed(
        &self,
        run: &Worked<'_, Made>,
        made: Made,
        replace: Replace,
        remembered: Result<(), Abort>,
        reporter: &mut Reporter,
    ) -> Result<Packed, Abort> {
        let layer = match &made {
            Made::Bytes(bank) if self.destination.is_layer() => Some(layer::summary(bank)),
            _ => None,
        };
        let delivered = self.destination.deliver(made, replace, reporter)?;
        let written = self.refuse_depfile(&delivered, reporter);
        let written = written.and_then(|()| self.write_depfile(&run.inputs, replace, reporter));
        let outcome = remembered.and(written);
        let Compiled { recalled, phases, .. } = &run.compiled;
        Ok(Packed {
            clip_count: run.inputs.len(),
            recalled: *recalled,
            delivered,
            layer,
            outcome: outcome.err().map_or(Outcome::Clean, Abort::outcome),
            discover: run.discover,
            phases: *phases,
        })
    }

    /// Refuses a depfile that is one of the files that were packed: which they are depends on the locales and the voices.
    fn refuse_depfile(&self, delivered: &Delivered, reporter: &mut Reporter) -> Result<(), Abort> {
        let Some(depfile) = &self.depfile else { return Ok(()) };
        for file in &delivered.files {
            output_file::refuse_same(&[("a packed file", &file.path), ("the depfile", depfile)], reporter)?;
        }
        Ok(())
    }

    /// Writes what the bank depends on, if that was asked for. Reports why that is not possible.
    fn write_depfile(&self, inputs: &[Input], replace: Replace, reporter: &mut Reporter) -> Result<(), Abort> {
        let Some(path) = &self.depfile else { return Ok(()) };
        let mut dependencies = dependencies(&self.project.settings, inputs).map_err(|report| reporter.fail(report))?;
        dependencies.extend(lipz_sync::dependencies(&self.project.settings));
        // A folder that outputs change would be newer than them after each run.
        let has_output = |folder: &PathBuf| [&self.output, path].iter().any(|file| is_in(file, folder));
        dependencies.extend(self.settings_folder.clone().filter(|folder| !has_output(folder)));
        dependencies.sort_unstable();
        dependencies.dedup();
        dependencies.extend(self.project.file.clone());
        let bytes = depfile(&self.output, &dependencies).map_err(|report| destination::without(report, reporter))?;
        destination::write(path, &bytes, replace, reporter)
    }
}

/// What a run has made; its diagnostics are shown.
fn made(run: &mut Worked<'_, Made>, reporter: &mut Reporter) -> Result<Made, Abort> {
    let outcome = run.outcome();
    let reports = mem::take(&mut run.reports);
    match run.compiled.bank.take() {
        Some(made) if outcome == Outcome::Clean => {
            reporter.add(reports);
            Ok(made)
        }
        _ => Err(reporter.abort(reports, outcome)),
    }
}

/// The folder beside whose entries the first source is, in which people create a settings file.
fn beside(sources: &[PathBuf]) -> Option<PathBuf> {
    let folder = sources.first()?.ancestors().find(|path| path.is_dir())?.parent()?;
    Some(if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder.to_owned() })
}

/// Whether a file is an entry of the folder.
fn is_in(file: &Path, folder: &Path) -> bool {
    let parent = file.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    match (parent.canonicalize(), folder.canonicalize()) {
        (Ok(parent), Ok(folder)) => parent == folder,
        _ => false,
    }
}

impl Packed {
    /// A line for each file that was written.
    pub(super) fn summary(&self) -> String {
        destination::summary(&self.delivered, &self.contents())
    }

    /// What was packed, as messages call it.
    fn contents(&self) -> String {
        self.layer.clone().unwrap_or_else(|| console::counted(self.clip_count, "clip"))
    }

    /// One line about all files, and whether any is another than before.
    pub(crate) fn message(&self) -> String {
        destination::message(&self.delivered, &self.contents())
    }
}
