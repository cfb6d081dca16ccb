//! The work of one thread: it reads, parses and checks one file after another, and measures the time.

use super::earlier_run::{EarlierFiles, EarlierRun, RecalledClip};
use super::{Lint, Phases};
use crate::bank::bake;
use crate::check::{self, CleanFiles, ClipSpeech, convert};
use crate::clip::{Batches, ClipData, Locales, source_record};
use crate::files::FileReader;
use crate::project::Options;
use crate::project::options::FileOptions;
use crate::sources::{Content, Input};
use lipz_diagnostics::{Diagnostic, Report, Severity};
use lipz_file::Document;
use std::time::{Duration, Instant};

/// The resources of a thread for making clips from files, and its results.
pub(super) struct Worker<'o> {
    options: FileOptions<'o>,
    reader: FileReader,
    earlier: Option<Box<dyn EarlierFiles + 'o>>,
    clean: CleanFiles<'o>,
    lint: Option<&'o Lint<'o>>,
    /// A buffer for the next clip.
    clip: ClipData,
    pub(super) clips: Batches,
    /// The number of clips in the bank of the earlier run instead.
    pub(super) recalled: usize,
    /// The number of files that the lint counts.
    pub(super) marked: usize,
    pub(super) reports: Vec<Report>,
    /// The reports of the lint.
    pub(super) linted: Vec<Report>,
    /// The time for recalling, reading, parsing and checking.
    pub(super) phases: Phases,
    stopwatch: Stopwatch,
}

impl<'o> Worker<'o> {
    pub(super) fn new(
        options: &'o Options,
        lint: Option<&'o Lint<'o>>,
        earlier: Option<&'o dyn EarlierRun>,
    ) -> Worker<'o> {
        Worker {
            options: FileOptions::new(options),
            reader: FileReader::default(),
            earlier: earlier.map(EarlierRun::for_thread),
            clean: CleanFiles::new(options),
            lint,
            clip: ClipData::default(),
            clips: Batches::default(),
            recalled: 0,
            marked: 0,
            reports: Vec::new(),
            linted: Vec::new(),
            phases: Phases::default(),
            stopwatch: Stopwatch::default(),
        }
    }

    /// Processes some files in sequence, the first of which has number `first`.
    pub(super) fn files(&mut self, first: usize, inputs: &[Input]) {
        // The clock is read for files that take time, and otherwise once for all of them.
        self.stopwatch.time();
        for (index, input) in (first..).zip(inputs) {
            self.file(index, input);
        }
        self.phases.recall += self.stopwatch.time();
    }

    /// Finds the clip of file number `index` in the old bank, or reads, parses and checks the file.
    fn file(&mut self, index: usize, input: &Input) {
        if let Some(earlier) = &mut self.earlier {
            if let Some(clip) = earlier.look_at(index, input, &mut self.reader) {
                self.recall(clip);
                return;
            }
            self.phases.recall += self.stopwatch.time();
        }
        let bytes = match &input.content {
            Content::Bytes { bytes, .. } => bytes.as_slice(),
            Content::File(path) => match self.reader.read(path) {
                Ok(bytes) => bytes,
                Err(report) => return self.reports.push(report),
            },
        };
        self.phases.read += self.stopwatch.time();
        if let Some(clip) = self.earlier.as_mut().and_then(|earlier| earlier.with_bytes(bytes)) {
            self.recall(clip);
            self.phases.recall += self.stopwatch.time();
            return;
        }
        let mut earlier = self.earlier.as_mut();
        let mut is_marked = false;
        if let Some(lint) = self.lint {
            let linted = lint(input, bytes);
            is_marked = linted.is_marked;
            self.marked += usize::from(is_marked);
            earlier = earlier.filter(|_| linted.report.is_none());
            self.linted.extend(linted.report);
        }
        if self.clean.clip(bytes, self.clips.locales(), &mut self.clip) {
            self.clips.push(&input.key, &self.clip);
            earlier.into_iter().for_each(|earlier| earlier.remember(is_marked));
            self.phases.parse += self.stopwatch.time();
            return;
        }
        let lipz_file::ParsedFile { document, mut diagnostics, fragment } = lipz_file::parse(bytes);
        self.phases.parse += self.stopwatch.time();
        let options = self.options.of(|| input.name());
        let is_made = match document {
            Some(document) => {
                make_clip(&document, &input.key, options, self.clips.locales(), &mut self.clip, &mut diagnostics)
            }
            None => {
                fragment.iter().for_each(|fragment| check::fragment(fragment, options, &mut diagnostics));
                options.levels.apply(&mut diagnostics);
                false
            }
        };
        if is_made {
            self.clips.push(&input.key, &self.clip);
        }
        self.phases.check += self.stopwatch.time();
        if is_made && diagnostics.is_empty() {
            earlier.into_iter().for_each(|earlier| earlier.remember(is_marked));
        }
        if !diagnostics.is_empty() {
            diagnostics.sort_by_key(Diagnostic::start);
            self.reports.push(Report::from_bytes(input.name(), bytes, diagnostics));
        }
    }

    fn recall(&mut self, clip: RecalledClip) {
        self.recalled += 1;
        self.marked += usize::from(clip.is_marked);
    }

    /// Ends the work. The earlier run is not queried again.
    pub(super) fn finish(&mut self) {
        self.earlier.take().into_iter().for_each(EarlierFiles::finish);
    }
}

/// Sets `clip` to the contents of `document`, converted if the project requires it. Returns false if there are errors,
/// which leave the clip unusable.
fn make_clip(
    document: &Document<'_>,
    key: &str,
    options: &Options,
    locales: &mut Locales,
    clip: &mut ClipData,
    diagnostics: &mut Vec<Diagnostic>,
) -> bool {
    check::check(document, options, ClipSpeech::of(key, options), locales, clip, diagnostics);
    if has_errors(options, diagnostics) {
        return false;
    }
    bake(key, clip, options);
    if let Some(packed) = &options.locales {
        clip.keep_texts(packed, locales, options);
    }
    let converted = options.viseme_type.and_then(|to| convert::convert_clip(document, clip, to, diagnostics));
    if has_errors(options, diagnostics) {
        return false;
    }
    if !options.strip {
        source_record::encode(converted.as_ref().unwrap_or(document), options, locales, clip);
    }
    true
}

/// Whether a diagnostic is an error at the project's levels, which are applied to the diagnostics.
fn has_errors(options: &Options, diagnostics: &mut Vec<Diagnostic>) -> bool {
    options.levels.apply(diagnostics);
    diagnostics.iter().any(|diagnostic| diagnostic.severity == Severity::Error)
}

/// A stopwatch that restarts at each reading.
struct Stopwatch {
    last: Instant,
}

impl Default for Stopwatch {
    fn default() -> Stopwatch {
        Stopwatch { last: Instant::now() }
    }
}

impl Stopwatch {
    fn time(&mut self) -> Duration {
        let now = Instant::now();
        let time = now - self.last;
        self.last = now;
        time
    }
}
