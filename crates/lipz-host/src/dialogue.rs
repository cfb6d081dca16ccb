//! A dialogue with its files.

use crate::files::{HostFile, HostFiles, Mode};
use crate::stamp::Stamp;
use crate::{Changes, OpenError, Source};
use self_cell::self_cell;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::{fmt, fs};

self_cell!(
    /// One version of the files, with their dialogue.
    struct Snapshot {
        owner: HostFiles,
        #[covariant]
        dependent: View,
    }
);

type View<'a> = lipz_bank::Dialogue<'a>;

/// Files that return answers like one bank: a bank or a set of banks, with patches and text banks.
///
/// Pass them from the bottom to the top. The base comes first: a bank, or the index of a set, whose banks are in the
/// same folder. Then come patches, downloads and mods, each after those below it, and text banks, each after the bank
/// of its clips. The kind of a file is in its header. Opening checks that all files match.
///
/// The value is one version of the files. A clone is the same version, and copies only the paths: give one to each
/// thread that reads. [`refresh`](Dialogue::refresh), [`add`](Dialogue::add) and [`remove`](Dialogue::remove) change
/// only this value, and either all files or none; clones do not change. A [`Locale`](lipz_bank::Locale), a
/// [`Voice`](lipz_bank::Voice) or a name belongs to one version and leads to nothing in a different one, so look it up
/// again. A [`Cursor`](lipz_bank::Cursor) and a [`ClipId`](lipz_bank::ClipId) are valid in every version.
///
/// A bank of a set is verified on the first query that needs it. If it is damaged, its clips are missing, and
/// [`failures`](Dialogue::failures) returns the reason.
#[derive(Clone)]
pub struct Dialogue {
    snapshot: Arc<Snapshot>,
    sources: Vec<Source>,
    mode: Mode,
    seen: ObservedStamps,
}

/// The observed state of the files.
#[derive(Clone)]
struct ObservedStamps {
    /// The stamps of the files; `None` for a bank of a set that is missing, because a new set may have replaced it.
    stamps: Vec<Option<Stamp>>,
    /// Whether any later change to the files will change a stamp. Recently written files may be replaced without a
    /// visible change.
    are_settled: bool,
}

impl Dialogue {
    /// Reads the files into memory and verifies them.
    ///
    /// # Errors
    /// The first file that cannot be read, is damaged, or does not match those before it.
    pub fn open<S: Into<Source>>(sources: impl IntoIterator<Item = S>) -> Result<Dialogue, OpenError> {
        Dialogue::open_in(sources, Mode { is_mapped: false, verifies: true })
    }

    /// Like [`Dialogue::open`], without verifying the files: for programs that have verified them before, such as with
    /// `lipz verify`. Queries still do not panic, but a damaged file may lead to wrong values or `None`, and each text
    /// is checked to be UTF-8 on each query.
    ///
    /// # Errors
    /// As [`Dialogue::open`], as far as headers and directories show them.
    pub fn open_unverified<S: Into<Source>>(sources: impl IntoIterator<Item = S>) -> Result<Dialogue, OpenError> {
        Dialogue::open_in(sources, Mode { is_mapped: false, verifies: false })
    }

    /// Maps the files and verifies them, which reads all of them. Banks of a set are mapped and verified on demand.
    ///
    /// # Safety
    /// As for [`FileBytes::map`](crate::FileBytes::map), for these files and for all that replace them: no process may
    /// change or truncate one while this dialogue, a clone or a later version of it exists. Rename new files over old
    /// ones. `lipz shard link` writes new banks of a set under new names, and removes the old ones after it has written
    /// the new index.
    ///
    /// # Errors
    /// As [`Dialogue::open`], and if a file cannot be mapped.
    #[allow(unsafe_code)] // the caller keeps the contract
    pub unsafe fn open_mapped<S: Into<Source>>(sources: impl IntoIterator<Item = S>) -> Result<Dialogue, OpenError> {
        Dialogue::open_in(sources, Mode { is_mapped: true, verifies: true })
    }

    /// Maps the files without verifying them. Opening takes microseconds, and a page is read when it is accessed.
    ///
    /// # Safety
    /// As for [`Dialogue::open_mapped`].
    ///
    /// # Errors
    /// As [`Dialogue::open_unverified`], and if a file cannot be mapped.
    #[allow(unsafe_code)] // the caller keeps the contract
    pub unsafe fn open_mapped_unverified<S: Into<Source>>(
        sources: impl IntoIterator<Item = S>,
    ) -> Result<Dialogue, OpenError> {
        Dialogue::open_in(sources, Mode { is_mapped: true, verifies: false })
    }

    fn open_in<S: Into<Source>>(sources: impl IntoIterator<Item = S>, mode: Mode) -> Result<Dialogue, OpenError> {
        let sources: Vec<Source> = sources.into_iter().map(Into::into).collect();
        // Before the files are read, so that later changes are detected.
        let mut seen = ObservedStamps::of(&sources, &[])?;
        let files = HostFiles::load(&sources, mode, None)?;
        let snapshot = Arc::new(snapshot(files)?);
        if snapshot.borrow_owner().list().len() > sources.len() {
            seen.are_settled = false; // the banks of a set are not in it yet
        }
        Ok(Dialogue { snapshot, sources, mode, seen })
    }

