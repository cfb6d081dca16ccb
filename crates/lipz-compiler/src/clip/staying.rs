//! Clips whose frames, texts and source records stay in the file of an object, until they are copied into a bank.

use super::ClipText;
use crate::cache::FileMeta;
use lipz_layout::TEXT_COUNT_BYTES;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

/// The file of an object, which was verified.
#[derive(Debug)]
pub(crate) struct ClipFile {
    path: PathBuf,
    /// Kept open, unless there are too many.
    file: Option<Mutex<File>>,
    /// What it looked like when it was verified.
    meta: FileMeta,
    /// Where the sections start that clips stay in.
    starts: SectionStarts,
    has_failed: AtomicBool,
}

/// Where frames, texts and source records start in a file.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SectionStarts {
    pub(crate) frames: usize,
    pub(crate) texts: usize,
    pub(crate) sources: usize,
}

/// Where the source record of a clip is among those of its file, and its hash.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct StayingSource {
    pub(crate) start: u32,
    pub(crate) end: u32,
    pub(crate) hash: u32,
}

/// A part of a clip in a file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StayingPart<'c> {
    file: &'c ClipFile,
    start: usize,
    end: usize,
    /// Where the count of a last text stands, which is no part of it.
    count: Option<usize>,
}

/// A stretch of a file that was read last: what is asked for next mostly is in it, too.
#[derive(Debug, Default)]
pub(crate) struct Window {
    start: usize,
    bytes: Vec<u8>,
    /// A part that stands before the stretch.
    before: Vec<u8>,
}

impl ClipFile {
    /// A file that looks like this, kept open in `file` or opened each time.
    pub(crate) fn new(path: PathBuf, file: Option<File>, meta: FileMeta, starts: SectionStarts) -> ClipFile {
        ClipFile { path, file: file.map(Mutex::new), meta, starts, has_failed: AtomicBool::new(false) }
    }

    pub(super) fn frames(&self, place: Range<usize>) -> StayingPart<'_> {
        self.part(self.starts.frames, place, None)
    }

    pub(super) fn source(&self, source: StayingSource) -> StayingPart<'_> {
        self.part(self.starts.sources, source.start as usize..source.end as usize, None)
    }

    /// A text of a clip, whose last segment starts so many bytes behind the first.
    pub(super) fn text(&self, text: &ClipText, last_start: usize) -> StayingPart<'_> {
        self.part(self.starts.texts, text.place(), text.is_counted().then_some(last_start))
    }

    fn part(&self, section: usize, place: Range<usize>, count: Option<usize>) -> StayingPart<'_> {
        StayingPart { file: self, start: section + place.start, end: section + place.end, count }
    }

    /// Whether all was read, and nobody has written to the file since it was verified.
    pub(crate) fn is_as_it_was(&self) -> bool {
        let metadata = match &self.file {
            Some(file) => file.lock().unwrap_or_else(PoisonError::into_inner).metadata(),
            None => self.path.metadata(),
        };
        !self.has_failed.load(Ordering::Relaxed) && metadata.ok().as_ref().and_then(FileMeta::new) == Some(self.meta)
    }

    /// Reads what starts at this offset; zeros if that is not possible, as [`is_as_it_was`](Self::is_as_it_was) then knows.
    fn read(&self, start: usize, bytes: &mut [u8]) {
        let mut read_from = |mut file: &File| -> io::Result<()> {
            file.seek(SeekFrom::Start(start as u64))?;
            file.read_exact(bytes)
        };
        let read = match &self.file {
            Some(file) => read_from(&file.lock().unwrap_or_else(PoisonError::into_inner)),
            None => File::open(&self.path).and_then(|file| read_from(&file)),
        };
        if read.is_err() {
            bytes.fill(0);
            self.has_failed.store(true, Ordering::Relaxed);
        }
    }
}

impl StayingPart<'_> {
    pub(super) fn length(&self) -> usize {
        self.end - self.start - self.count.map_or(0, |_| TEXT_COUNT_BYTES)
    }

    /// Where it stands: the address of its file, and the bytes there.
    pub(super) fn place(&self) -> (*const (), Range<usize>) {
        (std::ptr::from_ref(self.file).cast(), self.start..self.end)
    }

    pub(super) fn read(&self) -> Vec<u8> {
        let mut bytes = vec![0; self.end - self.start];
        self.file.read(self.start, &mut bytes);
        if let Some(count) = self.count {
            bytes.drain(count..count + TEXT_COUNT_BYTES);
        }
        bytes
    }
}

impl Window {
    /// A part in two pieces: what stands before a count, or all of it; and what stands behind. The window moves on by so many
    /// bytes at a time.
    pub(crate) fn pieces(&mut self, part: &StayingPart<'_>, at_once: usize) -> (&[u8], &[u8]) {
        let length = part.end - part.start;
        let bytes = if part.start < self.start {
            self.before.resize(length, 0);
            part.file.read(part.start, &mut self.before);
            &self.before
        } else {
            if part.end > self.start + self.bytes.len() {
                let rest = (part.file.meta.length_bytes() as usize).saturating_sub(part.start);
                self.bytes.resize(at_once.min(rest).max(length), 0);
                self.start = part.start;
                part.file.read(part.start, &mut self.bytes);
            }
            &self.bytes[part.start - self.start..][..length]
        };
        match part.count {
            Some(count) => (&bytes[..count], &bytes[count + TEXT_COUNT_BYTES..]),
            None => (bytes, &[]),
        }
    }
}
