//! `lipz coverage`: the translated and dubbed shares of a dialogue, and the remaining work.

mod open;
mod table;
mod voice_documents;
mod voices;
mod work;

use crate::CommandResult;
use crate::Outcome;
use crate::commands::Run;
use crate::reporter::{Abort, Reporter};
use crate::shared::bank_or_sources::DialogueArguments;
use crate::shared::locales::choose;
use crate::shared::values::{parse_locale, refuse_locales};
use clap::{ArgAction, Args, ValueEnum};
use lipz_compiler::{
    Coverage, LocaleError, MinCoverage, Options, VoiceCoverage, Voices, coverage, shortfalls, voice_coverage_of,
};
use lipz_diagnostics::{Code, Diagnostic, Report, escape};
use lipz_texts::{LocaleWork, Progress, Work, page};
use std::collections::BTreeSet;
use voices::Look;

/// Show the progress of translation and dubbing, and the remaining work.
///
/// Counts clips with text in at least one locale. A clip without its own text shows that of a different locale, or no
/// text. If you name Lipz files, lipz also counts the segments and words to translate from the default locale
/// (docs/guides/localisation.md).
#[derive(Args, Debug)]
#[command(override_usage = "lipz coverage [BANK] [OPTIONS]")]
#[command(after_help = "Examples:
  lipz coverage
  lipz coverage voices --cost-per-word 0.12
  lipz coverage voices --as html > coverage.html
  lipz coverage voices --show missing --locale de-de
  lipz coverage voices --show missing,stale --locale de-de --as csv > to-do.csv
  lipz coverage dialogue.lipzbank --min-coverage 95 --min-coverage de-de=100

Exit codes: 0 sufficient coverage, 1 coverage below the minimum or errors in the input, 2 the tool could not run, 130 interrupted.")]
pub(crate) struct CoverageArguments {
    #[command(flatten)]
    dialogue: DialogueArguments,

    /// List clips to translate, or show the voices: missing, stale, voices
    ///
    /// `missing` lists the clips without a text in --locale, and those of Lipz files with a blank segment. `stale` lists the
    /// clips whose text is older than its source. `voices` shows the dubbed share of each voice. With `missing`, it lists the
    /// missing lines of the voice that --locale names.
    #[arg(long, value_enum, value_name = "WHAT", value_delimiter = ',', hide_possible_values = true)]
    show: Vec<CoverageView>,

    /// Locale of the listed clips; may be a locale without texts
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale, requires = "show")]
    locale: Option<String>,

    /// Price per translated word, to show the cost of the remaining work
    #[arg(long, value_name = "PRICE", allow_negative_numbers = true, value_parser = parse_cost)]
    cost_per_word: Option<f64>,

    /// Minimum percentage of clips with text in each locale, or in one: 90, de-de=100
    #[arg(long, value_name = "[LOCALE=]PERCENT", value_parser = parse_min_coverage, action = ArgAction::Append)]
    min_coverage: Vec<(Option<String>, f64)>,

    /// Format of the result: a CSV table, or a page for browsers
    #[arg(long = "as", value_enum, value_name = "FORMAT")]
    format: Option<ResultFormat>,
}

/// The parts of the dialogue that are shown.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
enum CoverageView {
    Missing,
    Stale,
    Voices,
}

/// The format of the result.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
enum ResultFormat {
    Csv,
    Html,
}

/// The requested output.
struct Query<'a> {
    /// The locale whose missing texts are listed.
    missing: Option<&'a String>,
    /// The locale whose stale texts are listed.
    stale: Option<&'a String>,
    csv: bool,
    html: bool,
    cost_per_word: Option<f64>,
}

