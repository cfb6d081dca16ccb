//! The files of one version of a dialogue, with their contents.

use crate::error::Cause;
use crate::stamp::checksum;
use crate::{FileBytes, OpenError, Source};
use lipz_bank::ErrorKind;
use lipz_bank::files::{DialogueFile, FileKind, Files, SetIndex};
use once_cell::sync::OnceCell;
use self_cell::self_cell;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// How files are opened.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Mode {
    /// Mapped, not read: only where the caller of an unsafe function has promised what that asks for.
    pub(crate) is_mapped: bool,
    pub(crate) verifies: bool,
}

self_cell!(
    /// A file of a dialogue with its bytes.
    pub(crate) struct OpenFile {
        owner: Arc<FileBytes>,
        #[covariant]
        dependent: DialogueFile,
    }
);

/// A file that is in memory or mapped, and may be open.
pub(crate) struct HostFile {
    pub(crate) path: PathBuf,
    bytes: Arc<FileBytes>,
    /// Its number among the files.
    number: usize,
    /// Opened, and in most modes verified, when it is asked for: for the banks of a set, that is later.
    open: OnceCell<Result<Arc<OpenFile>, lipz_bank::Error>>,
}

/// The files of one version of a dialogue, the banks of a set behind its index.
pub(crate) struct HostFiles {
    list: Vec<HostFile>,
    /// How many banks the set has that is the base.
    shards: usize,
    mode: Mode,
}

impl HostFiles {
    /// Reads or maps the files, and opens those that are not banks of a set. Files that are the same in `old` are taken from
    /// there.
    pub(crate) fn load(sources: &[Source], mode: Mode, old: Option<&HostFiles>) -> Result<HostFiles, OpenError> {
        match HostFiles::load_once(sources, mode, old) {
            // A new set has taken the place of the one that named this bank.
            Err(error) if error.is_missing() && sources.iter().all(|source| source.path() != error.path()) => {
                HostFiles::load_once(sources, mode, old)
            }
            loaded => loaded,
        }
    }

    fn load_once(sources: &[Source], mode: Mode, old: Option<&HostFiles>) -> Result<HostFiles, OpenError> {
        let mut files = HostFiles { list: Vec::new(), shards: 0, mode };
        let index = sources.first().map(|first| files.bytes_of(first, old)).transpose()?;
        let banks = match (&index, sources.first()) {
            (Some(index), Some(first)) => banks_of_set(first.path(), index)?,
            _ => Vec::new(),
        };
        let (shards, others): (Vec<&Source>, Vec<&Source>) =
            sources.iter().skip(1).partition(|source| banks.iter().any(|bank| bank == source.path()));
        if let (Some(first), Some(bytes)) = (sources.first(), index) {
            files.push(first.path(), bytes, old)?;
        }
        files.shards = banks.len();
        for path in banks {
            let given = shards.iter().find(|source| source.path() == path);
            let source = given.map_or_else(|| Source::from(&path), |given| (*given).clone());
            let bytes = files.bytes_of(&source, old)?;
            files.push(&path, bytes, old)?;
        }
        for source in others {
            let bytes = files.bytes_of(source, old)?;
            files.push(source.path(), bytes, old)?;
        }
        Ok(files)
    }

    /// The bytes of a source: those of `old`, if its file has the same checksum.
    fn bytes_of(&self, source: &Source, old: Option<&HostFiles>) -> Result<Arc<FileBytes>, OpenError> {
        if let Some(bytes) = source.contents() {
            return Ok(Arc::clone(bytes));
        }
        let path = source.path();
        let failed = |error| OpenError::new(path, Cause::File(error));
        let mut file = File::open(path).map_err(failed)?;
        if let Some(old) = old.and_then(|old| old.list.iter().find(|old| old.path == path)) {
            let is_as_long = file.metadata().map_err(failed)?.len() == old.bytes.len() as u64;
            if is_as_long && checksum(&file).map_err(failed)? == old.checksum() {
                return Ok(Arc::clone(&old.bytes));
            }
            file = File::open(path).map_err(failed)?;
        }
        let bytes = if self.mode.is_mapped { map(&file) } else { FileBytes::read_from(&file) };
        bytes.map(Arc::new).map_err(failed)
    }

    /// Adds a file, and opens it unless it is a bank of the set.
    fn push(&mut self, path: &Path, bytes: Arc<FileBytes>, old: Option<&HostFiles>) -> Result<(), OpenError> {
        let number = self.list.len();
        let file = HostFile { path: path.to_owned(), bytes, number, open: OnceCell::new() };
        if let Some(open) = old.and_then(|old| old.opened_like(&file)) {
            let _ = file.open.set(Ok(open)); // it is empty
        }
        self.list.push(file);
        if (1..=self.shards).contains(&number) {
            return Ok(());
        }
        match self.list.last().map(|file| self.open(file)) {
            Some(Err(error)) => Err(OpenError::new(path, error)),
            _ => Ok(()),
        }
    }

