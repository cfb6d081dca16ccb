//! Stretches of the files in which clips stay.

use crate::clip::{StayingPart, Window};

/// Bytes of the windows of all files together, and of each at least.
const WINDOWS_BYTES: usize = 1 << 22;
const SMALLEST_WINDOW_BYTES: usize = 1 << 12;

/// For each batch of clips, where its file was read last.
pub(super) struct Windows {
    windows: Vec<Window>,
    window_bytes: usize,
}

impl Windows {
    /// Those of so many batches.
    pub(super) fn of(batch_count: usize) -> Windows {
        Windows {
            windows: (0..batch_count).map(|_| Window::default()).collect(),
            window_bytes: (WINDOWS_BYTES / batch_count.max(1)).max(SMALLEST_WINDOW_BYTES),
        }
    }

    /// A part of a clip of a batch in two pieces: so many bytes, and the rest. A part with a count in it has its two whatever
    /// is asked for.
    pub(super) fn pieces(&mut self, batch: usize, part: &StayingPart<'_>, before: usize) -> (&[u8], &[u8]) {
        match self.windows[batch].pieces(part, self.window_bytes) {
            (bytes, []) => bytes.split_at(before.min(bytes.len())),
            pieces => pieces,
        }
    }
}
