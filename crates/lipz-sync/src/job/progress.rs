//! The progress of a job, because a recording may last an hour.

use std::io::{Read, Result, Seek, SeekFrom};
use std::sync::atomic::{AtomicU32, Ordering};

/// The number of parts of a job, in which progress is measured.
pub const JOB_PARTS: u32 = 1_000;

/// The number of parts for decoding the recording. The rest is for its analysis.
const DECODED: u32 = 300;

/// The progress of a job.
pub(super) struct Progress<'p> {
    tell: &'p (dyn Fn(u32) + Sync),
    done: AtomicU32,
}

impl<'p> Progress<'p> {
    pub(super) fn new(tell: &'p (dyn Fn(u32) + Sync)) -> Progress<'p> {
        Progress { tell, done: AtomicU32::new(0) }
    }

    /// Marks the job as done.
    pub(super) fn finish(&self) {
        self.reach(JOB_PARTS);
    }

    /// Reports the decoded share of the recording, from 0 to 1.
    fn decoded(&self, share: f32) {
        self.reach(parts(share, DECODED));
    }

    /// Reports the analysed share of the recording, from 0 to 1.
    pub(super) fn heard(&self, share: f32) {
        self.reach(DECODED + parts(share, JOB_PARTS - DECODED));
    }

    fn reach(&self, parts: u32) {
        let before = self.done.fetch_max(parts, Ordering::Relaxed);
        if parts > before {
            (self.tell)(parts - before);
        }
    }
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a share of a few parts")]
fn parts(share: f32, all: u32) -> u32 {
    (share.clamp(0.0, 1.0) * all as f32) as u32
}

/// A file whose reading is tracked while it is decoded.
pub(super) struct WatchedFile<'p, F> {
    file: F,
    length: u64,
    position: u64,
    progress: &'p Progress<'p>,
}

impl<'p, F: Seek> WatchedFile<'p, F> {
    pub(super) fn new(mut file: F, progress: &'p Progress<'p>) -> Result<WatchedFile<'p, F>> {
        let length = file.seek(SeekFrom::End(0))?;
        file.rewind()?;
        Ok(WatchedFile { file, length, position: 0, progress })
    }
}

impl<F: Read> Read for WatchedFile<'_, F> {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize> {
        let count = self.file.read(buffer)?;
        self.position += count as u64;
        self.progress.decoded(self.position as f32 / self.length.max(1) as f32);
        Ok(count)
    }
}

impl<F: Seek> Seek for WatchedFile<'_, F> {
    fn seek(&mut self, position: SeekFrom) -> Result<u64> {
        self.position = self.file.seek(position)?;
        Ok(self.position)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use std::io::Cursor;
    use std::sync::Mutex;

    #[test]
    fn parts_of_a_job_add_up_and_never_go_back() {
        let told = Mutex::new(Vec::new());
        let tell = |parts| told.lock().unwrap().push(parts);
        let progress = Progress::new(&tell);
        let mut file = WatchedFile::new(Cursor::new([0; 100]), &progress).unwrap();
        for _ in 0..2 {
            let mut ten = [0; 10];
            (0..10).for_each(|_| assert_eq!(file.read(&mut ten).unwrap(), 10));
            file.rewind().unwrap(); // a decoder that probes the file first
        }
        assert_eq!(*told.lock().unwrap(), [30; 10]);
        [0.5, 0.25, 2.0].iter().for_each(|share| progress.heard(*share));
        progress.finish();
        assert_eq!(told.lock().unwrap()[10..], [350, 350]);
    }
}
