//! The recordings of a project, found by the keys of its clips.

use crate::places::{Place, Places};
use crate::record_place;
use lipz_compiler::settings::{Settings, sound_rank};
use lipz_compiler::{Content, Input, Voices};
use lipz_diagnostics::{Code, DiagnosticsError, Report, escape};
use std::collections::{BTreeMap, HashSet};
use std::path::{Path, PathBuf};
use walkdir::WalkDir;

/// Extensions of sounds that are not read: somebody should hear of them.
const OTHER_EXTENSIONS: [&str; 9] = ["m4a", "aac", "opus", "wma", "caf", "amr", "ape", "wv", "au"];

/// The recordings in a folder and below.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Recordings {
    /// By their paths below the folder, with `/` and without extension: those of all known extensions, best first.
    files: BTreeMap<String, Vec<PathBuf>>,
    /// Sounds that are not read, by the same paths.
    others: BTreeMap<String, PathBuf>,
    places: Places,
}

impl Recordings {
    /// The recordings of a project. There are none if it has no folder of recordings.
    ///
    /// # Errors
    /// A diagnostic for each folder or file that cannot be read.
    pub fn discover(settings: &Settings) -> Result<Recordings, DiagnosticsError> {
        let (recordings, reports) = Recordings::discover_with_reports(settings);
        Ok(DiagnosticsError::check(recordings, reports)?.0)
    }

    /// The recordings of a project that could be found, and what cannot be read.
    ///
    /// For tools that report everything at once, such as the command `lipz`. All other programs call
    /// [`discover`](Recordings::discover).
    #[must_use = "the reports say whether recordings are missing"]
    pub fn discover_with_reports(settings: &Settings) -> (Recordings, Vec<Report>) {
        match &settings.audio.folder {
            Some(folder) => Recordings::at(Places::new(settings), folder),
            None => Default::default(),
        }
    }

    /// The recordings in `folder` and below, whose paths are keys. Links are followed.
    ///
    /// # Errors
    /// A diagnostic for each folder or file that cannot be read.
    pub fn below(folder: &Path) -> Result<Recordings, DiagnosticsError> {
        let (recordings, reports) = Recordings::below_with_reports(folder);
        Ok(DiagnosticsError::check(recordings, reports)?.0)
    }

    /// The recordings in `folder` and below that could be found, and what cannot be read.
    pub(crate) fn below_with_reports(folder: &Path) -> (Recordings, Vec<Report>) {
        Recordings::at(Places::default(), folder)
    }

    fn at(places: Places, folder: &Path) -> (Recordings, Vec<Report>) {
        let (mut recordings, mut reports) = (Recordings { places, ..Recordings::default() }, Vec::new());
        for entry in WalkDir::new(folder).follow_links(true).sort_by_file_name() {
            match entry {
                Ok(entry) if entry.file_type().is_file() && (is_recording(entry.path()) || is_other(entry.path())) => {
                    let path = entry.into_path();
                    let name = path.strip_prefix(folder).ok().and_then(|below| slashed(&below.with_extension("")));
                    match name {
                        Some(name) if is_other(&path) => drop(recordings.others.insert(name, path)),
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
                            "check the spelling of the path, and that you may read it",
                        ),
                        (None, None) => unreadable(path, "unknown error", "check that you may read it"),
                    });
                }
            }
        }
        for files in recordings.files.values_mut() {
            files.sort_by_key(|path| sound_rank(path)); // stable: those of one extension stay in the order of their names
        }
        (recordings, reports)
    }

    /// Leaves those whose paths are such.
    pub(crate) fn retain(&mut self, is_one: impl Fn(&Path) -> bool) {
        self.files.retain(|_, files| {
            files.retain(|path| is_one(path));
            !files.is_empty()
        });
    }

    /// The recording of which the mouth of the clip with this key is made.
    pub fn find(&self, key: &str) -> Option<&Path> {
        self.entry(self.places.of(key)).map(|(_, path)| path)
    }

    /// The locale that is spoken in that recording, if it is that of a voice; otherwise that of the project.
    pub fn locale(&self, key: &str) -> Option<&str> {
        self.places.of(key).locale
    }

    /// The voices of the project: which clip is a dub of which other.
    pub(crate) fn voices(&self) -> &Voices {
        &self.places.voices
    }

    /// The recordings of the clip in the other languages: the locale, and the file if it is there.
    pub fn dubs(&self, key: &str) -> Vec<(&str, Option<&Path>)> {
        let path = |place| self.entry(place).map(|(_, path)| path);
        self.places.dubs(key).filter_map(|place| Some((place.locale?, path(place)))).collect()
    }

    /// Where the recording of this clip is looked for, below the folder.
    pub(crate) fn place(&self, key: &str) -> String {
        self.places.of(key).shown()
    }

    /// The name among the files, and the path.
    fn entry(&self, place: Place<'_, '_>) -> Option<(&str, &Path)> {
        let (name, extension) = place.path();
        let (name, files) = self.files.get_key_value(&name)?;
        let is_meant = |path: &&PathBuf| extension.is_none_or(|meant| path.extension().is_some_and(|own| own == meant));
        Some((name, files.iter().find(is_meant)?))
    }

    /// The recordings that belong to none of these clips, in the order of their paths.
    pub fn without_clip(&self, inputs: &[Input]) -> Vec<&Path> {
        let places = |input| std::iter::once(self.places.of(input)).chain(self.places.dubs(input));
        let names = inputs.iter().flat_map(|input| places(&input.key)).filter_map(|place| self.entry(place));
        let claimed: HashSet<&str> = names.map(|(name, _)| name).collect();
        self.iter().filter(|(name, _)| !claimed.contains(name)).map(|(_, path)| path).collect()
    }

    /// Files that are not used because another one has the same name and lost less: each with that one. None, if a
    /// pattern says which are meant.
    pub(crate) fn beside_others(&self) -> impl Iterator<Item = (&Path, &Path)> {
        let files = self.files.values().filter(|_| !self.places.name_an_extension());
        files.flat_map(|files| files.iter().skip(1).filter_map(|file| Some((file.as_path(), files.first()?.as_path()))))
    }

    /// Sounds without a recording beside them that is read.
    pub(crate) fn unread(&self) -> impl Iterator<Item = &Path> {
        self.others.iter().filter(|(name, _)| !self.files.contains_key(*name)).map(|(_, path)| path.as_path())
    }

    /// The sound at the place of the recording of this clip that is not read.
    pub(crate) fn unread_of(&self, key: &str) -> Option<&Path> {
        self.others.get(&self.places.of(key).path().0).map(PathBuf::as_path)
    }

    /// All recordings, each with its path below the folder, with `/` and without extension.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Path)> {
        self.files.iter().filter_map(|(name, files)| Some((name.as_str(), files.first()?.as_path())))
    }
}

