//! `lipz accept`: translations that still say what the source says, and recordings that say the texts of today.

mod recordings;

use crate::commands::Run;
use crate::commands::texts::{locales_of, source_locale};
use crate::reporter::{Abort, Ended, Reporter};
use crate::shared::inputs::find_all;
use crate::shared::project_flags::{hide_of_banks, parse_locale};
use crate::shared::sources::Sources;
use crate::shared::text_record::RecordFile;
use crate::{Outcome, console};
use clap::Args;
use glob::Pattern;
use lipz_compiler::{Compiler, Input, Options};
use lipz_diagnostics::escape;
use lipz_texts::{Standing, State, TextRecord, Texts, texts_of};
use std::fmt::Write;

/// Note that translations say what their source says today, after a look at them, and recordings what their texts say.
///
/// lipz-texts.txt, beside lipz.toml, knows the source text that each translation was made from. When the source
/// changes, `lipz check` reports the translations that are older. What is accepted here counts as made from the
/// text of today, also translations of which nothing was known before. If lipz.toml names the folder of the
/// recordings, lipz-sync.txt knows in the same way which text each of them was made for.
#[derive(Args, Debug)]
#[command(mut_args(hide_of_banks))]
#[command(after_help = "Examples:
  lipz accept voices/act1/mayor.lipz
  lipz accept voices/act1/mayor.lipz --locale de-de
  lipz accept --key 'act1/*' --locale de-de
  lipz accept --all
  lipz accept --all --check

Exit codes: 0 done, 1 --check has found something that is not accepted, 2 the tool could not run, 130 interrupted.")]
pub(crate) struct Accept {
    #[command(flatten)]
    sources: Sources,

    /// Accept the clips with these keys: `act1/*`; may be given several times
    #[arg(long, value_name = "PATTERN", value_parser = Pattern::new)]
    key: Vec<Pattern>,

    /// Accept translations into this locale only, and its dubs; may be given several times
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale)]
    locale: Vec<String>,

    /// The locale that was translated [default: `default-locale` of lipz.toml]
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale)]
    from: Option<String>,

    /// Accept all translations and recordings of the project, and forget the translations of Lipz files that are no more
    #[arg(long)]
    all: bool,

    /// Say what would be accepted, and write nothing; exit code 1 if that is something
    #[arg(long)]
    check: bool,
}

/// A clip that has something to accept.
struct Clip {
    key: String,
    /// What the record calls its file.
    file: String,
    sources: Vec<String>,
    translations: Vec<Translation>,
}

struct Translation {
    locale: String,
    texts: Vec<String>,
    standings: Vec<Standing>,
}

/// How many segments are accepted.
#[derive(Default)]
struct Counts {
    stale: usize,
    unknown: usize,
}

impl Run for Accept {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        if self.sources.paths().is_empty() && self.key.is_empty() && !self.all {
            let tip = "name Lipz files or folders, keys with `--key`, or all with `--all`";
            return Err(reporter.usage("nothing is named to be accepted", tip));
        }
        if self.all && !(self.sources.paths().is_empty() && self.key.is_empty()) {
            let tip = "leave out `--all`, or the files, folders and keys";
            return Err(reporter.usage("`--all` accepts the whole project, and some of it is named", tip));
        }
        let project = self.sources.project(reporter)?;
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
        let mut counts = Counts::default();
        for (old, new) in &file.renamed {
            let _ = writeln!(said, "{} is {} now", escape::text(old), escape::text(new));
        }
        for clip in &clips {
            clip.accept(&source_locale, &mut file.record, &mut counts, &mut said);
        }
        recordings.accept(&mut said);
        let forgotten = if self.all && self.sources.paths().is_empty() { file.lost.clone() } else { Vec::new() };
        for lost in &forgotten {
            file.record.forget(lost);
            let _ = writeln!(said, "{} is no more", escape::text(lost));
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
            said += &recordings.summary();
            said += &if is_written && is_new { file.introduction() } else { String::new() };
            reporter.summary(&said)?;
        }
        Ok(outcome)
    }
}

