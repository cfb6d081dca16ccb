//! The hashes in a record, of everything that affects visemes.

use crate::record::{MouthHashes, OriginalHashes, RecordLine};
use crate::recordings::clip::{ClipMouth, own_type};
use lipz_compiler::Options;
use lipz_file::Document;
use lipz_file::text::{DELIMITER, display, segments, trim};
use lipz_types::{Fps, VisemeType};
use twox_hash::XxHash3_64;

/// The hash of a missing text.
pub(crate) const NO_TEXT: u64 = 0;

pub(crate) fn hash(bytes: &[u8]) -> u64 {
    XxHash3_64::oneshot(bytes)
}

/// Returns the hash of a text's words, without `|`. Pronunciations are part of the settings.
pub(crate) fn text_hash(spoken: Option<&str>) -> u64 {
    spoken.map_or(NO_TEXT, |text| {
        let displayed: String =
            segments(text).flat_map(|segment| [display(&text[segment]).text.into_owned(), " ".into()]).collect();
        hash(words(&displayed).collect::<Vec<_>>().join(" ").as_bytes())
    })
}

/// Returns the hash in records of older versions, of the segments as written.
fn old_text_hash(spoken: Option<&str>) -> u64 {
    let segments = |text: &str| text.split(DELIMITER).map(trim).collect::<Vec<_>>().join("|");
    spoken.map_or(NO_TEXT, |text| hash(segments(text).as_bytes()))
}

/// Returns the hash of a text in the current form, if it is the hash of this text.
pub(crate) fn renewed(hash: u64, spoken: Option<&str>) -> u64 {
    if hash == old_text_hash(spoken) { text_hash(spoken) } else { hash }
}

impl RecordLine {
    /// Returns the line in the current form, if it was made from this text.
    pub(crate) fn renewed(&self, spoken: Option<&str>) -> RecordLine {
        RecordLine { made: MouthHashes { text: renewed(self.made.text, spoken), ..self.made }, ..self.clone() }
    }
}

impl OriginalHashes {
    /// Returns the hashes in the current form, if the original had this text.
    pub(crate) fn renewed(self, spoken: Option<&str>) -> OriginalHashes {
        OriginalHashes { text: renewed(self.text, spoken), ..self }
    }
}

/// Returns the hash of a file's visemes. It excludes `|`, because writers move them.
pub(crate) fn mouth_hash(codes: &[u8], fps: Option<Fps>, viseme_type: Option<VisemeType>) -> u64 {
    let head = format!("{:?} {viseme_type:?} ", fps.map(|fps| (fps.numerator(), fps.denominator())));
    hash(&[head.as_bytes(), codes].concat())
}

/// Returns the hash of the visemes in a Lipz file.
pub(crate) fn file_mouth_hash(document: &Document<'_>, mouth: &ClipMouth<'_>, options: &Options) -> u64 {
    let own_fps = document.get("fps").and(mouth.fps);
    let viseme_type = own_type(document).or(options.get_default_viseme_type());
    mouth_hash(&mouth.codes, own_fps.or(options.get_default_fps()), viseme_type)
}

/// Returns the words of a text, without `|`.
pub(crate) fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| c == DELIMITER || c.is_whitespace()).filter(|word| !word.is_empty())
}
