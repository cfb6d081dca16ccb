//! One rival with its file: checks, measurements and counts.

use crate::Failure;
use crate::corpus::{Corpus, Questions, frame_at};
use crate::heap;
use crate::rival::{File, Reader, Rival};
use cpu_time::ThreadTime;
use std::hint::black_box;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The number of queries between two readings of the clock.
const BATCH: usize = 1024;
/// The time for one kind of query in one round.
const SLICE: Duration = Duration::from_millis(5);
/// The length of a rendered frame, the step of the sweep.
const TICK_US: u32 = 16_667;
/// A rival that opens its file in less time opens it many times.
const FAST_OPEN: Duration = Duration::from_micros(100);
/// The number of times.
const OPENINGS: u32 = 1000;

/// The kinds of measurements.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Ask {
    Open,
    Validate,
    Find,
    Miss,
    Frame,
    Text,
    Event,
    Tick,
    Latency,
}

impl Ask {
    pub(crate) const ALL: [Ask; 9] =
        [Ask::Open, Ask::Validate, Ask::Find, Ask::Miss, Ask::Frame, Ask::Text, Ask::Event, Ask::Tick, Ask::Latency];

    /// The kinds of queries about clips.
    pub(crate) const QUERIES: [Ask; 7] =
        [Ask::Find, Ask::Miss, Ask::Frame, Ask::Text, Ask::Event, Ask::Tick, Ask::Latency];
}

/// A rival with its file.
pub(crate) trait Contestant {
    fn name(&self) -> &'static str;

    /// Returns the length of its file in bytes.
    fn file_bytes(&self) -> usize;

    /// Checks its answers against the corpus.
    fn check(&self, corpus: &Corpus, questions: &Questions) -> Result<(), Failure>;

    /// Returns the bytes on the heap that the opened file holds.
    fn heap_bytes(&self) -> Result<usize, Failure>;

    /// Makes `times` queries. Returns the number of answers: a sweep has many per clip.
    fn ask(&self, ask: Ask, at: Range<usize>) -> Result<usize, Failure>;

    /// Returns the nanoseconds of this thread's processor time per answer, which other programs do not affect. Queries
    /// start at number `cursor`, which advances.
    fn time(&self, ask: Ask, cursor: &mut usize) -> Result<f64, Failure> {
        if matches!(ask, Ask::Open | Ask::Validate) {
            let start = ThreadTime::now();
            self.ask(ask, 0..1)?;
            let once = start.elapsed();
            if once > FAST_OPEN {
                return Ok(once.as_nanos() as f64);
            }
            let start = ThreadTime::now();
            self.ask(ask, 0..OPENINGS as usize)?;
            return Ok(start.elapsed().as_nanos() as f64 / f64::from(OPENINGS));
        }
        let (start, mut answers) = (ThreadTime::now(), 0);
        while start.elapsed() < SLICE {
            answers += self.ask(ask, *cursor..*cursor + BATCH)?;
            *cursor = (*cursor + BATCH) % self.question_count();
        }
        Ok(start.elapsed().as_nanos() as f64 / answers as f64)
    }

    /// Returns the number of queries, a multiple of the batch.
    fn question_count(&self) -> usize;
}

/// A rival, its file, and the queries in its own numbers.
pub(crate) struct Entry<R: Rival> {
    file: &'static File,
    reader: R::Reader,
    questions: Questions,
    misses: Questions,
    locale: String,
}

impl<R: Rival> Entry<R> {
    /// Writes the file into `folder` and opens it.
    pub(crate) fn build(corpus: &Corpus, folder: &Path) -> Result<(), Failure> {
        R::build(corpus, &path(folder, R::NAME))
    }

