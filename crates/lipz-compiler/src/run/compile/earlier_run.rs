//! Queries of a run about the previous one, which the cache answers. Without a cache, there are no queries.

use crate::files::FileReader;
use crate::sources::Input;

/// An earlier run, some of whose clips may be unchanged.
pub(crate) trait EarlierRun: Sync {
    /// Returns the queries for one thread, which processes one file after another.
    fn for_thread(&self) -> Box<dyn EarlierFiles + '_>;
}

/// Queries of one thread about the files of an earlier run. The thread first examines each file. The other queries
/// refer to the file examined last.
pub(crate) trait EarlierFiles: Send {
    /// Examines the file of input number `index`, which `reader` may read next. Returns its clip if the file is
    /// certainly unchanged.
    fn look_at(&mut self, index: usize, input: &Input, reader: &mut FileReader) -> Option<RecalledClip>;

    /// Returns the clip of the file, if the file had these bytes before.
    fn with_bytes(&mut self, bytes: &[u8]) -> Option<RecalledClip>;

    /// Keeps the file for the next run: it became a clip without diagnostics. `is_marked` states whether a lint counts
    /// it.
    fn remember(&mut self, is_marked: bool);

    /// Ends the queries of the thread.
    fn finish(self: Box<Self>);
}

/// A clip in the bank of the earlier run.
#[derive(Clone, Copy)]
pub(crate) struct RecalledClip {
    /// Whether a lint counts its file.
    pub(crate) is_marked: bool,
}