    /// Opens new versions of the files if all of them are verified and match, and returns the changes. Otherwise this
    /// version stays in use. Call it where a pause of some milliseconds does no harm, or with a clone in your own
    /// thread.
    ///
    /// While the files look the same, this costs one `stat` each. The headers of files younger than two seconds are
    /// read with every call, because on some file systems the next version could look the same.
    ///
    /// # Errors
    /// The reason why the files cannot be used, such as a patch that was packed over another version of its base:
    /// replace that file as well. The same invalid files are not reported again once they are older than two seconds; a
    /// missing file is reported every time.
    pub fn refresh(&mut self) -> Result<Changes, OpenError> {
        let now = ObservedStamps::of(&self.sources, self.snapshot.borrow_owner().list())?;
        if self.seen.are_settled && self.seen.stamps == now.stamps {
            return Ok(Changes::default());
        }
        self.seen = now;
        let changes = self.take_in(self.sources.clone());
        // A bank that a new index names may arrive after it, and does not have a stamp yet.
        self.seen.are_settled &= !matches!(&changes, Err(error) if error.is_missing());
        changes
    }

    /// Opens another file on top of the others: a text bank, a patch, the dubs of a voice. Returns the changes.
    ///
    /// # Errors
    /// The reason why the file cannot be used. The dialogue is then unchanged.
    pub fn add(&mut self, source: impl Into<Source>) -> Result<Changes, OpenError> {
        let mut sources = self.sources.clone();
        sources.push(source.into());
        self.take_in(sources)
    }

    /// Removes a file by the path or name with which it was opened. Does nothing if there is no such file.
    ///
    /// # Errors
    /// If the remaining files do not match without it, such as the patches above it. The dialogue is then unchanged.
    pub fn remove(&mut self, path: impl AsRef<Path>) -> Result<Changes, OpenError> {
        let is_kept = |source: &Source| source.path() != path.as_ref();
        self.take_in(self.sources.iter().filter(|source| is_kept(source)).cloned().collect())
    }

    /// Replaces the sources with these.
    fn take_in(&mut self, sources: Vec<Source>) -> Result<Changes, OpenError> {
        let old = self.snapshot.borrow_owner();
        let files = HostFiles::load(&sources, self.mode, Some(old))?;
        let is_in = |file: &HostFile, all: &[HostFile]| all.iter().any(|other| other.is_like(file));
        let mut changed: Vec<PathBuf> = Vec::new();
        for (own, others) in [(files.list(), old.list()), (old.list(), files.list())] {
            changed.extend(own.iter().filter(|file| !is_in(file, others)).map(|file| file.path.clone()));
        }
        changed.sort_unstable();
        changed.dedup();
        // A file that was added twice changes no path, and does not match.
        let is_same = files.list().len() == old.list().len() && changed.is_empty();
        if !is_same {
            self.snapshot = Arc::new(snapshot(files)?);
            self.seen.are_settled = false; // the new files are not in it yet
        }
        self.sources = sources;
        Ok(Changes::new(changed))
    }

    /// Returns the files of this version, from the bottom to the top, including the banks of a set.
    pub fn files(&self) -> impl ExactSizeIterator<Item = &Path> {
        self.snapshot.borrow_owner().list().iter().map(|file| file.path.as_path())
    }

    /// Opens, and in most modes verifies, the banks of a set that no query has needed yet.
    ///
    /// # Errors
    /// The first bank that is damaged or is not the one that the index names.
    pub fn open_all(&self) -> Result<(), OpenError> {
        self.snapshot.borrow_owner().open_all()
    }

    /// Returns the reasons for missing clips: the banks of a set that are damaged, among those opened so far.
    pub fn failures(&self) -> impl Iterator<Item = OpenError> + '_ {
        self.snapshot.borrow_owner().failures()
    }

    /// Returns the dialogue without its files, for functions that accept any dialogue.
    pub fn view(&self) -> &lipz_bank::Dialogue<'_> {
        self.snapshot.borrow_dependent()
    }
}

fn snapshot(files: HostFiles) -> Result<Snapshot, OpenError> {
    let paths: Vec<PathBuf> = files.list().iter().map(|file| file.path.clone()).collect();
    Snapshot::try_new(files, |files| lipz_bank::Dialogue::with_files(files)).map_err(|error| {
        let path = paths.get(error.file()).or(paths.last()).cloned().unwrap_or_default();
        OpenError::new(&path, error.error())
    })
}

impl ObservedStamps {
    /// Observes the sources that may be replaced, which must exist, and the other files.
    fn of(sources: &[Source], files: &[HostFile]) -> Result<ObservedStamps, OpenError> {
        let look = |path: &Path| fs::metadata(path).map(|metadata| Stamp::new(&metadata));
        let mut stamps = Vec::new();
        for source in sources.iter().filter(|source| source.contents().is_none()) {
            stamps.push(Some(look(source.path()).map_err(|error| OpenError::new(source.path(), error))?));
        }
        let banks = files.iter().filter(|file| sources.iter().all(|source| source.path() != file.path));
        stamps.extend(banks.map(|bank| look(&bank.path).ok()));
        let are_settled = stamps.iter().flatten().all(Stamp::is_settled);
        Ok(ObservedStamps { stamps, are_settled })
    }
}

/// Prints the files, not their contents.
impl fmt::Debug for Dialogue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Dialogue").field(&self.files().collect::<Vec<_>>()).finish()
    }
}
