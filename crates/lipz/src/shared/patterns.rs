//! Patterns of files, such as `recorded/*.tsv`: not every shell puts the names in their place.

use lipz_compiler::is_pattern;
use std::path::{Path, PathBuf};

/// The files that are named; in place of a pattern those that match it, in the order of their names.
///
/// A pattern that nothing matches stays: whoever reads the file reports that there is none.
pub(crate) fn files(named: &[PathBuf]) -> Vec<PathBuf> {
    named.iter().flat_map(|path| matching(path).unwrap_or_else(|| vec![path.clone()])).collect()
}

fn matching(path: &Path) -> Option<Vec<PathBuf>> {
    let pattern = path.to_str().filter(|_| is_pattern(path))?;
    // A folder that cannot be looked into is reported like a file that cannot be read.
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
