//! The bank of the previous run: in memory, or as a file of which only the tables are in memory.

use super::recall::checksum_of;
use crate::files::FileMeta;
use lipz_layout::{CHECKED_FROM, DirectoryEntry, Header, MAX_SECTIONS, RunningChecksum, Tag, checksum};
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::Path;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use zerocopy::FromBytes;

/// The largest sections of a bank, from which a clip is recalled piece by piece.
const LARGE: [Tag; 3] = [Tag::FRAMES, Tag::TEXTS, Tag::SOURCES];

/// The number of bytes read at a time.
const BLOCK_BYTES: usize = 1 << 16;

/// The bank of the previous run. A clone shares it.
#[derive(Clone)]
pub(super) enum OldBank {
    Whole(Arc<Vec<u8>>),
    File(Arc<BankFile>),
}

/// A bank in a file.
pub(super) struct BankFile {
    file: Mutex<File>,
    /// A buffer as long as the file. It contains only the small sections. The pages of the others are never touched and
    /// take no memory.
    tables: Vec<u8>,
    /// The metadata of the file before it was read.
    meta: FileMeta,
    /// Whether the bytes match the checksum in the header. Not computed where all of them are read anyway.
    is_proven: OnceLock<bool>,
}

/// The last range read from the file, which usually contains the next data as well.
#[derive(Default)]
pub(super) struct Window {
    start: usize,
    bytes: Vec<u8>,
}

impl OldBank {
    /// Opens the bank in the file at `path`; `None` if its header does not have this checksum.
    pub(super) fn open(path: &Path, expected_checksum: u64) -> Option<OldBank> {
        BankFile::open(path, expected_checksum).ok().flatten().map(|file| OldBank::File(file.into()))
    }

    /// Returns the bank, of which only the small sections are guaranteed to be present.
    pub(super) fn tables(&self) -> &[u8] {
        match self {
            OldBank::Whole(bytes) => bytes,
            OldBank::File(file) => &file.tables,
        }
    }

    /// Returns the bytes in this range, using `window`, which holds the range read last and is filled with `at_once`
    /// bytes.
    pub(super) fn bytes<'w>(&'w self, range: Range<usize>, window: &'w mut Window, at_once: usize) -> Option<&'w [u8]> {
        let file = match self {
            OldBank::Whole(bytes) => return bytes.get(range),
            OldBank::File(file) => file,
        };
        if range.start < window.start || range.end > window.start + window.bytes.len() {
            let length = at_once.max(range.len()).min(file.tables.len().checked_sub(range.start)?);
            window.start = range.start;
            window.bytes.resize(length, 0);
            file.read_exact(range.start, &mut window.bytes).ok()?;
        }
        window.bytes.get(range.start - window.start..range.end.checked_sub(window.start)?)
    }

    /// Reads the bytes from this offset.
    pub(super) fn read(&self, offset: usize, bytes: &mut [u8]) -> Option<()> {
        match self {
            OldBank::Whole(whole) => bytes.copy_from_slice(whole.get(offset..offset.checked_add(bytes.len())?)?),
            OldBank::File(file) => file.read_exact(offset, bytes).ok()?,
        }
        Some(())
    }

    /// Returns the number of clips in the tables.
    pub(super) fn clip_count(&self) -> Option<usize> {
        lipz_bank::Bank::open(self.tables()).ok().map(|bank| bank.clip_count())
    }

    /// Whether all bytes match the checksum in the header, which proves that this is the verified bank.
    pub(super) fn is_proven(&self) -> bool {
        match self {
            OldBank::Whole(_) => true,
            OldBank::File(file) => *file.is_proven.get_or_init(|| {
                let mut checksum = RunningChecksum::default();
                let is_read = file.add_to(&mut checksum, CHECKED_FROM..file.tables.len()).is_ok();
                is_read && Some(checksum.finish()) == checksum_of(&file.tables)
            }),
        }
    }

    /// Returns a pass over all bytes, which proves them.
    pub(super) fn pass(&self) -> Pass<'_> {
        Pass { old: self, checksum: RunningChecksum::default(), at: CHECKED_FROM }
    }

    /// Whether the file is unmodified since it was opened, so that all data read since then belongs to the bank.
    pub(super) fn is_as_it_was(&self) -> bool {
        match self {
            OldBank::Whole(_) => true,
            OldBank::File(bank) => {
                let file = bank.file.lock().unwrap_or_else(PoisonError::into_inner);
                file.metadata().ok().as_ref().and_then(FileMeta::new) == Some(bank.meta)
            }
        }
    }

    /// Returns the whole bank; `None` if it has been modified.
    pub(super) fn into_whole(self) -> Option<Vec<u8>> {
        match self {
            OldBank::Whole(bytes) => Some(Arc::unwrap_or_clone(bytes)),
            OldBank::File(file) => {
                let expected_checksum = checksum_of(&file.tables)?;
                let mut bytes = match Arc::try_unwrap(file) {
                    Ok(BankFile { file, mut tables, .. }) => {
                        let mut file = file.into_inner().unwrap_or_else(PoisonError::into_inner);
                        file.seek(SeekFrom::Start(0)).and_then(|_| file.read_exact(&mut tables)).ok()?;
                        tables
                    }
                    Err(shared) => {
                        let mut bytes = vec![0; shared.tables.len()];
                        shared.read_exact(0, &mut bytes).ok()?;
                        bytes
                    }
                };
                bytes.shrink_to_fit();
                (checksum(bytes.get(CHECKED_FROM..)?) == expected_checksum).then_some(bytes)
            }
        }
    }
}

