//! What a record says about a mouth: hashes of everything that decides about it.

use super::SyncOptions;
use super::grid::Grid;
use super::record::{Line, Made, OriginalThen};
use lipz_file::text::{DELIMITER, display, segments, trim};
use lipz_speech::{RenderRules, Script};
use lipz_types::{Fps, VisemeType};
use twox_hash::XxHash3_64;

/// Changes whenever the same recording, text and settings give other mouths than before.
const VERSION: u32 = 4;

/// What a record has where there is no text.
pub(super) const NO_TEXT: u64 = 0;

fn hash(bytes: &[u8]) -> u64 {
    XxHash3_64::oneshot(bytes)
}

/// What a record has of a text: its words, without what only divides and comments it. How they are pronounced is a setting.
pub(crate) fn text_hash(spoken: Option<&str>) -> u64 {
    spoken.map_or(NO_TEXT, |text| {
        let displayed: String =
            segments(text).flat_map(|segment| [display(&text[segment]).text.into_owned(), " ".into()]).collect();
        hash(words(&displayed).collect::<Vec<_>>().join(" ").as_bytes())
    })
}

/// What records of older versions have: its segments as they are written.
fn old_text_hash(spoken: Option<&str>) -> u64 {
    let segments = |text: &str| text.split(DELIMITER).map(trim).collect::<Vec<_>>().join("|");
    spoken.map_or(NO_TEXT, |text| hash(segments(text).as_bytes()))
}

/// The hash of a text in a record, as it would be written today if it is of this text.
pub(super) fn renewed(hash: u64, spoken: Option<&str>) -> u64 {
    if hash == old_text_hash(spoken) { text_hash(spoken) } else { hash }
}

impl Line {
    /// The line, as it would be written today if it was made from this text.
    pub(crate) fn renewed(&self, spoken: Option<&str>) -> Line {
        Line { made: Made { text: renewed(self.made.text, spoken), ..self.made }, ..self.clone() }
    }
}

impl OriginalThen {
    /// The same, as it would be written today if the original had this text.
    pub(crate) fn renewed(self, spoken: Option<&str>) -> OriginalThen {
        OriginalThen { text: renewed(self.text, spoken), ..self }
    }
}

/// Everything besides recording and text that decides about a mouth.
pub(super) fn settings_hash(
    options: &SyncOptions,
    locale: Option<&str>,
    script: &Script,
    (viseme_type, fps): (VisemeType, Fps),
    grid: Option<&Grid>,
) -> u64 {
    // Not the places of words in the text, which formatting moves.
    let said = || script.words.iter().map(|word| &word.pronunciations).collect::<Vec<_>>();
    let rules = match viseme_type {
        VisemeType::Rms => format!("{:?}", options.rms),
        _ => {
            let model = options.trained_for(locale).map_or(String::new(), |trained| format!(" {:x}", trained.hash));
            let recogniser = options.recogniser.as_ref().filter(|_| script.words.is_empty());
            let recogniser = recogniser.map_or(String::new(), |recogniser| format!(" heard {:x}", recogniser.hash()));
            let rules = hash_of_rules(&options.rules);
            format!("{:?} {rules} {:?} {:?}{model}{recogniser}", options.align, said(), script.breaks)
        }
    };
    let grid = grid.map_or(String::new(), |grid| format!(" {grid:?}"));
    hash(format!("{VERSION} {}/{} {viseme_type:?} {rules}{grid}", fps.numerator(), fps.denominator()).as_bytes())
}

/// The rules of mouths; one that came later says something only if it is not as before.
fn hash_of_rules(rules: &RenderRules) -> String {
    let RenderRules { lead_us, hold_us, shortest_wide_us, .. } = rules;
    let consonants = if rules.hold_consonants { " consonants" } else { "" };
    format!(
        "RenderRules {{ lead_us: {lead_us}, hold_us: {hold_us}, shortest_wide_us: {shortest_wide_us} }}{consonants}"
    )
}

/// The mouth of a file. `|` is not a part of it: writers move them.
pub(crate) fn mouth_hash(codes: &[u8], fps: Option<Fps>, viseme_type: Option<VisemeType>) -> u64 {
    let head = format!("{:?} {viseme_type:?} ", fps.map(|fps| (fps.numerator(), fps.denominator())));
    hash(&[head.as_bytes(), codes].concat())
}

/// The words of a text, without what only divides and comments it.
pub(super) fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| c == DELIMITER || c.is_whitespace()).filter(|word| !word.is_empty())
}
