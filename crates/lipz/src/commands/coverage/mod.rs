//! `lipz coverage`: how much of a dialogue is translated and dubbed, and what is left to do.

mod open;
mod table;
mod voice_documents;
mod voices;
mod work;

use crate::Ended;
use crate::Outcome;
use crate::commands::Run;
use crate::reporter::{Abort, Reporter};
use crate::shared::bank_or_sources::DialogueArguments;
use crate::shared::locales::choose;
use crate::shared::project_flags::{parse_locale, refuse_locales};
use clap::Args;
use lipz_compiler::{Coverage, MinCoverage, VoiceCoverage, Voices, coverage, shortfalls, voice_coverage_of};
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use lipz_texts::{LocaleWork, Progress, Work, page};
use std::collections::BTreeSet;
use voices::Look;

/// Show how much of a dialogue is translated into each locale and dubbed in each voice, and what is left to do.
///
/// Counts clips that have text in at least one locale. A clip without a text of its own shows that of
/// another locale, or none. A folder is compiled in memory, with the same flags as for `lipz pack`.
///
/// Of Lipz files, also the segments and words that are to be translated from the default locale: missing ones, and those
/// that are older than their source (docs/guides/localisation.md).
#[derive(Args, Debug)]
#[command(override_usage = "lipz coverage [BANK] [OPTIONS]")]
#[command(after_help = "Examples:
  lipz coverage
  lipz coverage voices --cost-per-word 0.12
  lipz coverage voices --html > coverage.html
  lipz coverage voices --missing de-de
  lipz coverage voices --missing de-de --stale de-de --csv > to-do.csv
  lipz coverage voices --voices --missing de-de
  lipz coverage dialogue.lipzbank --texts dialogue.*.lipztexts
  lipz coverage dialogue.lipzbank --min-coverage 95 --min-coverage de-de=100

Exit codes: 0 enough is translated, 1 less than the project requires, 2 the tool could not run, 130
interrupted.")]
pub(crate) struct CoverageArguments {
    #[command(flatten)]
    dialogue: DialogueArguments,

    /// List the keys of clips without a text in LOCALE, of Lipz files also those of which a segment is blank; also for a locale that
    /// nobody has begun
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale, conflicts_with = "html")]
    missing: Option<String>,

    /// List the keys of clips whose text in LOCALE is older than its source
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale, conflicts_with = "html")]
    stale: Option<String>,

    /// Show how much is dubbed in each voice instead; with --missing, the keys of the lines that a voice does not have
    #[arg(long, conflicts_with = "stale")]
    voices: bool,

    /// What the translation of a word costs: shows the cost of what is to be done
    #[arg(long, value_name = "PRICE", value_parser = parse_cost)]
    cost_per_word: Option<f64>,

    /// Print JSON: the locales, or the segments that --missing and --stale list, with their texts
    #[arg(long)]
    json: bool,

    /// Print CSV: a row for each locale, or for each segment that --missing and --stale list, with its text and words
    #[arg(long, conflicts_with_all = ["json", "html"])]
    csv: bool,

    /// Print a page for a browser: how far each locale is, and what is to be done
    #[arg(long, conflicts_with = "json")]
    html: bool,
}

impl Run for CoverageArguments {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let mut project = self.dialogue.project(reporter)?;
        if !self.dialogue.is_bank() {
            refuse_locales(
                self.missing.iter().chain(&self.stale).map(String::as_str),
                &project.settings.options,
                reporter,
            )?;
        }
        // Here it is the question, not a condition for packing.
        let wanted = project.settings.options.get_min_coverage().clone();
        project.settings.options = std::mem::take(&mut project.settings.options).min_coverage(MinCoverage::new());
        let file = self.dialogue.files_of(&project, reporter)?;
        let files = file.verified(reporter)?;
        let dialogue = file.dialogue(&files, reporter)?;
        // A bank without dubs does not know the voices that the project plans.
        let planned = if self.dialogue.is_bank() { Voices::default() } else { project.settings.voices() };
        let dubs = voice_coverage_of(&dialogue, &planned);
        if self.voices {
            let look = match reporter.wants_json(self.json) {
                true => Look::Json,
                false if self.csv => Look::Csv,
                false if self.html => Look::Html,
                false => Look::Table,
            };
            return voices::run(&dubs, &file.name, self.missing.as_deref(), look, reporter);
        }
        let found = coverage(&dialogue);
        let work = match self.dialogue.is_bank() {
            true => None,
            false => {
                let named = self.missing.iter().chain(&self.stale).chain(wanted.get_locales().keys());
                let named: Vec<String> = named.cloned().collect();
                work::of_project(&project, &named, self.dialogue.is_quiet(), reporter)?
            }
        };
        let needs_sources = self.html || self.stale.is_some() || self.cost_per_word.is_some();
        let is_table = self.csv || reporter.wants_json(self.json);
        if work.is_none() && (needs_sources || is_table && self.missing.is_some()) {
            self.list(&found, None, &file.name).map_err(|report| reporter.fail(report))?;
            let tip = "name the folder of Lipz files, in a project with `default-locale`";
            return Err(reporter.usage("what translations are made from is not known here", tip));
        }
        self.print(&file.name, &found, &dubs, work.as_ref(), reporter)?;
        let mut shortfalls = shortfalls(&found, &wanted);
        let has_texts = found.iter().any(|coverage| coverage.own_count > 0);
        if found.is_empty() && (is_table || self.html) {
            reporter.remark(&format!("{}\n", table::NO_TEXTS));
        }
        let is_wanted = !wanted.get_locales().is_empty() || wanted.get_all().is_some();
        if !has_texts && is_wanted && shortfalls.is_empty() {
            let diagnostic = Diagnostic::new(Code::LowCoverage, "no clip has a text, and a minimum is required");
            shortfalls.push(diagnostic.help("name the text banks of a split bank with --texts"));
        }
        if shortfalls.is_empty() {
            return Ok(Outcome::Clean);
        }
        reporter.add(vec![Report::all_about(file.name.as_str(), shortfalls)]);
        Ok(Outcome::Errors)
    }
}

