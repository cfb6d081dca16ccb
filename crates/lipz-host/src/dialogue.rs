//! A dialogue together with its files.

use crate::files::{HostFile, HostFiles, Mode};
use crate::stamp::Stamp;
use crate::{Changes, OpenError, Source};
use self_cell::self_cell;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::{fmt, fs};

self_cell!(
    /// One version: the files, and the dialogue that they are.
    struct Snapshot {
        owner: HostFiles,
        #[covariant]
        dependent: View,
    }
);

type View<'a> = lipz_bank::Dialogue<'a>;

/// Files that answer as one bank: a bank or a set of banks, the patches over it, and text banks.
///
/// Name them from the bottom to the top: the base first, a bank or the index of a set, next to which its banks are; then patches,
/// downloads and mods, each over those before it, and text banks, each after the bank of its clips. The kind of a file is in its
/// header. Opening checks that all files fit.
///
/// The value is one version of the files. A clone is the same version, and copies the paths alone: give one to each thread that reads.
/// [`refresh`](Dialogue::refresh), [`add`](Dialogue::add) and [`remove`](Dialogue::remove) change this value only, all files or
/// none; clones stay as they are. [`Locale`](lipz_bank::Locale), [`Voice`](lipz_bank::Voice) and names are those of a version:
/// in a different version they lead to nothing, so look them up again. A [`Cursor`](lipz_bank::Cursor) and a
/// [`ClipId`](lipz_bank::ClipId) count in every version.
///
/// The banks of a set are verified when the first answer is from one of them. The clips of a damaged one are missing, and
/// [`failures`](Dialogue::failures) says why.
#[derive(Clone)]
pub struct Dialogue {
    snapshot: Arc<Snapshot>,
    sources: Vec<Source>,
    mode: Mode,
    seen: Seen,
}

/// A look at the files.
#[derive(Clone)]
struct Seen {
    /// The banks of a set may be gone when a new set has taken its place.
    stamps: Vec<Option<Stamp>>,
    /// Whether other files would look otherwise. Younger ones may be replaced by some that look the same.
    are_settled: bool,
}

impl Dialogue {
    /// Reads the files into memory and verifies them.
    ///
    /// # Errors
    /// The first file that cannot be read, is damaged, or does not fit those before it.
    pub fn open<S: Into<Source>>(sources: impl IntoIterator<Item = S>) -> Result<Dialogue, OpenError> {
        Dialogue::open_in(sources, Mode { is_mapped: false, verifies: true })
    }

    /// Like [`Dialogue::open`], without verifying the files: for programs that have done so before, such as with
    /// `lipz verify`. No query panics all the same, but a damaged file may have wrong answers or none, and each text is checked to
    /// be UTF-8 when it is asked for.
    ///
    /// # Errors
    /// As [`Dialogue::open`], for what headers and directories show.
    pub fn open_unverified<S: Into<Source>>(sources: impl IntoIterator<Item = S>) -> Result<Dialogue, OpenError> {
        Dialogue::open_in(sources, Mode { is_mapped: false, verifies: false })
    }

    /// Maps the files and verifies them, which reads all of them; the banks of a set when they are asked for.
    ///
    /// # Safety
    /// As for [`FileBytes::map`](crate::FileBytes::map), for these files and for all that take their place: no process changes or
    /// truncates one as long as this dialogue, a clone or a later version of it exists. Rename new files over old ones. `lipz link`
    /// gives new banks of a set new names, and removes the old ones when the new index is there.
    ///
    /// # Errors
    /// As [`Dialogue::open`], and when a file cannot be mapped.
    #[allow(unsafe_code)] // the caller keeps the contract
    pub unsafe fn open_mapped<S: Into<Source>>(sources: impl IntoIterator<Item = S>) -> Result<Dialogue, OpenError> {
        Dialogue::open_in(sources, Mode { is_mapped: true, verifies: true })
    }

    /// Maps the files without verifying them: opening takes microseconds, and a page is read when it is touched.
    ///
    /// # Safety
    /// As for [`Dialogue::open_mapped`].
    ///
    /// # Errors
    /// As [`Dialogue::open_unverified`], and when a file cannot be mapped.
    #[allow(unsafe_code)] // the caller keeps the contract
    pub unsafe fn open_mapped_unverified<S: Into<Source>>(
        sources: impl IntoIterator<Item = S>,
    ) -> Result<Dialogue, OpenError> {
        Dialogue::open_in(sources, Mode { is_mapped: true, verifies: false })
    }

