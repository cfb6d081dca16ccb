//! Generated clips as a folder of files.

use crate::{CLIPS_PER_SCENE, clip_json, scene_folder};
use rayon::prelude::*;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Writes `clips` generated clips into `folder`, and returns their length in bytes.
///
/// # Errors
/// If the folder already has files, or a file cannot be written.
pub fn write_clips(clips: usize, locales: usize, seed: u64, folder: &Path) -> Result<u64, String> {
    let failed = |path: &Path, error: &dyn std::fmt::Display| format!("`{}`: {error}", path.display());
    if fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_some()) {
        return Err(failed(folder, &"the folder is not empty"));
    }
    let scenes = clips.div_ceil(CLIPS_PER_SCENE);
    // One thread creates and fills a folder, so that no two threads wait for its lock.
    let sizes: Result<Vec<u64>, String> = (0..scenes)
        .into_par_iter()
        .map(|scene| {
            let folder = folder.join(scene_folder(scene));
            fs::create_dir_all(&folder).map_err(|error| failed(&folder, &error))?;
            let first = scene * CLIPS_PER_SCENE;
            let mut bytes = 0;
            for index in first..clips.min(first + CLIPS_PER_SCENE) {
                let path = folder.join(format!("line-{index:06}.lipz"));
                let json = clip_json(seed, index, locales);
                fs::write(&path, &json).map_err(|error| failed(&path, &error))?;
                bytes += json.len() as u64;
            }
            Ok(bytes)
        })
        .collect();
    Ok(sizes?.iter().sum())
}

/// Returns all files below `folder` whose names end in `.lipz`, in the order of the file system.
///
/// # Errors
/// If a folder cannot be read.
pub fn list(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder)? {
            let entry = entry?;
            let path = entry.path();
            if entry.file_type()?.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "lipz") {
                files.push(path);
            }
        }
    }
    Ok(files)
}

/// Returns a new folder below `target`, removed when dropped. The system's folder for temporary files is often in
/// memory: too small for 100,000 files, and not suitable to measure a disk.
///
/// # Errors
/// If it cannot be created.
pub fn temporary_folder() -> Result<TempDir, String> {
    let target = std::env::var_os("CARGO_TARGET_DIR")
        .map_or_else(|| PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../target")), PathBuf::from);
    let parent = target.join("benches");
    fs::create_dir_all(&parent)
        .and_then(|()| tempfile::tempdir_in(&parent))
        .map_err(|error| format!("no temporary folder in `{}`: {error}", parent.display()))
}

/// Writes a file, and waits until it is on disk, as for a bank.
///
/// # Errors
/// If it cannot be written.
pub fn write_synced(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = fs::File::create(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DEFAULT_SEED, MAX_LOCALES};
    use lipz_compiler::{Compiler, Input};

    fn clips(count: usize, locales: usize) -> Vec<String> {
        (0..count).map(|index| clip_json(DEFAULT_SEED, index, locales)).collect()
    }

    #[test]
    fn nothing_is_found_in_them() {
        for locales in [1, 5, MAX_LOCALES] {
            let inputs: Vec<Input> = clips(1000, locales)
                .into_iter()
                .enumerate()
                .map(|(index, json)| Input::from_bytes(format!("line-{index}"), json))
                .collect();
            let checked = Compiler::default().check(&inputs);
            let diagnostics: Vec<_> = checked.reports.iter().flat_map(|report| &report.diagnostics).take(3).collect();
            assert!(diagnostics.is_empty(), "{diagnostics:#?}");
        }
    }

    #[test]
    fn they_have_the_shape_of_real_ones() {
        let clips = clips(2000, 5);
        let mean = |of: &dyn Fn(&serde_json::Value) -> usize| {
            let values = clips.iter().map(|json| serde_json::from_str(json).unwrap());
            values.map(|value| of(&value)).sum::<usize>() as f64 / clips.len() as f64
        };
        let string = |value: &serde_json::Value, name: &str| value[name].as_str().unwrap_or_default().to_owned();
        let bytes = clips.iter().map(String::len).sum::<usize>() as f64 / clips.len() as f64;
        let frames = mean(&|value| string(value, "visemes").replace('|', "").len());
        let segments = mean(&|value| string(value, "visemes").split('|').count());
        let events = mean(&|value| string(value, "events").split('|').filter(|event| !event.is_empty()).count());
        assert!((690.0..740.0).contains(&bytes), "{bytes} bytes");
        assert!((155.0..178.0).contains(&frames), "{frames} frames");
        assert!((2.0..2.3).contains(&segments), "{segments} segments");
        assert!((0.27..0.33).contains(&(events / segments)), "{events} events on {segments} segments");
        let blair = clips.iter().filter(|json| json.contains("\"viseme_type\": \"blair\"")).count();
        assert!((1300..1500).contains(&blair), "{blair} of 2000 blair");
    }

    #[test]
    fn a_seed_keeps_its_meaning() {
        let folder = tempfile::tempdir().unwrap();
        let (one, two) = (folder.path().join("one"), folder.path().join("two"));
        let bytes = write_clips(250, 3, 7, &one).unwrap();
        assert_eq!(write_clips(250, 3, 7, &two).unwrap(), bytes);
        let line = |folder: &Path| fs::read(folder.join("act01/scene03/line-000249.lipz")).unwrap();
        assert_eq!(line(&one), line(&two));
        assert_ne!(clip_json(7, 249, 3), clip_json(8, 249, 3));
        assert!(write_clips(1, 1, 7, &one).is_err(), "the folder is not empty");
    }
}
