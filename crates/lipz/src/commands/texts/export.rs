//! `lipz texts export`: a file for translators.

use super::deliver::deliver;
use super::{By, Columns, Format, StateName};
use crate::console;
use crate::reporter::{Abort, Ended, Reporter};
use crate::shared::inputs::find_all;
use crate::shared::output_file::refuse_source;
use crate::shared::project_flags::{hide_of_banks, parse_locale, refuse_locales};
use crate::shared::sources::Sources;
use crate::shared::text_record::RecordFile;
use crate::shared::{formats, stdio};
use clap::Args;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Input, Options, Voices};
use lipz_diagnostics::{Report, Severity};
use lipz_file::Document;
use lipz_file::locale::{TextName, text_name};
use lipz_sync::Recordings;
use lipz_texts::{Collect, Division, Exchange, Progress, Shape, Unit, WriteOptions, Written, write};
use std::collections::BTreeSet;
use std::path::PathBuf;

/// Write the texts of clips and their translations into a file for translators.
///
/// Clips without a text in the default locale are left out; the summary counts them.
#[derive(Args, Debug)]
#[command(mut_args(hide_of_banks))]
pub(super) struct Export {
    /// The format to write
    #[arg(value_enum, value_name = "FORMAT")]
    pub(super) text_format: Format,

    #[command(flatten)]
    sources: Sources,

    /// The file to write, or the folder for a file of each locale; `-` is standard output
    #[arg(short, long, value_name = "FILE|FOLDER")]
    pub(super) output: PathBuf,

    /// The locale of the translations, also one that no clip has yet; may be given several times [default: all that the
    /// files have]
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale)]
    locale: Vec<String>,

    /// The locale that is translated [default: `default-locale` of lipz.toml]
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale)]
    from: Option<String>,

    /// Only clips with a segment in one of these states, separated by `,`
    #[arg(long, value_enum, value_name = "STATES", value_delimiter = ',')]
    state: Vec<StateName>,

    /// What an entry is about [default: clip]
    #[arg(long, value_enum)]
    by: Option<By>,

    /// The columns of a CSV [default: sheet]
    #[arg(long, value_enum)]
    shape: Option<Columns>,

    /// Write cells of a CSV that look like formulas without an apostrophe before them, for programs that show it
    #[arg(long)]
    raw_cells: bool,

    /// Replace files that exist
    #[arg(long)]
    pub(super) force: bool,
}

impl Export {
    /// Whether the file goes to standard output.
    pub(super) fn is_printed(&self) -> bool {
        stdio::is_meant(&self.output)
    }

    /// Refuses flags that the format has no use for: nobody should believe that they do something.
    fn refuse_idle_flags(&self, reporter: &mut Reporter) -> Result<(), Abort> {
        let knows_segments = matches!(self.text_format, Format::Xliff | Format::Json);
        let is_csv = self.text_format == Format::Csv;
        let (flag, why) = match self {
            Export { by: Some(_), .. } if knows_segments => ("--by", "the format has both clips and segments"),
            Export { shape: Some(_), .. } if !is_csv => ("--shape", "it chooses the columns of a CSV"),
            Export { raw_cells: true, .. } if !is_csv => ("--raw-cells", "it is about cells of a CSV"),
            _ => return Ok(()),
        };
        Err(reporter.usage(format!("`{flag}` changes nothing here"), &format!("leave it out: {why}")))
    }

    /// The states that clips are chosen by.
    fn states(&self) -> impl Iterator<Item = Progress> {
        self.state.iter().map(|state| Progress::from(*state))
    }

    /// Leaves out the clips of which no locale is in one of the states.
    fn keep_states(&self, exchange: &mut Exchange) {
        let locales = exchange.locales.len();
        let is_meant =
            |unit: &Unit| (0..locales).any(|locale| self.states().any(|progress| unit.has(locale, progress)));
        exchange.units.retain(|unit| self.state.is_empty() || is_meant(unit));
    }

