//! The list of clips: a row for each, with what can be searched and filtered.

use super::version::Version;
use lipz_bank::{Bank, Clip, Locale};
use lipz_diagnostics::{Report, Severity};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// How many diagnostics of the project as a whole the page shows above a clip.
const MOST_OTHERS: usize = 3;

/// All clips, as the page gets them.
#[derive(Serialize)]
pub(super) struct Listing {
    version: u64,
    /// What tells the bank from others.
    bank: String,
    name: String,
    is_read_only: bool,
    /// The locales of the bank; rows have their places here.
    locales: Vec<String>,
    clips: Vec<Row>,
    /// What is wrong with the project as a whole.
    diagnostics: Vec<String>,
}

/// One clip. What is empty is left out: there may be a hundred thousand.
#[derive(Serialize, Default)]
struct Row {
    key: String,
    /// Its length in seconds; none if its frames have no rate.
    #[serde(skip_serializing_if = "Option::is_none")]
    seconds: Option<f64>,
    /// Whether the bank has it: files with errors are left out.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    is_left_out: bool,
    #[serde(skip_serializing_if = "is_zero")]
    errors: usize,
    #[serde(skip_serializing_if = "is_zero")]
    warnings: usize,
    /// The codes of its diagnostics.
    #[serde(skip_serializing_if = "BTreeSet::is_empty")]
    codes: BTreeSet<&'static str>,
    /// How many of its words are not clearly heard.
    #[serde(skip_serializing_if = "is_zero")]
    doubtful_words: usize,
    /// The places of the locales in which it has a text of its own.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    locales: Vec<usize>,
    /// Who is in it.
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
    /// The list of a version.
    pub(super) fn new(version: &Version, is_read_only: bool) -> Listing {
        let bank = Bank::open(&version.bank).ok();
        let locales: Vec<Locale> = bank.iter().flat_map(Bank::locales).collect();
        let tag = |locale: &Locale| bank.as_ref().map_or("", |bank| bank.locale_tag(*locale)).to_owned();
        let mut rows: BTreeMap<String, Row> = BTreeMap::new();
        for clip in bank.iter().flat_map(Bank::clips) {
            rows.insert(clip.key().to_owned(), Row::of_clip(&clip, &locales));
        }
        for key in version.files.keys() {
            let row = rows.entry(key.clone()).or_insert_with(|| Row {
                key: key.clone(),
                is_left_out: true,
                ..Row::default()
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
    /// The keys of all clips, in the order of the list.
    pub(super) fn keys(&self) -> impl Iterator<Item = &str> {
        self.clips.iter().map(|row| row.key.as_str())
    }
}

/// The diagnostics that belong to no clip: some of them, and how many there are besides.
fn others(version: &Version) -> Vec<String> {
    let mut told: Vec<String> =
        version.other_reports().map(|report| report.to_string().trim_end().to_owned()).collect();
    let left = told.len().saturating_sub(MOST_OTHERS);
    if left > 0 {
        told.truncate(MOST_OTHERS);
        told.push(format!("and {left} more: `lipz check` prints them all"));
    }
    told
}

impl Row {
    fn of_clip(clip: &Clip<'_>, locales: &[Locale]) -> Row {
        let has_own = |locale: &Locale| {
            clip.segments().any(|segment| segment.text(*locale).is_some_and(|text| !text.is_fallback()))
        };
        let own = locales.iter().enumerate().filter(|(_, locale)| has_own(locale)).map(|(place, _)| place);
        #[allow(clippy::cast_precision_loss, reason = "clips are shorter than a century")]
        let seconds = clip.duration_us().map(|us| us as f64 / 1e6);
        Row { key: clip.key().to_owned(), seconds, locales: own.collect(), ..Row::default() }
    }

    fn add(&mut self, reports: &[Report]) {
        self.errors = reports.iter().map(|report| report.count(Severity::Error)).sum();
        self.warnings = reports.iter().map(|report| report.count(Severity::Warning)).sum();
        self.codes = reports.iter().flat_map(|report| &report.diagnostics).map(|found| found.code.number()).collect();
    }
}