impl Accept {
    /// Refuses keys and locales that the project does not have: a slip of the hand would accept nothing, and say that all is
    /// well.
    fn refuse_unknown(
        &self,
        inputs: &[Input],
        options: &Options,
        source_locale: &str,
        reporter: &mut Reporter,
    ) -> Result<(), Abort> {
        let is_there = |key: &&Pattern| inputs.iter().any(|input| key.matches(&input.key));
        if let Some(key) = self.key.iter().find(|key| !is_there(key)) {
            let message = format!("no clip has a key like {}", escape::quoted(key.as_str()));
            return Err(reporter.usage(message, "keys are paths of Lipz files without `.lipz`: act1/mayor"));
        }
        let known = if self.locale.is_empty() { Vec::new() } else { locales_of(inputs, options, source_locale) };
        if let Some(locale) = self.locale.iter().find(|locale| !known.contains(locale)) {
            let message = format!("no clip has a text in {}", escape::quoted(locale));
            let tip = match known.is_empty() {
                true => "there are no translations".to_owned(),
                false => format!("there are translations into {}", known.join(", ")),
            };
            return Err(reporter.usage(message, &tip));
        }
        Ok(())
    }

    /// Whether the clip with this key is one of those that are named.
    fn is_meant(&self, key: &str) -> bool {
        self.key.is_empty() || self.key.iter().any(|pattern| pattern.matches(key))
    }

    /// The clips that have something to accept, in the order of the inputs.
    fn clips(
        &self,
        options: &Options,
        source_locale: &str,
        inputs: &[Input],
        file: &RecordFile,
    ) -> (Vec<Clip>, Vec<lipz_diagnostics::Report>) {
        let inputs: Vec<Input> = inputs.iter().filter(|input| self.is_meant(&input.key)).cloned().collect();
        let bar = console::progress_bar(inputs.len(), self.sources.is_quiet());
        let compiler = Compiler::new(options.clone()).progress(|count| bar.inc(count));
        let results = compiler.each_file(&inputs, |input, bytes| {
            let parsed = lipz_file::parse(bytes);
            let Some(document) = parsed.document else {
                return Err(lipz_diagnostics::Report::from_bytes(input.name(), bytes, parsed.diagnostics));
            };
            let texts = texts_of(&document, options.get_default_locale());
            Ok(self.clip(input, file, source_locale, texts))
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

    fn clip(&self, input: &Input, file: &RecordFile, source_locale: &str, mut texts: Texts) -> Option<Clip> {
        let sources = texts.remove(source_locale)?;
        let name = file.name(input);
        let is_wanted = |locale: &String| self.locale.is_empty() || self.locale.contains(locale);
        let translations =
            texts.into_iter().filter(|(locale, texts)| is_wanted(locale) && texts.len() == sources.len());
        let translations = translations.map(|(locale, texts)| {
            let standings = file.record.standings(&name, source_locale, &locale, &sources, &texts);
            Translation { locale, texts, standings }
        });
        let translations: Vec<Translation> = translations.filter(|one| one.open(&sources).next().is_some()).collect();
        (!translations.is_empty()).then(|| Clip { key: input.key.clone(), file: name, sources, translations })
    }
}

impl Translation {
    /// The segments that nobody has accepted, from 0.
    fn open<'t>(&'t self, sources: &'t [String]) -> impl Iterator<Item = (usize, &'t Standing)> {
        self.standings.iter().enumerate().filter(|(at, standing)| {
            let has = |texts: &[String]| texts.get(*at).is_some_and(|text| !text.is_empty());
            !matches!(standing, Standing::Current(_)) && has(&self.texts) && has(sources)
        })
    }
}

impl Clip {
    fn accept(&self, source_locale: &str, record: &mut TextRecord, counts: &mut Counts, said: &mut String) {
        for translation in &self.translations {
            let mut accepted = vec![None; self.sources.len()];
            for (at, standing) in translation.open(&self.sources) {
                if let Some(slot) = accepted.get_mut(at) {
                    *slot = Some(State::Translated);
                }
                let Standing::Stale { made_from, .. } = standing else {
                    counts.unknown += 1;
                    continue;
                };
                counts.stale += 1;
                let text = |texts: &[String]| escape::quoted(texts.get(at).map_or("", String::as_str)).to_string();
                let _ = writeln!(
                    said,
                    "{} {}: {} for {}, before for {}",
                    escape::text(&self.key),
                    translation.locale,
                    text(&translation.texts),
                    text(&self.sources),
                    escape::quoted(made_from)
                );
            }
            record.accept(&self.file, source_locale, &translation.locale, &self.sources, &translation.texts, &accepted);
        }
    }
}

impl Counts {
    fn summary(&self, is_check: bool) -> String {
        let texts = |count: usize| console::counted(count, "text");
        let head = if is_check { "to be accepted" } else { "accepted" };
        format!(
            "{head}: {} with another source before, {} of which nothing was known\n",
            texts(self.stale),
            texts(self.unknown)
        )
    }
}
