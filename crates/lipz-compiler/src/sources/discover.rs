//! Finding the Lipz files in the sources that a user names.

use crate::files::path::{display, plain};
use crate::sources::key::EXTENSION;
use crate::sources::walk::{FolderWalk, Obstacle, is_hidden};
use crate::sources::{Content, Input, list};
use glob::MatchOptions;
use lipz_diagnostics::{Code, Diagnostic, DiagnosticsError, Report};
use std::ffi::OsStr;
use std::io;
use std::path::{Component, MAIN_SEPARATOR, Path, PathBuf};

/// Returns the Lipz files of `sources`, with their keys.
///
/// A source is a folder (all `.lipz` files in it, at any depth), a file, or a glob pattern. Keys are paths relative to
/// `root` or, without it, to the folder, to the folder of the file, or to the longest part of the pattern without
/// wildcards. A file named by several sources with the same path is included once, with the key from the first of them.
///
/// Hidden files and folders, whose names start with a dot, are skipped, because editors and file systems store other
/// data in them. A single file is read regardless of its name. [`Settings::hidden`](crate::settings::Settings::hidden)
/// includes hidden files.
///
/// Files are sorted by path. With the feature `parallel`, large folders are listed on all cores.
/// [`Settings::discover`](crate::settings::Settings::discover) uses the options of the project.
///
/// # Errors
/// If a source or a file cannot be found or read, or if a source contains no Lipz files: a diagnostic for each.
pub fn discover(sources: &[PathBuf], root: Option<&Path>) -> Result<Vec<Input>, DiagnosticsError> {
    let (inputs, reports) = discover_with_reports(sources, root);
    // Without the levels of a project, all of these are errors.
    Ok(DiagnosticsError::check(inputs, reports)?.0)
}

/// Returns the files that [`discover`] could find, with reports about the others.
///
/// This is for tools that report everything at once and continue with the other files. All other programs should call
/// [`discover`].
#[must_use = "check the reports for missing files"]
pub fn discover_with_reports(sources: &[PathBuf], root: Option<&Path>) -> (Vec<Input>, Vec<Report>) {
    find(sources, root, false, None)
}

/// Returns the same, with or without hidden files and folders, using this number of threads.
pub(crate) fn find(
    sources: &[PathBuf],
    root: Option<&Path>,
    reads_hidden: bool,
    threads: Option<usize>,
) -> (Vec<Input>, Vec<Report>) {
    let root = root.map(plain);
    let mut found = Discovery {
        root: root.as_deref(),
        reads_hidden,
        threads,
        hidden_count: 0,
        inputs: Vec::new(),
        reports: Vec::new(),
    };
    for source in sources {
        let before = (found.inputs.len(), found.reports.len());
        found.hidden_count = 0;
        found.source(&plain(source));
        if (found.inputs.len(), found.reports.len()) == before {
            let mut report = Report::failure(
                display(source),
                Code::NoSources,
                format!("no Lipz files in `{}`", display(source)),
                "name a .lipz file, a folder that contains some, or a pattern such as 'voices/**/*.lipz'",
            );
            if found.hidden_count > 0 {
                let note = "hidden files and folders are skipped unless the setting `hidden` is on".to_owned();
                report.diagnostics.iter_mut().for_each(|diagnostic| diagnostic.notes.push(note.clone()));
            }
            found.reports.push(report);
        }
    }
    let mut inputs = found.inputs;
    // Compare as strings, because comparing paths component by component takes many times as long. Equal ones stay in
    // the order of the sources.
    if !inputs.is_sorted_by(|a, b| path(a) < path(b)) {
        inputs.sort_by(|a, b| path(a).cmp(&path(b)));
        inputs.dedup_by(|next, first| path(next) == path(first));
    }
    (inputs, found.reports)
}

/// Returns the path of a discovered input.
fn path(input: &Input) -> Option<&OsStr> {
    match &input.content {
        Content::File(path) => Some(path.as_os_str()),
        Content::Bytes { .. } => None,
    }
}

/// Whether a source is a glob pattern: it contains wildcards, and is not the name of an existing file.
pub fn is_pattern(source: &Path) -> bool {
    has_wildcards(&source.to_string_lossy()) && !source.exists()
}

