//! The hash of all settings that affect visemes.

use super::SyncOptions;
use super::grid::Grid;
use crate::record::hashes::hash;
use lipz_speech::{RenderRules, Script};
use lipz_types::{Fps, VisemeType};

/// The version of lip sync. It must change when the same recording, text and settings produce different visemes.
const VERSION: u32 = 5;

/// Returns the hash of everything that affects visemes, apart from recording and text.
pub(super) fn settings_hash(
    options: &SyncOptions,
    locale: Option<&str>,
    script: &Script,
    (viseme_type, fps): (VisemeType, Fps),
    grid: Option<&Grid>,
) -> u64 {
    // Excludes the positions of words in the text, which formatting changes.
    let said = || script.words.iter().map(|word| &word.pronunciations).collect::<Vec<_>>();
    let rules = match viseme_type {
        VisemeType::Rms => format!("{:?}", options.rms),
        _ => {
            let model = options.trained_for(locale).map_or(String::new(), |trained| format!(" {:x}", trained.hash));
            let recogniser = match script.words.is_empty() {
                true => format!(" heard {:x}", options.recogniser_without_text().hash()),
                false => String::new(),
            };
            let rules = text_of_rules(&options.rules);
            format!("{:?} {rules} {:?} {:?}{model}{recogniser}", options.align, said(), script.breaks)
        }
    };
    let grid = grid.map_or(String::new(), |grid| format!(" {grid:?}"));
    let phones = if options.phones { " phones" } else { "" };
    hash(
        format!("{VERSION} {}/{} {viseme_type:?} {rules}{grid}{phones}", fps.numerator(), fps.denominator()).as_bytes(),
    )
}

/// Returns the text of the rules for the hash. Later additions appear in it only if they differ from the default, so that
/// old hashes stay valid.
fn text_of_rules(rules: &RenderRules) -> String {
    let RenderRules { lead_us, hold_us, shortest_wide_us, .. } = rules;
    let consonants = if rules.hold_consonants { " consonants" } else { "" };
    format!(
        "RenderRules {{ lead_us: {lead_us}, hold_us: {hold_us}, shortest_wide_us: {shortest_wide_us} }}{consonants}"
    )
}
