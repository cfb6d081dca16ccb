//! Detects changed files by their metadata, and banks by the checksum in their header.

use std::fs::Metadata;
use std::io::{self, Read};
use std::time::{Duration, SystemTime};

/// The time without changes after which the next change is sure to be visible. The clocks of some file systems tick
/// every two seconds, and a younger file may change again within the same tick.
const SETTLED_AFTER: Duration = Duration::from_secs(2);

/// The metadata of a file.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Stamp {
    length_bytes: u64,
    modified: Option<SystemTime>,
    identity: Identity,
}

/// Device, inode, and time of change. A file that is renamed over another has a different inode, and programs cannot
/// set the time of change.
#[cfg(unix)]
type Identity = (u64, u64, i64, i64);

/// The time of creation, because Windows provides nothing else.
#[cfg(not(unix))]
type Identity = Option<SystemTime>;

impl Stamp {
    pub(crate) fn new(metadata: &Metadata) -> Stamp {
        Stamp { length_bytes: metadata.len(), modified: metadata.modified().ok(), identity: identity(metadata) }
    }

    /// Whether any change from now on will change the stamp.
    pub(crate) fn is_settled(&self) -> bool {
        let age = self.modified.and_then(|modified| SystemTime::now().duration_since(modified).ok());
        age.map_or(false, |age| age > SETTLED_AFTER)
    }
}

#[cfg(unix)]
fn identity(metadata: &Metadata) -> Identity {
    use std::os::unix::fs::MetadataExt;
    (metadata.dev(), metadata.ino(), metadata.ctime(), metadata.ctime_nsec())
}

#[cfg(not(unix))]
fn identity(metadata: &Metadata) -> Identity {
    metadata.created().ok()
}

/// Returns the checksum in the header of a bank, which is read from its start; `None` if the file is too short.
pub(crate) fn checksum(bank: impl Read) -> io::Result<Option<u64>> {
    const END: u64 = 16;
    let mut start = Vec::new();
    bank.take(END).read_to_end(&mut start)?;
    Ok(start.get(8..).and_then(|bytes| bytes.try_into().ok()).map(u64::from_le_bytes))
}