    /// Opens the file in `folder`.
    pub(crate) fn open(folder: &Path, mut questions: Questions, locale: &str) -> Result<Box<dyn Contestant>, Failure> {
        let file = File::map(&path(folder, R::NAME))?;
        let reader = R::open_validated(file)?;
        for index in 0..questions.len() {
            questions.clips[index] = reader.find(questions.key(index)).ok_or("a clip was not found")?;
        }
        let misses = questions.misses();
        Ok(Box::new(Entry::<R> { file, reader, questions, misses, locale: locale.to_owned() }))
    }

    fn sum_open(
        &self,
        times: usize,
        open: impl Fn(&'static File) -> Result<R::Reader, Failure>,
    ) -> Result<usize, Failure> {
        for _ in 0..times {
            black_box(&open(black_box(self.file))?);
        }
        Ok(times)
    }

    #[inline(never)]
    fn find(&self, questions: &Questions, at: Range<usize>) -> u32 {
        at.filter_map(|index| self.reader.find(questions.key(index))).fold(0, u32::wrapping_add)
    }

    #[inline(never)]
    fn frame(&self, at: Range<usize>) -> u32 {
        let Questions { clips, times_us, .. } = &self.questions;
        let asked = std::iter::zip(&clips[at.clone()], &times_us[at]);
        let codes = asked.filter_map(|(&number, &time_us)| {
            let clip = self.reader.clip(number)?;
            Some(u32::from(self.reader.viseme(clip, time_us)))
        });
        codes.fold(0, u32::wrapping_add)
    }

    #[inline(never)]
    fn text(&self, at: Range<usize>) -> u32 {
        let Some(locale) = self.reader.locale(&self.locale) else { return 0 };
        let Questions { clips, times_us, .. } = &self.questions;
        let asked = std::iter::zip(&clips[at.clone()], &times_us[at]);
        let texts = asked.filter_map(|(&number, &time_us)| {
            let clip = self.reader.clip(number)?;
            self.reader.text(clip, locale, time_us, first_byte)
        });
        texts.fold(0, u32::wrapping_add)
    }

    #[inline(never)]
    fn event(&self, at: Range<usize>) -> u32 {
        let Questions { clips, times_us, .. } = &self.questions;
        let asked = std::iter::zip(&clips[at.clone()], &times_us[at]);
        let events = asked.filter_map(|(&number, &time_us)| {
            let clip = self.reader.clip(number)?;
            self.reader.event(clip, time_us, first_byte)
        });
        events.fold(0, u32::wrapping_add)
    }

    /// Reads viseme, subtitle and event for each rendered frame, from the start of a clip up to a time. Returns the
    /// number of rendered frames.
    #[inline(never)]
    fn sweep(&self, at: Range<usize>) -> usize {
        let Some(locale) = self.reader.locale(&self.locale) else { return 0 };
        let (mut shown, mut sum) = (0, 0_u32);
        for index in at {
            let Some(clip) = self.reader.clip(self.questions.clips[index]) else { continue };
            for time_us in (0..self.questions.times_us[index]).step_by(TICK_US as usize) {
                sum = sum.wrapping_add(self.reader.viseme(clip, time_us).into());
                sum = sum.wrapping_add(self.reader.text(clip, locale, time_us, first_byte).unwrap_or(0));
                sum = sum.wrapping_add(self.reader.event(clip, time_us, first_byte).unwrap_or(0));
                shown += 1;
            }
        }
        black_box(sum);
        shown
    }

    /// Finds a clip, its viseme and its subtitle. Each query depends on the answer before it, so that they cannot
    /// overlap in the processor.
    #[inline(never)]
    fn one_by_one(&self, at: Range<usize>) -> u32 {
        let Some(locale) = self.reader.locale(&self.locale) else { return 0 };
        let (mut sum, mut index) = (0_u32, at.start);
        let last = self.questions.len() - 1;
        for _ in at {
            let number = self.reader.find(self.questions.key(index)).unwrap_or(0);
            let Some(clip) = self.reader.clip(number) else { continue };
            let time_us = self.questions.times_us[index];
            let code = u32::from(self.reader.viseme(clip, time_us));
            // No code is 255, but the processor has to wait for the answer.
            let time_us = time_us + u32::from(code == 255);
            let text = self.reader.text(clip, locale, time_us, first_byte).unwrap_or(0);
            sum = sum.wrapping_add(text);
            index = (index + 1 + usize::from(text == u32::MAX)).min(last);
        }
        sum
    }
}

/// Reads a string, as a program would do.
#[inline]
fn first_byte(text: &str) -> u32 {
    text.len() as u32 + text.as_bytes().first().map_or(0, |byte| u32::from(*byte))
}

/// Returns the path of the file of the rival with this name.
fn path(folder: &Path, name: &str) -> PathBuf {
    folder.join(name.replace(|c: char| !c.is_ascii_alphanumeric(), "_"))
}

impl<R: Rival> Contestant for Entry<R> {
    fn name(&self) -> &'static str {
        R::NAME
    }

