//! The spectrogram of a recording: its spectrum, frame by frame.
//!
//! An hour takes 18 megabytes, and is read several times from start to end. So all but the last minutes of a long
//! recording are in a temporary file, and memory does not grow with its length.

use super::mel::{BANDS, Spectrum};
use super::temporary::TemporaryFile;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The most frames in memory: five and a half minutes, in 1.6 megabytes.
const MOST_FRAMES: usize = 1 << 15;
/// The frames that are read from the file at a time: those of three seconds.
const BLOCK_FRAMES: usize = 300;
/// The bytes of a frame in the file.
const FRAME_BYTES: usize = BANDS * size_of::<i16>();

/// The frames of a recording, or parts of them. Clones share the frames.
#[derive(Clone, Debug)]
pub(crate) struct Spectrogram {
    stored: Arc<Stored>,
    /// The stored frames that belong to it, in order.
    parts: Vec<Range<usize>>,
}

/// Frames in a file, followed by frames in memory.
#[derive(Debug, Default)]
struct Stored {
    file: Option<TemporaryFile>,
    in_file: usize,
    in_memory: Vec<Spectrum>,
    /// Whether a frame could not be read from the file.
    is_lost: AtomicBool,
}

/// Takes the frames of a recording one by one.
#[derive(Debug, Default)]
pub(crate) struct SpectrogramBuilder {
    stored: Stored,
    /// Whether writing the file has failed. All further frames then stay in memory.
    is_full: bool,
}

impl SpectrogramBuilder {
    pub(crate) fn push(&mut self, frame: Spectrum) {
        self.stored.in_memory.push(frame);
        if self.stored.in_memory.len() >= MOST_FRAMES && !self.is_full {
            self.is_full = self.stored.move_to_file().is_none();
        }
    }

    pub(crate) fn finish(self) -> Spectrogram {
        let frames = self.stored.in_file + self.stored.in_memory.len();
        let whole = 0..frames;
        Spectrogram { stored: Arc::new(self.stored), parts: vec![whole] }
    }
}

impl Stored {
    /// Moves all frames to the file. Returns `None`, and keeps them, if it cannot be written.
    fn move_to_file(&mut self) -> Option<()> {
        if self.file.is_none() {
            self.file = TemporaryFile::new().ok();
        }
        let bytes: Vec<u8> = self.in_memory.iter().flatten().flat_map(|band| band.to_le_bytes()).collect();
        self.file.as_ref()?.write((self.in_file * FRAME_BYTES) as u64, &bytes).ok()?;
        self.in_file += self.in_memory.len();
        self.in_memory.clear();
        Some(())
    }

    /// Reads these frames from the file. Frames that cannot be read are silent.
    fn read(&self, frames: Range<usize>) -> Vec<Spectrum> {
        let mut bytes = vec![0; frames.len() * FRAME_BYTES];
        let place = (frames.start * FRAME_BYTES) as u64;
        if self.file.as_ref().is_none_or(|file| file.read(place, &mut bytes).is_err()) {
            self.is_lost.store(true, Ordering::Relaxed);
        }
        let frame = |bytes: &[u8]| {
            let band = |band: usize| bytes.get(2 * band..2 * band + 2)?.try_into().ok().map(i16::from_le_bytes);
            std::array::from_fn(|number| band(number).unwrap_or_default())
        };
        bytes.chunks_exact(FRAME_BYTES).map(frame).collect()
    }
}

impl Spectrogram {
    pub(crate) fn len(&self) -> usize {
        self.parts.iter().map(Range::len).sum()
    }

    pub(crate) fn iter(&self) -> SpectrogramFrames<'_> {
        SpectrogramFrames {
            stored: &self.stored,
            parts: self.parts.iter(),
            now: 0..0,
            block: Vec::new(),
            block_start: 0,
        }
    }

    /// Returns a spectrogram of these frames, which ascend.
    pub(crate) fn cut(&self, ranges: &[Range<usize>]) -> Spectrogram {
        let mut parts = Vec::with_capacity(ranges.len());
        for range in ranges {
            let mut start = 0;
            for part in &self.parts {
                let place = |frame: usize| part.start + frame.clamp(start, start + part.len()) - start;
                let cut = place(range.start)..place(range.end);
                if !cut.is_empty() {
                    parts.push(cut);
                }
                start += part.len();
            }
        }
        Spectrogram { stored: Arc::clone(&self.stored), parts }
    }

    /// Whether a frame could not be read from the temporary file, and was silent instead.
    pub(crate) fn is_lost(&self) -> bool {
        self.stored.is_lost.load(Ordering::Relaxed)
    }
}