/// Whether a path is that of a recording, by its extension.
pub fn is_recording(path: &Path) -> bool {
    sound_rank(path).is_some()
}

/// What the bank of a project depends on besides its Lipz files: the record of its mouths, which tells when words are said,
/// and its recordings and their folder, if the bank says something about them.
pub fn dependencies(settings: &Settings) -> Vec<PathBuf> {
    let audio = &settings.audio;
    let record = Some(record_place(settings)).filter(|record| record.is_file());
    let mut paths = Vec::from_iter(record);
    if let Some(folder) = audio.folder.as_ref().filter(|_| audio.in_bank) {
        // Folders that cannot be read are for `check`.
        let (recordings, _) = Recordings::discover_with_reports(settings);
        paths.push(folder.clone());
        paths.extend(recordings.iter().map(|(_, path)| path.to_owned()));
    }
    paths
}

/// Whether a path is that of a sound that is not read.
fn is_other(path: &Path) -> bool {
    let extension = path.extension().and_then(|extension| extension.to_str());
    extension.is_some_and(|own| OTHER_EXTENSIONS.iter().any(|known| known.eq_ignore_ascii_case(own)))
}

/// Reports recordings that are not used because of others.
pub(crate) fn not_used(recordings: &Recordings) -> Vec<Report> {
    let report = |(path, used): (&Path, &Path)| {
        let message = format!("the recording is not used, because `{}` has the same name", escape::text(&shown(used)));
        let help = "remove or rename one of them, or name the extension in `pattern` of [audio]: {key}.wav";
        Report::failure(shown(path), Code::RecordingWithoutClip, message, help)
    };
    recordings.beside_others().map(report).collect()
}

/// A relative path with `/`, if it is Unicode.
pub(crate) fn slashed(path: &Path) -> Option<String> {
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
        let (recordings, reports) = Recordings::at(Places::of_pattern(pattern), folder);
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
        let recordings = Recordings::below(folder.path()).unwrap();
        let inputs = [Input::from_bytes("a", ""), Input::from_bytes("z", "")];
        assert_eq!(recordings.without_clip(&inputs), [folder.path().join("b.wav"), folder.path().join("c/d.mp3")]);
    }

    #[test]
    #[cfg(unix)]
    fn links_that_lead_back_and_missing_folders_are_reported() {
        let folder = folder(&["a.wav"]);
        std::os::unix::fs::symlink(folder.path(), folder.path().join("again")).unwrap();
        let (recordings, reports) = Recordings::below_with_reports(folder.path());
        assert_eq!((recordings.iter().count(), reports.len()), (1, 1));
        assert!(reports[0].to_string().contains("is a link that leads back to"), "{}", reports[0]);
        let error = Recordings::below(&folder.path().join("nowhere")).unwrap_err();
        assert_eq!(error.reports().len(), 1);
    }
}
