//! The recordings of a project, found by the keys of its clips.

use crate::recordings::paths::{shown, slashed};
use crate::recordings::places::{RecordingPlace, RecordingPlaces};
use lipz_compiler::settings::{Settings, sound_rank};
use lipz_compiler::{Input, Voices, key};
use lipz_diagnostics::{Code, DiagnosticsError, Report, escape};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::path::{Path, PathBuf};
use walkdir::WalkDir;

/// The extensions of unsupported audio files, which are reported.
const OTHER_EXTENSIONS: [&str; 11] = ["m4a", "aac", "opus", "wma", "caf", "amr", "ape", "wv", "au", "w64", "mp2"];

/// The recordings in a folder and below.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Recordings {
    /// By their paths below the folder, with `/` and without extension: the files of all supported extensions, best
    /// first.
    files: BTreeMap<String, Vec<PathBuf>>,
    /// Unsupported audio files, by the same paths.
    others: BTreeMap<String, PathBuf>,
    /// The paths of `files` and `others` as some file systems compare them: without case and Unicode normalisation.
    /// `None` for several paths.
    folded: HashMap<String, Option<String>>,
    places: RecordingPlaces,
}

impl Recordings {
    /// Returns the recordings of a project; none if it has no folder of recordings.
    ///
    /// # Errors
    /// A diagnostic for each folder or file that cannot be read.
    pub fn discover(settings: &Settings) -> Result<Recordings, DiagnosticsError> {
        let (recordings, reports) = Recordings::discover_with_reports(settings);
        Ok(DiagnosticsError::check(recordings, reports)?.0)
    }

    /// Returns the recordings of a project, and reports about unreadable files.
    ///
    /// For tools that report everything at once, such as the command `lipz`. All other programs call
    /// [`discover`](Recordings::discover).
    #[must_use = "check the reports for missing recordings"]
    pub fn discover_with_reports(settings: &Settings) -> (Recordings, Vec<Report>) {
        match &settings.audio.folder {
            Some(folder) => Recordings::at(RecordingPlaces::new(settings), folder),
            None => (Recordings::planned(settings), Vec::new()),
        }
    }

    /// Returns the places of a project's recordings, as if none existed yet.
    pub fn planned(settings: &Settings) -> Recordings {
        Recordings { places: RecordingPlaces::new(settings), ..Recordings::default() }
    }

    /// Returns the recordings in `folder` and below, whose paths are keys. Links are followed.
    ///
    /// # Errors
    /// A diagnostic for each folder or file that cannot be read.
    pub fn below(folder: &Path) -> Result<Recordings, DiagnosticsError> {
        let (recordings, reports) = Recordings::below_with_reports(folder);
        Ok(DiagnosticsError::check(recordings, reports)?.0)
    }

    /// Returns the recordings in `folder` and below, and reports about unreadable files.
    pub(crate) fn below_with_reports(folder: &Path) -> (Recordings, Vec<Report>) {
        Recordings::at(RecordingPlaces::default(), folder)
    }