impl From<Vec<Spectrum>> for Spectrogram {
    fn from(frames: Vec<Spectrum>) -> Spectrogram {
        let whole = 0..frames.len();
        Spectrogram { stored: Arc::new(Stored { in_memory: frames, ..Stored::default() }), parts: vec![whole] }
    }
}

/// Iterates over frames.
#[derive(Clone, Debug)]
pub(crate) struct SpectrogramFrames<'a> {
    stored: &'a Stored,
    /// The parts after the current one.
    parts: std::slice::Iter<'a, Range<usize>>,
    /// The rest of the current part.
    now: Range<usize>,
    /// Frames from the file, and the first of them.
    block: Vec<Spectrum>,
    block_start: usize,
}

impl Iterator for SpectrogramFrames<'_> {
    type Item = Spectrum;

    fn next(&mut self) -> Option<Spectrum> {
        let frame = loop {
            match self.now.next() {
                Some(frame) => break frame,
                None => self.now = self.parts.next()?.clone(),
            }
        };
        if let Some(in_memory) = frame.checked_sub(self.stored.in_file) {
            return self.stored.in_memory.get(in_memory).copied();
        }
        let in_block = frame.checked_sub(self.block_start).filter(|place| *place < self.block.len());
        if in_block.is_none() {
            self.block = self.stored.read(frame..(frame + BLOCK_FRAMES).min(self.stored.in_file));
            self.block_start = frame;
        }
        self.block.get(in_block.unwrap_or(0)).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a spectrogram whose bands have the number of their frame.
    fn numbered(frames: usize) -> Spectrogram {
        let mut builder = SpectrogramBuilder::default();
        (0..frames).for_each(|frame| builder.push([number(frame); BANDS]));
        builder.finish()
    }

    fn number(frame: usize) -> i16 {
        i16::try_from(frame % 30_011).unwrap() - 9_000
    }

    #[test]
    fn long_recordings_keep_all_frames_and_few_in_memory() {
        for frames in [0, 1, MOST_FRAMES - 1, MOST_FRAMES, 2 * MOST_FRAMES + 5_000] {
            let spectrogram = numbered(frames);
            assert_eq!(spectrogram.len(), frames);
            assert!(spectrogram.iter().eq((0..frames).map(|frame| [number(frame); BANDS])), "{frames}");
            assert!(spectrogram.stored.in_memory.len() < MOST_FRAMES && !spectrogram.is_lost());
        }
    }

    #[test]
    fn parts_of_parts_are_parts() {
        let all = numbered(MOST_FRAMES + 100);
        let cut = all.cut(&[5..10, 400..1_000, MOST_FRAMES - 2..MOST_FRAMES + 3]);
        let places: Vec<usize> = (5..10).chain(400..1_000).chain(MOST_FRAMES - 2..MOST_FRAMES + 3).collect();
        assert_eq!(cut.len(), places.len());
        assert!(cut.iter().eq(places.iter().map(|place| [number(*place); BANDS])));
        let again = cut.cut(&[3..6, 604..700]);
        assert!(
            again
                .iter()
                .map(|frame| frame[0])
                .eq([8, 9, 400, 999].map(number).into_iter().chain((MOST_FRAMES - 2..MOST_FRAMES + 3).map(number)))
        );
    }

    #[test]
    fn frames_that_cannot_be_read_are_silent_and_told() {
        let mut spectrogram = numbered(MOST_FRAMES + 1);
        Arc::get_mut(&mut spectrogram.stored).unwrap().file = None;
        assert_eq!(spectrogram.iter().count(), MOST_FRAMES + 1);
        assert!(spectrogram.is_lost());
    }
}
