//! Replacing many files like [`replace_file`](crate::replace_file), but synced in groups.

use crate::files::FileReader;
use crate::files::output::failed;
use crate::files::path::display;
use crate::files::temporary::{Leftovers, TemporaryFile, distinct, sync_folders, sync_temporary};
use crate::util::hash::hash;
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{LazyLock, Mutex, PoisonError};

/// The number of files in a group: large enough to make syncing cheap, small enough to end an interrupted run soon.
const GROUP: usize = 256;

/// The number of files in a group if the system allows a process few open files: each waiting file is open, and
/// possibly its folder, in addition to the files being read.
static FILES_AT_ONCE: LazyLock<usize> = LazyLock::new(|| {
    #[cfg(unix)]
    if let Some(open) = rustix::process::getrlimit(rustix::process::Resource::Nofile).current {
        return usize::try_from(open / 4).unwrap_or(GROUP).clamp(1, GROUP);
    }
    GROUP
});

/// Replaces many files, each as a whole: temporary files are written at once, then synced and renamed in groups of 256.
/// Whenever the process or the machine stops, each path is either the old file or the new one.
///
/// Files of an incomplete group are renamed only by [`finish`](Replacements::finish), so call it last.
///
/// ```
/// use lipz_compiler::Replacements;
/// # let folder = tempfile::tempdir()?;
/// # let (mayor, mara) = (folder.path().join("mayor.lipz"), folder.path().join("mara.lipz"));
/// let files = Replacements::default();
/// files.replace(&mayor, b"{}")?;
/// files.replace(&mara, b"{}")?;
/// assert_eq!(files.finish(), []);
/// assert_eq!(std::fs::read(&mara)?, b"{}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Default)]
pub struct Replacements(Mutex<PendingFiles>);

/// Files that are written but not yet renamed.
#[derive(Debug, Default)]
struct PendingFiles {
    files: Vec<Replacement>,
    /// Errors of earlier groups.
    reports: Vec<Report>,
    leftovers: Leftovers,
}

/// A file that will replace another.
#[derive(Debug)]
struct Replacement {
    path: PathBuf,
    temporary: TemporaryFile,
    /// The required content of the replaced file, and its new content; `None` to replace any content.
    change: Option<ContentChange>,
}

/// The contents of a file before and after, by length and hash.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContentChange {
    before: (usize, u64),
    after: (usize, u64),
}

/// The current content of a file to be rewritten.
pub(crate) enum FoundContent {
    /// As it was read.
    Before,
    /// The new content, written through a different name of the same file.
    After,
}

impl Replacements {
    /// Writes the replacement for the file at `path`. [`finish`](Self::finish) reports later errors.
    ///
    /// # Errors
    /// Those of [`replace_file`](crate::replace_file).
    pub fn replace(&self, path: &Path, bytes: &[u8]) -> Result<(), Report> {
        self.stage(path, bytes, None)
    }

    /// Writes the replacement for the file at `path`, which was read as `before`, like
    /// [`rewrite_file`](crate::rewrite_file). If another program changes it before it is replaced, it stays unchanged,
    /// and [`finish`](Self::finish) reports this.
    ///
    /// # Errors
    /// Those of [`rewrite_file`](crate::rewrite_file).
    pub fn rewrite(&self, path: &Path, before: &[u8], after: &[u8]) -> Result<(), Report> {
        let change = ContentChange::new(before, after);
        match change.look(path)? {
            FoundContent::Before => self.stage(path, after, Some(change)),
            FoundContent::After => Ok(()),
        }
    }

    fn stage(&self, path: &Path, bytes: &[u8], change: Option<ContentChange>) -> Result<(), Report> {
        // Detect this before other files are renamed.
        if path.is_dir() {
            return Err(failed(path, &io::ErrorKind::IsADirectory.into()));
        }
        let temporary = TemporaryFile::beside(path, bytes).map_err(|error| failed(path, &error))?;
        self.wait(path, temporary, change);
        Ok(())
    }

    /// Writes the replacement for the file `name` in `folder`, like [`replace`](Self::replace), but never outside it,
    /// even if links point elsewhere. `path` is its name in messages.
    #[cfg(feature = "unpack")]
    pub(crate) fn replace_below(
        &self,
        folder: &std::sync::Arc<crate::files::temporary::OpenFolder>,
        name: &str,
        path: &Path,
        bytes: &[u8],
    ) -> io::Result<()> {
        let temporary = crate::files::temporary::FileBelow::new(folder, name, bytes)?;
        self.wait(path, TemporaryFile::Below(temporary), None);
        Ok(())
    }

    fn wait(&self, path: &Path, temporary: TemporaryFile, change: Option<ContentChange>) {
        let mut waiting = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        waiting.files.push(Replacement { path: path.to_owned(), temporary, change });
        if waiting.files.len() >= *FILES_AT_ONCE {
            waiting.bring_to_disk();
        }
    }

