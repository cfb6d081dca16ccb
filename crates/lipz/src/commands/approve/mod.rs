//! `lipz approve`: marks translations and recordings as up to date with their source text.

mod recordings;

use crate::commands::Run;
use crate::reporter::{Abort, CommandResult, Reporter};
use crate::shared::inputs::find_all;
use crate::shared::sources::Sources;
use crate::shared::stdin_file::StdinFile;
use crate::shared::text_record::RecordFile;
use crate::shared::translations::{locales_of, source_locale};
use crate::shared::values::parse_locale;
use crate::{Outcome, console};
use clap::Args;
use lipz_compiler::{Compiler, Input, Options};
use lipz_diagnostics::escape;
use lipz_file::locale::split_variant;
use lipz_texts::{ClipSources, ClipTexts, Standing, State, TextRecord, texts_of};
use std::fmt::Write;

/// Mark translations and recordings as up to date with their source text.
///
/// lipz-texts.txt, next to lipz.toml, records the source text of each translation. When the source changes, `lipz check`
/// reports the translation as stale. Approve it if it is still correct, so that lipz records the current source text.
/// lipz-sync.txt does the same for the text of each recording, if lipz.toml names their folder.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz approve voices/act1/mayor.lipz
  lipz approve voices/act1/mayor.lipz --locale de-de
  lipz approve 'voices/act1/*' --locale de-de
  lipz approve --all
  lipz approve --all --check

Exit codes: 0 done, 1 --check found missing approvals, 2 the tool could not run, 130 interrupted.")]
pub(crate) struct Approve {
    #[command(flatten)]
    sources: Sources,

    #[command(flatten)]
    stdin: StdinFile,

    /// Approve only translations into these locales, and their dubs
    #[arg(long, value_name = "LOCALE", value_delimiter = ',', value_parser = parse_locale)]
    locale: Vec<String>,

    /// Source locale [default: `default-locale` of lipz.toml]
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale)]
    from: Option<String>,

    /// Approve the whole project, and remove the records of deleted Lipz files
    #[arg(long, conflicts_with = "sources")]
    all: bool,

    /// List the missing approvals, and write nothing; exit code 1 if any
    #[arg(long)]
    check: bool,
}

/// A clip with segments to approve.
struct ClipApproval {
    key: String,
    /// The name of its file in the record.
    file: String,
    translations: Vec<Translation>,
}

/// The texts of a clip in one locale, or those of a variant.
struct Translation {
    /// The locale of the source texts, with the key of the variant.
    source_locale: String,
    sources: Vec<String>,
    locale: String,
    texts: Vec<String>,
    standings: Vec<Standing>,
    /// By segment: whether the record has this translation of this source text.
    is_recorded: Vec<bool>,
}

/// Numbers of approved segments.
#[derive(Default)]
struct SegmentCounts {
    stale: usize,
    unknown: usize,
}

impl Run for Approve {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        if self.sources.paths().is_empty() && !self.all {
            let tip = "name Lipz files, folders or patterns, or the whole project with `--all`";
            return Err(reporter.usage("no clips are named", tip));
        }
        self.stdin.apply(self.sources.paths(), reporter)?;
        let mut project = self.sources.project(reporter)?;
        project.keep_keys();
        let options = &project.settings.options;
        let source_locale = source_locale(self.from.as_ref(), options, reporter)?;
        let (inputs, mut reports) = find_all(&project.settings, reporter)?;
        let (mut file, odd_lines) = RecordFile::open(&project, &inputs).map_err(|report| reporter.fail(report))?;
        reports.extend(odd_lines);
        self.refuse_unknown(&inputs, options, &source_locale, reporter)?;
        let (clips, unread) = self.clips(options, &source_locale, &inputs, &file);
        reports.extend(unread);
        let mut recordings = recordings::find(self, &project, &inputs).map_err(|report| reporter.fail(report))?;
        reports.append(&mut recordings.reports);
        let mut said = String::new();
        let mut counts = SegmentCounts::default();
        for (old, new) in &file.renamed {
            let _ = writeln!(said, "renamed: {} -> {}", escape::text(old), escape::text(new));
        }
        for clip in &clips {
            clip.approve(&mut file.record, &mut counts, &mut said);
        }
        recordings.approve(&mut said);
        let forgotten = if self.all { file.lost.clone() } else { Vec::new() };
        for lost in &forgotten {
            file.record.forget(lost);
            let _ = writeln!(said, "deleted: {}", escape::text(lost));
        }
        let is_new = !file.exists();
        let write = || recordings.write().and_then(|()| file.write());
        let is_written = !self.check && write().map_err(|report| reporter.fail(report))?;
        let has_some = counts.stale + counts.unknown + recordings.count() + file.renamed.len() + forgotten.len() > 0;
        let mut outcome = Outcome::from_reports(&reports);
        if self.check && has_some {
            outcome = outcome.max(Outcome::Errors);
        }
        reporter.add(reports);
        if !self.sources.is_quiet() {
            said += &counts.summary(self.check);
            said += &recordings.summary(self.check);
            said += &if is_written && is_new { file.introduction() } else { String::new() };
            reporter.summary(&said)?;
        }
        Ok(outcome)
    }
}

