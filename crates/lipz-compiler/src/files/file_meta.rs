//! Metadata of a file, and whether it proves that the file is unchanged.

use bincode::{Decode, Encode};
use std::fs::Metadata;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// The coarsest resolution of file times (FAT: two seconds). A file that changed within this time before it was
/// examined may change again without a difference in its metadata.
const COARSEST_TICK: Duration = Duration::from_secs(2);

/// The metadata that identifies the state of a file.
#[derive(Encode, Decode, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct FileMeta {
    length_bytes: u64,
    modified_ns: u64,
    /// The time of the last change to the file or its metadata. On Unix, unlike the modification time, programs cannot
    /// set it. On other systems, it is the modification time.
    changed_ns: u64,
    /// The inode number of the file on Unix, which tells a new file from the one that it replaces; 0 on other systems.
    number: u64,
}

impl FileMeta {
    /// Creates it from metadata; `None` for times before 1970 or after 2500.
    pub(crate) fn new(metadata: &Metadata) -> Option<FileMeta> {
        let modified_ns = since_epoch_ns(metadata.modified().ok()?)?;
        #[cfg(unix)]
        let (changed_ns, number) = {
            use std::os::unix::fs::MetadataExt;
            let time = Duration::new(metadata.ctime().try_into().ok()?, metadata.ctime_nsec().try_into().ok()?);
            (u64::try_from(time.as_nanos()).ok()?, metadata.ino())
        };
        #[cfg(not(unix))]
        let (changed_ns, number) = (modified_ns, 0);
        Some(FileMeta { length_bytes: metadata.len(), modified_ns, changed_ns, number })
    }

    /// Returns the length of the file.
    #[cfg(feature = "shards")]
    pub(crate) fn length_bytes(&self) -> u64 {
        self.length_bytes
    }

    /// Creates it from the system's data about a file in an open folder.
    #[cfg(target_os = "linux")]
    pub(crate) fn of_stat(stat: &rustix::fs::Stat) -> Option<FileMeta> {
        let ns = |seconds: i64, ns: u32| u64::try_from(Duration::new(u64::try_from(seconds).ok()?, ns).as_nanos()).ok();
        Some(FileMeta {
            length_bytes: u64::try_from(stat.st_size).ok()?,
            modified_ns: ns(stat.st_mtime, u32::try_from(stat.st_mtime_nsec).ok()?)?,
            changed_ns: ns(stat.st_ctime, u32::try_from(stat.st_ctime_nsec).ok()?)?,
            number: stat.st_ino,
        })
    }

    /// Whether changes to the file after `time` are certain to change this metadata.
    pub(crate) fn is_settled_at(&self, time: SystemTime) -> bool {
        let settled_ns = u128::from(self.changed_ns) + COARSEST_TICK.as_nanos();
        since_epoch_ns(time).is_some_and(|time| u128::from(time) > settled_ns)
    }
}

fn since_epoch_ns(time: SystemTime) -> Option<u64> {
    u64::try_from(time.duration_since(UNIX_EPOCH).ok()?.as_nanos()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs::{self, File};

    #[test]
    fn a_file_settles_after_the_coarsest_tick() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let meta = FileMeta::new(&file.as_file().metadata().unwrap()).unwrap();
        let changed = UNIX_EPOCH + Duration::from_nanos(meta.changed_ns);
        assert!(!meta.is_settled_at(changed) && !meta.is_settled_at(changed + COARSEST_TICK));
        assert!(meta.is_settled_at(changed + COARSEST_TICK + Duration::from_millis(1)));
        assert!(!meta.is_settled_at(changed - COARSEST_TICK), "a file from the future");
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn a_file_looks_the_same_by_its_path_and_in_its_folder() {
        let file = tempfile::NamedTempFile::new().unwrap();
        fs::write(file.path(), "abc").unwrap();
        let by_path = FileMeta::new(&file.path().metadata().unwrap()).unwrap();
        let stat = rustix::fs::statat(rustix::fs::CWD, file.path(), rustix::fs::AtFlags::empty()).unwrap();
        assert_eq!(FileMeta::of_stat(&stat), Some(by_path));
    }

    #[test]
    #[cfg(unix)]
    fn another_file_with_the_same_name_length_and_time_looks_different() {
        let folder = tempfile::tempdir().unwrap();
        let (path, other) = (folder.path().join("a"), folder.path().join("b"));
        fs::write(&path, "old").unwrap();
        let metadata = path.metadata().unwrap();
        fs::write(&other, "new").unwrap();
        File::options().append(true).open(&other).unwrap().set_modified(metadata.modified().unwrap()).unwrap();
        fs::rename(&other, &path).unwrap();
        let (old, new) = (FileMeta::new(&metadata).unwrap(), FileMeta::new(&path.metadata().unwrap()).unwrap());
        assert_eq!((old.length_bytes, old.modified_ns), (new.length_bytes, new.modified_ns));
        assert_ne!(old, new);
    }
}
