//! `lipz import texts`: imports translations into clips.

mod new_problems;
mod translations;

use crate::commands::Run;
use crate::commands::import::incoming_texts::IncomingTexts;
use crate::console;
use crate::interrupt::Files;
use crate::reporter::{CommandResult, Reporter};
use crate::shared::inputs::find_all;
use crate::shared::lint_flags::LintFlags;
use crate::shared::run_flags::QuietFlag;
use crate::shared::settings_file::{Project, SettingsFile};
use crate::shared::stdin_file::StdinFile;
use crate::shared::text_record::RecordFile;
use crate::shared::translations::{locales_of, source_locale, texts_of_clips};
use crate::shared::values::{parse_locale, refuse_locales};
use clap::{Args, ValueEnum};
use lipz_compiler::{Compiler, Content, Input};
use lipz_diagnostics::{Code, Diagnostic, Report, Span, reports as all_reports};
use lipz_texts::{
    ConfirmedTranslations, Counts, Merge, ReadOptions, TextTranslations, TranslatorComments, follow_renamed_clips,
    resolve_keys, unknown_keys,
};
use new_problems::new_problems;
use std::collections::{BTreeMap, BTreeSet, HashSet};
use std::path::PathBuf;
use translations::Translations;

/// Import translations into the clips that they belong to.
///
/// Only texts that were changed in the file change in the clips. Everything else keeps its spelling. Texts that do not fit
/// their clips are reported with line and column, and are not imported.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz import texts de-de.po
  lipz import texts texts.xlsx -o voices --locale fr-fr --check
  msgmerge old.po texts.pot | lipz import texts - --stdin-filename de-de.po")]
pub(crate) struct ImportTexts {
    /// Translated files: .po, .xlf, .csv, .tsv, .xlsx, .ods, .json; `-` is standard input
    #[arg(value_name = "FILES", required = true)]
    files: Vec<PathBuf>,

    /// Lipz files to change: folders, files or patterns [default: those of lipz.toml]
    #[arg(short, long, value_name = "SOURCES")]
    output: Vec<PathBuf>,

    /// Only these locales, also for files that do not name theirs
    #[arg(long, value_name = "LOCALE", value_delimiter = ',', value_parser = parse_locale)]
    locale: Vec<String>,

    /// Source locale [default: `default-locale` of lipz.toml]
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale)]
    from: Option<String>,

    /// Minimum state of imported translations
    #[arg(long, value_enum, default_value_t = MinState::Translated)]
    state: MinState,

    /// Translate texts that have no translation by entries with the same source text, whatever their keys are
    #[arg(long)]
    by_text: bool,

    /// Import stale translations, and replace newer ones
    #[arg(long)]
    discard_edits: bool,

    /// Write nothing, but count the texts to import, and report the problems that they would bring into the project
    #[arg(long)]
    check: bool,

    #[command(flatten)]
    file: SettingsFile,

    #[command(flatten)]
    stdin: StdinFile,

    #[command(flatten)]
    lints: LintFlags,

    #[command(flatten)]
    quiet: QuietFlag,
}

/// States on the command line.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
enum MinState {
    /// Any translation, including fuzzy ones
    Initial,
    /// Finished translations
    Translated,
    /// Reviewed translations
    Reviewed,
    /// Final translations
    Final,
}

impl From<MinState> for lipz_texts::State {
    fn from(state: MinState) -> lipz_texts::State {
        match state {
            MinState::Initial => lipz_texts::State::Initial,
            MinState::Translated => lipz_texts::State::Translated,
            MinState::Reviewed => lipz_texts::State::Reviewed,
            MinState::Final => lipz_texts::State::Final,
        }
    }
}

impl Run for ImportTexts {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        run(self, reporter)
    }
}