/// A pass over the bytes of a bank from front to end: those in the file, each read once, and the tables in memory. If
/// all bytes are read anyway, the proof costs no more than their checksum.
pub(super) struct Pass<'o> {
    old: &'o OldBank,
    checksum: RunningChecksum,
    /// The end of the bytes included in the checksum.
    at: usize,
}

impl Pass<'_> {
    /// Reads the bytes from this offset and passes them on in pieces; `None` if they do not come after the previous
    /// ones.
    pub(super) fn read(&mut self, offset: usize, place: &mut [u8], mut next: impl FnMut(&[u8])) -> Option<()> {
        let tables = self.old.tables();
        let range = offset..offset.checked_add(place.len()).filter(|end| *end <= tables.len())?;
        self.go_to(offset)?;
        for (block, is_table) in blocks_in(tables, range) {
            let piece = &mut place[block.start - offset..block.end - offset];
            if is_table {
                piece.copy_from_slice(&tables[block]);
            } else {
                self.old.read(block.start, piece)?;
            }
            self.at += piece.len();
            if matches!(self.old, OldBank::File(_)) {
                self.checksum.add(piece);
            }
            next(piece);
        }
        Some(())
    }

    /// Advances to this offset; `None` if it is before the current one, as with the sections of a damaged directory.
    fn go_to(&mut self, offset: usize) -> Option<()> {
        if offset < self.at {
            return None;
        }
        let skipped = self.at..offset;
        self.at = offset;
        match self.old {
            OldBank::Whole(_) => Some(()),
            OldBank::File(file) => file.add_to(&mut self.checksum, skipped).ok(),
        }
    }

    /// Whether the bytes match the checksum in the header.
    pub(super) fn proves(mut self) -> bool {
        let OldBank::File(file) = self.old else { return true };
        let is_read = self.go_to(file.tables.len()).is_some();
        let is_proven = is_read && Some(self.checksum.finish()) == checksum_of(&file.tables);
        *file.is_proven.get_or_init(|| is_proven) && is_proven
    }
}

impl BankFile {
    fn open(path: &Path, expected_checksum: u64) -> io::Result<Option<BankFile>> {
        let mut file = File::open(path)?;
        let metadata = file.metadata()?;
        let length = u32::try_from(metadata.len()).map_or(0, |length| length as usize);
        let (true, Some(meta)) = (metadata.is_file() && length > size_of::<Header>(), FileMeta::new(&metadata)) else {
            return Ok(None);
        };
        let mut tables = vec![0; length];
        // Enough for the directory with the maximum number of sections.
        let head = (size_of::<Header>() + MAX_SECTIONS * size_of::<DirectoryEntry>()).min(length);
        file.read_exact(&mut tables[..head])?;
        if checksum_of(&tables) != Some(expected_checksum) {
            return Ok(None);
        }
        for (block, is_table) in blocks(&tables) {
            if is_table {
                file.seek(SeekFrom::Start(block.start as u64))?;
                file.read_exact(&mut tables[block])?;
            }
        }
        Ok(Some(BankFile { file: file.into(), tables, meta, is_proven: OnceLock::new() }))
    }

    /// Adds the bytes in this range to a checksum: tables from memory, everything else from the file.
    fn add_to(&self, checksum: &mut RunningChecksum, range: Range<usize>) -> io::Result<()> {
        let mut bytes = Vec::new();
        for (block, is_table) in blocks_in(&self.tables, range) {
            if is_table {
                checksum.add(&self.tables[block]);
            } else {
                bytes.resize(block.len(), 0);
                self.read_exact(block.start, &mut bytes)?;
                checksum.add(&bytes);
            }
        }
        Ok(())
    }

    fn read_exact(&self, offset: usize, bytes: &mut [u8]) -> io::Result<()> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(offset as u64))?;
        file.read_exact(bytes)
    }
}

/// Returns the blocks of a bank, each with a flag that is true if it contains anything besides parts of large sections.
/// The directory of the bank must be present.
fn blocks(bank: &[u8]) -> Vec<(Range<usize>, bool)> {
    blocks_in(bank, 0..bank.len())
}

/// Returns the same blocks, limited to this range.
fn blocks_in(bank: &[u8], range: Range<usize>) -> Vec<(Range<usize>, bool)> {
    let large: Vec<Range<usize>> = LARGE.into_iter().filter_map(|tag| section(bank, tag)).collect();
    let starts = (range.start / BLOCK_BYTES * BLOCK_BYTES..range.end).step_by(BLOCK_BYTES);
    let blocks = starts.map(|start| start..(start + BLOCK_BYTES).min(bank.len()));
    let is_large = |block: &Range<usize>| large.iter().any(|part| part.start <= block.start && block.end <= part.end);
    let part = |block: &Range<usize>| block.start.max(range.start)..block.end.min(range.end);
    blocks.map(|block| (part(&block), !is_large(&block))).collect()
}