impl Approve {
    /// Refuses locales that no clip has a text in. After a typing error, the command would otherwise approve nothing and
    /// still report success.
    fn refuse_unknown(
        &self,
        inputs: &[Input],
        options: &Options,
        source_locale: &str,
        reporter: &mut Reporter,
    ) -> Result<(), Abort> {
        let known = if self.locale.is_empty() { Vec::new() } else { locales_of(inputs, options, source_locale) };
        if let Some(locale) = self.locale.iter().find(|locale| !known.contains(locale)) {
            let message = format!("no clip has a text in {}", escape::quoted(locale));
            let tip = match known.is_empty() {
                true => "the project does not contain translations".to_owned(),
                false => format!("choose one of these locales: {}", known.join(", ")),
            };
            return Err(reporter.usage(message, &tip));
        }
        Ok(())
    }

    /// Returns the clips with something to approve, in the order of the inputs.
    fn clips(
        &self,
        options: &Options,
        source_locale: &str,
        inputs: &[Input],
        file: &RecordFile,
    ) -> (Vec<ClipApproval>, Vec<lipz_diagnostics::Report>) {
        let bar = console::progress_bar(inputs.len(), self.sources.is_quiet());
        let compiler = Compiler::new(options.clone()).progress(|count| bar.inc(count));
        let results = compiler.each_file(inputs, |input, bytes| {
            let parsed = lipz_file::parse(bytes);
            let Some(document) = parsed.document else {
                return Err(lipz_diagnostics::Report::from_bytes(input.name(), bytes, parsed.diagnostics));
            };
            let texts = texts_of(&document, options.get_default_locale());
            Ok(self.clip(input, file, source_locale, &texts))
        });
        bar.finish_and_clear();
        let (mut clips, mut reports) = (Vec::new(), Vec::new());
        for result in results {
            match result.and_then(|result| result) {
                Ok(clip) => clips.extend(clip),
                Err(report) => reports.push(report),
            }
        }
        (clips, reports)
    }

    fn clip(&self, input: &Input, file: &RecordFile, source_locale: &str, clip: &ClipTexts) -> Option<ClipApproval> {
        let name = file.name(input);
        let is_wanted = |tag: &str| match split_variant(tag).0 {
            locale if locale == source_locale => false,
            locale => self.locale.is_empty() || self.locale.iter().any(|wanted| wanted == locale),
        };
        let all_sources = ClipSources::new(clip, source_locale)?;
        let translations = clip.iter().filter(|(tag, _)| is_wanted(tag)).filter_map(|(locale, texts)| {
            let from = Some(all_sources.of(locale)).filter(|from| from.texts.len() == texts.len())?;
            let (source_locale, sources) = (from.locale.into_owned(), from.texts.into_owned());
            let standings = file.record.standings(&name, &source_locale, locale, &sources, texts);
            // Without the pair of texts in the record, a later merge could combine this translation with another source.
            let is_recorded = match self.check {
                true => vec![true; sources.len()],
                false => file.record.recorded(&name, &source_locale, locale, &sources, texts),
            };
            let (locale, texts) = (locale.clone(), texts.clone());
            Some(Translation { source_locale, sources, locale, texts, standings, is_recorded })
        });
        let translations: Vec<Translation> = translations.filter(|one| one.open().next().is_some()).collect();
        (!translations.is_empty()).then(|| ClipApproval { key: input.key.clone(), file: name, translations })
    }
}

impl Translation {
    /// Returns the segments that are not yet approved, with their numbers from 0.
    fn open(&self) -> impl Iterator<Item = (usize, &Standing)> {
        self.standings.iter().enumerate().filter(|(at, standing)| {
            let has = |texts: &[String]| texts.get(*at).is_some_and(|text| !text.is_empty());
            let is_recorded = self.is_recorded.get(*at).copied().unwrap_or_default();
            let is_approved = matches!(standing, Standing::Current(state) if *state > State::Initial) && is_recorded;
            !is_approved && has(&self.texts) && has(&self.sources)
        })
    }
}

impl ClipApproval {
    fn approve(&self, record: &mut TextRecord, counts: &mut SegmentCounts, said: &mut String) {
        for translation in &self.translations {
            let mut approved = vec![None; translation.sources.len()];
            for (at, standing) in translation.open() {
                if let Some(slot) = approved.get_mut(at) {
                    *slot = Some(State::Translated);
                }
                let reason = |now: &str| match standing {
                    Standing::Stale { made_from, .. } => {
                        Some(format!("source was {}, is now {now}", escape::quoted(made_from)))
                    }
                    Standing::Current(State::Initial) => Some("it was marked for review".to_owned()),
                    Standing::Current(_) | Standing::Unknown => None,
                };
                let text = |texts: &[String]| escape::quoted(texts.get(at).map_or("", String::as_str)).to_string();
                let Some(reason) = reason(&text(&translation.sources)) else {
                    counts.unknown += 1;
                    continue;
                };
                counts.stale += 1;
                let (key, now) = (escape::text(&self.key), text(&translation.texts));
                let _ = writeln!(said, "{key} {}: {now} ({reason})", translation.locale);
            }
            record.approve(
                &self.file,
                &translation.source_locale,
                &translation.locale,
                &translation.sources,
                &translation.texts,
                &approved,
            );
        }
    }
}

impl SegmentCounts {
    fn summary(&self, is_check: bool) -> String {
        format!(
            "{}: {}, {} without a recorded source text\n",
            head(is_check),
            console::counted(self.stale, "stale text"),
            console::counted(self.unknown, "text")
        )
    }
}

/// Returns the start of a summary line.
fn head(is_check: bool) -> &'static str {
    if is_check { "to approve" } else { "approved" }
}