impl CoverageArguments {
    fn print(
        &self,
        name: &str,
        found: &[Coverage],
        dubs: &[VoiceCoverage],
        work: Option<&Work>,
        reporter: &mut Reporter,
    ) -> Result<(), Abort> {
        if self.missing.is_some() || self.stale.is_some() {
            if let (Some(work), true) = (work, reporter.wants_json(self.json)) {
                let rows = self.named(work).flat_map(|locale| {
                    open::rows(locale, |progress| self.is_meant(locale, progress), self.cost_per_word)
                });
                let rows: Vec<_> = rows.collect();
                self.remark_if(rows.is_empty(), work, reporter);
                return reporter.print_json(&rows);
            }
            let list = self.list(found, work, name).map_err(|report| reporter.fail(report))?;
            // A table has its head in any case.
            let lines = list.iter().filter(|byte| **byte == b'\n').count();
            self.remark_if(lines <= usize::from(self.csv), work.unwrap_or(&Work::default()), reporter);
            return reporter.print_bytes(&list);
        }
        match work {
            Some(work) if self.html => reporter.print(&page(work, name, self.cost_per_word)),
            work if reporter.wants_json(self.json) => {
                reporter.print_json(&table::document(found, work, self.cost_per_word))
            }
            work if self.csv => reporter.print(&table::csv(found, work, self.cost_per_word)),
            work => {
                let of_work = work.map(|work| table::of_work(work, self.cost_per_word)).unwrap_or_default();
                reporter.print(&(table::of_bank(name, found) + &of_work + &voices::table(dubs)))
            }
        }
    }

    /// Says why nothing is listed, if nothing is.
    fn remark_if(&self, is_empty: bool, work: &Work, reporter: &Reporter) {
        if !is_empty {
            return;
        }
        let mut asked = self.missing.iter().chain(&self.stale);
        if let Some(source) = asked.find(|locale| **locale == work.source_locale) {
            let source = escape::text(source);
            reporter
                .remark(&format!("nothing is translated into {source}: the texts of the others are made from it\n"));
            return;
        }
        reporter.remark(match (&self.missing, &self.stale) {
            (Some(_), None) => "no text is missing\n",
            (None, _) => "no text is known to be older than its source\n",
            _ => "no text is missing, and none is known to be older than its source\n",
        });
    }

    /// Whether --missing or --stale asks for segments of a locale that are so far.
    fn is_meant(&self, locale: &LocaleWork, progress: Progress) -> bool {
        match progress {
            Progress::Missing => self.missing.as_ref() == Some(&locale.locale),
            Progress::Stale => self.stale.as_ref() == Some(&locale.locale),
            _ => false,
        }
    }

    /// The locales that they name.
    fn named<'w>(&self, work: &'w Work) -> impl Iterator<Item = &'w LocaleWork> {
        let named = [self.missing.clone(), self.stale.clone()];
        work.locales.iter().filter(move |locale| named.contains(&Some(locale.locale.clone())))
    }

    /// What is missing, stale, or both: the keys, one a line, or a table of segments.
    fn list(&self, found: &[Coverage], work: Option<&Work>, bank: &str) -> Result<Vec<u8>, Report> {
        let named = work.into_iter().flat_map(|work| self.named(work));
        if self.csv && work.is_some() {
            let tables = named.enumerate().map(|(number, locale)| {
                let table = locale.csv(|progress| self.is_meant(locale, progress), self.cost_per_word);
                // One head for both.
                let head =
                    if number == 0 { 0 } else { table.iter().position(|byte| *byte == b'\n').map_or(0, |at| at + 1) };
                table.get(head..).unwrap_or_default().to_vec()
            });
            return Ok(tables.flatten().collect());
        }
        let mut keys: BTreeSet<&str> = BTreeSet::new();
        for locale in named {
            let open = locale.open.iter().filter(|open| self.is_meant(locale, open.progress()));
            keys.extend(open.map(|open| open.key.as_str()));
        }
        let known = |tag: &String| found.iter().any(|coverage| coverage.tag == *tag);
        if let Some(tag) = self.missing.as_ref().filter(|tag| work.is_none() || known(tag)) {
            let coverage = choose(tag, bank, found.iter(), |coverage| &coverage.tag)?;
            keys.extend(coverage.fallbacks.values().flatten().chain(&coverage.missing).map(String::as_str));
        }
        Ok(keys.into_iter().flat_map(|key| [escape::text(key), "\n".into()]).collect::<String>().into_bytes())
    }
}

fn parse_cost(text: &str) -> Result<f64, String> {
    let cost: Option<f64> = text.parse().ok().filter(|cost: &f64| cost.is_finite() && *cost >= 0.0);
    cost.ok_or_else(|| "a price is a number, as in 0.12".to_owned())
}
