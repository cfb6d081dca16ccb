//! Replacing many files: each as [`replace_file`](crate::replace_file) does it, but on disk in groups.

use crate::compile::FileReader;
use crate::discover;
use crate::hashed::hash;
use crate::output::failed;
use crate::temporary::{Leftovers, TemporaryFile, distinct, sync_folders, sync_temporary};
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{LazyLock, Mutex, PoisonError};

/// Files of a group: so many that syncing costs little for each, and so few that a run that is interrupted ends soon.
const GROUP: usize = 256;

/// Files of a group where the system lets a process open few: each that waits is open, and so may its folder be,
/// beside those that are read.
static FILES_AT_ONCE: LazyLock<usize> = LazyLock::new(|| {
    #[cfg(unix)]
    if let Some(open) = rustix::process::getrlimit(rustix::process::Resource::Nofile).current {
        return usize::try_from(open / 4).unwrap_or(GROUP).clamp(1, GROUP);
    }
    GROUP
});

/// Replaces files, each as a whole, and many together: temporary files are written at once, and brought to disk and
/// renamed in groups of 256. Whenever the process or the machine stops, each path is the old file or the new one.
///
/// Nothing is renamed before [`finish`](Replacements::finish) returns but whole groups, so call it last.
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
pub struct Replacements(Mutex<Waiting>);

/// What is written and not yet renamed.
#[derive(Debug, Default)]
struct Waiting {
    files: Vec<Replacement>,
    /// What went wrong with those before.
    reports: Vec<Report>,
    leftovers: Leftovers,
}

/// A file to take the place of another one.
#[derive(Debug)]
struct Replacement {
    path: PathBuf,
    temporary: TemporaryFile,
    /// What must still be there when it does, and what it brings; `None` if it replaces whatever is there.
    change: Option<Change>,
}

/// The contents of a file before and after, by length and hash.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Change {
    before: (usize, u64),
    after: (usize, u64),
}

/// What a file that is to be rewritten has by now.
pub(crate) enum Now {
    /// What it was read as.
    Before,
    /// What it is to have: through another name of the same file.
    After,
}

impl Replacements {
    /// Writes what will replace the file at `path`. A later error is in the reports of [`finish`](Self::finish).
    ///
    /// # Errors
    /// As [`replace_file`](crate::replace_file).
    pub fn replace(&self, path: &Path, bytes: &[u8]) -> Result<(), Report> {
        self.stage(path, bytes, None)
    }

    /// Writes what will replace the file at `path`, which was read as `before`, as
    /// [`rewrite_file`](crate::rewrite_file) does: if somebody changes it up to the moment at which it is replaced,
    /// the reports of [`finish`](Self::finish) say so, and it stays as it is.
    ///
    /// # Errors
    /// As [`rewrite_file`](crate::rewrite_file).
    pub fn rewrite(&self, path: &Path, before: &[u8], after: &[u8]) -> Result<(), Report> {
        let change = Change::new(before, after);
        match change.look(path)? {
            Now::Before => self.stage(path, after, Some(change)),
            Now::After => Ok(()),
        }
    }

    fn stage(&self, path: &Path, bytes: &[u8], change: Option<Change>) -> Result<(), Report> {
        // Found before other files are renamed.
        if path.is_dir() {
            return Err(failed(path, &io::ErrorKind::IsADirectory.into()));
        }
        let temporary = TemporaryFile::beside(path, bytes).map_err(|error| failed(path, &error))?;
        self.wait(path, temporary, change);
        Ok(())
    }

    /// Writes what will replace the file `name` in `folder`, as [`replace`](Self::replace) does, but nowhere else,
    /// wherever links lead. `path` is how messages name it.
    #[cfg(feature = "unpack")]
    pub(crate) fn replace_below(
        &self,
        folder: &std::sync::Arc<crate::temporary::OpenFolder>,
        name: &str,
        path: &Path,
        bytes: &[u8],
    ) -> io::Result<()> {
        let temporary = crate::temporary::FileBelow::new(folder, name, bytes)?;
        self.wait(path, TemporaryFile::Below(temporary), None);
        Ok(())
    }

    fn wait(&self, path: &Path, temporary: TemporaryFile, change: Option<Change>) {
        let mut waiting = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        waiting.files.push(Replacement { path: path.to_owned(), temporary, change });
        if waiting.files.len() >= *FILES_AT_ONCE {
            waiting.bring_to_disk();
        }
    }

    /// Replaces what is left, and returns what could not be replaced: a report for each file, which is then as it was.
    pub fn finish(&self) -> Vec<Report> {
        let mut waiting = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        waiting.bring_to_disk();
        std::mem::take(&mut waiting.reports)
    }

    /// Gives up what is not replaced yet, and removes the temporary files: for programs that are asked to end.
    pub fn abandon(&self) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).files.clear();
    }
}

impl Waiting {
    fn bring_to_disk(&mut self) {
        let group = std::mem::take(&mut self.files);
        if let Err(error) = sync_temporary(group.iter().map(|file| &file.temporary)) {
            self.reports.extend(group.iter().map(|file| failed(&file.path, &error)));
            return;
        }
        let mut folders = Vec::new();
        for Replacement { path, temporary, change } in group {
            // The second look, right before: somebody may have saved the file while others were synced.
            match change.map_or(Ok(Now::Before), |change| change.look(&path)) {
                Ok(Now::Before) => match temporary.rename() {
                    Ok(folder) => folders.push(folder),
                    Err(error) => self.reports.push(failed(&path, &error)),
                },
                Ok(Now::After) => {}
                Err(report) => self.reports.push(report),
            }
        }
        let folders = distinct(folders);
        sync_folders(&folders);
        self.leftovers.remove(&folders);
    }
}

impl Change {
    pub(crate) fn new(before: &[u8], after: &[u8]) -> Change {
        let stamp = |bytes: &[u8]| (bytes.len(), hash(bytes));
        Change { before: stamp(before), after: stamp(after) }
    }

    /// What the file has now.
    ///
    /// # Errors
    /// If it is read-only, or neither what it was nor what it is to become.
    pub(crate) fn look(&self, path: &Path) -> Result<Now, Report> {
        let refused = |why: &str, help: &str| {
            let shown = discover::display(path);
            let diagnostic = Diagnostic::new(Code::OutputFailed, format!("`{shown}` cannot be written: {why}"));
            Err(Report::about(shown, diagnostic.note("it is unchanged").help(help)))
        };
        if path.metadata().is_ok_and(|metadata| metadata.permissions().readonly()) {
            return refused("it is read-only", "make it writable, or check it out if your version control locks files");
        }
        let mut reader = FileReader::default();
        let now = reader.read(path).ok().map(|bytes| (bytes.len(), hash(bytes)));
        if now == Some(self.after) {
            return Ok(Now::After);
        }
        if now != Some(self.before) {
            return refused("another program has changed it in the meantime", "run the command again");
        }
        Ok(Now::Before)
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
        // As editors save.
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
