//! The parts of an XLSX file, each unpacked while it is read, with a limit on their total size.

use super::xml::PartReader;
use crate::formats::xlsx::MAX_UNPACKED_BYTES;
use lipz_diagnostics::escape;
use std::cell::Cell;
use std::io::{self, Cursor, Read};
use zip::ZipArchive;
use zip::read::ZipFile;
use zip::result::ZipError;

/// The total unpacked size that is allowed for any file, in bytes.
const FREE_BYTES: u64 = 1 << 26;

/// The additional unpacked bytes per byte of the file. Files written by programs are compressed to a tenth, malicious
/// ones to a thousandth.
const RATIO: u64 = 32;

/// The most bytes of a tag, a comment or a text without tags: a hundred times the capacity of a cell.
const MAX_PIECE_BYTES: u64 = 1 << 22;

/// Returns the greatest total unpacked size of the parts of a file of this size.
pub(super) fn most_bytes(file_bytes: usize) -> u64 {
    (FREE_BYTES + RATIO * file_bytes as u64).min(MAX_UNPACKED_BYTES)
}

/// Returns the greatest total unpacked size of a file, if its parts exceed it.
pub(crate) fn exceeded(file: &[u8]) -> Option<u64> {
    let mut archive = ZipArchive::new(Cursor::new(file)).ok()?;
    let parts = 0..archive.len();
    let unpacked: u64 = parts.filter_map(|part| Some(archive.by_index(part).ok()?.size())).sum();
    Some(most_bytes(file.len())).filter(|most| unpacked > *most)
}

/// The reason why a file is rejected.
pub(super) struct Refusal {
    pub(super) why: String,
    pub(super) help: &'static str,
}

impl<T: Into<String>> From<T> for Refusal {
    fn from(why: T) -> Refusal {
        Refusal { why: why.into(), help: "open it in a spreadsheet program, and save it as .xlsx without a password" }
    }
}

impl Refusal {
    /// Converts a library's error about a part.
    pub(super) fn of(error: &dyn std::error::Error) -> Refusal {
        escape::text(&error.to_string()).into_owned().into()
    }

    pub(super) fn too_large(what: &str, most: u64) -> Refusal {
        let why = format!("{what} more than {} megabytes", most >> 20);
        Refusal { why, help: "split it, or save it as CSV" }
    }
}

/// The parts of a file, and the remaining limit on their unpacked size.
pub(super) struct Parts<'b> {
    archive: ZipArchive<Cursor<&'b [u8]>>,
    limits: Limits,
}

/// The numbers of bytes that may still be unpacked.
#[derive(Debug)]
pub(super) struct Limits {
    most_bytes: u64,
    left_bytes: Cell<u64>,
    /// Those for the current piece.
    left_piece_bytes: Cell<u64>,
}

impl<'b> Parts<'b> {
    pub(super) fn new(file: &'b [u8]) -> Result<Parts<'b>, Refusal> {
        let archive = ZipArchive::new(Cursor::new(file)).map_err(|error| Refusal::of(&error))?;
        let most_bytes = most_bytes(file.len());
        let limits =
            Limits { most_bytes, left_bytes: Cell::new(most_bytes), left_piece_bytes: Cell::new(MAX_PIECE_BYTES) };
        Ok(Parts { archive, limits })
    }

    /// Whether cells have comments, in the old or the new form.
    pub(super) fn has_cell_comments(&self) -> bool {
        let mut names = self.archive.file_names().flatten();
        names.any(|name| name.starts_with("xl/comments") || name.starts_with("xl/threadedComments/"))
    }

    /// Returns a part; `None` if there is no part with this name.
    pub(super) fn part(&mut self, name: &str) -> Result<Option<PartReader<'_, 'b>>, Refusal> {
        let file = match self.archive.by_name(name) {
            Ok(file) => file,
            Err(ZipError::FileNotFound) => return Ok(None),
            Err(error) => return Err(Refusal::of(&error)),
        };
        Ok(Some(PartReader::new(BoundedReader { file, limits: &self.limits }, &self.limits)))
    }
}

impl Limits {
    /// Starts a new piece.
    pub(super) fn begin_piece(&self) {
        self.left_piece_bytes.set(MAX_PIECE_BYTES);
    }

    /// Returns the limit that is exceeded, if any.
    pub(super) fn exceeded(&self) -> Option<Refusal> {
        if self.left_bytes.get() == 0 {
            return Some(Refusal::too_large("unpacked it has", self.most_bytes));
        }
        let is_piece = self.left_piece_bytes.get() == 0;
        is_piece.then(|| Refusal::too_large("a tag or a text in it has", MAX_PIECE_BYTES))
    }
}

/// The bytes of a part, up to the limits, whatever size the archive declares.
pub(super) struct BoundedReader<'p, 'b> {
    file: ZipFile<'p, Cursor<&'b [u8]>>,
    limits: &'p Limits,
}

impl Read for BoundedReader<'_, '_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.file.read(buffer)?;
        for left in [&self.limits.left_bytes, &self.limits.left_piece_bytes] {
            left.set(left.get().saturating_sub(count as u64));
        }
        if self.limits.exceeded().is_some() { Err(io::ErrorKind::FileTooLarge.into()) } else { Ok(count) }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn what_is_too_large_to_be_read_is_not_written() {
        let packed = |bytes: usize| {
            let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
            archive.start_file("a", zip::write::SimpleFileOptions::default()).unwrap();
            io::Write::write_all(&mut archive, &vec![b'a'; bytes]).unwrap();
            archive.finish().unwrap().into_inner()
        };
        assert_eq!(exceeded(&packed(1 << 20)), None);
        let large = packed(usize::try_from(FREE_BYTES * 2).unwrap());
        assert_eq!(exceeded(&large), Some(most_bytes(large.len())));
    }
}
