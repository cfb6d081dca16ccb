//! One run: files are read on all threads, then a bank is made of their clips.

use super::file::Worker;
use super::requirements::Texts;
use super::stamped::FileStamps;
use super::{Compiled, Lint, Phases, Progress};
use crate::cache::Cache;
#[cfg(feature = "cache")]
use crate::clip::Clip;
use crate::clip::Clips;
use crate::dubs::{self, Dubs, KeptDubs};
use crate::layers::Kept;
use crate::lower::{Beside, Layout};
use crate::{Input, Options, key, localise, parallel};
use lipz_diagnostics::Report;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// Files that a thread takes at a time: few enough that all threads end together, and so many that those of
/// a folder stay together.
const FILES_AT_ONCE: usize = 64;

/// What is known after the files are read.
#[derive(Default)]
pub(crate) struct Run {
    clips: Vec<Clips>,
    reports: Vec<Report>,
    /// What a lint found.
    pub(crate) linted: Vec<Report>,
    /// Whether nothing is reported about keys.
    #[cfg(feature = "cache")]
    pub(crate) are_keys_fine: bool,
    pub(crate) phases: Phases,
    /// Clips of a bank below this one, and in which batch they are.
    kept: Option<(usize, Kept)>,
    /// What a cache should know of the files, if there is one.
    pub(crate) stamped: FileStamps,
}

/// Verifies the tables of a bank, and judges its texts by what the project asks for.
pub(crate) type Check<'c> = dyn FnMut() -> Result<(), Report> + Send + 'c;

impl Run {
    /// Reads, parses and checks `inputs`, or finds that their clips are in the old bank.
    pub(crate) fn read(inputs: &[Input], options: &Options, cache: Option<&Cache<'_>>, progress: &Progress<'_>) -> Run {
        Run::read_with(inputs, options, cache, None, progress)
    }

