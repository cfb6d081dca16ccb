//! One packing run: its input and its result.

use super::PackArguments;
use super::destination::{self, Destination, PackedBank};
use super::layer;
use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::inputs::{FoundInputs, RunResult, with_found, with_inputs};
use crate::shared::settings_file::Project;
use crate::shared::split::Split;
use crate::shared::{output_file, rig, stdio};
use crate::{Outcome, console};
use lipz_compiler::{Compiled, Compiler, DeliveredFiles, Input, Memory, Phases, Replace, dependencies, depfile};
use lipz_sync::FactsCache;
use std::mem;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The input of a run: the project in its current state, with the command line's arguments.
pub(crate) struct Plan {
    pub(crate) project: Project,
    pub(crate) output: PathBuf,
    destination: Destination,
    depfile: Option<PathBuf>,
    /// The folder in which a new settings file would take effect.
    settings_folder: Option<PathBuf>,
}

/// Results that one of several runs keeps for the next, which reads only changed files.
#[derive(Default)]
pub(crate) struct PackMemory {
    clips: Memory,
    recordings: FactsCache,
}

/// The result of a run.
pub(crate) struct PackResult {
    pub(super) clip_count: usize,
    /// The number of clips taken from a cache.
    pub(super) recalled: usize,
    delivered: DeliveredFiles,
    /// A summary of a layer's changes.
    layer: Option<String>,
    /// Failed if the cache or the depfile could not be written. The bank is written nevertheless.
    pub(crate) outcome: Outcome,
    /// The time for finding the files.
    pub(super) discover: Duration,
    /// The times of the following phases.
    pub(super) phases: Phases,
}