impl Run for CoverageArguments {
    fn prints_result(&self) -> bool {
        true
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let query = self.query(reporter)?;
        let mut project = self.dialogue.project(reporter)?;
        if !self.dialogue.is_bank() {
            refuse_locales(self.locale.iter().map(String::as_str), &project.settings.options, reporter)?;
        }
        // Here, low coverage is a result, not an error as in packing.
        let wanted = self.wanted(&project.settings.options).map_err(|error| reporter.fail(error.to_report()))?;
        project.settings.options = std::mem::take(&mut project.settings.options).min_coverage(MinCoverage::new());
        let file = self.dialogue.files_of(&project, reporter)?;
        let files = file.verified(reporter)?;
        let dialogue = file.dialogue(&files, reporter)?;
        // A bank without dubs does not contain the voices that the project plans.
        let planned = if self.dialogue.is_bank() { Voices::default() } else { project.settings.voices() };
        let dubs = voice_coverage_of(&dialogue, &planned);
        if self.show.contains(&CoverageView::Voices) {
            let look = match self.format {
                _ if reporter.wants_json() => Look::Json,
                Some(ResultFormat::Csv) => Look::Csv,
                Some(ResultFormat::Html) => Look::Html,
                None => Look::Table,
            };
            return voices::run(&dubs, &file.name, query.missing.map(String::as_str), look, reporter);
        }
        let found = coverage(&dialogue);
        let work = match self.dialogue.is_bank() {
            true => None,
            false => {
                let named = query.missing.into_iter().chain(query.stale).chain(wanted.get_locales().keys());
                let named: Vec<String> = named.cloned().collect();
                work::of_project(&project, &named, self.dialogue.is_quiet(), reporter)?
            }
        };
        let needs_sources = query.html || query.stale.is_some() || query.cost_per_word.is_some();
        let is_table = query.csv || reporter.wants_json();
        if work.is_none() && (needs_sources || is_table && query.missing.is_some()) {
            query.list(&found, None, &file.name).map_err(|report| reporter.fail(report))?;
            let tip = "name Lipz files of a project that sets `default-locale`";
            return Err(reporter.usage("the source texts of the translations are missing", tip));
        }
        query.print(&file.name, &found, &dubs, work.as_ref(), reporter)?;
        let mut shortfalls = shortfalls(&found, &wanted);
        let has_texts = found.iter().any(|coverage| coverage.own_count > 0);
        if found.is_empty() && (is_table || query.html) {
            reporter.remark(&format!("{}\n", table::NO_TEXTS));
        }
        let is_wanted = !wanted.get_locales().is_empty() || wanted.get_all().is_some();
        if !has_texts && is_wanted && shortfalls.is_empty() {
            let diagnostic = Diagnostic::new(Code::LowCoverage, "no clip has a text, but a minimum is required");
            shortfalls.push(diagnostic.help("name the text banks of a split bank: BANK+TEXTS"));
        }
        if shortfalls.is_empty() {
            return Ok(Outcome::Clean);
        }
        reporter.add(vec![Report::all_about(file.name.as_str(), shortfalls)]);
        Ok(Outcome::Errors)
    }
}

impl CoverageArguments {
    /// Returns the query. Refuses contradicting options.
    fn query(&self, reporter: &mut Reporter) -> Result<Query<'_>, Abort> {
        let shows = |shown: CoverageView| self.show.contains(&shown);
        let lists = shows(CoverageView::Missing) || shows(CoverageView::Stale);
        if lists && self.locale.is_none() {
            return Err(
                reporter.usage("the locale of the listed clips is not set", "name it with `--locale`, as in de-de")
            );
        }
        if shows(CoverageView::Voices) && shows(CoverageView::Stale) {
            let tip = "list stale texts in a separate run";
            return Err(reporter.usage("`--show` cannot combine `voices` and `stale`", tip));
        }
        if self.locale.is_some() && !lists {
            let tip = "list clips with `--show missing` or `--show stale`";
            return Err(reporter.usage("`--locale` has no effect without a list of clips", tip));
        }
        let html = self.format == Some(ResultFormat::Html);
        if html && lists {
            return Err(reporter.usage("`--as html` always shows all locales", "leave out `--show`, or use `--as csv`"));
        }
        if self.format.is_some() && reporter.wants_json() {
            let tip = "leave out one of them";
            return Err(reporter.usage("`--as` and `--output-format json` cannot be combined", tip));
        }
        Ok(Query {
            missing: self.locale.as_ref().filter(|_| shows(CoverageView::Missing)),
            stale: self.locale.as_ref().filter(|_| shows(CoverageView::Stale)),
            csv: self.format == Some(ResultFormat::Csv),
            html,
            cost_per_word: self.cost_per_word,
        })
    }

    /// Returns the minimum from the project or the command line.
    fn wanted(&self, options: &Options) -> Result<MinCoverage, LocaleError> {
        let mut wanted = options.get_min_coverage().clone();
        for (locale, percent) in &self.min_coverage {
            wanted = match locale {
                None => wanted.all(*percent),
                Some(locale) => wanted.locale(locale, *percent)?,
            };
        }
        Ok(wanted)
    }
}

