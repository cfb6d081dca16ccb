//! The settings of a project for its recordings.

use super::SyncStatuses;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Stands for the key of a clip in [`Audio::pattern`] and in those of [`Audio::voices`].
pub const KEY: &str = "{key}";

/// The paths and properties of a project's recordings.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct Audio {
    /// The folder of the recordings. Without it, a project has none.
    pub folder: Option<PathBuf>,
    /// The path of a clip's recording below the folder, with `{key}` for its key. Without an extension, all known ones
    /// match. `None` for `{key}`.
    pub pattern: Option<String>,
    /// The spoken locale, unless a voice sets a different one; `None` for the default locale.
    pub locale: Option<String>,
    /// The languages in which lines are recorded, each with the pattern of its recordings and of the keys of its clips.
    /// Clips whose keys match a pattern are spoken in its locale, and are dubs if that is not [`Audio::locale`]
    /// ([`Voices`](crate::Voices)). All others are spoken in that locale.
    pub voices: BTreeMap<String, String>,
    /// The sync statuses of lines, which limit the lengths of their dubs.
    pub sync_statuses: SyncStatuses,
    /// The allowed difference between the lengths of a clip and its recording in milliseconds; `None` for one frame.
    pub tolerance_ms: Option<u32>,
    /// The sync record, which stores the source of each clip's visemes; `None` for one next to the Lipz files.
    pub record: Option<PathBuf>,
    /// A cache of data from recordings, so that the next check decodes only new ones.
    pub cache: Option<PathBuf>,
    /// Whether the bank contains the length and the content hash of each recording.
    pub in_bank: bool,
}

/// Extensions of recordings. If several files have the same name, the first of this list is used: lossless formats
/// first.
pub const SOUND_EXTENSIONS: [&str; 9] = ["wav", "wave", "aiff", "aif", "aifc", "flac", "ogg", "oga", "mp3"];

/// Returns the index of a file's extension in [`SOUND_EXTENSIONS`], ignoring case.
pub fn sound_rank(path: &Path) -> Option<usize> {
    let extension = path.extension()?.to_str()?;
    SOUND_EXTENSIONS.iter().position(|known| known.eq_ignore_ascii_case(extension))
}

/// Returns a pattern without its extension. Because keys may contain dots, only a known extension counts as one.
pub fn without_extension(pattern: &str) -> &str {
    let path = Path::new(pattern);
    let extension = path.extension().filter(|_| sound_rank(path).is_some() && !pattern.ends_with(KEY));
    extension.map_or(pattern, |extension| &pattern[..pattern.len() - extension.len() - 1])
}

/// Returns why `pattern` is invalid: the problem, and the help.
pub fn refused_pattern(pattern: &str) -> Option<(&'static str, &'static str)> {
    let others = pattern.replace(KEY, "");
    if pattern.matches(KEY).count() != 1 || others.contains(['{', '}']) {
        return Some(("does not contain {key} exactly once", "write {key} once, for the key of the clip: en-us/{key}"));
    }
    let is_inside = pattern.split(['/', '\\']).all(|part| part != "..") && !pattern.starts_with(['/', '\\']);
    (!is_inside).then_some(("leads out of the folder", "write a path below the folder"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_name_the_key_once_and_stay_in_the_folder() {
        for good in ["{key}", "en-us/{key}", "{key}_en.wav", "vo/{key}/take.ogg", "..{key}"] {
            assert_eq!(refused_pattern(good), None, "{good}");
        }
        for bad in ["", "key", "{key}{key}", "{locale}/{key}", "{key", "../{key}", "{key}/../x", "/{key}", "..\\{key}"]
        {
            assert!(refused_pattern(bad).is_some(), "{bad}");
        }
    }
}