impl Plan {
    /// Creates the plan from the arguments and the settings file. Reports their problems.
    pub(super) fn new(arguments: &PackArguments, reporter: &mut Reporter) -> Result<Plan, Abort> {
        let mut project = arguments.sources.project(reporter)?;
        let settings = &mut project.settings;
        arguments.audio.apply(&mut settings.audio, reporter)?;
        if let Some(name) = &arguments.bake {
            let rig = rig::named(name, &settings.options, reporter)?;
            settings.options = mem::take(&mut settings.options).baked_rig(rig);
        }
        let output = match (&arguments.output, &settings.output) {
            (Some(output), _) => output.clone(),
            (None, Some(output)) if stdio::is_meant(output) => {
                let tip = "set a file there; only `--output -` means standard output";
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
        // A cache must not overwrite files of other kinds.
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
        let split = Split { locales: settings.split_locales, voices: settings.split_voices };
        let cache = cache.as_deref();
        if !arguments.over.is_empty() {
            let destination = layer::destination(arguments, &output, split, reporter)?;
            return Ok(Plan { project, output, destination, depfile: arguments.depfile.clone(), settings_folder });
        }
        split.refuse_both(reporter)?;
        let destination = Destination::new(&output, split, arguments.depfile.is_some(), cache, reporter)?;
        Ok(Plan { project, output, destination, depfile: arguments.depfile.clone(), settings_folder })
    }

    /// Whether only one run is possible, because it reads standard input or writes the bank to standard output.
    pub(crate) fn works_once(&self) -> bool {
        let mut sources = self.project.settings.sources.iter();
        self.destination.is_standard_output() || sources.any(|path| stdio::is_meant(path))
    }

    /// Packs once. Shows the diagnostics, and writes nothing if there are errors.
    pub(super) fn run(&self, quiet: bool, reporter: &mut Reporter) -> Result<PackResult, Abort> {
        let work = |compiler: &Compiler<'_>, inputs: &[Input]| self.destination.make(compiler, inputs);
        let mut run = with_inputs(&self.project.settings, None, quiet, work);
        let made = made(&mut run, reporter)?;
        self.packed(&run, made, Replace::Always, Ok(()), reporter)
    }

    /// Packs these inputs as one of several runs. Remembered results are reused, and files are replaced only if their
    /// bytes change. If `changed` names the files that can have changed since the remembered run, no others are read.
    pub(crate) fn run_again(
        &self,
        memory: &mut PackMemory,
        found: FoundInputs<'_>,
        changed: Option<&[usize]>,
        quiet: bool,
        reporter: &mut Reporter,
    ) -> Result<PackResult, Abort> {
        let PackMemory { clips, recordings } = memory;
        let mut run = with_found(&self.project.settings, found, Some(recordings), quiet, |compiler, inputs| {
            self.destination.make_again(clips, compiler, inputs, changed)
        });
        let made = made(&mut run, reporter)?;
        let remembered = self.destination.remember(clips, reporter);
        self.packed(&run, made, Replace::IfDifferent, remembered, reporter)
    }

    /// Writes a bank that is still in memory, and the files that accompany it.
    fn packed(
        &self,
        run: &RunResult<'_, PackedBank>,
        made: PackedBank,
        replace: Replace,
        remembered: Result<(), Abort>,
        reporter: &mut Reporter,
    ) -> Result<PackResult, Abort> {
        let layer = match &made {
            PackedBank::Bytes(bank) if self.destination.is_layer() => Some(layer::summary(bank)),
            _ => None,
        };
        let delivered = self.destination.deliver(made, replace, reporter)?;
        let written = self.refuse_depfile(&delivered, reporter);
        let written = written.and_then(|()| self.write_depfile(&run.inputs, replace, reporter));
        let outcome = remembered.and(written);
        let Compiled { recalled, phases, .. } = &run.compiled;
        Ok(PackResult {
            clip_count: run.inputs.len(),
            recalled: *recalled,
            delivered,
            layer,
            outcome: outcome.err().map_or(Outcome::Clean, Abort::outcome),
            discover: run.discover,
            phases: *phases,
        })
    }

    /// Refuses a depfile with the path of a packed file. These paths depend on the locales and the voices.
    fn refuse_depfile(&self, delivered: &DeliveredFiles, reporter: &mut Reporter) -> Result<(), Abort> {
        let Some(depfile) = &self.depfile else { return Ok(()) };
        for file in &delivered.files {
            output_file::refuse_same(&[("a packed file", &file.path), ("the depfile", depfile)], reporter)?;
        }
        Ok(())
    }

    /// Writes the dependencies of the bank, if requested. Reports errors.
    fn write_depfile(&self, inputs: &[Input], replace: Replace, reporter: &mut Reporter) -> Result<(), Abort> {
        let Some(path) = &self.depfile else { return Ok(()) };
        let mut dependencies = dependencies(&self.project.settings, inputs).map_err(|report| reporter.fail(report))?;
        dependencies.extend(lipz_sync::dependencies(&self.project.settings));
        // A folder that contains outputs would be newer than these after each run.
        let has_output = |folder: &PathBuf| [&self.output, path].iter().any(|file| is_in(file, folder));
        dependencies.extend(self.settings_folder.clone().filter(|folder| !has_output(folder)));
        dependencies.sort_unstable();
        dependencies.dedup();
        dependencies.extend(self.project.file.clone());
        let bytes = depfile(&self.output, &dependencies).map_err(|report| destination::without(report, reporter))?;
        destination::write(path, &bytes, replace, reporter)
    }
}

/// Returns the result of a run, and shows its diagnostics.
fn made(run: &mut RunResult<'_, PackedBank>, reporter: &mut Reporter) -> Result<PackedBank, Abort> {
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

/// Returns the folder that contains the first source, where people create a settings file.
fn beside(sources: &[PathBuf]) -> Option<PathBuf> {
    let folder = sources.first()?.ancestors().find(|path| path.is_dir())?.parent()?;
    Some(if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder.to_owned() })
}

/// Whether a file is directly in the folder.
fn is_in(file: &Path, folder: &Path) -> bool {
    let parent = file.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    match (parent.canonicalize(), folder.canonicalize()) {
        (Ok(parent), Ok(folder)) => parent == folder,
        _ => false,
    }
}

impl PackResult {
    /// Returns a line for each written file.
    pub(super) fn summary(&self) -> String {
        destination::summary(&self.delivered, &self.contents())
    }

    /// Describes the packed content for messages.
    fn contents(&self) -> String {
        self.layer.clone().unwrap_or_else(|| console::counted(self.clip_count, "clip"))
    }

    /// Returns one line about all files, and whether any of them changed.
    pub(crate) fn message(&self) -> String {
        destination::message(&self.delivered, &self.contents())
    }
}
