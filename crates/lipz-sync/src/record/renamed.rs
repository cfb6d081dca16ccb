//! Renamed Lipz files, whose lines in the record follow them.

use super::SyncRecord;
use crate::record::hashes::file_mouth_hash;
use crate::recordings::clip::ClipMouth;
use lipz_compiler::Options;
use std::collections::{BTreeMap, HashMap};
use std::fs;
use std::path::Path;

impl SyncRecord {
    /// Gives the lines of files that no longer exist to new files with the same visemes, if these visemes are those of
    /// only one such file. Returns the old and the new names. Reads a file only if it is not in the record.
    pub(crate) fn follow<'p>(
        &mut self,
        lipz_files: impl Iterator<Item = &'p Path>,
        options: &Options,
    ) -> Vec<(String, String)> {
        let named = lipz_files.map(|path| (self.name(path), path));
        let new: BTreeMap<String, &Path> = named.filter(|(name, _)| !self.lines.contains_key(name)).collect();
        if new.is_empty() {
            return Vec::new();
        }
        let folder = self.path.parent().unwrap_or(Path::new(""));
        let lost = self.lines.iter().filter(|(name, _)| !folder.join(name).exists());
        let mut by_mouth: HashMap<u64, Option<String>> = HashMap::new();
        for (name, lines) in lost {
            let mut mouths: Vec<u64> = lines.iter().map(|line| line.made.mouth).collect();
            mouths.sort_unstable();
            mouths.dedup();
            // Visemes of several files, such as those of silence, identify none of them.
            mouths.into_iter().for_each(|mouth| {
                by_mouth.entry(mouth).and_modify(|known| *known = None).or_insert_with(|| Some(name.clone()));
            });
        }
        if by_mouth.is_empty() {
            return Vec::new();
        }
        let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
        for (name, path) in new {
            let Some(mouth) = mouth_of(path, options) else { continue };
            if let Some(Some(old)) = by_mouth.get(&mouth) {
                found.entry(old.clone()).or_default().push(name);
            }
        }
        // A file that was copied and then deleted has several successors.
        let only = found.into_iter().filter_map(|(old, new)| Some((old, <[String; 1]>::try_from(new).ok()?)));
        let renamed: Vec<(String, String)> = only.map(|(old, [new])| (old, new)).collect();
        for (old, new) in &renamed {
            if let Some(lines) = self.lines.remove(old) {
                self.lines.insert(new.clone(), lines);
            }
            if let Some(spoken) = self.spoken.remove(old) {
                self.spoken.insert(new.clone(), spoken);
            }
        }
        renamed
    }
}

/// Returns the hash of a file's visemes; `None` if it has none.
fn mouth_of(path: &Path, options: &Options) -> Option<u64> {
    let bytes = fs::read(path).ok()?;
    let document = lipz_file::parse(&bytes).document?;
    let mouth = ClipMouth::from_document(&document, options);
    (!mouth.codes.is_empty()).then(|| file_mouth_hash(&document, &mouth, options))
}
