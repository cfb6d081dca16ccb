//! What measurements of lipz share: a generator of realistic clips, and the answers of rivals.
//!
//! The clips have the shape that the project's goals are stated for: 1 to 12 s at 24, 25 or 30
//! frames per second, 1 to 6 segments, texts as long as what is said in that time in each language,
//! events on 30 % of the segments, about 700 bytes a file at five locales.

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
pub mod naive;
mod random;
mod texts;

#[cfg(feature = "tools")]
pub use folder::{list, temporary_folder, write_clips, write_synced};
pub use memory::peak_bytes;
pub use random::Random;

/// Clips of a folder: a scene.
pub const CLIPS_PER_SCENE: usize = 100;
/// Scenes of an act.
const SCENES_PER_ACT: usize = 20;
/// The seed of all published measurements.
pub const DEFAULT_SEED: u64 = 1;
/// The most locales that a clip can have.
pub const MAX_LOCALES: usize = texts::LOCALES.len();

/// Clip number `index` of `seed` as a Lipz file, with the first `locales` locales.
pub fn clip_json(seed: u64, index: usize, locales: usize) -> String {
    clip::json(seed, index, locales)
}

/// Keys and Lipz files of the first `count` clips of the published measurements.
pub fn files(count: usize, locales: usize) -> Vec<(String, String)> {
    (0..count).map(|index| (clip_key(index), clip_json(DEFAULT_SEED, index, locales))).collect()
}

/// The key of clip number `index`, `act03/scene07/line-004611`.
pub fn clip_key(index: usize) -> String {
    format!("{}/line-{index:06}", scene_folder(index / CLIPS_PER_SCENE))
}

/// The folder of a scene, `act03/scene07`.
pub fn scene_folder(scene: usize) -> String {
    format!("act{:02}/scene{:02}", scene / SCENES_PER_ACT + 1, scene % SCENES_PER_ACT + 1)
}

/// The tags of the first `count` locales.
pub fn locale_tags(count: usize) -> impl Iterator<Item = &'static str> {
    texts::LOCALES.iter().take(count).map(|locale| locale.tag)
}

/// A number of locales that there are words for, as a command line names it.
///
/// # Errors
/// If it is none.
pub fn parse_locale_count(text: &str) -> Result<usize, String> {
    let most = MAX_LOCALES;
    text.parse().ok().filter(|count| (1..=most).contains(count)).ok_or_else(|| format!("a number from 1 to {most}"))
}