    /// The same, and asks `lint` about each file that is read.
    pub(crate) fn read_with(
        inputs: &[Input],
        options: &Options,
        cache: Option<&Cache<'_>>,
        lint: Option<&Lint<'_>>,
        progress: &Progress<'_>,
    ) -> Run {
        let start = Instant::now();
        let mut run = Run::default();
        let next = AtomicUsize::new(0);
        let read = || {
            parallel::workers(options.threads, || {
                let mut worker = Worker::new(options, lint);
                loop {
                    let first = next.fetch_add(FILES_AT_ONCE, Ordering::Relaxed);
                    let Some(behind) = inputs.get(first..).filter(|behind| !behind.is_empty()) else { return worker };
                    let files = behind.len().min(FILES_AT_ONCE);
                    worker.files(first, &behind[..files], cache);
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
            run.clips.extend(worker.batch.clips.into_all());
            run.reports.extend(worker.reports);
            run.linted.extend(worker.linted);
            run.stamped.append(worker.batch.stamped);
            run.phases.recall += worker.phases.recall;
            run.phases.read += worker.phases.read;
            run.phases.parse += worker.phases.parse;
            run.phases.check += worker.phases.check;
        }
        run.stamped.sort();
        run.phases.files = start.elapsed();
        run
    }

    /// Adds clips of the old bank, and the time that it took to recall them.
    #[cfg(feature = "cache")]
    pub(crate) fn add(&mut self, recalled: Vec<Clips>, time: std::time::Duration) {
        self.clips.extend(recalled);
        self.phases.recall += time;
        self.phases.files += time;
    }

    /// A run over the clips of objects, with what was reported about their files.
    #[cfg(feature = "shards")]
    pub(crate) fn of_clips(clips: Vec<Clips>, reports: Vec<Report>, inputs: &[Input], options: &Options) -> Run {
        let mut of_keys = Vec::new();
        key::check(inputs, &mut of_keys);
        of_keys.iter_mut().for_each(|report| options.apply_levels(report));
        of_keys.extend(reports);
        Run { clips, reports: of_keys, ..Run::default() }
    }

    /// Adds what was found before.
    #[cfg(feature = "shards")]
    pub(crate) fn add_reports(&mut self, reports: Vec<Report>) {
        self.reports.extend(reports);
    }

    /// Makes an object of the clips: a bank with their own texts, and the section that `export` makes of what was
    /// reported and of the locales.
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
        let beside = Beside { export: export(&self.reports, &tags), ..Beside::of(options) };
        let layout = Layout::new(&clips, &localised, &Dubs::default(), beside);
        drop((clips, localised));
        let batches = std::mem::take(&mut self.clips);
        let bank = layout.and_then(|layout| layout.fill(batches)).map_err(|report| in_file(report, inputs));
        match bank.and_then(|bank| super::verify(&bank).map(|()| bank)) {
            Ok(bank) => self.finish(Some(bank)),
            Err(report) => self.fail(report),
        }
    }

    /// Number of clips that were made of their files.
    #[cfg(feature = "cache")]
    pub(crate) fn clip_count(&self) -> usize {
        self.clips.iter().map(Clips::count).sum()
    }

    /// The clips that were made of their files, in the order of their keys.
    #[cfg(feature = "cache")]
    pub(crate) fn changed_clips(&self) -> Vec<Clip<'_>> {
        Clips::by_key(&self.clips)
    }

    /// Adds the clips of a bank below this one.
    pub(crate) fn keep(&mut self, mut kept: Kept) {
        self.clips.push(std::mem::take(&mut kept.clips));
        self.kept = Some((self.clips.len() - 1, kept));
    }

    /// Compares dubs with their originals. A dub with diagnostics is read again in the next run, so that they are reported
    /// again.
    #[must_use]
    pub(crate) fn compare_dubs(mut self, inputs: &[Input], options: &Options) -> Run {
        let no_dubs = KeptDubs::default();
        let kept = self.kept.as_ref().map_or(&no_dubs, |(_, kept)| &kept.dubs);
        for (index, report) in dubs::compare(&self.clips, inputs, options, kept) {
            self.stamped.files.retain(|(stamped, ..)| *stamped != index);
            self.reports.push(report);
        }
        self
    }

    pub(crate) fn has_errors(&self) -> bool {
        lipz_diagnostics::reports::have_errors(&self.reports)
    }

    /// Makes a bank of the clips; returns it only if `finish` accepts it.
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

    /// Lays out the bank of the clips. A report may have the key of a clip for a path.
    fn lay_out(&mut self, options: &Options) -> Result<Layout, Report> {
        let start = Instant::now();
        let tags = Clips::join_locales(&mut self.clips);
        let clips = Clips::by_key(&self.clips);
        let no_dubs = KeptDubs::default();
        let dubs = Dubs::find(&clips, options, self.kept.as_ref().map_or(&no_dubs, |(_, kept)| &kept.dubs));
        let mut localised = localise::localise(&clips, &tags, &dubs, options);
        let mut beside = Beside::of(options);
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

    /// Lays out the bank of the clips and has `write` write it, of the layout and the clips. It is handed a [`Check`], too, without
    /// whose consent there must be no bank. `name` gives a report that has the key of a clip for a path the name of its file.
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
        // The layout has its own.
        clips.iter_mut().for_each(Clips::drop_names);
        let written = layout.and_then(|layout| {
            let mut check = || {
                let tables = layout.tables()?;
                super::verify_tables(&tables)?;
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

    /// Ends the run with a bank, if the project and `finish` accept it.
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

    /// Judges the texts of a bank by what the project asks for.
    fn judge(&mut self, bank: &[u8], options: &Options) -> Result<(), Report> {
        let texts = Texts::of(bank, options);
        texts.are_enough(options)?;
        self.expect(&texts, options)
    }

    /// Reports the locales that the project packs and the bank does not have, and those that do not fall back to
    /// others of their language.
    ///
    /// # Errors
    /// If they are errors in the project.
    pub(crate) fn expect(&mut self, texts: &Texts, options: &Options) -> Result<(), Report> {
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
        let recalled = self.stamped.recalled.len();
        Compiled { bank, reports: self.reports, recalled, phases: self.phases, ..Compiled::default() }
    }
}

/// The report with the name of the file, where it has the key of a clip for a path.
pub(crate) fn in_file(mut report: Report, inputs: &[Input]) -> Report {
    if let Some(input) = inputs.iter().find(|input| input.key == report.source.path) {
        report.source.path = input.name();
    }
    report
}