    /// Replaces the remaining files. Returns a report for each file that could not be replaced, which stays unchanged.
    pub fn finish(&self) -> Vec<Report> {
        let mut waiting = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        waiting.bring_to_disk();
        std::mem::take(&mut waiting.reports)
    }

    /// Discards pending replacements and removes the temporary files, for programs that are asked to end.
    pub fn abandon(&self) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).files.clear();
    }
}

impl PendingFiles {
    fn bring_to_disk(&mut self) {
        let group = std::mem::take(&mut self.files);
        if let Err(error) = sync_temporary(group.iter().map(|file| &file.temporary)) {
            self.reports.extend(group.iter().map(|file| failed(&file.path, &error)));
            return;
        }
        let mut folders = Vec::new();
        for Replacement { path, temporary, change } in group {
            // Check again just before renaming, because another program may have saved the file while others were
            // synced.
            match change.map_or(Ok(FoundContent::Before), |change| change.look(&path)) {
                Ok(FoundContent::Before) => match temporary.rename() {
                    Ok(folder) => folders.push(folder),
                    Err(error) => self.reports.push(failed(&path, &error)),
                },
                Ok(FoundContent::After) => {}
                Err(report) => self.reports.push(report),
            }
        }
        let folders = distinct(folders);
        sync_folders(&folders);
        self.leftovers.remove(&folders);
    }
}

impl ContentChange {
    pub(crate) fn new(before: &[u8], after: &[u8]) -> ContentChange {
        let stamp = |bytes: &[u8]| (bytes.len(), hash(bytes));
        ContentChange { before: stamp(before), after: stamp(after) }
    }

    /// Returns the current content of the file.
    ///
    /// # Errors
    /// If it is read-only, or has neither the old nor the new content.
    pub(crate) fn look(&self, path: &Path) -> Result<FoundContent, Report> {
        let refused = |why: &str, help: &str| {
            let shown = display(path);
            let diagnostic = Diagnostic::new(Code::OutputFailed, format!("`{shown}` cannot be written: {why}"));
            Err(Report::about(shown, diagnostic.note("it is unchanged").help(help)))
        };
        if path.metadata().is_ok_and(|metadata| metadata.permissions().readonly()) {
            return refused("it is read-only", "make it writable, or check it out if your version control locks files");
        }
        let mut reader = FileReader::default();
        let now = reader.read(path).ok().map(|bytes| (bytes.len(), hash(bytes)));
        if now == Some(self.after) {
            return Ok(FoundContent::After);
        }
        if now != Some(self.before) {
            return refused("another program has changed it in the meantime", "run the command again");
        }
        Ok(FoundContent::Before)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_file_that_is_saved_before_it_is_replaced_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let files = Replacements::default();
        for name in ["a.lipz", "b.lipz"] {
            fs::write(path(name), "old").unwrap();
            files.rewrite(&path(name), b"old", b"mine").unwrap();
        }
        assert_eq!(fs::read(path("a.lipz")).unwrap(), b"old", "not before the group is on disk");
        // Like an editor.
        fs::write(path("saved"), "theirs").unwrap();
        fs::rename(path("saved"), path("a.lipz")).unwrap();
        let reports = files.finish();
        assert_eq!(reports.len(), 1);
        assert!(reports[0].diagnostics[0].message.ends_with("another program has changed it in the meantime"));
        assert_eq!(fs::read(path("a.lipz")).unwrap(), b"theirs");
        assert_eq!(fs::read(path("b.lipz")).unwrap(), b"mine");
        assert_eq!(folder.path().read_dir().unwrap().count(), 2, "no temporary file is left");
    }

    #[test]
    fn groups_are_replaced_as_they_fill_and_the_rest_is_given_up() {
        let folder = tempfile::tempdir().unwrap();
        let path = |number: usize| folder.path().join(format!("{number}.lipz"));
        let files = Replacements::default();
        for number in 0..GROUP + 3 {
            files.replace(&path(number), b"{}").unwrap();
        }
        assert!((0..GROUP).all(|number| path(number).exists()) && !path(GROUP).exists());
        files.abandon();
        assert_eq!(files.finish(), []);
        assert_eq!(folder.path().read_dir().unwrap().count(), GROUP);
    }

    #[cfg(unix)]
    #[test]
    fn two_names_of_a_file_are_one() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("a.lipz"), folder.path().join("b.lipz"));
        fs::write(&file, "old").unwrap();
        std::os::unix::fs::symlink("a.lipz", &link).unwrap();
        let files = Replacements::default();
        files.rewrite(&file, b"old", b"new").unwrap();
        files.rewrite(&link, b"old", b"new").unwrap();
        assert_eq!(files.finish(), []);
        assert_eq!(fs::read(&link).unwrap(), b"new");
        assert!(link.is_symlink());
    }
}
