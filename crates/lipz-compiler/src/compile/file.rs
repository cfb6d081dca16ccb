//! One file: read, parsed, checked, with the time that each takes.

use super::Phases;
use crate::clip::ClipData;
use crate::{Content, Input, Options, Report, check, convert, levels, source_record};
use lipz::{Code, Diagnostic, Document, Level};
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Nanoseconds per phase, summed over threads.
#[derive(Default)]
pub(super) struct Clock {
    read: AtomicU64,
    parse: AtomicU64,
    check: AtomicU64,
}

impl Clock {
    /// The phases of which this is the time.
    pub(super) fn phases(&self) -> Phases {
        let time = |sum: &AtomicU64| Duration::from_nanos(sum.load(Ordering::Relaxed));
        Phases { read: time(&self.read), parse: time(&self.parse), check: time(&self.check), ..Phases::default() }
    }
}

/// Reads, parses and checks one file. `buffer` is kept between the files of a thread.
pub(super) fn one_file(
    input: &Input,
    options: &Options,
    buffer: &mut Vec<u8>,
    clock: &Clock,
) -> (Option<ClipData>, Option<Report>) {
    let mut lap = Lap { last: Instant::now() };
    let bytes = match &input.content {
        Content::Bytes(bytes) => bytes.as_slice(),
        Content::File(path) => {
            buffer.clear();
            if let Some(finding) = read_file(path, buffer) {
                return (None, Some(Report::about(&input.name, finding)));
            }
            buffer.as_slice()
        }
    };
    lap.add_to(&clock.read);
    let mut parsed = lipz::parse(bytes);
    lap.add_to(&clock.parse);
    let clip = parsed.document.as_ref().and_then(|document| {
        let mut clip = checked(document, options, &mut parsed.diagnostics)?;
        clip.key.clone_from(&input.key);
        Some(clip)
    });
    lap.add_to(&clock.check);
    if parsed.diagnostics.is_empty() {
        return (clip, None);
    }
    parsed.diagnostics.sort_by_key(Diagnostic::start);
    (clip, Some(Report::of_file(&input.name, bytes, parsed.diagnostics)))
}

/// The clip that a document describes, converted if the project asks for that; `None` if there are
/// errors.
fn checked(document: &Document<'_>, options: &Options, diagnostics: &mut Vec<Diagnostic>) -> Option<ClipData> {
    let mut clip = check::check(document, options, diagnostics);
    if has_errors(options, diagnostics) {
        return None;
    }
    let converted = options.viseme_type.and_then(|to| convert::convert_clip(document, &mut clip, to, diagnostics));
    if has_errors(options, diagnostics) {
        return None;
    }
    if !options.strip {
        clip.source = source_record::encode(converted.as_ref().unwrap_or(document), &clip);
    }
    Some(clip)
}

/// Whether a finding is an error at the project's levels, which the findings get.
fn has_errors(options: &Options, diagnostics: &mut Vec<Diagnostic>) -> bool {
    levels::apply(&options.levels, diagnostics);
    diagnostics.iter().any(|finding| finding.level == Level::Error)
}

/// Bytes that are read without asking how many there are, which takes as long as to read them.
const SMALL_FILE: u64 = 1 << 16;

/// Reads a file into the empty `buffer`; a finding if that is not possible.
pub(crate) fn read_file(path: &Path, buffer: &mut Vec<u8>) -> Option<Diagnostic> {
    let limit = lipz::MAX_FILE_BYTES as u64;
    let read = File::open(path).and_then(|mut file| {
        file.by_ref().take(SMALL_FILE).read_to_end(buffer)?;
        let is_read = (buffer.len() as u64) < SMALL_FILE;
        if is_read || file.metadata()?.len() > limit {
            return Ok(is_read);
        }
        // Some files do not tell their length: one byte too many shows that they are too large.
        file.take(limit + 1 - SMALL_FILE).read_to_end(buffer).map(|_| true)
    });
    match read {
        Ok(true) => None,
        Ok(false) => Some(lipz::too_large()),
        Err(error) => Some(Diagnostic::new(Code::UnreadableFile, format!("the file cannot be read: {error}"))),
    }
}

/// A stopwatch that starts again at each reading.
struct Lap {
    last: Instant,
}

impl Lap {
    fn add_to(&mut self, sum: &AtomicU64) {
        let now = Instant::now();
        let elapsed = u64::try_from((now - self.last).as_nanos()).unwrap_or(u64::MAX);
        sum.fetch_add(elapsed, Ordering::Relaxed);
        self.last = now;
    }
}
