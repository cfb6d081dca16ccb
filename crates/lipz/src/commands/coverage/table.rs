//! Coverage as tables for people, as CSV, and as a document for programs.

use crate::console::{self, grouped};
use crate::shared::locales::locale_name;
use lipz_compiler::Coverage;
use lipz_diagnostics::escape;
use lipz_texts::{Amount, LocaleWork, Progress, SourceMatch, Work, cost_of};
use serde::Serialize;
use std::fmt::Write;

/// The message for a bank without locales.
pub(super) const NO_TEXTS: &str = "no clip has a text; add the text banks of a split bank: BANK+TEXTS";

/// Returns the coverage of a bank.
pub(super) fn of_bank(name: &str, found: &[Coverage]) -> String {
    let Some(first) = found.first() else {
        return format!("{name}: {NO_TEXTS}\n");
    };
    let clips = console::counted(first.clip_count, "clip");
    let mut text = format!("{name}: {clips} with texts\n\n");
    let _ = writeln!(
        text,
        "  {:<12} {:>9} {:>7} {:>8} {:>9} {:>8}  falls back to",
        "locale", "covered", "texts", "same", "fallback", "no text"
    );
    for coverage in found {
        let mut fallbacks: Vec<String> = coverage
            .fallbacks
            .iter()
            .map(|(tag, keys)| format!("{} {}", locale_name(tag), grouped(keys.len())))
            .collect();
        if coverage.is_default {
            fallbacks.insert(0, "(default locale)".to_owned());
        }
        let line = format!(
            "  {:<12} {:>7.1} % {:>7} {:>8} {:>9} {:>8}  {}",
            escape::text(&coverage.tag),
            coverage.percent_in_tenths(),
            grouped(coverage.own_count),
            grouped(coverage.same_as_default.len()),
            grouped(fallback_count(coverage)),
            grouped(coverage.missing.len()),
            fallbacks.join(", ")
        );
        let _ = writeln!(text, "{}", line.trim_end());
    }
    text.push_str("\nsame: the text is identical to that of the default locale\n");
    text
}

fn fallback_count(coverage: &Coverage) -> usize {
    coverage.fallbacks.values().map(Vec::len).sum()
}

/// Returns the remaining translation work, in segments and words.
pub(super) fn of_work(work: &Work, cost_per_word: Option<f64>) -> String {
    let Some(first) = work.locales.first() else { return String::new() };
    let (segments, words) =
        (console::counted(first.all().segments, "segment"), console::counted(first.all().words, "word"));
    let mut text = format!("\nto translate from {}: {segments} with {words}\n\n", escape::text(&work.source_locale));
    let mut head = format!("  {:<12} {:>9}", "locale", "words");
    for progress in Progress::ALL {
        let _ = write!(head, " {:>10}", progress.name());
    }
    let cost_head = cost_per_word.map(|_| format!(" {:>12}", "cost"));
    let _ = writeln!(text, "{head} {:>12}{}", "words to do", cost_head.unwrap_or_default());
    for locale in &work.locales {
        let _ = write!(text, "  {:<12} {:>7.1} %", escape::text(&locale.locale), locale.percent_in_tenths());
        for progress in Progress::ALL {
            let _ = write!(text, " {:>10}", grouped(locale.amount(progress).segments));
        }
        let to_do = locale.to_do().words;
        let cost = cost_per_word.map(|cost| format!(" {:>12}", cost_of(to_do, cost)));
        let _ = writeln!(text, " {:>12}{}", grouped(to_do), cost.unwrap_or_default());
    }
    text.push_str("\nwords: the translated share; the next columns count segments\n");
    let matches = matches(work);
    text.push_str(&matches);
    let (translated, unknown) = work.unknown();
    if unknown > 0 {
        if !matches.is_empty() {
            text.push('\n');
        }
        let _ = writeln!(
            text,
            "unknown: {} of {} without a recorded source text, which may be stale;\n`lipz approve --all` \
             records the current source texts",
            grouped(unknown),
            console::counted(translated, "translated segment")
        );
    }
    text
}

/// Returns the words to translate by how much of them is translated elsewhere; an empty string if nothing is.
fn matches(work: &Work) -> String {
    let mut text = format!("\nwords to do by similarity:\n\n  {:<12}", "locale");
    SourceMatch::BANDS.iter().for_each(|band| _ = write!(text, " {band:>10}"));
    text.push('\n');
    let mut has_matches = false;
    for locale in &work.locales {
        let bands = locale.bands();
        has_matches |= bands.iter().skip(1).any(|amount| amount.segments > 0);
        let _ = write!(text, "  {:<12}", escape::text(&locale.locale));
        bands.iter().for_each(|amount| _ = write!(text, " {:>10}", grouped(amount.words)));
        text.push('\n');
    }
    if has_matches { text } else { String::new() }
}

