//! What one thread does: it reads, parses and checks one file after another, and takes the time.

use super::Phases;
use super::read::FileReader;
use crate::clip::{ClipData, Clips};
use crate::{Content, Input, Options, Report, check, source_record};
use lipz::{Diagnostic, Source};
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
            Content::Bytes(bytes) => bytes.as_slice(),
            Content::File(path) => match self.reader.read(path) {
                Ok(bytes) => bytes,
                Err(report) => return self.reports.push(report),
            },
        };
        self.phases.read += self.lap.time();
        let lipz::Parsed { document, mut diagnostics } = lipz::parse(bytes);
        self.phases.parse += self.lap.time();
        let locales = &mut self.clips.locales;
        if let Some(document) = document
            && check::check(&document, options, locales, &mut self.clip, &mut diagnostics)
        {
            if !options.strip {
                source_record::encode(&document, locales, &mut self.clip);
            }
            self.clips.push(&input.key, &self.clip);
        }
        self.phases.check += self.lap.time();
        if !diagnostics.is_empty() {
            diagnostics.sort_by_key(Diagnostic::start);
            let text = String::from_utf8_lossy(bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes)).into_owned();
            self.reports.push(Report { source: Source { path: input.name(), text }, diagnostics });
        }
    }
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
