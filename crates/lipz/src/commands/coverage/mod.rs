//! `lipz coverage`: how much of a dialogue is translated, and how much of it is dubbed.

mod voices;

use crate::Ended;
use crate::commands::Run;
use crate::console::grouped;
use crate::reporter::Reporter;
use crate::shared::bank_or_sources::Dialogue;
use crate::shared::locales::{choose, locale_name};
use crate::{Outcome, console};
use clap::Args;
use lipz_compiler::{BankWithTexts, Coverage, MinCoverage, coverage, shortfalls, voice_coverage};
use lipz_diagnostics::{Report, escape};
use std::fmt::Write;

/// Show how much of a dialogue is translated into each locale, and dubbed in each voice.
///
/// Counts clips that have text in at least one locale. A clip without a text of its own shows that of
/// another locale, or none. A folder is compiled in memory, with the same flags as for `lipz pack`.
#[derive(Args, Debug)]
#[command(override_usage = "lipz coverage [BANK] [OPTIONS]")]
#[command(after_help = "Examples:
  lipz coverage
  lipz coverage voices
  lipz coverage voices --missing de-de
  lipz coverage voices --voices --missing de-de
  lipz coverage dialogue.lipzbank --texts dialogue.*.lipztexts
  lipz coverage dialogue.lipzbank --min-coverage 95 --min-coverage de-de=100

Exit codes: 0 enough is translated, 1 less than the project requires, 2 the tool could not run, 130
interrupted.")]
pub(crate) struct CoverageArguments {
    #[command(flatten)]
    dialogue: Dialogue,

    /// List the keys of clips without a text in LOCALE
    #[arg(long, value_name = "LOCALE", conflicts_with = "json")]
    missing: Option<String>,

    /// Show how much is dubbed in each voice instead; with --missing, the keys of the lines that a voice does not have
    #[arg(long)]
    voices: bool,

    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Run for CoverageArguments {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let mut project = self.dialogue.project(reporter)?;
        // Here it is the question, not a condition for packing.
        let wanted: MinCoverage = std::mem::take(&mut project.settings.options.min_coverage);
        let file = self.dialogue.bank_of(&project, reporter)?;
        let bank = file.bank(reporter)?;
        if self.voices {
            return voices::run(&bank, &file.name, self.missing.as_deref(), reporter.wants_json(self.json), reporter);
        }
        let text_files = self.dialogue.text_files(reporter)?;
        let found = coverage(BankWithTexts::new(&bank, &text_files.verified(&bank, reporter)?));
        match &self.missing {
            Some(tag) => {
                let keys = missing(&found, tag, &file.name).map_err(|report| reporter.fail(report))?;
                reporter.print(&keys)?;
            }
            None if reporter.wants_json(self.json) => reporter.print_json(&found)?,
            None => reporter.print(&(table(&file.name, &found) + &voices::table(&voice_coverage(&bank))))?,
        };
        let shortfalls = shortfalls(&found, &wanted);
        if shortfalls.is_empty() {
            return Ok(Outcome::Clean);
        }
        reporter.add(vec![Report::all_about(file.name.as_str(), shortfalls)]);
        Ok(Outcome::Errors)
    }
}

/// The keys of the clips that have no text of their own in a locale, one a line.
fn missing(found: &[Coverage], tag: &str, bank: &str) -> Result<String, Report> {
    let coverage = choose(tag, bank, found.iter(), |coverage| &coverage.tag)?;
    let mut keys: Vec<&String> = coverage.fallbacks.values().flatten().chain(&coverage.missing).collect();
    keys.sort_unstable();
    Ok(keys.into_iter().flat_map(|key| [escape::text(key), "\n".into()]).collect())
}

fn table(name: &str, found: &[Coverage]) -> String {
    let Some(first) = found.first() else {
        return format!("{name}: no clip has a text; those of a split bank are in its text banks (--texts)\n");
    };
    let clips = console::counted(first.clip_count, "clip");
    let mut text = format!("{name}: {clips} with texts\n\n");
    let _ = writeln!(
        text,
        "  {:<12} {:>9} {:>7} {:>8} {:>9} {:>8}  falls back to",
        "locale", "covered", "texts", "same", "fallback", "nothing"
    );
    for coverage in found {
        let fallback_count: usize = coverage.fallbacks.values().map(Vec::len).sum();
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
            grouped(fallback_count),
            grouped(coverage.missing.len()),
            fallbacks.join(", ")
        );
        let _ = writeln!(text, "{}", line.trim_end());
    }
    text.push_str("\nsame: the text is that of the default locale, letter by letter\n");
    text
}