    fn open_in<S: Into<Source>>(sources: impl IntoIterator<Item = S>, mode: Mode) -> Result<Dialogue, OpenError> {
        let sources: Vec<Source> = sources.into_iter().map(Into::into).collect();
        // Before they are read: what is written afterwards then shows.
        let mut seen = Seen::of(&sources, &[])?;
        let files = HostFiles::load(&sources, mode, None)?;
        let snapshot = Arc::new(snapshot(files)?);
        if snapshot.borrow_owner().list().len() > sources.len() {
            seen.are_settled = false; // the banks of a set were not looked at before
        }
        Ok(Dialogue { snapshot, sources, mode, seen })
    }

    /// Takes in new versions of the files once all of them are verified and fit, and reports which have changed. Otherwise this
    /// version stays in use. Call it where a pause of some milliseconds does not hurt, or with a clone in a thread of your own.
    ///
    /// As long as the files look the same, this costs one `stat` each. Of files that are younger than two seconds, the headers are
    /// read with every call: on some file systems the next version could look the same.
    ///
    /// # Errors
    /// Why the files cannot be used, such as a patch that was made over another version of its base: replace the other file, too.
    /// The same files are not refused again once they are older than two seconds; a missing one is refused every time.
    pub fn refresh(&mut self) -> Result<Changes, OpenError> {
        let now = Seen::of(&self.sources, self.snapshot.borrow_owner().list())?;
        if self.seen.are_settled && self.seen.stamps == now.stamps {
            return Ok(Changes::default());
        }
        self.seen = now;
        let changes = self.take_in(self.sources.clone());
        // A bank that a new index names may arrive after it, and no stamp is about that bank yet.
        self.seen.are_settled &= !matches!(&changes, Err(error) if error.is_missing());
        changes
    }

    /// Opens another file on top of the others: a text bank, a patch, the dubs of a voice. What it changes is in the result.
    ///
    /// # Errors
    /// Why the file cannot be used. The dialogue stays as it was.
    pub fn add(&mut self, source: impl Into<Source>) -> Result<Changes, OpenError> {
        let mut sources = self.sources.clone();
        sources.push(source.into());
        self.take_in(sources)
    }

    /// Lets go of a file, by the path or the name that it was opened with; nothing changes if there is none.
    ///
    /// # Errors
    /// When the others do not fit without it, such as the patches over it. The dialogue stays as it was.
    pub fn remove(&mut self, path: impl AsRef<Path>) -> Result<Changes, OpenError> {
        let is_kept = |source: &Source| source.path() != path.as_ref();
        self.take_in(self.sources.iter().filter(|source| is_kept(source)).cloned().collect())
    }

    /// Goes on with these sources.
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
        // A file that was added twice changes no path, and does not fit.
        let is_same = files.list().len() == old.list().len() && changed.is_empty();
        if !is_same {
            self.snapshot = Arc::new(snapshot(files)?);
            self.seen.are_settled = false; // of the files that are new
        }
        self.sources = sources;
        Ok(Changes::new(changed))
    }

    /// The files that this version is made of, from the bottom to the top, the banks of a set among them.
    pub fn files(&self) -> impl ExactSizeIterator<Item = &Path> {
        self.snapshot.borrow_owner().list().iter().map(|file| file.path.as_path())
    }

    /// Opens, and in most modes verifies, the banks of a set that have not been asked for yet.
    ///
    /// # Errors
    /// The first bank that is damaged or not the one that the index names.
    pub fn open_all(&self) -> Result<(), OpenError> {
        self.snapshot.borrow_owner().open_all()
    }

    /// Why clips are missing: the banks of a set that were asked for and turned out to be damaged.
    pub fn failures(&self) -> impl Iterator<Item = OpenError> + '_ {
        self.snapshot.borrow_owner().failures()
    }

    /// The dialogue without its files, for functions that take one, whoever has opened it.
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

impl Seen {
    /// A look at the sources that may be replaced, which have to be there, and at the other files.
    fn of(sources: &[Source], files: &[HostFile]) -> Result<Seen, OpenError> {
        let look = |path: &Path| fs::metadata(path).map(|metadata| Stamp::new(&metadata));
        let mut stamps = Vec::new();
        for source in sources.iter().filter(|source| source.contents().is_none()) {
            stamps.push(Some(look(source.path()).map_err(|error| OpenError::new(source.path(), error))?));
        }
        let banks = files.iter().filter(|file| sources.iter().all(|source| source.path() != file.path));
        stamps.extend(banks.map(|bank| look(&bank.path).ok()));
        let are_settled = stamps.iter().flatten().all(Stamp::is_settled);
        Ok(Seen { stamps, are_settled })
    }
}

/// The files, not their contents.
impl fmt::Debug for Dialogue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Dialogue").field(&self.files().collect::<Vec<_>>()).finish()
    }
}
