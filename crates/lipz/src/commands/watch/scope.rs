//! The watched paths: those of Lipz files and settings.

use super::state::State;
use crate::shared::settings_file::Project;
use crate::shared::sources::Sources;
use lipz_compiler::key::EXTENSION;
use lipz_compiler::settings::{FILE_NAME, Settings};
use lipz_compiler::watched;
use notify::RecursiveMode;
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// The sources and the settings file of a project.
pub(crate) struct Scope {
    settings: Settings,
    settings_file: Option<PathBuf>,
}

impl Scope {
    /// Creates the scope from the command line, before the settings are read.
    pub(crate) fn before_settings(arguments: &Sources) -> Scope {
        let settings = Settings::from_sources(arguments.paths().to_vec());
        Scope { settings, settings_file: arguments.settings_file() }
    }

    /// Creates the scope from the project.
    pub(crate) fn new(project: &Project, arguments: &Sources) -> Scope {
        Scope { settings: project.settings.clone(), settings_file: arguments.settings_file() }
    }

    /// Adds all recordings, for programs that play them, as if the bank contained data about them.
    pub(crate) fn with_recordings(mut self) -> Scope {
        self.settings.audio.in_bank = true;
        self
    }

    /// Returns the folders to watch, and whether to include their subfolders.
    pub(crate) fn folders(&self) -> BTreeMap<PathBuf, RecursiveMode> {
        let recordings = self.settings.audio.folder.iter().filter(|_| self.settings.audio.in_bank);
        let recordings = recordings.map(|folder| (folder.clone(), RecursiveMode::Recursive));
        let settings_folder = self.settings_file.iter().map(|file| (folder_of(file), RecursiveMode::NonRecursive));
        let mut folders: BTreeMap<_, _> = settings_folder.collect();
        for place in watched(&self.settings.sources) {
            if place.is_file() || is_lipz(&place) && !place.is_dir() {
                folders.entry(folder_of(&place)).or_insert(RecursiveMode::NonRecursive);
            } else {
                folders.insert(place, RecursiveMode::Recursive);
            }
        }
        folders.extend(recordings);
        folders
    }

    /// Returns the sources and the settings file for people; a pattern is shortened to its folder.
    pub(crate) fn places(&self) -> Vec<PathBuf> {
        let mut places = watched(&self.settings.sources);
        places.extend(self.settings_file.clone().filter(|file| file.exists()));
        places
    }

    /// Returns the name of the settings file.
    pub(crate) fn settings_name(&self) -> Option<&OsStr> {
        self.settings_file.as_ref()?.file_name()
    }

    /// Returns the current state of all files.
    pub(crate) fn state(&self) -> State {
        State::of(&self.settings, self.settings_file.as_deref())
    }
}

/// Whether a path belongs to a Lipz file, a recording, the sync record or the settings file, judging by its name:
/// watchers may use different paths than the project.
pub(crate) fn concerns(settings_name: Option<&OsStr>, path: &Path) -> bool {
    is_lipz(path)
        || lipz_sync::is_recording(path)
        || path
            .file_name()
            .is_some_and(|name| name == FILE_NAME || name == lipz_sync::RECORD_NAME || Some(name) == settings_name)
}

fn is_lipz(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(EXTENSION))
}

/// Returns the folder that contains a file.
fn folder_of(file: &Path) -> PathBuf {
    match file.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_of_files_and_whole_folders() {
        let sources = ["voices/act?/*.lipz", "clips/a.lipz", "other"].map(PathBuf::from).to_vec();
        let settings = Settings::from_sources(sources);
        let scope = Scope { settings, settings_file: Some("lipz.toml".into()) };
        let (alone, below) = (RecursiveMode::NonRecursive, RecursiveMode::Recursive);
        let expected = [(".", alone), ("clips", alone), ("other", below), ("voices", below)];
        assert_eq!(scope.folders(), BTreeMap::from(expected.map(|(folder, mode)| (PathBuf::from(folder), mode))));
    }

    #[test]
    fn a_folder_is_watched_with_those_in_it_if_a_source_asks_for_that() {
        let settings = Settings::from_sources(vec!["a.lipz".into(), ".".into()]);
        let scope = Scope { settings, settings_file: Some("lipz.toml".into()) };
        assert_eq!(scope.folders(), BTreeMap::from([(PathBuf::from("."), RecursiveMode::Recursive)]));
    }
}
