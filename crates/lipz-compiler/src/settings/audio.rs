//! What a project decides about its recordings.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Stands for the key of a clip in [`Audio::pattern`] and in those of [`Audio::voices`].
pub const KEY: &str = "{key}";

/// Where the recordings of a project are, and what is asked of them.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct Audio {
    /// The folder of the recordings; without it, a project has none.
    pub folder: Option<PathBuf>,
    /// The path of a clip's recording below the folder, with `{key}` for its key. Without an extension, any that is
    /// known will do. `None` for `{key}`.
    pub pattern: Option<String>,
    /// The locale that is spoken, unless a voice says otherwise; `None` for the default locale.
    pub locale: Option<String>,
    /// The languages in which lines are recorded, each with the pattern of its recordings and of the keys of its clips.
    /// Clips whose keys fit a pattern are spoken in its locale, and are dubs if that is not [`Audio::locale`]
    /// ([`Voices`](crate::Voices)); all others are spoken in that.
    pub voices: BTreeMap<String, String>,
    /// Milliseconds by which the length of a clip may differ from that of its recording; `None` for a frame.
    pub tolerance_ms: Option<u32>,
    /// The file that records from what each mouth was made; `None` for one beside the Lipz files.
    pub record: Option<PathBuf>,
    /// A file that remembers what was heard in recordings, so that the next check decodes only new ones.
    pub cache: Option<PathBuf>,
    /// The bank carries the length and the content hash of each recording.
    pub in_bank: bool,
}

/// Extensions of recordings. Of several files with one name, the first of this list counts: what nothing was lost of.
pub const SOUND_EXTENSIONS: [&str; 9] = ["wav", "wave", "aiff", "aif", "aifc", "flac", "ogg", "oga", "mp3"];

/// The place of a file's extension in [`SOUND_EXTENSIONS`], whatever its case.
pub fn sound_rank(path: &Path) -> Option<usize> {
    let extension = path.extension()?.to_str()?;
    SOUND_EXTENSIONS.iter().position(|known| known.eq_ignore_ascii_case(extension))
}

/// A pattern without its extension. Keys may have dots: only a pattern that ends in a known extension has one.
pub fn without_extension(pattern: &str) -> &str {
    let path = Path::new(pattern);
    let extension = path.extension().filter(|_| sound_rank(path).is_some() && !pattern.ends_with(KEY));
    extension.map_or(pattern, |extension| &pattern[..pattern.len() - extension.len() - 1])
}

/// What keeps `pattern` from being one: what is wrong, and what to do.
pub fn refused_pattern(pattern: &str) -> Option<(&'static str, &'static str)> {
    let others = pattern.replace(KEY, "");
    if pattern.matches(KEY).count() != 1 || others.contains(['{', '}']) {
        return Some(("does not name {key} once", "write {key} where the key of the clip stands: en-us/{key}"));
    }
    let is_inside = pattern.split(['/', '\\']).all(|part| part != "..") && !pattern.starts_with(['/', '\\']);
    (!is_inside).then_some(("leads out of the folder", "name another folder, and the path below it"))
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