impl Query<'_> {
    fn print(
        &self,
        name: &str,
        found: &[Coverage],
        dubs: &[VoiceCoverage],
        work: Option<&Work>,
        reporter: &mut Reporter,
    ) -> Result<(), Abort> {
        if self.missing.is_some() || self.stale.is_some() {
            if let (Some(work), true) = (work, reporter.wants_json()) {
                let rows = self.named(work).flat_map(|locale| {
                    open::rows(locale, |progress| self.is_meant(locale, progress), self.cost_per_word)
                });
                let rows: Vec<_> = rows.collect();
                self.remark_if(rows.is_empty(), work, reporter);
                return reporter.print_json(&rows);
            }
            let list = self.list(found, work, name).map_err(|report| reporter.fail(report))?;
            // A table always has a header.
            let lines = list.iter().filter(|byte| **byte == b'\n').count();
            self.remark_if(lines <= usize::from(self.csv), work.unwrap_or(&Work::default()), reporter);
            return reporter.print_bytes(&list);
        }
        match work {
            Some(work) if self.html => reporter.print(&page(work, name, self.cost_per_word)),
            work if reporter.wants_json() => reporter.print_json(&table::document(found, work, self.cost_per_word)),
            work if self.csv => reporter.print(&table::csv(found, work, self.cost_per_word)),
            work => {
                let of_work = work.map(|work| table::of_work(work, self.cost_per_word)).unwrap_or_default();
                reporter.print(&(table::of_bank(name, found) + &of_work + &voices::table(dubs)))
            }
        }
    }

    /// Explains an empty list.
    fn remark_if(&self, is_empty: bool, work: &Work, reporter: &Reporter) {
        if !is_empty {
            return;
        }
        let mut asked = self.missing.into_iter().chain(self.stale);
        if let Some(source) = asked.find(|locale| **locale == work.source_locale) {
            let source = escape::text(source);
            reporter.remark(&format!("{source} is the source locale of the translations\n"));
            return;
        }
        reporter.remark(match (self.missing, self.stale) {
            (Some(_), None) => "no text is missing\n",
            (None, _) => "no text is stale\n",
            _ => "no text is missing or stale\n",
        });
    }

    /// Whether the query includes segments of this locale and progress.
    fn is_meant(&self, locale: &LocaleWork, progress: Progress) -> bool {
        match progress {
            Progress::Missing => self.missing == Some(&locale.locale),
            Progress::Stale => self.stale == Some(&locale.locale),
            _ => false,
        }
    }

    /// Returns the locales that the query names.
    fn named<'w>(&self, work: &'w Work) -> impl Iterator<Item = &'w LocaleWork> {
        let named = [self.missing, self.stale];
        work.locales.iter().filter(move |locale| named.contains(&Some(&locale.locale)))
    }

    /// Returns the missing or stale content, or both: keys, one per line, or a table of segments.
    fn list(&self, found: &[Coverage], work: Option<&Work>, bank: &str) -> Result<Vec<u8>, Report> {
        let named = work.into_iter().flat_map(|work| self.named(work));
        if self.csv && work.is_some() {
            let tables = named.enumerate().map(|(number, locale)| {
                let table = locale.csv(|progress| self.is_meant(locale, progress), self.cost_per_word);
                // Both share one header.
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
        if let Some(tag) = self.missing.filter(|tag| work.is_none() || known(tag)) {
            let coverage = choose(tag, bank, found.iter(), |coverage| &coverage.tag)?;
            keys.extend(coverage.fallbacks.values().flatten().chain(&coverage.missing).map(String::as_str));
        }
        Ok(keys.into_iter().flat_map(|key| [escape::text(key), "\n".into()]).collect::<String>().into_bytes())
    }
}

fn parse_min_coverage(text: &str) -> Result<(Option<String>, f64), String> {
    let (locale, percent) = match text.split_once('=') {
        Some((locale, percent)) => (Some(parse_locale(locale)?), percent),
        None => (None, text),
    };
    match percent.parse::<f64>() {
        Ok(percent) if (0.0..=100.0).contains(&percent) => Ok((locale, percent)),
        _ => Err("expected a percentage from 0 to 100, such as 90 or de-de=90".into()),
    }
}

/// The highest price of a word, far above real ones in any currency. With it, the cost of all words is a finite number.
const HIGHEST_COST: f64 = 1e9;

fn parse_cost(text: &str) -> Result<f64, String> {
    let cost: Option<f64> = text.parse().ok().filter(|cost| (0.0..=HIGHEST_COST).contains(cost));
    // A price of -0 is 0.
    cost.map(f64::abs).ok_or_else(|| "expected a price from 0 to 1,000,000,000, such as 0.12".to_owned())
}
