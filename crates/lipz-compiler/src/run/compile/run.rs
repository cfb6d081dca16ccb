//! One run: reading files on all threads, then making a bank from their clips.

use super::earlier_run::EarlierRun;
use super::file::Worker;
use super::requirements::TextFacts;
use super::{Compiled, Lint, Phases, Progress};
use crate::bank::layers::KeptClips;
use crate::bank::lower::{BankExtras, Layout};
use crate::bank::verify;
#[cfg(feature = "cache")]
use crate::clip::Clip;
use crate::clip::Clips;
use crate::locales::dubs::{self, Dubs, KeptDubs};
use crate::locales::localise;
use crate::project::Options;
use crate::sources::{Input, key};
use crate::util::parallel;
use lipz_diagnostics::Report;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// The number of files that a thread takes at a time: few enough that all threads end together, and so many that those
/// of a folder stay together.
const FILES_AT_ONCE: usize = 64;

/// The state after reading the files.
#[derive(Default)]
pub(crate) struct CompileRun {
    clips: Vec<Clips>,
    reports: Vec<Report>,
    /// The reports of a lint.
    pub(crate) linted: Vec<Report>,
    /// Whether there are no reports about keys.
    #[cfg(feature = "cache")]
    pub(crate) are_keys_fine: bool,
    pub(crate) phases: Phases,
    /// Clips of a bank below this one, with the number of their batch.
    kept: Option<(usize, KeptClips)>,
    /// The number of clips in the bank of the previous run instead.
    pub(crate) recalled: usize,
    /// The number of files that a lint counts.
    pub(crate) marked: usize,
    /// Numbers of the inputs of dubs with diagnostics, which the next run must read again.
    #[cfg(feature = "cache")]
    pub(crate) reported_dubs: Vec<u32>,
}

/// Verifies the tables of a bank, and checks its texts against the project's requirements.
pub(crate) type Check<'c> = dyn FnMut() -> Result<(), Report> + Send + 'c;

impl CompileRun {
    /// Reads, parses and checks `inputs`, or finds their clips in the old bank.
    pub(crate) fn read(
        inputs: &[Input],
        options: &Options,
        earlier: Option<&dyn EarlierRun>,
        progress: &Progress<'_>,
    ) -> CompileRun {
        CompileRun::read_with(inputs, options, earlier, None, progress)
    }

    /// Reads the inputs, and calls `lint` for each file that is read.
    pub(crate) fn read_with(
        inputs: &[Input],
        options: &Options,
        earlier: Option<&dyn EarlierRun>,
        lint: Option<&Lint<'_>>,
        progress: &Progress<'_>,
    ) -> CompileRun {
        let start = Instant::now();
        let mut run = CompileRun::default();
        let next = AtomicUsize::new(0);
        let read = || {
            parallel::workers(options.threads, || {
                let mut worker = Worker::new(options, lint, earlier);
                loop {
                    let first = next.fetch_add(FILES_AT_ONCE, Ordering::Relaxed);
                    let Some(behind) = inputs.get(first..).filter(|behind| !behind.is_empty()) else {
                        worker.finish();
                        return worker;
                    };
                    let files = behind.len().min(FILES_AT_ONCE);
                    worker.files(first, &behind[..files]);
                    progress(files as u64);
                }
            })
        };
        let ((), workers) = parallel::join(|| key::check(inputs, &mut run.reports), read);
        #[cfg(feature = "cache")]
        {
            run.are_keys_fine = run.reports.is_empty();
        }
        run.reports.iter_mut().for_each(|report| options.apply_levels(report));
        for worker in workers {
            run.clips.extend(worker.clips.into_all());
            run.reports.extend(worker.reports);
            run.linted.extend(worker.linted);
            run.recalled += worker.recalled;
            run.marked += worker.marked;
            run.phases.recall += worker.phases.recall;
            run.phases.read += worker.phases.read;
            run.phases.parse += worker.phases.parse;
            run.phases.check += worker.phases.check;
        }
        run.phases.files = start.elapsed();
        run
    }

    /// Adds clips of the old bank, and the time for recalling them.
    #[cfg(feature = "cache")]
    pub(crate) fn add(&mut self, recalled: Vec<Clips>, time: std::time::Duration) {
        self.clips.extend(recalled);
        self.phases.recall += time;
        self.phases.files += time;
    }

