//! Buffered ranges of the files that contain clips.

use crate::clip::{PartOnDisk, Window};

/// The total length of the windows of all files, and the minimum length of each, in bytes.
const WINDOWS_BYTES: usize = 1 << 22;
const SMALLEST_WINDOW_BYTES: usize = 1 << 12;

/// The last range read from the file of each batch of clips.
pub(super) struct Windows {
    windows: Vec<Window>,
    window_bytes: usize,
}

impl Windows {
    /// Creates the windows for this number of batches.
    pub(super) fn of(batch_count: usize) -> Windows {
        Windows {
            windows: (0..batch_count).map(|_| Window::default()).collect(),
            window_bytes: (WINDOWS_BYTES / batch_count.max(1)).max(SMALLEST_WINDOW_BYTES),
        }
    }

    /// Returns the part of a clip of a batch in two pieces: this many bytes, and the rest. A part that contains a count
    /// is always split there.
    pub(super) fn pieces(&mut self, batch: usize, part: &PartOnDisk<'_>, before: usize) -> (&[u8], &[u8]) {
        match self.windows[batch].pieces(part, self.window_bytes) {
            (bytes, []) => bytes.split_at(before.min(bytes.len())),
            pieces => pieces,
        }
    }
}
