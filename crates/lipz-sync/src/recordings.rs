//! The recordings of a project, found by the keys of its clips.

use lipz_compiler::settings::{Audio, KEY};
use lipz_compiler::{Content, Input};
use lipz_diagnostics::{Code, Report};
use std::collections::{BTreeMap, HashSet};
use std::path::{Path, PathBuf};
use walkdir::WalkDir;

/// Extensions of recordings. Of several files with one name, the first of this list counts: what nothing was lost of.
pub const EXTENSIONS: [&str; 6] = ["wav", "wave", "flac", "ogg", "oga", "mp3"];

/// The recordings in a folder and below.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Recordings {
    /// By their paths below the folder, with `/` and without extension: those of all known extensions, best first.
    files: BTreeMap<String, Vec<PathBuf>>,
    pattern: Option<String>,
}

impl Recordings {
    /// The recordings of a project, and what could not be looked at. None if it has no folder of recordings.
    pub fn discover(audio: &Audio) -> (Recordings, Vec<Report>) {
        match &audio.folder {
            Some(folder) => Recordings::below(folder, audio.pattern.clone()),
            None => Default::default(),
        }
    }

    /// The recordings in `folder` and below; `pattern` is that of [`Audio`]. Links are followed.
    pub fn below(folder: &Path, pattern: Option<String>) -> (Recordings, Vec<Report>) {
        let (mut recordings, mut reports) = (Recordings { files: BTreeMap::new(), pattern }, Vec::new());
        for entry in WalkDir::new(folder).follow_links(true).sort_by_file_name() {
            match entry {
                Ok(entry) if entry.file_type().is_file() && rank(entry.path()).is_some() => {
                    let path = entry.into_path();
                    let name = path.strip_prefix(folder).ok().and_then(|below| slashed(&below.with_extension("")));
                    match name {
                        Some(name) => recordings.files.entry(name).or_default().push(path),
                        None => reports.push(unreadable(&path, "its name is not Unicode", "rename it")),
                    }
                }
                Ok(_) => {}
                Err(error) => {
                    let path = error.path().unwrap_or(folder);
                    reports.push(match (error.loop_ancestor(), error.io_error()) {
                        (Some(ancestor), _) => {
                            let why = format!("it is a link that leads back to `{}`", shown(ancestor));
                            unreadable(path, &why, "remove the link")
                        }
                        (None, Some(error)) => unreadable(
                            path,
                            &error.to_string(),
                            "check the spelling of the path, and that you may read it: `folder` of [audio] names it",
                        ),
                        (None, None) => unreadable(path, "unknown error", "check that you may read it"),
                    });
                }
            }
        }
        for files in recordings.files.values_mut() {
            files.sort_by_key(|path| rank(path)); // stable: those of one extension stay in the order of their names
        }
        (recordings, reports)
    }

    /// The recording of the clip with this key.
    pub fn find(&self, key: &str) -> Option<&Path> {
        self.entry(key).map(|(_, path)| path)
    }

    /// The name among the files, and the path.
    fn entry(&self, key: &str) -> Option<(&str, &Path)> {
        let pattern = self.pattern.as_deref().unwrap_or(KEY);
        let name = pattern.replace(KEY, key);
        // Keys may have dots: only a pattern that ends in a known extension means that one.
        let extension = Path::new(pattern).extension().filter(|_| !pattern.ends_with(KEY));
        let Some(extension) = extension.and_then(|found| found.to_str()).filter(|_| rank(Path::new(pattern)).is_some())
        else {
            let (name, files) = self.files.get_key_value(&name)?;
            return Some((name, files.first()?));
        };
        let stem = name.strip_suffix(extension)?.strip_suffix('.')?;
        let (name, files) = self.files.get_key_value(stem)?;
        let is_meant = |path: &&PathBuf| path.extension().is_some_and(|found| found == extension);
        Some((name, files.iter().find(is_meant)?))
    }

    /// The recordings that belong to none of these clips, in the order of their paths.
    pub fn without_clip(&self, inputs: &[Input]) -> Vec<&Path> {
        let claimed: HashSet<&str> = inputs.iter().filter_map(|input| Some(self.entry(&input.key)?.0)).collect();
        self.iter().filter(|(name, _)| !claimed.contains(name)).map(|(_, path)| path).collect()
    }