/// Returns a row for each locale, with all numbers. Tags and numbers need no quotes.
pub(super) fn csv(found: &[Coverage], work: Option<&Work>, cost_per_word: Option<f64>) -> String {
    let mut text = "locale,clips,covered percent,texts,same,fallback,nothing".to_owned();
    if work.is_some() {
        text.push_str(",segments,words");
        for progress in Progress::ALL {
            let _ = write!(text, ",{0} segments,{0} words", progress.name());
        }
        text.push_str(",unknown segments,unknown words");
        SourceMatch::BANDS.iter().for_each(|band| _ = write!(text, ",{band} words"));
        text.push_str(",words to do");
        text.push_str(if cost_per_word.is_some() { ",cost" } else { "" });
    }
    text.push_str("\r\n");
    for coverage in found {
        let _ = write!(
            text,
            "{},{},{:.1},{},{},{},{}",
            coverage.tag,
            coverage.clip_count,
            coverage.percent_in_tenths(),
            coverage.own_count,
            coverage.same_as_default.len(),
            fallback_count(coverage),
            coverage.missing.len()
        );
        match (work, work.and_then(|work| of_locale(work, &coverage.tag))) {
            (None, _) => {}
            (Some(_), Some(work)) => work_cells(work, cost_per_word, &mut text),
            (Some(_), None) => {
                text.push_str(&",".repeat(15 + SourceMatch::BANDS.len() + usize::from(cost_per_word.is_some())));
            }
        }
        text.push_str("\r\n");
    }
    text
}

fn work_cells(work: &LocaleWork, cost_per_word: Option<f64>, text: &mut String) {
    let _ = write!(text, ",{},{}", work.all().segments, work.all().words);
    for progress in Progress::ALL {
        let amount = work.amount(progress);
        let _ = write!(text, ",{},{}", amount.segments, amount.words);
    }
    let to_do = work.to_do().words;
    let _ = write!(text, ",{},{}", work.unknown.segments, work.unknown.words);
    work.bands().iter().for_each(|amount| _ = write!(text, ",{}", amount.words));
    let _ = write!(text, ",{to_do}");
    if let Some(cost) = cost_per_word {
        let _ = write!(text, ",{}", cost_of(to_do, cost));
    }
}

fn of_locale<'w>(work: &'w Work, tag: &str) -> Option<&'w LocaleWork> {
    work.locales.iter().find(|work| work.locale == tag)
}

/// A locale in the JSON document.
#[derive(Serialize)]
pub(super) struct CoverageRow<'a> {
    #[serde(flatten)]
    coverage: &'a Coverage,
    #[serde(skip_serializing_if = "Option::is_none")]
    work: Option<WorkRow>,
}

#[derive(Serialize)]
struct WorkRow {
    from: String,
    missing: AmountRow,
    stale: AmountRow,
    translated: AmountRow,
    reviewed: AmountRow,
    #[serde(rename = "final")]
    done: AmountRow,
    /// The part of the translated amount whose source texts are unrecorded.
    unknown: AmountRow,
    words_to_do: usize,
    /// The words to do by band of similarity.
    matches: MatchesRow,
    #[serde(skip_serializing_if = "Option::is_none")]
    cost: Option<f64>,
}

/// The words in each of the [`SourceMatch::BANDS`].
#[derive(Serialize)]
struct MatchesRow {
    new: usize,
    similar_75: usize,
    similar_85: usize,
    similar_95: usize,
    same: usize,
    repeated: usize,
}

#[derive(Serialize)]
struct AmountRow {
    segments: usize,
    words: usize,
}

/// Returns the coverage as a document, with the work of each locale if it is available.
pub(super) fn document<'a>(
    found: &'a [Coverage],
    work: Option<&Work>,
    cost_per_word: Option<f64>,
) -> Vec<CoverageRow<'a>> {
    let row = |coverage: &'a Coverage| {
        let own = work.and_then(|work| Some((work, of_locale(work, &coverage.tag)?)));
        CoverageRow { coverage, work: own.map(|(work, locale)| work_row(&work.source_locale, locale, cost_per_word)) }
    };
    found.iter().map(row).collect()
}

fn work_row(from: &str, locale: &LocaleWork, cost_per_word: Option<f64>) -> WorkRow {
    let row = |amount: Amount| AmountRow { segments: amount.segments, words: amount.words };
    let amount = |progress| row(locale.amount(progress));
    let to_do = locale.to_do().words;
    let [new, similar_75, similar_85, similar_95, same, repeated] = locale.bands().map(|amount| amount.words);
    WorkRow {
        from: from.to_owned(),
        missing: amount(Progress::Missing),
        stale: amount(Progress::Stale),
        translated: amount(Progress::Translated),
        reviewed: amount(Progress::Reviewed),
        done: amount(Progress::Final),
        unknown: row(locale.unknown),
        words_to_do: to_do,
        matches: MatchesRow { new, similar_75, similar_85, similar_95, same, repeated },
        cost: cost_per_word.map(|cost| (to_do as f64 * cost * 100.0).round() / 100.0),
    }
}
