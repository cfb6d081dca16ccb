//! The files on which a bank depends, apart from Lipz files.

use super::record_place;
use crate::recordings::Recordings;
use lipz_compiler::settings::Settings;
use std::path::PathBuf;

/// Returns the files on which the bank of a project depends, apart from its Lipz files: the record with its word times,
/// and its recordings and their folder, if the bank contains data about them.
pub fn dependencies(settings: &Settings) -> Vec<PathBuf> {
    let audio = &settings.audio;
    let record = Some(record_place(settings)).filter(|record| record.is_file());
    let mut paths = Vec::from_iter(record);
    if let Some(folder) = audio.folder.as_ref().filter(|_| audio.in_bank) {
        // `check` reports unreadable folders.
        let (recordings, _) = Recordings::discover_with_reports(settings);
        paths.push(folder.clone());
        paths.extend(recordings.iter().map(|(_, path)| path.to_owned()));
    }
    paths
}