    /// The files of the exchange.
    fn write(&self, exchange: &Exchange) -> Written {
        let format = lipz_texts::Format::from(self.text_format);
        let options = WriteOptions::new()
            .division(self.by.map_or(Division::Clip, Into::into))
            .shape(self.shape.map_or(Shape::Sheet, Into::into))
            .raw_cells(self.raw_cells);
        if self.state.is_empty() || !format.is_of_one_locale(&options) {
            return write(format, exchange, &options);
        }
        // Each locale has its own clips.
        let mut all = Written::default();
        for (at, locale) in exchange.locales.iter().enumerate() {
            let own = |unit: &Unit| Unit {
                translations: unit.translations.get(at).cloned().into_iter().collect(),
                ..unit.clone()
            };
            let units = exchange.units.iter().map(own).collect();
            let mut one =
                Exchange { source_locale: exchange.source_locale.clone(), locales: vec![locale.clone()], units };
            self.keep_states(&mut one);
            let written = write(format, &one, &options);
            all.files.extend(written.files.into_iter().filter(|_| !one.units.is_empty()));
            all.diagnostics.extend(written.diagnostics);
        }
        all
    }
}

/// Locales that the summary names.
const LOCALES_SHOWN: usize = 6;

/// Clips that have no entry.
struct LeftOut {
    count: usize,
    /// Of these, dubs that have the texts of their originals.
    dubs: usize,
}

impl LeftOut {
    fn count(inputs: &[Input], units: &[Unit], voices: &Voices) -> LeftOut {
        let keys: BTreeSet<&str> = inputs.iter().map(|input| input.key.as_str()).collect();
        let exported: BTreeSet<&str> = units.iter().map(|unit| unit.key.as_str()).collect();
        let is_dub = |key: &&&str| voices.original_of(key, |original| keys.contains(original)).is_some();
        let dubs = keys.difference(&exported).filter(is_dub).count();
        LeftOut { count: inputs.len() - units.len(), dubs }
    }

    fn said(&self, source_locale: &str) -> String {
        let mut said = String::new();
        let others = self.count - self.dubs;
        if others > 0 {
            said += &format!("; {} without a text in {source_locale} left out", console::counted(others, "clip"));
        }
        if self.dubs > 0 {
            said += &format!("; {} left out, whose texts are their originals'", console::counted(self.dubs, "dub"));
        }
        said
    }
}

/// What one clip gives.
struct Made {
    unit: Option<Unit>,
    report: Option<Report>,
}

pub(super) fn run(arguments: &Export, reporter: &mut Reporter) -> Ended {
    refuse_source(&arguments.output, reporter)?;
    arguments.refuse_idle_flags(reporter)?;
    let project = arguments.sources.project(reporter)?;
    let options = &project.settings.options;
    refuse_locales(arguments.locale.iter().chain(&arguments.from).map(String::as_str), options, reporter)?;
    let (inputs, mut reports) = find_all(&project.settings, reporter)?;
    let source_locale = source_locale(arguments.from.as_ref(), options, reporter)?;
    let is_template = arguments.text_format == Format::Pot;
    let locales = match arguments.locale.is_empty() {
        // The translations of no locale.
        _ if is_template => vec![String::new()],
        true => locales_of(&inputs, options, &source_locale),
        false => unique(&arguments.locale, &source_locale),
    };
    if locales.is_empty() && !inputs.is_empty() {
        let message = format!("no clip has a text in another locale than {source_locale}");
        return Err(reporter.usage(message, "name the locale of the translations with `--locale`, as in de-de"));
    }
    let record = match RecordFile::open(&project, &inputs) {
        Ok((record, odd_lines)) => {
            reports.extend(odd_lines);
            record
        }
        Err(report) => return Err(reporter.fail(report)),
    };
    let units = units(arguments, &project.settings, &inputs, (&source_locale, &locales), &record, &mut reports);
    let left_out = LeftOut::count(&inputs, &units, &project.settings.voices());
    let mut exchange = Exchange { source_locale, locales, units };
    arguments.keep_states(&mut exchange);
    if exchange.units.is_empty() && left_out.count < inputs.len() {
        let message = format!("no text is {}", arguments.states().map(Progress::name).collect::<Vec<_>>().join(" or "));
        return Err(reporter.usage(message, "`lipz coverage` shows how far the translations are"));
    }
    let written = arguments.write(&exchange);
    let name = console::path(&arguments.output);
    let mut diagnostics = written.diagnostics.clone();
    options.get_levels().apply(&mut diagnostics);
    if !diagnostics.is_empty() {
        reports.push(Report::all_about(name.clone(), diagnostics));
    }
    let is_whole = !lipz_diagnostics::reports::have_errors(&reports);
    let count = if is_whole { deliver(arguments, &written, &mut reports, reporter)? } else { 0 };
    let clips = console::counted(exchange.units.len(), "clip");
    let locales = match exchange.locales.as_slice() {
        _ if is_template => "any locale".to_owned(),
        few if few.len() <= LOCALES_SHOWN => few.join(", "),
        many => console::counted(many.len(), "locale"),
    };
    let without = left_out.said(&exchange.source_locale);
    let into = if arguments.is_printed() { "standard output".to_owned() } else { name };
    let summary = format!("texts of {clips} for {locales} written into {into}{without}\n");
    reporter.end(reports, (!arguments.sources.is_quiet() && count > 0).then_some(summary))
}

