//! One file: read, parsed, checked, with the time that each takes.

use super::Phases;
use super::read::FileReader;
use crate::clip::ClipData;
use crate::{Content, Input, Options, Report, check, source_record};
use lipz::{Diagnostic, Source};
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

/// Reads, parses and checks one file.
pub(super) fn one_file(
    input: &Input,
    options: &Options,
    reader: &mut FileReader,
    clock: &Clock,
) -> (Option<ClipData>, Option<Report>) {
    let mut lap = Lap { last: Instant::now() };
    let bytes = match &input.content {
        Content::Bytes(bytes) => bytes.as_slice(),
        Content::File(path) => match reader.read(path) {
            Ok(bytes) => bytes,
            Err(finding) => return (None, Some(Report::about(&input.name, finding))),
        },
    };
    lap.add_to(&clock.read);
    let mut parsed = lipz::parse(bytes);
    lap.add_to(&clock.parse);
    let clip = parsed.document.as_ref().and_then(|document| {
        let mut clip = check::check(document, options, &mut parsed.diagnostics)?;
        clip.key.clone_from(&input.key);
        if !options.strip {
            clip.source = source_record::encode(document, &clip);
        }
        Some(clip)
    });
    lap.add_to(&clock.check);
    if parsed.diagnostics.is_empty() {
        return (clip, None);
    }
    parsed.diagnostics.sort_by_key(Diagnostic::start);
    let text = String::from_utf8_lossy(bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes)).into_owned();
    let source = Source { path: input.name.clone(), text };
    (clip, Some(Report { source, diagnostics: parsed.diagnostics }))
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