    fn at(places: RecordingPlaces, folder: &Path) -> (Recordings, Vec<Report>) {
        let (mut recordings, mut reports) = (Recordings { places, ..Recordings::default() }, Vec::new());
        for entry in WalkDir::new(folder).follow_links(true).sort_by_file_name() {
            match entry {
                Ok(entry) if entry.file_type().is_file() && (is_recording(entry.path()) || is_other(entry.path())) => {
                    let path = entry.into_path();
                    let name = path.strip_prefix(folder).ok().and_then(|below| slashed(&below.with_extension("")));
                    match name {
                        Some(name) if is_other(&path) => drop(recordings.others.insert(name, path)),
                        Some(name) => recordings.files.entry(name).or_default().push(path),
                        None => reports.push(unreadable(&path, "its name is not Unicode", "rename the file")),
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
                        (None, Some(error)) => {
                            unreadable(path, &error.to_string(), "check the spelling of the path, and its permissions")
                        }
                        (None, None) => unreadable(path, "unknown error", "check its permissions"),
                    });
                }
            }
        }
        recordings.fold();
        for files in recordings.files.values_mut() {
            files.sort_by_key(|path| sound_rank(path)); // stable: files with the same extension stay sorted by name
        }
        (recordings, reports)
    }

    fn fold(&mut self) {
        for name in self.files.keys().chain(self.others.keys().filter(|name| !self.files.contains_key(*name))) {
            let only = |one: &mut Option<String>| *one = None;
            self.folded.entry(key::folded(name)).and_modify(only).or_insert_with(|| Some(name.clone()));
        }
    }

    /// Returns the path among the files for an expected one: the same, or else the only one that differs in case or
    /// Unicode normalisation, because a copy to a different system may change both.
    fn actual<'n>(&'n self, name: &'n str) -> &'n str {
        if self.files.contains_key(name) || self.others.contains_key(name) {
            return name;
        }
        self.folded.get(&key::folded(name)).and_then(Option::as_deref).unwrap_or(name)
    }

    /// Keeps only the recordings whose paths fulfil the condition.
    pub(crate) fn retain(&mut self, is_one: impl Fn(&Path) -> bool) {
        self.files.retain(|_, files| {
            files.retain(|path| is_one(path));
            !files.is_empty()
        });
    }

    /// Returns the recording for the visemes of the clip with this key.
    pub fn find(&self, key: &str) -> Option<&Path> {
        self.entry(self.places.of(key)).map(|(_, path)| path)
    }

    /// Returns the spoken locale of that recording, if it is that of a voice, rather than of the project.
    pub fn locale(&self, key: &str) -> Option<&str> {
        self.places.of(key).locale
    }

    /// Returns the voices of the project, which determine the originals of dubs.
    pub(crate) fn voices(&self) -> &Voices {
        &self.places.voices
    }

    /// Returns the recordings of the clip in the other languages: the locale, and the file if it exists.
    pub fn dubs(&self, key: &str) -> Vec<(&str, Option<&Path>)> {
        let path = |place| self.entry(place).map(|(_, path)| path);
        self.places.dubs(key).filter_map(|place| Some((place.locale?, path(place)))).collect()
    }

    /// Returns the expected path of this clip's recording, below the folder.
    pub fn place(&self, key: &str) -> String {
        self.places.of(key).shown()
    }

    /// Returns the name among the files, and the path.
    fn entry(&self, place: RecordingPlace<'_, '_>) -> Option<(&str, &Path)> {
        let (name, extension) = place.path();
        let (name, files) = self.files.get_key_value(self.actual(&name))?;
        let is_meant = |path: &&PathBuf| extension.is_none_or(|meant| path.extension().is_some_and(|own| own == meant));
        Some((name, files.iter().find(is_meant)?))
    }

    /// Returns the recordings that belong to none of these clips, sorted by path.
    pub fn without_clip(&self, inputs: &[Input]) -> Vec<&Path> {
        let places = |input| std::iter::once(self.places.of(input)).chain(self.places.dubs(input));
        let names = inputs.iter().flat_map(|input| places(&input.key)).filter_map(|place| self.entry(place));
        let claimed: HashSet<&str> = names.map(|(name, _)| name).collect();
        self.iter().filter(|(name, _)| !claimed.contains(name)).map(|(_, path)| path).collect()
    }

    /// Returns the files that are not used because a file with the same name has better quality, each with that file.
    /// Returns none if a pattern states the extension.
    pub(crate) fn beside_others(&self) -> impl Iterator<Item = (&Path, &Path)> {
        let files = self.files.values().filter(|_| !self.places.name_an_extension());
        files.flat_map(|files| files.iter().skip(1).filter_map(|file| Some((file.as_path(), files.first()?.as_path()))))
    }

    /// Returns all supported files, several of which may have one path below the folder without extension.
    pub fn all_files(&self) -> impl Iterator<Item = (&str, &Path)> {
        self.files.iter().flat_map(|(name, files)| files.iter().map(|file| (name.as_str(), file.as_path())))
    }

    /// Returns unsupported audio files without a supported recording of the same name.
    pub(crate) fn unread(&self) -> impl Iterator<Item = &Path> {
        self.others.iter().filter(|(name, _)| !self.files.contains_key(*name)).map(|(_, path)| path.as_path())
    }

    /// Returns the unsupported audio file in the place of this clip's recording.
    pub(crate) fn unread_of(&self, key: &str) -> Option<&Path> {
        self.others.get(self.actual(&self.places.of(key).path().0)).map(PathBuf::as_path)
    }

    /// Returns all recordings, each with its path below the folder, with `/` and without extension.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Path)> {
        self.files.iter().filter_map(|(name, files)| Some((name.as_str(), files.first()?.as_path())))
    }
}

/// Whether a path is that of a recording, by its extension.
pub fn is_recording(path: &Path) -> bool {
    sound_rank(path).is_some()
}

/// Whether a path is that of an unsupported audio file.
fn is_other(path: &Path) -> bool {
    let extension = path.extension().and_then(|extension| extension.to_str());
    extension.is_some_and(|own| OTHER_EXTENSIONS.iter().any(|known| known.eq_ignore_ascii_case(own)))
}

/// Reports recordings that are not used because of others.
pub(crate) fn not_used(recordings: &Recordings) -> Vec<Report> {
    let report = |(path, used): (&Path, &Path)| {
        let message = format!("the recording is not used because `{}` has the same name", escape::text(&shown(used)));
        let help = "remove or rename one of the two, or name the extension in `pattern` of [audio]: {key}.wav";
        Report::failure(shown(path), Code::RecordingWithoutClip, message, help)
    };
    recordings.beside_others().map(report).collect()
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
        let (recordings, reports) = Recordings::at(RecordingPlaces::of_pattern(pattern), folder);
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

    /// macOS decomposes names, and recorders write capitals.
    #[test]
    fn names_of_other_systems_lead_to_recordings() {
        let folder = folder(&["Act1/MARA.WAV", "ma\u{308}ry.wav", "otto.wav", "Otto.wav", "OTTO.m4a", "Tom.m4a"]);
        let found = |key| found(folder.path(), None, key);
        assert_eq!(found("act1/mara").as_deref(), Some("Act1/MARA.WAV"));
        assert_eq!(found("m\u{e4}ry").as_deref(), Some("ma\u{308}ry.wav"));
        assert_eq!(found("Otto").as_deref(), Some("Otto.wav"));
        assert_eq!(found("oTTO"), None, "two are equally near");
        let recordings = Recordings::below(folder.path()).unwrap();
        assert_eq!(recordings.unread_of("tom"), Some(folder.path().join("Tom.m4a").as_path()));
        let inputs = ["act1/mara", "m\u{e4}ry", "otto", "Otto"].map(|key| Input::from_bytes(key, ""));
        assert_eq!(recordings.without_clip(&inputs), [] as [&Path; 0]);
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