fn run(arguments: &ImportTexts, reporter: &mut Reporter) -> CommandResult {
    arguments.stdin.apply(&arguments.files, reporter)?;
    let mut project = arguments.file.project(&arguments.output, reporter)?;
    let settings = &mut project.settings;
    arguments.lints.apply(&mut settings.options);
    let settings = &project.settings;
    let options = &settings.options;
    refuse_locales(arguments.locale.iter().chain(&arguments.from).map(String::as_str), options, reporter)?;
    let (inputs, mut reports) = find_all(settings, reporter)?;
    let source_locale = source_locale(arguments.from.as_ref(), options, reporter)?;
    let known = locales_of(&inputs, options, &source_locale);
    let read_options = ReadOptions::new(source_locale.as_str())
        .wanted(arguments.locale.iter().cloned())
        .known(known)
        .extended_locales(options.get_extended_locales());
    let mut incoming = IncomingTexts::read(&arguments.files, &read_options, reporter, &mut reports)?;
    let keys: BTreeSet<&str> = inputs.iter().map(|input| input.key.as_str()).collect();
    let mut entries = std::mem::take(&mut incoming.entries);
    resolve_keys(&mut entries, &keys);
    if entries.iter().any(|entry| !keys.contains(entry.key.text.as_str())) {
        let clips = texts_of_clips(&inputs, options);
        incoming.found.extend(follow_renamed_clips(&mut entries, &keys, &source_locale, &clips));
    }
    let by_text = arguments.by_text.then(|| TextTranslations::new(&entries, &keys));
    let (by_text, found) =
        by_text.map_or_else(|| (None, unknown_keys(&entries, &keys)), |(by_text, found)| (Some(by_text), found));
    incoming.found.extend(found);
    incoming.found.retain_mut(|(_, diagnostic)| {
        let mut one = vec![diagnostic.clone()];
        options.get_levels().apply(&mut one);
        one.pop().map(|levelled| *diagnostic = levelled).is_some()
    });
    let (record, odd_lines) = RecordFile::open(&project, &inputs).map_err(|report| reporter.fail(report))?;
    reports.extend(odd_lines);
    let locales = (source_locale.as_str(), options.get_default_locale());
    let translations = Translations::new(&entries, by_text, locales, &record);
    let (counts, confirmed) = arguments.merge(&project, &inputs, &translations, &mut incoming.found, &mut reports);
    let remembered = match arguments.check {
        true => Ok(String::new()),
        false => remember(record, &source_locale, &confirmed),
    };
    let remembered = remembered.unwrap_or_else(|report| {
        reports.push(report);
        String::new()
    });
    reports.extend(incoming.reports());
    all_reports::sort(&mut reports);
    reporter.end(reports, (!arguments.quiet.is_set()).then(|| summary(counts, arguments.check) + &remembered))
}

impl ImportTexts {
    /// Merges the translations into the clips.
    fn merge(
        &self,
        project: &Project,
        inputs: &[Input],
        translations: &Translations<'_>,
        found: &mut Vec<(usize, Diagnostic)>,
        reports: &mut Vec<Report>,
    ) -> (Counts, Vec<ToRecord>) {
        let options = &project.settings.options;
        let inputs: Vec<Input> = inputs.iter().filter(|input| translations.concern(input)).cloned().collect();
        let merge = Merge::new(translations.source_locale)
            .default_locale(translations.default_locale)
            .min_state(self.state.into())
            .forced(self.discard_edits)
            .placeholders(&project.settings.placeholders)
            .levels(options.get_levels());
        let bar = console::progress_bar(inputs.len(), self.quiet.is_set());
        let compiler = Compiler::new(options.clone()).progress(|count| bar.inc(count));
        let files = Files::new();
        let results = compiler.each_file(&inputs, |input, bytes| {
            let (merged, of_texts) = translations.merge(&merge, input, bytes)?;
            if let (Some(text), Content::File(path), false) = (&merged.text, &input.content, self.check) {
                files.rewrite(path, bytes, text.as_bytes())?;
            }
            Ok((merged, of_texts))
        });
        let unwritten = files.finish();
        bar.finish_and_clear();
        let mut counts = Counts::default();
        let (mut confirmed, mut used, mut changed) = (Vec::new(), Vec::new(), Vec::new());
        let mut other_sources: BTreeMap<usize, BTreeSet<Span>> = BTreeMap::new();
        for (input, result) in inputs.into_iter().zip(results) {
            match result.and_then(|result| result) {
                Ok((merged, of_texts)) => {
                    used.extend(of_texts);
                    changed.extend(merged.text.filter(|_| self.check).map(|text| (input.clone(), text)));
                    counts.add(merged.counts);
                    let is_written = unwritten.iter().all(|report| report.source.path != input.name());
                    if is_written {
                        let (of_clip, comments) = (merged.confirmed, merged.comments);
                        confirmed.push(ToRecord { input, confirmed: of_clip, comments, sources: merged.sources });
                    }
                    found.extend(merged.found);
                    for (file, span) in merged.other_sources {
                        other_sources.entry(file).or_default().insert(span);
                    }
                }
                Err(report) => reports.push(report),
            }
        }
        reports.extend(unwritten);
        let (placed, others) = match self.check {
            true => new_problems(project, changed, translations.entries().chain(&used)),
            false => (Vec::new(), Vec::new()),
        };
        // The merge has reported some of them.
        let place = |(file, found): &(usize, Diagnostic)| {
            (*file, found.code, found.primary.as_ref().map(|label| label.span), found.message.clone())
        };
        let mut known: HashSet<_> = found.iter().map(place).collect();
        found.extend(placed.into_iter().filter(|new| known.insert(place(new))));
        reports.extend(others);
        let mut of_all: Vec<(usize, Diagnostic)> =
            other_sources.iter().filter_map(|(file, spans)| Some((*file, not_imported(spans)?))).collect();
        of_all.extend(translations.unused(&used));
        of_all.extend((counts.unmarked > 0).then(|| (0, unmarked(counts.unmarked, self.check))));
        for (file, diagnostic) in of_all {
            let mut one = vec![diagnostic];
            options.get_levels().apply(&mut one);
            found.extend(one.into_iter().map(|diagnostic| (file, diagnostic)));
        }
        (counts, confirmed)
    }
}