    /// The same bank, if it is open here under the same number. Texts are verified again: their bank may be a new one; so are banks
    /// of a set: their index may be.
    fn opened_like(&self, file: &HostFile) -> Option<Arc<OpenFile>> {
        let same = self.list.iter().find(|old| Arc::ptr_eq(&old.bytes, &file.bytes) && old.number == file.number)?;
        let open = same.open.get()?.as_ref().ok()?;
        let is_bank = matches!(open.borrow_dependent().kind(), FileKind::Bank | FileKind::Patch);
        let is_of_set = (1..=self.shards).contains(&file.number);
        if is_bank && !is_of_set { Some(Arc::clone(open)) } else { None }
    }

    /// The file, opened now if it is not open yet.
    fn open<'f>(&self, file: &'f HostFile) -> Result<&'f OpenFile, lipz_bank::Error> {
        let open = file.open.get_or_init(|| {
            if self.mode.verifies {
                file.bytes.expect_all();
            }
            let open = OpenFile::try_new(Arc::clone(&file.bytes), |bytes| {
                let open = DialogueFile::open(bytes, file.number)?;
                if self.mode.verifies {
                    return open.verify_in(self, file.number, utf8);
                }
                self.check_bank_of_set(file.number, &open)?;
                Ok(open)
            });
            file.bytes.expect_queries();
            open.map(Arc::new)
        });
        match open {
            Ok(open) => Ok(open),
            Err(error) => Err(*error),
        }
    }

    /// Checks that a file is the one that the index of the set names, by its header.
    fn check_bank_of_set(&self, number: usize, file: &DialogueFile<'_>) -> Result<(), lipz_bank::Error> {
        if !(1..=self.shards).contains(&number) {
            return Ok(());
        }
        let index = self.file(0).and_then(DialogueFile::set_index);
        match (index, file.bank()) {
            (Some(index), Some(bank)) => index.check_bank(number - 1, bank),
            _ => Ok(()),
        }
    }

    /// Opens the banks of a set that have not been asked for yet.
    pub(crate) fn open_all(&self) -> Result<(), OpenError> {
        self.list.iter().try_for_each(|file| match self.open(file) {
            Ok(_) => Ok(()),
            Err(error) => Err(OpenError::new(&file.path, error)),
        })
    }

    pub(crate) fn list(&self) -> &[HostFile] {
        &self.list
    }

    /// Why banks of the set are not used, which were opened and are damaged.
    pub(crate) fn failures(&self) -> impl Iterator<Item = OpenError> + '_ {
        self.list.iter().filter_map(|file| match file.open.get()? {
            Ok(_) => None,
            Err(error) => Some(OpenError::new(&file.path, *error)),
        })
    }
}

impl HostFile {
    /// The checksum in its header.
    pub(crate) fn checksum(&self) -> Option<u64> {
        checksum(&self.bytes[..]).ok().flatten()
    }

    /// Whether the file has the same contents as another, by its length and the checksum in its header.
    pub(crate) fn is_like(&self, other: &HostFile) -> bool {
        self.path == other.path && self.bytes.len() == other.bytes.len() && self.checksum() == other.checksum()
    }
}

impl Files for HostFiles {
    fn count(&self) -> usize {
        self.list.len()
    }

    fn file(&self, number: usize) -> Option<&DialogueFile<'_>> {
        self.open(self.list.get(number)?).ok().map(OpenFile::borrow_dependent)
    }

    fn file_if_open(&self, number: usize) -> Option<&DialogueFile<'_>> {
        self.list.get(number)?.open.get()?.as_ref().ok().map(|open| open.borrow_dependent())
    }
}

/// The paths of the banks that an index names, which are in its folder; none for a file that is not an index.
fn banks_of_set(path: &Path, file: &[u8]) -> Result<Vec<PathBuf>, OpenError> {
    // Names are checked to lead to no other folder: whatever the mode, an index is verified.
    match SetIndex::open(file).and_then(SetIndex::verify) {
        Ok(index) => Ok(index.banks().map(|bank| path.with_file_name(bank.file_name)).collect()),
        Err(error) if matches!(error.kind(), ErrorKind::NotASet | ErrorKind::TooShort) => Ok(Vec::new()),
        Err(error) => Err(OpenError::new(path, error)),
    }
}

#[allow(unsafe_code)] // the contract of `Dialogue::open_mapped`, through which alone a file is mapped
fn map(file: &File) -> std::io::Result<FileBytes> {
    // SAFETY: the caller of `open_mapped` has promised it for the files and their successors.
    unsafe { FileBytes::map_from(file) }
}

/// The check of strings.
fn utf8(bytes: &[u8]) -> Option<&str> {
    #[cfg(feature = "simdutf8")]
    return simdutf8::basic::from_utf8(bytes).ok();
    #[cfg(not(feature = "simdutf8"))]
    return std::str::from_utf8(bytes).ok();
}