    /// All recordings, each with its path below the folder, with `/` and without extension.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Path)> {
        self.files.iter().filter_map(|(name, files)| Some((name.as_str(), files.first()?.as_path())))
    }
}

/// Whether a path is that of a recording, by its extension.
pub fn is_recording(path: &Path) -> bool {
    rank(path).is_some()
}

/// What the bank of a project depends on besides its Lipz files: its recordings and their folder, if the bank says
/// something about them.
pub fn dependencies(audio: &Audio) -> Vec<PathBuf> {
    let Some(folder) = audio.folder.as_ref().filter(|_| audio.in_bank) else { return Vec::new() };
    let (recordings, _) = Recordings::discover(audio);
    std::iter::once(folder.clone()).chain(recordings.iter().map(|(_, path)| path.to_owned())).collect()
}

/// The place of a file's extension in [`EXTENSIONS`], whatever its case.
fn rank(path: &Path) -> Option<usize> {
    let extension = path.extension()?.to_str()?;
    EXTENSIONS.iter().position(|known| known.eq_ignore_ascii_case(extension))
}

/// A relative path with `/`, if it is Unicode.
fn slashed(path: &Path) -> Option<String> {
    let parts: Option<Vec<&str>> = path.iter().map(|part| part.to_str()).collect();
    Some(parts?.join("/"))
}

/// A path as messages name it, with `/` on every system.
pub(crate) fn shown(path: &Path) -> String {
    Input { key: String::new(), content: Content::File(path.to_owned()) }.name()
}

fn unreadable(path: &Path, why: &str, help: &str) -> Report {
    let path = shown(path);
    let message = format!("`{path}` cannot be read: {why}");
    Report::failure(path, Code::UnreadableFile, message, help)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use std::fs;

    fn folder(files: &[&str]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for file in files {
            let path = folder.path().join(file);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, "").unwrap();
        }
        folder
    }

    fn found(folder: &Path, pattern: Option<&str>, key: &str) -> Option<String> {
        let (recordings, reports) = Recordings::below(folder, pattern.map(str::to_owned));
        assert_eq!(reports, []);
        recordings.find(key).map(|path| slashed(path.strip_prefix(folder).unwrap()).unwrap())
    }

    #[test]
    fn keys_and_patterns_lead_to_recordings() {
        let folder = folder(&["act1/mara.wav", "act1/mara.mp3", "act1/otto.FLAC", "a.b.ogg", "en/x/take.wav", "x.txt"]);
        let found = |pattern, key| found(folder.path(), pattern, key);
        assert_eq!(found(None, "act1/mara").as_deref(), Some("act1/mara.wav"), "what nothing was lost of");
        assert_eq!(found(Some("{key}.mp3"), "act1/mara").as_deref(), Some("act1/mara.mp3"));
        assert_eq!(found(Some("{key}.ogg"), "act1/mara"), None);
        assert_eq!(found(None, "act1/otto").as_deref(), Some("act1/otto.FLAC"));
        assert_eq!(found(None, "a.b").as_deref(), Some("a.b.ogg"));
        assert_eq!(found(None, "a"), None);
        assert_eq!(found(None, "x"), None, "no recording");
        assert_eq!(found(Some("en/{key}/take"), "x").as_deref(), Some("en/x/take.wav"));
        assert_eq!(found(Some("act1/{key}"), "mara").as_deref(), Some("act1/mara.wav"));
    }

    #[test]
    fn recordings_that_no_clip_has() {
        let folder = folder(&["a.wav", "a.ogg", "b.wav", "c/d.mp3"]);
        let (recordings, _) = Recordings::below(folder.path(), None);
        let inputs = [Input::from_bytes("a", ""), Input::from_bytes("z", "")];
        assert_eq!(recordings.without_clip(&inputs), [folder.path().join("b.wav"), folder.path().join("c/d.mp3")]);
    }

    #[test]
    #[cfg(unix)]
    fn links_that_lead_back_and_missing_folders_are_reported() {
        let folder = folder(&["a.wav"]);
        std::os::unix::fs::symlink(folder.path(), folder.path().join("again")).unwrap();
        let (recordings, reports) = Recordings::below(folder.path(), None);
        assert_eq!((recordings.iter().count(), reports.len()), (1, 1));
        assert!(reports[0].to_string().contains("is a link that leads back to"), "{}", reports[0]);
        let (_, reports) = Recordings::below(&folder.path().join("nowhere"), None);
        assert_eq!(reports.len(), 1);
    }
}
