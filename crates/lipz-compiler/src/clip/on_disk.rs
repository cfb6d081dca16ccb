//! Clips whose frames, texts and source records stay in the file of an object until they are copied into a bank.

use super::ClipText;
use crate::files::FileMeta;
use lipz_layout::TEXT_COUNT_BYTES;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

/// The verified file of an object.
#[derive(Debug)]
pub(crate) struct ClipFile {
    path: PathBuf,
    /// The open file, unless there are too many.
    file: Option<Mutex<File>>,
    /// Its metadata when it was verified.
    meta: FileMeta,
    /// The starts of the sections that contain the data of clips.
    starts: SectionStarts,
    has_failed: AtomicBool,
}

/// The offsets of frames, texts and source records in a file.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SectionStarts {
    pub(crate) frames: usize,
    pub(crate) texts: usize,
    pub(crate) sources: usize,
}

/// The position of the source record of a clip among those of its file, and its hash.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SourceOnDisk {
    pub(crate) start: u32,
    pub(crate) end: u32,
    pub(crate) hash: u32,
}

/// A part of a clip in a file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PartOnDisk<'c> {
    file: &'c ClipFile,
    start: usize,
    end: usize,
    /// The offset of the count of a last text, which is not part of the text.
    count: Option<usize>,
}

/// The last range read from a file. It usually contains the next part as well.
#[derive(Debug, Default)]
pub(crate) struct Window {
    start: usize,
    bytes: Vec<u8>,
    /// A part that starts before the range.
    before: Vec<u8>,
}

impl ClipFile {
    /// Creates the file with this metadata, kept open in `file` or opened for each access.
    pub(crate) fn new(path: PathBuf, file: Option<File>, meta: FileMeta, starts: SectionStarts) -> ClipFile {
        ClipFile { path, file: file.map(Mutex::new), meta, starts, has_failed: AtomicBool::new(false) }
    }

    pub(super) fn frames(&self, place: Range<usize>) -> PartOnDisk<'_> {
        self.part(self.starts.frames, place, None)
    }

    pub(super) fn source(&self, source: SourceOnDisk) -> PartOnDisk<'_> {
        self.part(self.starts.sources, source.start as usize..source.end as usize, None)
    }

    /// Returns a text of a clip. Its last segment starts `last_start` bytes after the first.
    pub(super) fn text(&self, text: &ClipText, last_start: usize) -> PartOnDisk<'_> {
        self.part(self.starts.texts, text.place(), text.is_counted().then_some(last_start))
    }

    fn part(&self, section: usize, place: Range<usize>, count: Option<usize>) -> PartOnDisk<'_> {
        PartOnDisk { file: self, start: section + place.start, end: section + place.end, count }
    }

    /// Whether everything was read, and the file has not changed since it was verified.
    pub(crate) fn is_as_it_was(&self) -> bool {
        let metadata = match &self.file {
            Some(file) => file.lock().unwrap_or_else(PoisonError::into_inner).metadata(),
            None => self.path.metadata(),
        };
        !self.has_failed.load(Ordering::Relaxed) && metadata.ok().as_ref().and_then(FileMeta::new) == Some(self.meta)
    }

    /// Reads from this offset. On failure, fills with zeros, which [`is_as_it_was`](Self::is_as_it_was) reports.
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

impl PartOnDisk<'_> {
    pub(super) fn length(&self) -> usize {
        self.end - self.start - self.count.map_or(0, |_| TEXT_COUNT_BYTES)
    }

    /// Returns the position: the address of its file, and the range of bytes in it.
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
    /// Returns a part in two pieces: the bytes before a count, or all of them; and the bytes after it. The window
    /// advances by `at_once` bytes.
    pub(crate) fn pieces(&mut self, part: &PartOnDisk<'_>, at_once: usize) -> (&[u8], &[u8]) {
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
