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

/// The way in which files are opened.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Mode {
    /// Whether to map files instead of reading them. Only set if the caller has accepted the contract of an unsafe
    /// function.
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

/// A file in memory or mapped, which may be open.
pub(crate) struct HostFile {
    pub(crate) path: PathBuf,
    bytes: Arc<FileBytes>,
    /// Its number among the files.
    number: usize,
    /// Opened, and in most modes verified, on first use, which is later for the banks of a set.
    open: OnceCell<Result<Arc<OpenFile>, lipz_bank::Error>>,
}

/// The files of one version of a dialogue, with the banks of a set after its index.
pub(crate) struct HostFiles {
    list: Vec<HostFile>,
    /// The number of banks in the base, if that is a set.
    shards: usize,
    mode: Mode,
}

impl HostFiles {
    /// Reads or maps the files, and opens those that are not banks of a set. Unchanged files are taken from `old`.
    pub(crate) fn load(sources: &[Source], mode: Mode, old: Option<&HostFiles>) -> Result<HostFiles, OpenError> {
        match HostFiles::load_once(sources, mode, old) {
            // The set was replaced by a new one while this bank was being opened.
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

    /// Returns the bytes of a source, from `old` if its file has the same checksum.
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
            let _ = file.open.set(Ok(open)); // the cell is empty
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

    /// Returns the same bank, if it is open here under the same number. Texts and banks of a set are verified again,
    /// because their bank or index may be new.
    fn opened_like(&self, file: &HostFile) -> Option<Arc<OpenFile>> {
        let same = self.list.iter().find(|old| Arc::ptr_eq(&old.bytes, &file.bytes) && old.number == file.number)?;
        let open = same.open.get()?.as_ref().ok()?;
        let is_bank = matches!(open.borrow_dependent().kind(), FileKind::Bank | FileKind::Patch);
        let is_of_set = (1..=self.shards).contains(&file.number);
        if is_bank && !is_of_set { Some(Arc::clone(open)) } else { None }
    }

    /// Returns the file, and opens it first if necessary.
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

    /// Checks by its header that a file is the one that the index of the set names.
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

    /// Opens the banks of a set that no query has needed yet.
    pub(crate) fn open_all(&self) -> Result<(), OpenError> {
        self.list.iter().try_for_each(|file| match self.open(file) {
            Ok(_) => Ok(()),
            Err(error) => Err(OpenError::new(&file.path, error)),
        })
    }

    pub(crate) fn list(&self) -> &[HostFile] {
        &self.list
    }

    /// Returns the errors of those opened banks of the set that are damaged.
    pub(crate) fn failures(&self) -> impl Iterator<Item = OpenError> + '_ {
        self.list.iter().filter_map(|file| match file.open.get()? {
            Ok(_) => None,
            Err(error) => Some(OpenError::new(&file.path, *error)),
        })
    }
}

impl HostFile {
    /// Returns the checksum in its header.
    pub(crate) fn checksum(&self) -> Option<u64> {
        checksum(&self.bytes[..]).ok().flatten()
    }

    /// Whether two files have the same contents, by their lengths and the checksums in their headers.
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

/// Returns the paths of the banks that an index names, which are in its folder. Empty for other files.
fn banks_of_set(path: &Path, file: &[u8]) -> Result<Vec<PathBuf>, OpenError> {
    // An index is verified in every mode, so that its names lead to no other folder.
    match SetIndex::open(file).and_then(SetIndex::verify) {
        Ok(index) => Ok(index.banks().map(|bank| path.with_file_name(bank.file_name)).collect()),
        Err(error) if matches!(error.kind(), ErrorKind::NotASet | ErrorKind::TooShort) => Ok(Vec::new()),
        Err(error) => Err(OpenError::new(path, error)),
    }
}

#[allow(unsafe_code)] // covered by the contract of `Dialogue::open_mapped`, the only way to map a file
fn map(file: &File) -> std::io::Result<FileBytes> {
    // SAFETY: the caller of `open_mapped` has guaranteed it for the files and their replacements.
    unsafe { FileBytes::map_from(file) }
}

/// The UTF-8 check of strings.
fn utf8(bytes: &[u8]) -> Option<&str> {
    #[cfg(feature = "simdutf8")]
    return simdutf8::basic::from_utf8(bytes).ok();
    #[cfg(not(feature = "simdutf8"))]
    return std::str::from_utf8(bytes).ok();
}
