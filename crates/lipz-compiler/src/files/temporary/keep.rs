//! Metadata that a new file takes over from the file it replaces.

use std::fs::{File, Metadata};
use std::io;

/// Sets the permissions of `new` to those of the replaced file and, as far as the system permits, its owner, its group
/// and its extended attributes, including access control lists. `old` is the replaced file, if it can be opened.
///
/// # Errors
/// If the permissions cannot be set.
pub(super) fn keep(metadata: &Metadata, old: Option<&File>, new: &File) -> io::Result<()> {
    #[cfg(unix)]
    keep_owner(metadata, new);
    #[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
    if let Some(old) = old {
        keep_attributes(old, new);
    }
    #[cfg(not(any(target_os = "linux", target_os = "android", target_vendor = "apple")))]
    let _ = old;
    // Set them last, because a change of the owner removes the set-user-ID and set-group-ID bits.
    new.set_permissions(metadata.permissions())
}

/// Only root may change the owner; others may set only their own groups. As with any editor, the file then becomes
/// ours.
#[cfg(unix)]
fn keep_owner(old: &Metadata, new: &File) {
    use rustix::fs::{Gid, Uid, fchown};
    use std::os::unix::fs::MetadataExt;
    let Ok(now) = new.metadata() else { return };
    let owner = (old.uid() != now.uid()).then(|| Uid::from_raw(old.uid()));
    let group = (old.gid() != now.gid()).then(|| Gid::from_raw(old.gid()));
    if (owner.is_some() || group.is_some()) && fchown(new, owner, group).is_err() {
        let _ = fchown(new, None, group);
    }
}

/// The most bytes of all names of a file's attributes on Linux and macOS (`XATTR_LIST_MAX`).
#[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
const LIST_BYTES: usize = 1 << 16;
/// The most bytes of a value on Linux (`XATTR_SIZE_MAX`). On macOS, longer ones belong to Finder and do not concern
/// sources.
#[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
const VALUE_BYTES: usize = 1 << 16;

/// Attributes that cannot be set belong to the system, which sets them itself.
#[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
fn keep_attributes(old: &File, new: &File) {
    use rustix::fs::{XattrFlags, fgetxattr, flistxattr, fsetxattr};
    let mut names = vec![0; LIST_BYTES];
    let Ok(length) = flistxattr(old, names.as_mut_slice()) else { return };
    names.truncate(length);
    for name in names.split(|byte| *byte == 0).filter(|name| !name.is_empty()) {
        let mut value = vec![0; VALUE_BYTES];
        let length = fgetxattr(old, name, value.as_mut_slice()).ok();
        if let Some(value) = length.and_then(|length| value.get(..length)) {
            let _ = fsetxattr(new, name, value, XattrFlags::empty());
        }
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use crate::files::{Replacements, replace_file};
    use rustix::fs::{Gid, Uid, XattrFlags, chown, getxattr, setxattr};
    use std::fs;
    use std::os::unix::fs::{MetadataExt, PermissionsExt};

    #[test]
    fn owner_and_group_stay() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.lipz");
        fs::write(&path, "old").unwrap();
        if chown(&path, Some(Uid::from_raw(1234)), Some(Gid::from_raw(4321))).is_err() {
            eprintln!("skipped: only root gives files away");
            return;
        }
        fs::set_permissions(&path, fs::Permissions::from_mode(0o2640)).unwrap();
        replace_file(&path, b"new").unwrap();
        let metadata = path.metadata().unwrap();
        assert_eq!((metadata.uid(), metadata.gid(), metadata.mode() & 0o7777), (1234, 4321, 0o2640));
        assert_eq!(fs::read(&path).unwrap(), b"new");
    }

    #[test]
    fn extended_attributes_stay() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.lipz");
        fs::write(&path, "old").unwrap();
        let value = vec![7; 500];
        if setxattr(&path, "user.take", &value, XattrFlags::empty()).is_err() {
            eprintln!("skipped: the file system has no attributes");
            return;
        }
        setxattr(&path, "user.empty", b"", XattrFlags::empty()).unwrap();
        let files = Replacements::default();
        files.rewrite(&path, b"old", b"new").unwrap();
        assert_eq!(files.finish(), []);
        let read = |name: &str| {
            let mut value = vec![0; 1000];
            let length = getxattr(&path, name, value.as_mut_slice()).unwrap();
            value[..length].to_vec()
        };
        assert_eq!((read("user.take"), read("user.empty")), (value, vec![]));
        assert_eq!(fs::read(&path).unwrap(), b"new");
    }
}