/// Returns the range of a section in a bank.
pub(crate) fn section(bank: &[u8], tag: Tag) -> Option<Range<usize>> {
    let (header, rest) = Header::ref_from_prefix(bank).ok()?;
    let count = (header.section_count.get() as usize).min(MAX_SECTIONS);
    let (directory, _) = <[DirectoryEntry]>::ref_from_prefix_with_elems(rest, count).ok()?;
    let entry = directory.iter().find(|entry| entry.tag == tag.0)?;
    let start = entry.offset_bytes.get() as usize;
    Some(start..start.checked_add(entry.length_bytes.get() as usize)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::Compiler;
    use crate::sources::Input;

    fn bank(text: &str) -> Vec<u8> {
        let file = |number| format!(r#"{{"visemes":"A-","viseme_type":"blair","text_en-us":"{text} {number}"}}"#);
        let inputs: Vec<Input> =
            (100..400).map(|number| Input::from_bytes(format!("{number}"), file(number))).collect();
        Compiler::default().compile(&inputs).into_bank().unwrap()
    }

    #[test]
    fn a_file_gives_the_bytes_of_the_bank_or_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("b.lipzbank");
        let bytes = bank("Aye.");
        let checksum = checksum_of(&bytes).unwrap();
        std::fs::write(&path, &bytes).unwrap();
        let old = OldBank::open(&path, checksum).unwrap();
        let mut window = Window::default();
        for at_once in [1, 7, 600, BLOCK_BYTES] {
            for start in (0..bytes.len() - 40).step_by(13) {
                let found = old.bytes(start..start + start % 40, &mut window, at_once);
                assert_eq!(found, Some(&bytes[start..start + start % 40]), "{start}, {at_once} at once");
            }
        }
        assert_eq!(old.bytes(bytes.len() - 1..bytes.len() + 1, &mut window, 1), None);
        assert!(old.is_as_it_was() && old.is_proven());
        assert!(old.clone().into_whole().is_some_and(|whole| whole == bytes), "shared");
        assert!(old.into_whole().is_some_and(|whole| whole == bytes));
        assert!(OldBank::open(&path, checksum ^ 1).is_none());
    }

    #[test]
    fn a_pass_proves_what_it_reads_and_what_it_leaves_out() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("b.lipzbank");
        let bytes = bank(&"Aye. ".repeat(600));
        let checksum = checksum_of(&bytes).unwrap();
        let (from, to) = (BLOCK_BYTES + 100, 6 * BLOCK_BYTES + 9);
        let pass = |old: OldBank| {
            let (mut pass, mut place, mut pieces) = (old.pass(), vec![0; to - from], Vec::new());
            pass.read(from, &mut place, |piece| pieces.extend_from_slice(piece)).unwrap();
            let is_read = place == bytes[from..to];
            assert!(place == pieces && pass.read(from, &mut place, |_| ()).is_none(), "no second time");
            let is_proven = pass.proves();
            assert!(is_read || !is_proven);
            is_proven
        };
        assert!(pass(OldBank::Whole(bytes.clone().into())));
        std::fs::write(&path, &bytes).unwrap();
        assert!(pass(OldBank::open(&path, checksum).unwrap()));
        for at in [from - 1, from, to - 1, to, bytes.len() - 1] {
            let mut damaged = bytes.clone();
            damaged[at] ^= 4;
            std::fs::write(&path, &damaged).unwrap();
            assert!(!pass(OldBank::open(&path, checksum).unwrap()), "{at}");
        }
    }

    #[test]
    fn damage_anywhere_behind_the_header_is_no_proof() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("b.lipzbank");
        let bytes = bank(&"Aye. ".repeat(600));
        assert!(bytes.len() > 8 * BLOCK_BYTES && blocks(&bytes).iter().any(|(_, is_table)| !is_table));
        let checksum = checksum_of(&bytes).unwrap();
        for at in (size_of::<Header>()..bytes.len()).step_by(BLOCK_BYTES / 3) {
            let mut damaged = bytes.clone();
            damaged[at] ^= 4;
            std::fs::write(&path, &damaged).unwrap();
            let old = OldBank::open(&path, checksum);
            assert!(old.is_none_or(|old| !old.is_proven() && old.into_whole().is_none()), "{at}");
        }
    }

    #[test]
    fn a_file_that_somebody_writes_to_is_no_longer_the_bank() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("b.lipzbank");
        let (bytes, other) = (bank("Aye."), bank("Nay."));
        std::fs::write(&path, &bytes).unwrap();
        let old = OldBank::open(&path, checksum_of(&bytes).unwrap()).unwrap();
        std::thread::sleep(std::time::Duration::from_millis(20));
        std::fs::write(&path, &other).unwrap();
        assert!(bytes.len() == other.len() && !old.is_as_it_was());
        assert_eq!(old.into_whole(), None);
    }
}
