//! File patterns such as `recorded/*.tsv`, because not every shell expands them.

use lipz_compiler::is_pattern;
use std::path::{Path, PathBuf};

/// Returns the named files, with each pattern replaced by the matching files, sorted by name.
///
/// A pattern without matches stays, so that reading it reports a missing file.
pub(crate) fn files(named: &[PathBuf]) -> Vec<PathBuf> {
    named.iter().flat_map(|path| matching(path).unwrap_or_else(|| vec![path.clone()])).collect()
}

fn matching(path: &Path) -> Option<Vec<PathBuf>> {
    let pattern = path.to_str().filter(|_| is_pattern(path))?;
    // An unreadable folder is reported like an unreadable file.
    let found = glob::glob(pattern).ok()?.map(|found| found.unwrap_or_else(|error| error.path().to_owned()));
    Some(found.collect()).filter(|found: &Vec<PathBuf>| !found.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_become_the_files_that_match() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        for name in ["b.tsv", "a.tsv", "c.txt", "[d].tsv"] {
            std::fs::write(path(name), "").unwrap();
        }
        let named = ["*.tsv", "c.txt", "[d].tsv", "*.dat", "["].map(path);
        let expected = ["[d].tsv", "a.tsv", "b.tsv", "c.txt", "[d].tsv", "*.dat", "["].map(path);
        assert_eq!(files(&named), expected);
    }
}
