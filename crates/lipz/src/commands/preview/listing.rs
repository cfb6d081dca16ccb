//! The list of clips: a row for each, with the data for search and filters.

use super::version::Version;
use lipz_bank::{Bank, Clip, Locale};
use lipz_diagnostics::{Report, Severity};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// The most diagnostics of the whole project that the page shows above a clip.
const MOST_OTHERS: usize = 3;

/// All clips, as they are sent to the page.
#[derive(Serialize)]
pub(super) struct Listing {
    version: u64,
    /// Identifies the bank.
    bank: String,
    name: String,
    is_read_only: bool,
    /// The locales of the bank. Rows refer to their indexes.
    locales: Vec<String>,
    clips: Vec<ListingRow>,
    /// The diagnostics of the project as a whole.
    diagnostics: Vec<String>,
}

/// One clip. Empty fields are omitted, because there may be a hundred thousand clips.
#[derive(Serialize, Default)]
struct ListingRow {
    key: String,
    /// Its length in seconds; `None` without a frame rate.
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds: Option<f64>,
    /// Whether the bank leaves it out because its file has errors.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    is_left_out: bool,
    #[serde(skip_serializing_if = "is_zero")]
    errors: usize,
    #[serde(skip_serializing_if = "is_zero")]
    warnings: usize,
    /// The codes of its diagnostics.
    #[serde(skip_serializing_if = "BTreeSet::is_empty")]
    codes: BTreeSet<&'static str>,
    /// The number of its words that are unclear in the recording.
    #[serde(skip_serializing_if = "is_zero")]
    doubtful_words: usize,
    /// The indexes of the locales in which it has a text of its own.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    locales: Vec<usize>,
    /// Its characters.
    #[serde(skip_serializing_if = "BTreeSet::is_empty")]
    characters: BTreeSet<String>,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    has_sound: bool,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks by reference")]
fn is_zero(number: &usize) -> bool {
    *number == 0
}

impl Listing {
    /// Creates the list of a version.
    pub(super) fn new(version: &Version, is_read_only: bool) -> Listing {
        let bank = Bank::open(&version.bank).ok();
        let locales: Vec<Locale> = bank.iter().flat_map(Bank::locales).collect();
        let tag = |locale: &Locale| bank.as_ref().map_or("", |bank| bank.locale_tag(*locale)).to_owned();
        let mut rows: BTreeMap<String, ListingRow> = BTreeMap::new();
        for clip in bank.iter().flat_map(Bank::clips) {
            rows.insert(clip.key().to_owned(), ListingRow::of_clip(&clip, &locales));
        }
        for key in version.files.keys() {
            let row = rows.entry(key.clone()).or_insert_with(|| ListingRow {
                key: key.clone(),
                is_left_out: true,
                ..ListingRow::default()
            });
            row.add(&version.reports_of(key));
            row.doubtful_words = version.words.get(key).map_or(0, lipz_compiler::WordTimes::doubtful_count);
        }
        let characters = version.characters();
        for (key, row) in &mut rows {
            row.characters = characters.get(key).cloned().unwrap_or_default();
            row.has_sound = version.recordings.find(key).is_some();
        }
        Listing {
            version: version.number,
            bank: version.bank_tag(),
            name: version.name.clone(),
            is_read_only,
            locales: locales.iter().map(tag).collect(),
            clips: rows.into_values().collect(),
            diagnostics: others(version),
        }
    }
}

impl Listing {
    /// Returns the keys of all clips, in the order of the list.
    pub(super) fn keys(&self) -> impl Iterator<Item = &str> {
        self.clips.iter().map(|row| row.key.as_str())
    }
}

/// Returns some of the diagnostics that belong to no clip, and the number of the remaining ones.
fn others(version: &Version) -> Vec<String> {
    let mut told: Vec<String> =
        version.other_reports().map(|report| report.to_string().trim_end().to_owned()).collect();
    let left = told.len().saturating_sub(MOST_OTHERS);
    if left > 0 {
        told.truncate(MOST_OTHERS);
        told.push(format!("and {left} more; run `lipz check` to see all"));
    }
    told
}

impl ListingRow {
    fn of_clip(clip: &Clip<'_>, locales: &[Locale]) -> ListingRow {
        let has_own = |locale: &Locale| {
            clip.segments().any(|segment| segment.text(*locale).is_some_and(|text| !text.is_fallback()))
        };
        let own = locales.iter().enumerate().filter(|(_, locale)| has_own(locale)).map(|(place, _)| place);
        #[allow(clippy::cast_precision_loss, reason = "clips are shorter than a century")]
        let seconds = clip.duration_us().map(|us| us as f64 / 1e6);
        ListingRow { key: clip.key().to_owned(), seconds, locales: own.collect(), ..ListingRow::default() }
    }

    fn add(&mut self, reports: &[Report]) {
        self.errors = reports.iter().map(|report| report.count(Severity::Error)).sum();
        self.warnings = reports.iter().map(|report| report.count(Severity::Warning)).sum();
        self.codes = reports.iter().flat_map(|report| &report.diagnostics).map(|found| found.code.number()).collect();
    }
}