fn has_wildcards(text: &str) -> bool {
    text.contains(['*', '?', '['])
}

/// Returns the longest part of a pattern without wildcards.
pub(crate) fn base(pattern: &str) -> PathBuf {
    Path::new(pattern).components().take_while(|part| !has_wildcards(&part.as_os_str().to_string_lossy())).collect()
}

struct Discovery<'a> {
    root: Option<&'a Path>,
    reads_hidden: bool,
    threads: Option<usize>,
    /// The number of hidden entries in the current source.
    hidden_count: usize,
    inputs: Vec<Input>,
    reports: Vec<Report>,
}

impl Discovery<'_> {
    fn source(&mut self, source: &Path) {
        match std::fs::metadata(source) {
            Ok(metadata) if metadata.is_dir() => self.folder(source),
            Ok(_) => self.file(source.to_owned(), source.parent().unwrap_or(Path::new(""))),
            Err(error) => match source.to_str() {
                Some(pattern) if has_wildcards(pattern) => self.pattern(pattern),
                _ => self.reports.push(unreadable(source, &error)),
            },
        }
    }

    fn folder(&mut self, folder: &Path) {
        // Avoids splitting paths into components, where possible.
        let known = folder.to_str().zip(key_prefix(folder, self.root.unwrap_or(folder)));
        let key = |path: &Path| known.as_ref().and_then(|(folder, prefix)| key_below(path, folder, prefix));
        if let Some(listed) = list::plain(folder, self.reads_hidden, self.threads, key) {
            self.hidden_count += listed.hidden_count;
            self.inputs.reserve(listed.files.iter().map(Vec::len).sum());
            listed.files.into_iter().flatten().for_each(|(path, key)| self.found(path, key, folder));
            return;
        }
        let mut walk = FolderWalk::new(folder, self.reads_hidden);
        for entry in &mut walk {
            match entry {
                Ok(entry) if entry.file_type().is_file() && is_lipz(entry.path()) => {
                    let mut path = entry.into_path();
                    // There are many paths, and they are kept.
                    path.shrink_to_fit();
                    let key = key(&path);
                    self.found(path, key, folder);
                }
                Ok(_) => {}
                Err(obstacle) => self.reports.push(impassable(folder, &obstacle)),
            }
        }
        self.hidden_count += walk.hidden_count;
    }

    /// Adds a file found in a folder, with its key if that is known.
    fn found(&mut self, path: PathBuf, key: Option<String>, folder: &Path) {
        match key {
            Some(key) => self.input(path, key),
            None => self.file(path, folder),
        }
    }

    fn pattern(&mut self, pattern: &str) {
        // A pattern with a leading dot means hidden files, but the glob crate would skip them.
        let base = base(pattern);
        let mut parts = Path::new(pattern).components().skip(base.components().count());
        let names_hidden = parts.any(|part| matches!(part, Component::Normal(name) if is_hidden(name)));
        let reads_hidden = self.reads_hidden || names_hidden;
        let options = MatchOptions { require_literal_leading_dot: !reads_hidden, ..MatchOptions::new() };
        let paths = match glob::glob_with(pattern, options) {
            Ok(paths) => paths,
            Err(error) => {
                self.reports.push(Report::failure(
                    pattern,
                    Code::NoSources,
                    format!("`{pattern}` is not a pattern: {}", error.msg),
                    "use `*` for a part of a name, `**` for folders, `?` for a character, and `[…]` for one of a set",
                ));
                return;
            }
        };
        for path in paths {
            match path {
                Ok(path) if path.is_file() && is_lipz(&path) => self.file(path, &base),
                Ok(_) => {}
                Err(error) => self.reports.push(unreadable(error.path(), error.error())),
            }
        }
    }

    fn file(&mut self, path: PathBuf, base: &Path) {
        match key_of(&path, self.root.unwrap_or(base)) {
            Ok(key) => self.input(path, key),
            Err((why, help)) => {
                let path = display(&path);
                let message = format!("`{path}` has no key because {why}");
                self.reports.push(Report::failure(path, Code::RefusedKey, message, help));
            }
        }
    }

    fn input(&mut self, path: PathBuf, key: String) {
        self.inputs.push(Input { key, content: Content::File(path) });
    }
}