/// The information about a clip for the record.
struct ToRecord {
    input: Input,
    confirmed: Vec<ConfirmedTranslations>,
    comments: Vec<TranslatorComments>,
    /// The texts of its segments in the source locale.
    sources: Vec<String>,
}

/// Records the source texts of the translations and the comments on them, and returns a message about them.
fn remember(mut file: RecordFile, source_locale: &str, clips: &[ToRecord]) -> Result<String, Report> {
    let mut commented = 0;
    for clip in clips {
        let name = file.name(&clip.input);
        for one in &clip.confirmed {
            file.record.confirm(&name, source_locale, one);
        }
        let mut has_new = false;
        for TranslatorComments { locale, lines, exported } in &clip.comments {
            has_new |= file.record.take_comments(&name, locale, lines, *exported);
        }
        file.record.keep_source(&name, source_locale, &clip.sources);
        commented += usize::from(has_new);
    }
    let is_written = file.write()?;
    let mut message = String::new();
    if commented > 0 {
        let clips = console::counted(commented, "clip");
        message = format!("comments of translators on {clips} updated in {}\n", file.shown());
    }
    if is_written && !file.exists() {
        message += &file.introduction();
    }
    Ok(message)
}

/// Returns the diagnostic for source texts that differ from those of the project, at the first of them.
fn not_imported(spans: &BTreeSet<Span>) -> Option<Diagnostic> {
    let texts = console::counted(spans.len(), "source text");
    let (differ, are) = if spans.len() == 1 { ("differs", "is") } else { ("differ", "are") };
    let message = format!("{texts} of the file {differ} from the project and {are} not imported");
    let diagnostic = Diagnostic::at(Code::ExchangeLoss, *spans.first()?, message);
    Some(diagnostic.help("edit source texts in the Lipz files; if they changed there, export again"))
}

/// Returns the diagnostic for texts that were replaced without a mark.
fn unmarked(count: usize, is_check: bool) -> Diagnostic {
    let (texts, were) = (console::counted(count, "text"), if count == 1 { "was" } else { "were" });
    let what = if is_check { "would be".to_owned() } else { were.to_owned() };
    Diagnostic::new(Code::TextReplaced, format!("{texts} of the project {what} replaced"))
        .note("the file does not contain the texts from its export, so changes since then may be lost")
        .help("compare the texts in version control, and keep the marks of the export, such as the column `lock de-de`")
}

fn summary(counts: Counts, is_check: bool) -> String {
    let parts = [
        (counts.added, "new"),
        (counts.changed, "changed"),
        (counts.unchanged, "unchanged"),
        (counts.newer, "kept (newer in the project)"),
        (counts.refused, "not imported"),
    ];
    let parts: Vec<String> = parts
        .into_iter()
        .filter(|(count, what)| *count > 0 || *what == "new")
        .map(|(count, what)| format!("{} {what}", console::grouped(count)))
        .collect();
    let head = if is_check { "texts that would be imported" } else { "texts imported" };
    format!("{head}: {}\n", parts.join(", "))
}
