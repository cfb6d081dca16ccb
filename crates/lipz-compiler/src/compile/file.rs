//! What one thread does: it reads, parses and checks one file after another, and takes the time.

use super::Phases;
use super::read::FileReader;
use crate::clip::{ClipData, Clips, Locales};
use crate::{Content, Input, Options, Report, check, convert, levels, source_record};
use lipz::{Diagnostic, Document, Level};
use std::time::{Duration, Instant};

/// What a thread needs to make clips of files, and what it has made of them.
#[derive(Default)]
pub(super) struct Worker {
    reader: FileReader,
    clip: ClipData,
    pub(super) clips: Clips,
    pub(super) reports: Vec<Report>,
    /// The time of reading, parsing and checking.
    pub(super) phases: Phases,
    lap: Lap,
}

impl Worker {
    /// Reads, parses and checks one file.
    pub(super) fn file(&mut self, input: &Input, options: &Options) {
        let bytes = match &input.content {
            Content::Bytes { bytes, .. } => bytes.as_slice(),
            Content::File(path) => match self.reader.read(path) {
                Ok(bytes) => bytes,
                Err(report) => return self.reports.push(report),
            },
        };
        self.phases.read += self.lap.time();
        let lipz::Parsed { document, mut diagnostics } = lipz::parse(bytes);
        self.phases.parse += self.lap.time();
        match document {
            Some(document) => {
                if make_clip(&document, options, &mut self.clips.locales, &mut self.clip, &mut diagnostics) {
                    self.clips.push(&input.key, &self.clip);
                }
            }
            None => levels::apply(&options.levels, &mut diagnostics),
        }
        self.phases.check += self.lap.time();
        if !diagnostics.is_empty() {
            diagnostics.sort_by_key(Diagnostic::start);
            self.reports.push(Report::of_file(input.name(), bytes, diagnostics));
        }
    }
}

/// Makes `clip` the one that `document` describes, converted if the project asks for that; false if there
/// are errors, and the clip then of no use.
fn make_clip(
    document: &Document<'_>,
    options: &Options,
    locales: &mut Locales,
    clip: &mut ClipData,
    diagnostics: &mut Vec<Diagnostic>,
) -> bool {
    check::check(document, options, locales, clip, diagnostics);
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

/// Whether a finding is an error at the project's levels, which the findings get.
fn has_errors(options: &Options, diagnostics: &mut Vec<Diagnostic>) -> bool {
    levels::apply(&options.levels, diagnostics);
    diagnostics.iter().any(|finding| finding.level == Level::Error)
}

/// A stopwatch that starts again at each reading.
struct Lap {
    last: Instant,
}

impl Default for Lap {
    fn default() -> Lap {
        Lap { last: Instant::now() }
    }
}

impl Lap {
    fn time(&mut self) -> Duration {
        let now = Instant::now();
        let time = now - self.last;
        self.last = now;
        time
    }
}