/// Returns the diagnostic for an obstacle in a walk through a folder.
pub(crate) fn impassable(folder: &Path, obstacle: &Obstacle) -> Report {
    let error = match obstacle {
        Obstacle::Error(error) => error,
        Obstacle::TooManyWays(path) => {
            let shown = display(path);
            let message = format!("too many paths through links lead to `{shown}`");
            let help = "remove links between folders; each path gives every file in the folder a different key";
            return Report::failure(shown, Code::UnreadableFile, message, help);
        }
    };
    let path = error.path().unwrap_or(folder);
    match (error.loop_ancestor(), error.io_error()) {
        (Some(ancestor), _) => {
            let link = display(path);
            let message = format!("`{link}` is a link that leads back to `{}`", display(ancestor));
            Report::failure(link, Code::UnreadableFile, message, "remove the link")
        }
        (None, Some(error)) => unreadable(path, error),
        (None, None) => unreadable(path, &io::Error::other("unknown error")),
    }
}

/// Returns the diagnostic for an unreadable source or file in it.
fn unreadable(path: &Path, error: &io::Error) -> Report {
    let shown = display(path);
    let (message, help) = if error.kind() != io::ErrorKind::NotFound {
        let message = format!("`{shown}` cannot be read: {error}");
        return Report::about(shown, Diagnostic::new(Code::UnreadableFile, message));
    } else if path.symlink_metadata().is_ok() {
        (format!("`{shown}` is a link to a file that does not exist"), "remove the link, or restore the file")
    } else {
        (format!("`{shown}` does not exist"), "check the spelling of the path")
    };
    Report::failure(shown, Code::UnreadableFile, message, help)
}

fn is_lipz(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(EXTENSION))
}

/// Returns the path relative to `root`, with `/`, without the extension `.lipz`; or as an error the problem and the
/// help.
fn key_of(path: &Path, root: &Path) -> Result<String, (String, &'static str)> {
    let not_below =
        || (format!("it is not below the root `{}`", display(root)), "set `root` to a folder above the file");
    let root = if root == Path::new(".") { Path::new("") } else { root };
    let path = path.strip_prefix(".").unwrap_or(path);
    let resolved;
    let below = match path.strip_prefix(root) {
        Ok(below) => below,
        Err(_) => {
            // Through a different path, such as `act1` in `../voices`, which only the file system can resolve.
            resolved = resolved_below(path, root).ok_or_else(not_below)?;
            &resolved
        }
    };
    let mut parts = Vec::new();
    for component in below.components() {
        match component {
            Component::Normal(part) => parts
                .push(part.to_str().ok_or_else(|| ("its path is not Unicode".into(), "rename the file or folder"))?),
            Component::ParentDir => {
                return Err(("its path contains `..`".into(), "write the path without `..`"));
            }
            _ => return Err(not_below()),
        }
    }
    let key = parts.join("/");
    let stem = key.len().saturating_sub(EXTENSION.len() + 1);
    Ok(if is_lipz(path) { key.get(..stem).unwrap_or_default().to_owned() } else { key })
}

/// Returns the path of a file relative to `root`, after resolving the folder of the file and `root`; `None` if the file
/// is outside of `root`, or if one of the two folders does not exist. The file itself need not exist, and a link keeps
/// its name.
pub fn resolved_below(path: &Path, root: &Path) -> Option<PathBuf> {
    let root = plain(root).canonicalize().ok()?;
    let folder = plain(path.parent()?).canonicalize().ok()?;
    Some(folder.strip_prefix(root).ok()?.join(path.file_name()?))
}

/// Returns the prefix of the keys of the files in `folder`; `None` if it depends on the file.
fn key_prefix(folder: &Path, root: &Path) -> Option<String> {
    let mut prefix = key_of(folder, root).ok()?;
    if is_lipz(folder) {
        return None;
    }
    if !prefix.is_empty() {
        prefix.push('/');
    }
    Some(prefix)
}

