//! The text files next to recordings.

use lipz_compiler::key;
use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The extension of text files.
const EXTENSION: &str = "txt";

/// The text files of folders, read when a recording has none with its exact name.
#[derive(Default)]
pub(super) struct TextFiles(HashMap<PathBuf, HashMap<String, PathBuf>>);

impl TextFiles {
    /// Returns the text file of a recording: `mara.txt` for `mara.wav`. Case and Unicode normalisation may differ,
    /// because a copy to a different system may change both.
    pub(super) fn beside(&mut self, recording: &Path) -> Option<PathBuf> {
        let path = recording.with_extension(EXTENSION);
        if path.is_file() {
            return Some(path);
        }
        let folder = recording.parent()?;
        let files = self.0.entry(folder.to_owned()).or_insert_with(|| text_files(folder));
        files.get(&stem(recording)?).cloned()
    }
}

fn text_files(folder: &Path) -> HashMap<String, PathBuf> {
    let here = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let files = fs::read_dir(here).into_iter().flatten().flatten().map(|entry| folder.join(entry.file_name()));
    let is_text = |path: &PathBuf| {
        path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(EXTENSION)) && path.is_file()
    };
    files.filter(is_text).filter_map(|path| Some((stem(&path)?, path))).collect()
}

fn stem(path: &Path) -> Option<String> {
    Some(key::folded(path.file_stem()?.to_str()?))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn texts_of_other_systems() {
        let folder = tempfile::tempdir().unwrap();
        for file in ["mara.txt", "MA\u{308}RY.TXT", "otto.doc"] {
            fs::write(folder.path().join(file), "x").unwrap();
        }
        let mut texts = TextFiles::default();
        let mut beside =
            |name: &str| texts.beside(&folder.path().join(name)).map(|path| path.file_name().unwrap().to_owned());
        assert_eq!(beside("mara.wav").unwrap(), "mara.txt");
        assert_eq!(beside("Mara.WAV").unwrap(), "mara.txt");
        assert_eq!(beside("m\u{e4}ry.wav").unwrap(), "MA\u{308}RY.TXT");
        assert_eq!(beside("otto.wav"), None);
    }
}
