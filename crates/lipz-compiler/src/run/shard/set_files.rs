//! The files of a set: a bank with its own name for each shard, and the index, which is written last.

use crate::bank::lower::assemble::{Section, assemble};
use crate::files::path::display;
use crate::files::temporary::folder_of;
use crate::files::{OutputFile, Replace};
use lipz_bank::Bank;
use lipz_bank::files::SetIndex;
use lipz_diagnostics::{Code, Report};
use lipz_layout::{SET_MAGIC, SetBankRecord, Tag, U16, U64};
use std::collections::HashSet;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use zerocopy::IntoBytes;

/// The files of a set.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub struct SetFiles {
    /// The index.
    pub index: OutputFile,
    /// The banks, sorted by shard.
    pub banks: Vec<OutputFile>,
    /// Removed banks of the previous set.
    pub removed: Vec<PathBuf>,
}

/// A written bank of a set that no index names yet.
#[derive(Clone, Debug)]
pub(super) struct SetPart {
    file: OutputFile,
    checksum: u64,
    fingerprint: u64,
    clip_count: usize,
}

/// The destination of the banks of a set.
pub(super) struct SetPlace<'p> {
    pub(super) index: &'p Path,
    shards: u16,
}

impl SetPlace<'_> {
    /// Creates the destination of the set with its index at `index`.
    pub(super) fn new(index: &Path, shards: u16) -> Result<SetPlace<'_>, Report> {
        if index.file_stem().and_then(OsStr::to_str).is_some_and(|stem| !stem.is_empty() && !stem.starts_with('.')) {
            return Ok(SetPlace { index, shards });
        }
        let message = "the index has no name with which the names of the banks could start";
        Err(Report::failure(display(index), Code::OutputFailed, message, "give it a name such as dialogue.lipzset"))
    }

    /// Writes the bank of a shard. Its name contains its checksum, so that banks of the existing set stay unchanged.
    pub(super) fn write(&self, shard: u16, bytes: &[u8]) -> Result<SetPart, Report> {
        let bank = Bank::open(bytes)
            .map_err(|error| Report::failure("", Code::BankDamaged, error.to_string(), "report this bug of lipz"))?;
        let stem = self.index.file_stem().and_then(OsStr::to_str).unwrap_or_default();
        let name = format!("{stem}.{shard}-of-{}.{:016x}.lipzbank", self.shards, bank.checksum());
        let file = OutputFile::write(&self.index.with_file_name(name), bytes, Replace::IfDifferent)?;
        let (checksum, fingerprint, clip_count) = (bank.checksum(), bank.fingerprint(), bank.clip_count());
        Ok(SetPart { file, checksum, fingerprint, clip_count })
    }

    /// Writes the index of these banks, and removes those that it does not name. `moved` are the ids of clips in a
    /// different bank than their ids imply, each with its shard.
    pub(super) fn finish(&self, parts: Vec<SetPart>, moved: &[(u64, u16)]) -> Result<SetFiles, Report> {
        let bytes = index(&parts, moved)?;
        let index = OutputFile::write(self.index, &bytes, Replace::IfDifferent)?;
        let banks: Vec<OutputFile> = parts.into_iter().map(|part| part.file).collect();
        let named: HashSet<&OsStr> = banks.iter().filter_map(|bank| bank.path.file_name()).collect();
        let mut removed: Vec<PathBuf> = self.banks_there().filter(|name| !named.contains(name.as_os_str())).collect();
        removed.sort();
        let removed = removed.into_iter().map(|name| self.index.with_file_name(name));
        // On some systems, a bank in use cannot be removed. It stays, and the next run tries again.
        let removed = removed.filter(|path| fs::remove_file(path).is_ok()).collect();
        Ok(SetFiles { index, banks, removed })
    }

    /// Returns the paths of banks next to the index with names of this set.
    fn banks_there(&self) -> impl Iterator<Item = PathBuf> {
        let stem = self.index.file_stem().unwrap_or_default().to_owned();
        let files = fs::read_dir(folder_of(self.index)).into_iter().flatten();
        let names = files.filter_map(|file| file.ok()?.file_name().into_string().ok());
        names.filter(move |name| is_bank_of(name, &stem)).map(PathBuf::from)
    }
}