/// Returns the same as [`key_of`] for a file found in `folder`, whose keys start with `prefix`, without splitting the
/// path into components.
fn key_below(path: &Path, folder: &str, prefix: &str) -> Option<String> {
    let below = path.to_str()?.strip_prefix(folder)?.trim_start_matches(MAIN_SEPARATOR);
    let stem = below.get(..below.len().checked_sub(EXTENSION.len() + 1)?)?;
    let mut key = String::with_capacity(prefix.len() + stem.len());
    key.push_str(prefix);
    key.push_str(stem);
    Some(if MAIN_SEPARATOR == '/' { key } else { key.replace(MAIN_SEPARATOR, "/") })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn keys(sources: &[PathBuf], reads_hidden: bool) -> Vec<String> {
        let (inputs, reports) = find(sources, None, reads_hidden, None);
        assert_eq!(reports, []);
        inputs.into_iter().map(|input| input.key).collect()
    }

    #[test]
    fn hidden_files_are_read_only_if_somebody_says_so() {
        let scene = tempfile::tempdir().unwrap();
        let path = |name: &str| scene.path().join(name);
        for name in ["v/a.lipz", "v/.b.lipz", "v/._a.lipz", "v/.git/c.lipz", "v/sub/.d/e.lipz", "v/sub/f.lipz"] {
            fs::create_dir_all(path(name).parent().unwrap()).unwrap();
            fs::write(path(name), "{}").unwrap();
        }
        #[cfg(unix)]
        std::os::unix::fs::symlink("me@host.1:1", path("v/.#b.lipz")).unwrap();
        assert_eq!(keys(&[path("v")], false), ["a", "sub/f"]);
        assert_eq!(keys(&[path("v/**/*.lipz")], false), ["a", "sub/f"]);
        assert_eq!(keys(&[path("v/.*.lipz")], false), ["._a", ".b"], "a pattern with a dot means them");
        assert_eq!(keys(&[path("v/.b.lipz"), path("v/.git")], false), [".b", "c"], "so does a name");
        #[cfg(unix)]
        fs::remove_file(path("v/.#b.lipz")).unwrap();
        assert_eq!(keys(&[path("v")], true), ["._a", ".b", ".git/c", "a", "sub/.d/e", "sub/f"]);
        assert_eq!(keys(&[path("v/**/*.lipz")], true).len(), 6);
        let (inputs, reports) = find(&[path("v/sub/.d/..").join(".d")], None, false, None);
        assert_eq!((inputs.len(), reports.len()), (1, 0));
        fs::remove_file(path("v/sub/f.lipz")).unwrap();
        let (_, reports) = find(&[path("v/sub")], None, false, None);
        assert!(reports[0].to_string().contains("hidden files and folders are skipped"), "{}", reports[0]);
    }

    #[cfg(unix)]
    #[test]
    fn links_between_folders_are_followed_and_end() {
        use std::os::unix::fs::symlink;
        let scene = tempfile::tempdir().unwrap();
        let path = |name: &str| scene.path().join(name);
        fs::create_dir_all(path("common")).unwrap();
        fs::write(path("common/aye.lipz"), "{}").unwrap();
        for act in ["act1", "act2"] {
            fs::create_dir_all(path(act)).unwrap();
            symlink("../common", path(act).join("common")).unwrap();
        }
        assert_eq!(keys(&[scene.path().into()], false), ["act1/common/aye", "act2/common/aye", "common/aye"]);

        // Two links from each folder to the next: 2 to the power of 24 paths to the last one.
        let deep = tempfile::tempdir().unwrap();
        for level in 0..25 {
            let folder = deep.path().join(format!("f{level}"));
            fs::create_dir(&folder).unwrap();
            for name in ["a", "b"] {
                symlink(format!("../f{}", level + 1), folder.join(name)).unwrap();
            }
        }
        fs::create_dir(deep.path().join("f25")).unwrap();
        let (_, reports) = find(&[deep.path().join("f0")], None, false, None);
        assert_eq!(reports.len(), 1);
        assert!(reports[0].to_string().contains("too many paths through links lead to"), "{}", reports[0]);
    }
}