    fn file_bytes(&self) -> usize {
        self.file.map.len()
    }

    fn question_count(&self) -> usize {
        self.questions.len()
    }

    fn heap_bytes(&self) -> Result<usize, Failure> {
        let held = || heap::held_bytes() + R::foreign_heap_bytes();
        let before = held();
        let reader = R::open(self.file)?;
        let held = held().saturating_sub(before);
        drop(reader);
        Ok(held)
    }

    fn ask(&self, ask: Ask, at: Range<usize>) -> Result<usize, Failure> {
        let count = at.len();
        match ask {
            Ask::Open => return self.sum_open(count, R::open),
            Ask::Validate => return self.sum_open(count, R::open_validated),
            Ask::Find => _ = black_box(self.find(&self.questions, at)),
            Ask::Miss => _ = black_box(self.find(&self.misses, at)),
            Ask::Frame => _ = black_box(self.frame(at)),
            Ask::Text => _ = black_box(self.text(at)),
            Ask::Event => _ = black_box(self.event(at)),
            Ask::Tick => return Ok(self.sweep(at)),
            Ask::Latency => _ = black_box(self.one_by_one(at)),
        }
        Ok(count)
    }

    fn check(&self, corpus: &Corpus, questions: &Questions) -> Result<(), Failure> {
        let reader = &self.reader;
        let wrong = |key: &str, what: &str| Err(format!("{}: {what} of `{key}` is wrong", R::NAME).into());
        for (index, locale_tag) in (0..questions.len()).zip(corpus.bank.locales.iter().cycle()) {
            let expected = &corpus.bank.clips[questions.clips[index] as usize];
            let locale = reader.locale(locale_tag).ok_or("a locale was not found")?;
            let number = reader.find(questions.key(index)).ok_or("a clip was not found")?;
            let clip = reader.clip(number).ok_or("a number led to no clip")?;
            let time_us = questions.times_us[index];
            let frame = frame_at(expected.fps, time_us);
            if reader.viseme(clip, time_us) != expected.visemes.as_bytes()[frame] {
                return wrong(questions.key(index), "a frame");
            }
            let segment = expected.starts.partition_point(|&start| start as usize <= frame) - 1;
            let place = corpus.bank.locales.iter().position(|tag| tag == locale_tag).unwrap_or(0);
            let text = &expected.texts[place][segment];
            if reader.text(clip, locale, time_us, |found| found == text) != Some(true) {
                return wrong(questions.key(index), "a text");
            }
            let event = expected.events.get(segment).map_or("", String::as_str);
            if reader.event(clip, time_us, |found| found == event) != Some(true) {
                return wrong(questions.key(index), "an event");
            }
            if reader.find(self.misses.key(index)).is_some() {
                return wrong(self.misses.key(index), "the absence");
            }
            let behind_us = expected.visemes.len() as u32 * 1_000_000 / expected.fps + 1_000_000;
            if reader.viseme(clip, behind_us) != b'-' {
                return wrong(questions.key(index), "the rest behind the end");
            }
        }
        Ok(())
    }
}
