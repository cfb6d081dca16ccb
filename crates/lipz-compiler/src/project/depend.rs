//! The dependencies of a bank, for build engines that run the compiler again after changes.

use crate::files::path::{display, plain};
use crate::project::settings::Settings;
use crate::sources::walk::FolderWalk;
use crate::sources::{Content, Input, discover};
use lipz_diagnostics::{Code, Report, escape};
use std::iter;
use std::path::{Path, PathBuf};

/// Returns the files of `inputs`, and all folders in which a run with `settings` searches for files, sorted. If a file
/// is added or removed, its folder changes.
///
/// # Errors
/// If a folder cannot be read, because unknown dependencies would be missed silently.
pub fn dependencies(settings: &Settings, inputs: &[Input]) -> Result<Vec<PathBuf>, Report> {
    let mut folders = Vec::new();
    for source in watched(&settings.sources).into_iter().filter(|source| source.is_dir()) {
        for entry in FolderWalk::new(&source, settings.hidden) {
            let entry = entry.map_err(|obstacle| discover::impassable(&source, &obstacle))?;
            if entry.file_type().is_dir() {
                folders.push(entry.into_path());
            }
        }
    }
    let files = inputs.iter().filter_map(|input| match &input.content {
        Content::File(path) => Some(path.clone()),
        Content::Bytes { .. } => None,
    });
    let mut all: Vec<PathBuf> = folders.into_iter().chain(files).collect();
    all.sort_unstable();
    all.dedup();
    Ok(all)
}

/// Returns the folders and files that contain the sources; for a pattern, the folder before its first wildcard. All
/// changes that affect a run over `sources` occur in these.
pub fn watched(sources: &[PathBuf]) -> Vec<PathBuf> {
    let place = |source: &PathBuf| match source.to_str() {
        Some(pattern) if discover::is_pattern(source) => plain(&discover::base(pattern)),
        _ => plain(source),
    };
    sources.iter().map(place).collect()
}

/// Returns a dependency file as compilers write it (`gcc -MD -MP`) for Make, Ninja and CMake: `target` depends on
/// `dependencies`. Each of them is also a target without a rule, so that Make accepts its removal.
///
/// ```
/// use std::path::Path;
/// let file = lipz_compiler::depfile(Path::new("dialogue.lipzbank"), &["voices".into(), "voices/no 1.lipz".into()]);
/// assert_eq!(file.as_deref(), Ok(&b"dialogue.lipzbank: voices voices/no\\ 1.lipz\n\nvoices:\n\nvoices/no\\ 1.lipz:\n"[..]));
/// ```
///
/// # Errors
/// If Make has no spelling for a path. It would depend on a different one, and not pack again when the file changes.
pub fn depfile(target: &Path, dependencies: &[PathBuf]) -> Result<Vec<u8>, Report> {
    let mut file = escaped(target).filter(|name| !is_assignment(name)).ok_or_else(|| unspeakable(target))?;
    file.push(b':');
    let mut names = Vec::with_capacity(dependencies.len());
    for path in dependencies {
        names.push((escaped(path).ok_or_else(|| unspeakable(path))?, path));
    }
    // The first name determines whether the line is an assignment.
    names.sort_by_key(|(name, _)| is_assignment(name));
    if let Some((name, path)) = names.first()
        && is_assignment(name)
    {
        return Err(unspeakable(path));
    }
    for (name, _) in &names {
        file.push(b' ');
        file.extend_from_slice(name);
    }
    file.push(b'\n');
    for (name, _) in names.iter().filter(|(name, _)| !is_assignment(name)) {
        file.push(b'\n');
        file.extend_from_slice(name);
        file.extend_from_slice(b":\n");
    }
    Ok(file)
}

/// Whether Make interprets a line that starts with this name as an assignment to a variable.
fn is_assignment(name: &[u8]) -> bool {
    name.contains(&b'=')
}

/// Returns the path in Make's syntax: `\` before blanks, `#` and `:`, with backslashes before these doubled, and `$`
/// doubled. Line breaks, `;` and `|` cannot be escaped.
fn escaped(path: &Path) -> Option<Vec<u8>> {
    let mut name: Vec<u8> = Vec::new();
    for &byte in path.as_os_str().as_encoded_bytes() {
        match byte {
            b'\\' if cfg!(windows) => name.push(b'/'),
            // After a drive letter.
            b':' if cfg!(windows) => name.push(byte),
            b' ' | b'#' | b':' => {
                let backslashes = name.iter().rev().take_while(|&&before| before == b'\\').count();
                name.extend(iter::repeat_n(b'\\', backslashes + 1));
                name.push(byte);
            }
            b'$' => name.extend_from_slice(b"$$"),
            b';' | b'|' => return None,
            byte if byte.is_ascii_control() => return None,
            _ => name.push(byte),
        }
    }
    Some(name)
}

/// Returns the report that a depfile cannot contain a path.
fn unspeakable(path: &Path) -> Report {
    let shown = display(path);
    let message = format!("a depfile cannot contain `{}`, because Make cannot escape it", escape::text(&shown));
    let help = "rename it without `;`, `|`, `=` or control characters, or pack without a depfile";
    Report::failure(shown, Code::OutputFailed, message, help)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_watched_from_their_first_wildcard() {
        let folder = tempfile::tempdir().unwrap();
        let literal = folder.path().join("[act 1]");
        std::fs::create_dir(&literal).unwrap();
        let sources = ["voices/act?/**/*.lipz", "*.lipz", "./voices/", "no/where.lipz"].map(PathBuf::from);
        assert_eq!(watched(&sources), ["voices", ".", "voices", "no/where.lipz"].map(PathBuf::from));
        assert_eq!(watched(std::slice::from_ref(&literal)), [literal], "a folder with the name of a pattern");
    }

    #[cfg(unix)]
    #[test]
    fn names_are_escaped_for_make() {
        let names = [("a b", "a\\ b"), ("a\\ b", "a\\\\\\ b"), ("#$\\", "\\#$$\\"), ("é", "é"), ("a:b", "a\\:b")];
        for (path, expected) in names {
            assert_eq!(escaped(Path::new(path)).as_deref(), Some(expected.as_bytes()), "{path}");
        }
        for path in ["a;b", "a|b", "a\nb", "a\tb"] {
            assert_eq!(escaped(Path::new(path)), None, "{path:?}");
        }
    }

    #[test]
    fn names_that_make_takes_for_assignments_come_last_or_nowhere() {
        let of = |names: &[&str]| depfile(Path::new("x"), &names.iter().map(PathBuf::from).collect::<Vec<_>>());
        assert_eq!(of(&["a=b", "c"]).unwrap(), b"x: c a=b\n\nc:\n");
        assert!(of(&["a=b"]).unwrap_err().diagnostics[0].message.contains("`a=b`"));
        assert!(of(&["a;b"]).is_err() && depfile(Path::new("x=y"), &[]).is_err());
    }
}
