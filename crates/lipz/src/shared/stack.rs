//! Several files instead of one: a base and its patches.

use std::path::{Path, PathBuf};

/// The separator between the names of a base and its layers.
const BETWEEN: char = '+';

/// Returns the files that a path names: one, or those of a stack, `base.lipzbank+patch.lipzbank`. Names of files and
/// folders may contain a `+` themselves.
pub(crate) fn paths(path: &Path) -> Vec<PathBuf> {
    let parts: Vec<&str> = path.to_str().map_or_else(Vec::new, |path| path.split(BETWEEN).collect());
    if parts.len() < 2 || parts.contains(&"") || path.exists() {
        return vec![path.to_owned()];
    }
    let mut files = Vec::new();
    let mut rest = parts.as_slice();
    while !rest.is_empty() {
        // Take the shortest name of an existing file. A missing file has no `+` in its name.
        let mut joined = (1..=rest.len()).map(|count| (count, PathBuf::from(rest[..count].join("+"))));
        let there = joined.find(|(_, path)| path.is_file());
        let (count, file) = there.unwrap_or_else(|| {
            // The name may be misspelled, in a folder with a `+` in its own name.
            let whole = PathBuf::from(rest.join("+"));
            let folder = whole.parent().filter(|folder| folder.is_dir());
            let has_plus = folder.and_then(Path::to_str).is_some_and(|folder| folder.contains(BETWEEN));
            if has_plus { (rest.len(), whole) } else { (1, PathBuf::from(rest[0])) }
        });
        files.push(file);
        rest = &rest[count..];
    }
    files
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plus_is_between_files_unless_a_file_has_it_in_its_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        std::fs::write(path("a+b"), "").unwrap();
        assert_eq!(paths(&path("a+b")), [path("a+b")]);
        std::fs::create_dir(path("d+e")).unwrap();
        let [one, two] = ["d+e/one", "d+e/two+2"].map(path);
        [&one, &two].into_iter().for_each(|file| std::fs::write(file, "").unwrap());
        let stack = format!("{}+{}+nowhere+{}", one.display(), two.display(), one.display());
        assert_eq!(paths(Path::new(&stack)), [one.clone(), two, "nowhere".into(), one]);
        assert_eq!(paths(&path("d+e/typo")), [path("d+e/typo")]);
        assert_eq!(paths(Path::new("x/a+y/b+c")), ["x/a", "y/b", "c"].map(PathBuf::from));
        for one in ["a", "+", "a+", "+a", "a++b"] {
            assert_eq!(paths(Path::new(one)), [PathBuf::from(one)]);
        }
    }
}
