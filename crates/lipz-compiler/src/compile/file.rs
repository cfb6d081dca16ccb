//! What one thread does: it reads, parses and checks one file after another, and takes the time.

use super::read::FileReader;
use super::stamped::FileStamps;
use super::{Lint, Phases};
use crate::cache::{Cache, CachedFile, Look, Stamp};
use crate::check::{CleanFiles, Spoken};
use crate::clip::{Batches, ClipData, Locales};
use crate::options::FileOptions;
use crate::{Content, Input, Options, check, convert, source_record};
use lipz_diagnostics::{Diagnostic, Report, Severity};
use lipz_file::Document;
use std::time::{Duration, Instant};

/// What a thread needs to make clips of files, and what it has made of them.
pub(super) struct Worker<'o> {
    options: FileOptions<'o>,
    reader: FileReader,
    clean: CleanFiles<'o>,
    lint: Option<&'o Lint<'o>>,
    pub(super) batch: Batch,
    pub(super) reports: Vec<Report>,
    /// What the lint found.
    pub(super) linted: Vec<Report>,
    /// The time of recalling, reading, parsing and checking.
    pub(super) phases: Phases,
    stopwatch: Stopwatch,
}

/// The clips that a thread has batch.
#[derive(Default)]
pub(super) struct Batch {
    /// Room for the next one.
    clip: ClipData,
    pub(super) clips: Batches,
    /// What a cache should know of their files.
    pub(super) stamped: FileStamps,
    /// What it needs to look at files.
    look: Look,
}

impl<'o> Worker<'o> {
    pub(super) fn new(options: &'o Options, lint: Option<&'o Lint<'o>>) -> Worker<'o> {
        Worker {
            options: FileOptions::new(options),
            reader: FileReader::default(),
            clean: CleanFiles::new(options),
            lint,
            batch: Batch::default(),
            reports: Vec::new(),
            linted: Vec::new(),
            phases: Phases::default(),
            stopwatch: Stopwatch::default(),
        }
    }

    /// Does some files one after the other, of which the first has number `first`.
    pub(super) fn files(&mut self, first: usize, inputs: &[Input], cache: Option<&Cache<'_>>) {
        // The clock is read where a file takes time, and otherwise once for all of them.
        self.stopwatch.time();
        for (index, input) in (first..).zip(inputs) {
            self.file(index, input, cache);
        }
        self.phases.recall += self.stopwatch.time();
    }

    /// Finds the clip of file number `index` in the old bank, or reads, parses and checks the file.
    fn file(&mut self, index: usize, input: &Input, cache: Option<&Cache<'_>>) {
        let batch = &mut self.batch;
        let seen = cache.and_then(|cache| cache.file(index, input, &mut batch.look, &mut self.reader));
        if let Some(seen) = &seen
            && let Some(stamp) = seen.unread()
        {
            batch.found(index, seen, stamp);
            batch.stamped.unread += 1;
            return;
        }
        if cache.is_some() {
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
        let stamped = seen.map(|seen| (seen.read(bytes), seen));
        if let Some(((stamp, true), seen)) = &stamped {
            batch.found(index, seen, *stamp);
            self.phases.recall += self.stopwatch.time();
            return;
        }
        let mut stamped = stamped.map(|((stamp, _), seen)| (index as u32, seen.name(), stamp));
        if let Some(lint) = self.lint {
            let linted = lint(input, bytes);
            batch.stamped.marked += usize::from(linted.is_marked);
            stamped = stamped.filter(|_| linted.report.is_none());
            stamped.iter_mut().for_each(|(.., stamp)| stamp.mark(linted.is_marked));
            self.linted.extend(linted.report);
        }
        if self.clean.clip(bytes, batch.clips.locales(), &mut batch.clip) {
            batch.clips.push(&input.key, &batch.clip);
            batch.stamped.files.extend(stamped);
            self.phases.parse += self.stopwatch.time();
            return;
        }
        let lipz_file::Parsed { document, mut diagnostics, fragment } = lipz_file::parse(bytes);
        self.phases.parse += self.stopwatch.time();
        let options = self.options.of(|| input.name());
        let is_made = match document {
            Some(document) => make_clip(
                &document,
                options,
                Spoken::of(&input.key, options),
                batch.clips.locales(),
                &mut batch.clip,
                &mut diagnostics,
            ),
            None => {
                fragment.iter().for_each(|fragment| check::fragment(fragment, options, &mut diagnostics));
                options.levels.apply(&mut diagnostics);
                false
            }
        };
        if is_made {
            batch.clips.push(&input.key, &batch.clip);
        }
        self.phases.check += self.stopwatch.time();
        if is_made && diagnostics.is_empty() {
            batch.stamped.files.extend(stamped);
        }
        if !diagnostics.is_empty() {
            diagnostics.sort_by_key(Diagnostic::start);
            self.reports.push(Report::from_bytes(input.name(), bytes, diagnostics));
        }
    }
}

impl Batch {
    /// Remembers that the clip of input number `index` is in the old bank.
    fn found(&mut self, index: usize, seen: &CachedFile<'_>, stamp: Stamp) {
        self.stamped.marked += usize::from(stamp.is_marked());
        self.stamped.files.push((index as u32, seen.name(), stamp));
        self.stamped.recalled.push(index as u32);
    }
}

/// Makes `clip` the one that `document` describes, converted if the project asks for that; false if there
/// are errors, and the clip then of no use.
fn make_clip(
    document: &Document<'_>,
    options: &Options,
    spoken: Spoken<'_>,
    locales: &mut Locales,
    clip: &mut ClipData,
    diagnostics: &mut Vec<Diagnostic>,
) -> bool {
    check::check(document, options, spoken, locales, clip, diagnostics);
    if has_errors(options, diagnostics) {
        return false;
    }
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

/// Whether a diagnostic is an error at the project's levels, which the diagnostics get.
fn has_errors(options: &Options, diagnostics: &mut Vec<Diagnostic>) -> bool {
    options.levels.apply(diagnostics);
    diagnostics.iter().any(|diagnostic| diagnostic.severity == Severity::Error)
}

/// A stopwatch that starts again at each reading.
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
