//! Shared code of lipz's measurements: a generator of realistic clips, and the answers of rivals.
//!
//! The clips have the properties for which the project's goals are stated: 1 to 12 s at 24, 25 or 30 frames per second,
//! 1 to 6 segments, texts with the amount of speech for that time in each language, events on 30 % of the segments,
//! about 700 bytes per file with five locales.

pub mod callgrind;
mod clip;
#[cfg(feature = "tools")]
pub mod faces;
#[cfg(feature = "tools")]
mod folder;
#[cfg(feature = "tools")]
pub mod layers;
mod memory;
#[cfg(feature = "tools")]
pub mod mouths;
#[cfg(feature = "tools")]
pub mod naive;
mod random;
mod texts;

#[cfg(feature = "tools")]
pub use folder::{list, temporary_folder, write_clips, write_synced};
pub use memory::peak_bytes;
pub use random::Random;

/// The number of clips in a folder: a scene.
pub const CLIPS_PER_SCENE: usize = 100;
/// The rig of the bank with mouths.
pub const RIG: &str = "arkit";
/// The number of scenes in an act.
const SCENES_PER_ACT: usize = 20;
/// The seed of all published measurements.
pub const DEFAULT_SEED: u64 = 1;
/// The maximal number of locales in a clip.
pub const MAX_LOCALES: usize = texts::LOCALES.len();

/// Returns clip number `index` of `seed` as a Lipz file, with the first `locales` locales.
pub fn clip_json(seed: u64, index: usize, locales: usize) -> String {
    clip::json(seed, index, locales)
}

/// Returns keys and Lipz files of the first `count` clips of the published measurements.
pub fn files(count: usize, locales: usize) -> Vec<(String, String)> {
    (0..count).map(|index| (clip_key(index), clip_json(DEFAULT_SEED, index, locales))).collect()
}

/// Returns the key of clip number `index`, `act03/scene07/line-004611`.
pub fn clip_key(index: usize) -> String {
    format!("{}/line-{index:06}", scene_folder(index / CLIPS_PER_SCENE))
}

/// Returns the folder of a scene, `act03/scene07`.
pub fn scene_folder(scene: usize) -> String {
    format!("act{:02}/scene{:02}", scene / SCENES_PER_ACT + 1, scene % SCENES_PER_ACT + 1)
}

/// Returns the tags of the first `count` locales.
pub fn locale_tags(count: usize) -> impl Iterator<Item = &'static str> {
    texts::LOCALES.iter().take(count).map(|locale| locale.tag)
}

/// Parses a number of locales from a command line, up to those with words.
///
/// # Errors
/// If it is not such a number.
pub fn parse_locale_count(text: &str) -> Result<usize, String> {
    let most = MAX_LOCALES;
    text.parse().ok().filter(|count| (1..=most).contains(count)).ok_or_else(|| format!("a number from 1 to {most}"))
}