    /// Creates a run over the clips of objects, with the reports about their files.
    #[cfg(feature = "shards")]
    pub(crate) fn of_clips(clips: Vec<Clips>, reports: Vec<Report>, inputs: &[Input], options: &Options) -> CompileRun {
        let mut of_keys = Vec::new();
        key::check(inputs, &mut of_keys);
        of_keys.iter_mut().for_each(|report| options.apply_levels(report));
        of_keys.extend(reports);
        CompileRun { clips, reports: of_keys, ..CompileRun::default() }
    }

    /// Adds earlier reports.
    #[cfg(feature = "shards")]
    pub(crate) fn add_reports(&mut self, reports: Vec<Report>) {
        self.reports.extend(reports);
    }

    /// Makes an object from the clips: a bank with their own texts, and the section that `export` makes from the
    /// reports and the locales.
    #[cfg(feature = "shards")]
    pub(crate) fn object(
        mut self,
        inputs: &[Input],
        options: &Options,
        export: impl FnOnce(&[Report], &[Box<str>]) -> Vec<u8>,
    ) -> Compiled {
        if self.has_errors() {
            return self.finish(None);
        }
        let tags = Clips::join_locales(&mut self.clips);
        let clips = Clips::by_key(&self.clips);
        let localised = localise::own(&tags, options);
        let beside = BankExtras { export: export(&self.reports, &tags), ..BankExtras::of(options) };
        let layout = Layout::new(&clips, &localised, &Dubs::default(), beside);
        drop((clips, localised));
        let batches = std::mem::take(&mut self.clips);
        let bank = layout.and_then(|layout| layout.fill(batches)).map_err(|report| in_file(report, inputs));
        match bank.and_then(|bank| verify::verify(&bank).map(|()| bank)) {
            Ok(bank) => self.finish(Some(bank)),
            Err(report) => self.fail(report),
        }
    }

    /// Returns the number of clips made from their files.
    #[cfg(feature = "cache")]
    pub(crate) fn clip_count(&self) -> usize {
        self.clips.iter().map(Clips::count).sum()
    }

