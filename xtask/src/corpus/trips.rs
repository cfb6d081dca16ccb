//! Round trips and determinism: what must be the same after a detour.

use super::{Differences, Files, Seen, bank_of};
use crate::Failure;
use lipz_bank::Bank;
use lipz_benches::Random;
use lipz_compiler::{Options, discover, unpack};
use std::fs;
use std::path::{Path, PathBuf};

/// The banks of a sub-folder, and a place to unpack them.
pub(super) struct Trips<'a> {
    pub(super) files: &'a Files,
    pub(super) whole: &'a [u8],
    pub(super) stripped: &'a [u8],
    pub(super) temporary: &'a Path,
}

impl Trips<'_> {
    pub(super) fn run(&self, differences: &mut Differences, seen: &mut Seen) -> Result<(), Failure> {
        let exact = self.unpacked("exact", self.whole)?;
        self.documents(&exact, differences)?;
        let mut same = |what: &str, bank: &[u8], expected: &[u8]| {
            if bank == expected {
                seen.identical_banks += 1;
            } else {
                let at = std::iter::zip(bank, expected).position(|(a, b)| a != b);
                let (length, other) = (bank.len(), expected.len());
                differences.add(|| format!("{what}: other bytes from {at:?} ({length} bytes, expected {other})"));
            }
        };
        let whole = Options::default();
        same("unpacked and packed", &bank_of_folder(&exact, &whole)?, self.whole);
        let strip = Options { strip: true, ..Options::default() };
        let display = self.unpacked("display", self.stripped)?;
        same("stripped, unpacked and packed", &bank_of_folder(&display, &strip)?, self.stripped);
        let mut inputs = self.files.inputs.clone();
        for threads in 1..=8 {
            Random::new(threads as u64, 0).shuffle(&mut inputs);
            let options = Options { threads: Some(threads), ..Options::default() };
            same(&format!("shuffled, {threads} threads"), &bank_of(&inputs, &options)?, self.whole);
        }
        same("a copy elsewhere", &bank_of_folder(&self.copy()?, &whole)?, self.whole);
        Ok(())
    }

    fn unpacked(&self, name: &str, bytes: &[u8]) -> Result<PathBuf, Failure> {
        let folder = self.temporary.join(name);
        let bank = Bank::open(bytes).and_then(Bank::verify).map_err(|error| error.to_string())?;
        unpack(&bank, &folder, false, &|_| {}).map_err(|reports| format!("unpacking: {reports:?}"))?;
        Ok(folder)
    }

    /// The unpacked files against the original ones: by the parser of this project, which keeps
    /// order and spelling, and by another one.
    fn documents(&self, folder: &Path, differences: &mut Differences) -> Result<(), Failure> {
        for (key, original) in &self.files.contents {
            let path = folder.join(format!("{key}.lipz"));
            let unpacked = fs::read(&path).map_err(|error| format!("`{}`: {error}", path.display()))?;
            let (before, after) = (lipz::parse(original), lipz::parse(&unpacked));
            if before.document.is_none() || before.document != after.document {
                differences.add(|| format!("{key}: unpacked, the document is not that of the file"));
            }
            let (before, after) = (json(original), json(&unpacked));
            if before.is_none() || before != after {
                differences.add(|| format!("{key}: unpacked, the JSON is not that of the file"));
            }
        }
        Ok(())
    }

    /// A copy of the files with another path and other times.
    fn copy(&self) -> Result<PathBuf, Failure> {
        let folder = self.temporary.join("elsewhere/deeper");
        for (key, contents) in &self.files.contents {
            let path = folder.join(format!("{key}.lipz"));
            let parent = path.parent().unwrap_or(&folder);
            fs::create_dir_all(parent)
                .and_then(|()| fs::write(&path, contents))
                .map_err(|error| format!("`{}`: {error}", path.display()))?;
        }
        Ok(folder)
    }
}

fn bank_of_folder(folder: &Path, options: &Options) -> Result<Vec<u8>, Failure> {
    let (inputs, reports) = discover(&[folder.to_owned()], None);
    match reports.first() {
        None => bank_of(&inputs, options),
        Some(report) => Err(format!("{report:?}")),
    }
}

/// A file as `serde_json` reads it, which knows nothing of the format.
pub(super) fn json(bytes: &[u8]) -> Option<serde_json::Value> {
    serde_json::from_slice(bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes)).ok()
}
