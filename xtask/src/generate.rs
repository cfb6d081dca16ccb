//! `cargo xtask generate`: a folder of made-up clips of realistic size and shape.
//!
//! What they are like is said in the crate that makes them, `lipz-benches`.

use crate::Failure;
use clap::Args;
use lipz_benches::{CLIPS_PER_SCENE, DEFAULT_SEED, MAX_LOCALES, clip_json, scene_folder};
use rayon::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What `generate` is asked for.
#[derive(Args, Debug)]
pub(crate) struct Settings {
    /// Number of clips
    #[arg(long, value_name = "N")]
    clips: usize,

    /// Number of locales of each clip
    #[arg(long, value_name = "K", value_parser = parse_locale_count)]
    locales: usize,

    /// The folder to make; it must be empty if it exists
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,

    /// Other seeds give other clips; the same seed gives the same bytes everywhere
    #[arg(long, value_name = "SEED", default_value_t = DEFAULT_SEED)]
    seed: u64,
}

/// A number of locales that there are words for.
pub(crate) fn parse_locale_count(text: &str) -> Result<usize, String> {
    let most = MAX_LOCALES;
    text.parse().ok().filter(|count| (1..=most).contains(count)).ok_or_else(|| format!("a number from 1 to {most}"))
}

pub(crate) fn run(settings: &Settings) -> Result<(), Failure> {
    let start = Instant::now();
    let bytes = generate(settings.clips, settings.locales, settings.seed, &settings.out)?;
    println!(
        "{} clips with {} locales, {:.2} MB, in {:.1} s",
        settings.clips,
        settings.locales,
        bytes as f64 / 1e6,
        start.elapsed().as_secs_f64()
    );
    Ok(())
}

/// Writes the clips into `folder` and returns the number of bytes.
pub(crate) fn generate(clips: usize, locales: usize, seed: u64, folder: &Path) -> Result<u64, Failure> {
    let failed = |path: &Path, error: &dyn std::fmt::Display| format!("`{}`: {error}", path.display());
    if fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_some()) {
        return Err(failed(folder, &"the folder is not empty"));
    }
    let scenes = clips.div_ceil(CLIPS_PER_SCENE);
    // A folder is made and filled by one thread: no two wait for its lock.
    let sizes: Result<Vec<u64>, Failure> = (0..scenes)
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

#[cfg(test)]
mod tests {
    use super::*;
    use lipz_compiler::{Input, Options, check_all};

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
            let checked = check_all(&inputs, &Options::default(), &|_| {});
            let findings: Vec<_> = checked.reports.iter().flat_map(|report| &report.diagnostics).take(3).collect();
            assert!(findings.is_empty(), "{findings:#?}");
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
        let folder = crate::place::temporary_folder().unwrap();
        let (one, two) = (folder.path().join("one"), folder.path().join("two"));
        let bytes = generate(250, 3, 7, &one).unwrap();
        assert_eq!(generate(250, 3, 7, &two).unwrap(), bytes);
        let line = |folder: &Path| fs::read(folder.join("act01/scene03/line-000249.lipz")).unwrap();
        assert_eq!(line(&one), line(&two));
        assert_ne!(clip_json(7, 249, 3), clip_json(8, 249, 3));
        assert!(generate(1, 1, 7, &one).is_err(), "the folder is not empty");
    }
}