    /// Returns the clips made from their files, sorted by key.
    #[cfg(feature = "cache")]
    pub(crate) fn changed_clips(&self) -> Vec<Clip<'_>> {
        Clips::by_key(&self.clips)
    }

    /// Adds the clips of a bank below this one.
    pub(crate) fn keep(&mut self, mut kept: KeptClips) {
        self.clips.push(std::mem::take(&mut kept.clips));
        self.kept = Some((self.clips.len() - 1, kept));
    }

    /// Compares dubs with their originals. Dubs with diagnostics are read again in the next run, so that these are
    /// reported again.
    #[must_use]
    pub(crate) fn compare_dubs(mut self, inputs: &[Input], options: &Options) -> CompileRun {
        let no_dubs = KeptDubs::default();
        let kept = self.kept.as_ref().map_or(&no_dubs, |(_, kept)| &kept.dubs);
        let reports = dubs::compare(&self.clips, inputs, options, kept);
        #[cfg(feature = "cache")]
        self.reported_dubs.extend(reports.iter().map(|(index, _)| *index));
        self.reports.extend(reports.into_iter().map(|(_, report)| report));
        self
    }

    pub(crate) fn has_errors(&self) -> bool {
        lipz_diagnostics::reports::have_errors(&self.reports)
    }

    /// Makes a bank from the clips, and returns it only if `finish` accepts it.
    pub(crate) fn make(
        mut self,
        inputs: &[Input],
        options: &Options,
        finish: impl FnOnce(&[u8]) -> Result<(), Report> + Send,
    ) -> Compiled {
        if self.has_errors() {
            return self.finish(None);
        }
        let layout = self.lay_out(options);
        let start = Instant::now();
        let batches = std::mem::take(&mut self.clips);
        let bank = layout.and_then(|layout| layout.fill(batches)).map_err(|report| in_file(report, inputs));
        self.phases.lower += start.elapsed();
        self.conclude(bank, options, finish)
    }

    /// Lays out the bank of the clips. The path of a report may be the key of a clip.
    fn lay_out(&mut self, options: &Options) -> Result<Layout, Report> {
        let start = Instant::now();
        let tags = Clips::join_locales(&mut self.clips);
        let clips = Clips::by_key(&self.clips);
        let no_dubs = KeptDubs::default();
        let dubs = Dubs::find(&clips, options, self.kept.as_ref().map_or(&no_dubs, |(_, kept)| &kept.dubs));
        let mut localised = localise::localise(&clips, &tags, &dubs, options);
        let mut beside = BankExtras::of(options);
        if let Some((batch, kept)) = &mut self.kept {
            kept.restore(*batch, &clips, &tags, &mut localised);
            if beside.babble.is_empty() {
                beside.babble = std::mem::take(&mut kept.babble);
            }
            if beside.faces.is_empty() {
                beside.faces = std::mem::take(&mut kept.faces);
            }
        }
        self.phases.localise = start.elapsed();
        let start = Instant::now();
        let layout = Layout::new(&clips, &localised, &dubs, beside);
        self.phases.lower = start.elapsed();
        layout
    }

    /// Lays out the bank of the clips and calls `write` with the layout and the clips. `write` also receives a
    /// [`Check`], which must succeed for the bank to be kept. `name` replaces the key of a clip in the path of a report
    /// with the name of its file.
    pub(crate) fn write<T>(
        mut self,
        options: &Options,
        name: impl FnOnce(Report, &[Clips]) -> Report,
        write: impl FnOnce(&Layout, Vec<Clips>, &mut Check<'_>) -> Result<T, Report>,
    ) -> Compiled<T> {
        if self.has_errors() {
            return self.finish(None);
        }
        let layout = self.lay_out(options).map_err(|report| name(report, &self.clips));
        let start = Instant::now();
        let mut clips = std::mem::take(&mut self.clips);
        // The layout has its own names.
        clips.iter_mut().for_each(Clips::drop_names);
        let written = layout.and_then(|layout| {
            let mut check = || {
                let tables = layout.tables()?;
                verify::verify_tables(&tables)?;
                self.judge(&tables, options)
            };
            write(&layout, clips, &mut check)
        });
        self.phases.finish = start.elapsed();
        match written {
            Ok(written) => self.finish(Some(written)),
            Err(report) => self.fail(report),
        }
    }

    /// Ends the run with a bank, if the project's requirements and `finish` accept it.
    pub(crate) fn conclude(
        mut self,
        bank: Result<Vec<u8>, Report>,
        options: &Options,
        finish: impl FnOnce(&[u8]) -> Result<(), Report> + Send,
    ) -> Compiled {
        let start = Instant::now();
        let finished = bank.and_then(|bank| {
            self.judge(&bank, options)?;
            finish(&bank).map(|()| bank)
        });
        self.phases.finish = start.elapsed();
        match finished {
            Ok(bank) => self.finish(Some(bank)),
            Err(report) => self.fail(report),
        }
    }

    /// Checks the texts of a bank against the project's requirements.
    fn judge(&mut self, bank: &[u8], options: &Options) -> Result<(), Report> {
        let texts = TextFacts::of(bank, options);
        texts.check_coverage(options)?;
        self.expect(&texts, options)
    }

    /// Reports packed locales that the bank lacks, and locales that do not fall back to others of their language.
    ///
    /// # Errors
    /// If these are errors in the project.
    pub(crate) fn expect(&mut self, texts: &TextFacts, options: &Options) -> Result<(), Report> {
        let report = texts.judged(options);
        if report.has_errors() {
            return Err(report);
        }
        self.reports.push(report);
        Ok(())
    }

    /// Ends the run with this diagnostic.
    pub(crate) fn fail<B>(mut self, report: Report) -> Compiled<B> {
        self.reports.push(report);
        self.finish(None)
    }

    /// Ends the run with this bank.
    pub(crate) fn finish<B>(mut self, bank: Option<B>) -> Compiled<B> {
        lipz_diagnostics::reports::sort(&mut self.reports);
        Compiled { bank, reports: self.reports, recalled: self.recalled, phases: self.phases, ..Compiled::default() }
    }
}

/// Replaces the key of a clip in the path of a report with the name of the file.
pub(crate) fn in_file(mut report: Report, inputs: &[Input]) -> Report {
    if let Some(input) = inputs.iter().find(|input| input.key == report.source.path) {
        report.source.path = input.name();
    }
    report
}