/// The locale that is translated.
pub(in crate::commands) fn source_locale(
    from: Option<&String>,
    options: &Options,
    reporter: &mut Reporter,
) -> Result<String, Abort> {
    let default = || lipz_file::locale::canonical_tag(options.get_default_locale()?, true);
    from.cloned().or_else(default).ok_or_else(|| {
        let tip = "name it with `--from`, as in en-us, or set `default-locale` in lipz.toml";
        reporter.usage("the locale that is translated is not known", tip)
    })
}

/// Each locale once, but for the one that is translated.
fn unique(locales: &[String], source_locale: &str) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for locale in locales {
        if locale != source_locale && !all.contains(locale) {
            all.push(locale.clone());
        }
    }
    all
}

/// The locales that files have, but for the one that is translated.
pub(in crate::commands) fn locales_of(inputs: &[Input], options: &Options, source_locale: &str) -> Vec<String> {
    let each = Compiler::new(options.clone()).each_file(inputs, |_, bytes| {
        let document = lipz_file::parse(bytes).document.unwrap_or_default();
        document.elements.iter().filter_map(|element| tag(&element.name.text)).collect::<Vec<String>>()
    });
    let all: BTreeSet<String> = each.into_iter().flatten().flatten().collect();
    all.into_iter().filter(|locale| locale != source_locale).collect()
}

fn tag(name: &str) -> Option<String> {
    match text_name(name)? {
        TextName::Canonical(tag) | TextName::Misspelt(tag) | TextName::OtherShape(_, Some(tag)) => Some(tag),
        TextName::NoLocale | TextName::OtherShape(_, None) => None,
    }
}

/// The units of all clips, in the order of their keys.
fn units(
    arguments: &Export,
    settings: &Settings,
    inputs: &[Input],
    (source_locale, locales): (&str, &[String]),
    record: &RecordFile,
    reports: &mut Vec<Report>,
) -> Vec<Unit> {
    let options = &settings.options;
    let limits = options.get_text_limits();
    let on_screen =
        limits.get_line_columns().zip(limits.get_lines()).map(|(columns, lines)| columns as usize * lines as usize);
    let collect = Collect::new(source_locale, locales.iter().cloned())
        .default_locale(options.get_default_locale().map(str::to_owned))
        .default_rate(options.get_default_fps().map(formats::rate))
        .limits(on_screen, limits.get_characters_per_second());
    let (recordings, unread) = Recordings::discover_with_reports(settings);
    reports.extend(unread);
    let bar = console::progress_bar(inputs.len(), arguments.sources.is_quiet());
    let compiler = Compiler::new(options.clone()).progress(|count| bar.inc(count));
    let results = compiler.each_file(inputs, |input, bytes| {
        let parsed = lipz_file::parse(bytes);
        let mut diagnostics = parsed.diagnostics;
        // Warnings about clips are for `lipz check`.
        diagnostics.retain(|diagnostic| diagnostic.severity == Severity::Error);
        let document: Document<'_> = parsed.document.unwrap_or_default();
        let mut unit = collect.unit(&input.key, &document, &mut diagnostics);
        if let Some(unit) = &mut unit {
            record.record.describe(&record.name(input), source_locale, locales, unit);
            unit.file = Some(input.name());
            unit.recording = recordings.find(&input.key).map(|path| path.to_string_lossy().replace('\\', "/"));
        }
        options.get_levels().apply(&mut diagnostics);
        let report = (!diagnostics.is_empty()).then(|| Report::from_bytes(input.name(), bytes, diagnostics));
        Made { unit, report }
    });
    bar.finish_and_clear();
    let mut units = Vec::new();
    for result in results {
        match result {
            Ok(made) => {
                units.extend(made.unit);
                reports.extend(made.report);
            }
            Err(report) => reports.push(report),
        }
    }
    units.sort_by(|a, b| a.key.cmp(&b.key));
    units
}
