//! From the sources that a user names to the Lipz files in them.

use crate::key::EXTENSION;
use crate::{Content, Input, Report};
use lipz::{Code, Diagnostic};
use std::path::{Component, Path, PathBuf};
use walkdir::WalkDir;

/// The Lipz files of `sources`, with their keys.
///
/// A source is a folder (all `.lipz` files in it and below), a file, or a glob pattern. Keys are
/// paths below `root`; without it, below the folder, beside the file, or below the longest part of
/// the pattern without wildcards. A file named by several sources counts once.
///
/// Reports what cannot be found or read. Files are returned in the order of their paths.
pub fn discover(sources: &[PathBuf], root: Option<&Path>) -> (Vec<Input>, Vec<Report>) {
    let root = root.map(plain);
    let mut found = Discovery { root: root.as_deref(), files: Vec::new(), reports: Vec::new() };
    for source in sources {
        let before = (found.files.len(), found.reports.len());
        found.source(&plain(source));
        if (found.files.len(), found.reports.len()) == before {
            found.reports.push(Report::failure(
                display(source),
                Code::NoSources,
                format!("no Lipz files in `{}`", display(source)),
                "Lipz files end in .lipz; name the folder that contains them, a file, or a pattern such as 'voices/**/*.lipz'",
            ));
        }
    }
    let mut files = found.files;
    files.sort_by(|a, b| (&a.path, &a.key).cmp(&(&b.path, &b.key)));
    files.dedup_by(|a, b| a.path == b.path && a.key == b.key);
    let inputs = files.into_iter().map(|file| Input {
        name: display(&file.path),
        key: file.key,
        content: Content::File(file.path),
    });
    (inputs.collect(), found.reports)
}

/// The path without `.` parts, so that `voices`, `./voices` and `voices/` are one folder. Links and
/// `..` stay: only the file system knows where they lead.
fn plain(path: &Path) -> PathBuf {
    let plain: PathBuf = path.components().filter(|part| *part != Component::CurDir).collect();
    if plain.as_os_str().is_empty() { PathBuf::from(".") } else { plain }
}

struct Found {
    path: PathBuf,
    key: String,
}

struct Discovery<'a> {
    root: Option<&'a Path>,
    files: Vec<Found>,
    reports: Vec<Report>,
}

impl Discovery<'_> {
    fn source(&mut self, source: &Path) {
        match std::fs::metadata(source) {
            Ok(metadata) if metadata.is_dir() => self.folder(source),
            Ok(_) => self.file(source.to_owned(), source.parent().unwrap_or(Path::new(""))),
            Err(error) => match source.to_str() {
                Some(pattern) if pattern.contains(['*', '?', '[']) => self.pattern(pattern),
                _ => self.unreadable(source, &error.to_string()),
            },
        }
    }

    fn folder(&mut self, folder: &Path) {
        for entry in WalkDir::new(folder).follow_links(true) {
            match entry {
                Ok(entry) if entry.file_type().is_file() && is_lipz(entry.path()) => {
                    self.file(entry.into_path(), folder);
                }
                Ok(_) => {}
                Err(error) => {
                    let path = error.path().unwrap_or(folder).to_owned();
                    let why = match (error.loop_ancestor(), error.io_error()) {
                        (Some(ancestor), _) => format!("a link leads back to `{}`", display(ancestor)),
                        (None, Some(error)) => error.to_string(),
                        (None, None) => "unknown error".into(),
                    };
                    self.unreadable(&path, &why);
                }
            }
        }
    }

    fn pattern(&mut self, pattern: &str) {
        let paths = match glob::glob(pattern) {
            Ok(paths) => paths,
            Err(error) => {
                self.reports.push(Report::failure(
                    pattern,
                    Code::NoSources,
                    format!("`{pattern}` is not a pattern: {}", error.msg),
                    "`*` stands for a part of a name, `**` for folders, `?` for a character, `[…]` for a set",
                ));
                return;
            }
        };
        let base: PathBuf = Path::new(pattern)
            .components()
            .take_while(|part| !part.as_os_str().to_string_lossy().contains(['*', '?', '[']))
            .collect();
        for path in paths {
            match path {
                Ok(path) if path.is_file() && is_lipz(&path) => self.file(path, &base),
                Ok(_) => {}
                Err(error) => self.unreadable(error.path(), &error.error().to_string()),
            }
        }
    }

    fn file(&mut self, path: PathBuf, base: &Path) {
        match key_of(&path, self.root.unwrap_or(base)) {
            Ok(key) => self.files.push(Found { path, key }),
            Err(why) => self.reports.push(Report::failure(
                display(&path),
                Code::RefusedKey,
                format!("`{}` has no key: {why}", display(&path)),
                "keys are paths below the source root; choose it with --root, or rename the file",
            )),
        }
    }

    fn unreadable(&mut self, path: &Path, why: &str) {
        let headline = format!("`{}` cannot be read: {why}", display(path));
        self.reports.push(Report::about(display(path), Diagnostic::new(Code::UnreadableFile, headline)));
    }
}

fn is_lipz(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(EXTENSION))
}

/// The path below `root`, with `/`, without the extension `.lipz`.
fn key_of(path: &Path, root: &Path) -> Result<String, String> {
    let root = if root == Path::new(".") { Path::new("") } else { root };
    let path = path.strip_prefix(".").unwrap_or(path);
    let below = path.strip_prefix(root).map_err(|_| format!("it is not below the root `{}`", display(root)))?;
    let mut parts = Vec::new();
    for component in below.components() {
        match component {
            Component::Normal(part) => parts.push(part.to_str().ok_or("its path is not Unicode")?),
            other => return Err(format!("its path contains `{}`", other.as_os_str().to_string_lossy())),
        }
    }
    let key = parts.join("/");
    let stem = key.len().saturating_sub(EXTENSION.len() + 1);
    Ok(if is_lipz(path) { key.get(..stem).unwrap_or_default().to_owned() } else { key })
}

/// A path as messages show it: with `/` on every system.
pub(crate) fn display(path: &Path) -> String {
    let path = path.to_string_lossy();
    if std::path::MAIN_SEPARATOR == '/' { path.into_owned() } else { path.replace(std::path::MAIN_SEPARATOR, "/") }
}