impl SetPart {
    /// Removes the bank, if it was written for a set that failed.
    pub(super) fn withdraw(&self) {
        if self.file.is_new {
            let _ = fs::remove_file(&self.file.path);
        }
    }
}

/// Whether a file has the name of a bank in the set of this name: `NAME.3-of-64.0123456789abcdef.lipzbank`.
fn is_bank_of(name: &str, stem: &OsStr) -> bool {
    let rest = stem.to_str().and_then(|stem| name.strip_prefix(stem)?.strip_prefix('.')?.strip_suffix(".lipzbank"));
    let parts = rest.and_then(|rest| {
        let (shard, checksum) = rest.split_once('.')?;
        Some((shard.split_once("-of-")?, checksum))
    });
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let is_hex = |byte: u8| matches!(byte, b'0'..=b'9' | b'a'..=b'f');
    parts.is_some_and(|((shard, shards), checksum)| {
        is_number(shard) && is_number(shards) && checksum.len() == 16 && checksum.bytes().all(is_hex)
    })
}

/// Returns the index of these banks.
fn index(parts: &[SetPart], moved: &[(u64, u16)]) -> Result<Vec<u8>, Report> {
    let (mut names, mut records) = (String::new(), Vec::new());
    for part in parts {
        let name = part.file.path.file_name().and_then(OsStr::to_str).unwrap_or_default();
        records.push(SetBankRecord {
            checksum: part.checksum.into(),
            fingerprint: part.fingerprint.into(),
            length_bytes: (part.file.length_bytes as u32).into(),
            clip_count: (part.clip_count as u32).into(),
            name_offset_bytes: (names.len() as u32).into(),
            name_length_bytes: (name.len() as u32).into(),
        });
        names.push_str(name);
    }
    let ids: Vec<U64> = moved.iter().map(|(id, _)| U64::new(*id)).collect();
    let homes: Vec<U16> = moved.iter().map(|(_, home)| U16::new(*home)).collect();
    let sections = [
        Section::table(Tag::SET_BANKS, records.as_bytes()),
        Section::table(Tag::SET_MOVED, ids.as_bytes()),
        Section::table(Tag::SET_HOMES, homes.as_bytes()),
        Section::table(Tag::NAMES, names.as_bytes()),
    ];
    let mut bytes = assemble(&sections, 0, lipz_layout::set_fingerprint(&records), |_| ())?;
    // The checksum does not include it.
    bytes[..SET_MAGIC.len()].copy_from_slice(&SET_MAGIC);
    match SetIndex::open(&bytes).and_then(SetIndex::verify) {
        Ok(_) => Ok(bytes),
        Err(error) => {
            let message = format!("the new index fails verification: {error}");
            Err(Report::failure("", Code::BankDamaged, message, "give the index a name of letters and digits"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_banks_of_a_set_are_taken_for_such() {
        let is_bank = |name| is_bank_of(name, OsStr::new("a"));
        assert!(is_bank("a.3-of-64.0123456789abcdef.lipzbank"));
        for other in [
            "a.lipzbank",
            "a.de-de.lipzbank",
            "a.b.3-of-64.0123456789abcdef.lipzbank",
            "b.3-of-64.0123456789abcdef.lipzbank",
            "a.3-of-64.0123456789abcde.lipzbank",
            "a.3-of-64.0123456789ABCDEF.lipzbank",
            "a.-of-64.0123456789abcdef.lipzbank",
            "a.3-of-64.0123456789abcdef.lipztexts",
        ] {
            assert!(!is_bank(other), "{other}");
        }
    }
}
