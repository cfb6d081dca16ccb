//! `lipz export texts`: files for translators.

mod deliver;

use crate::commands::Run;
use crate::commands::export::units::UnitFiles;
use crate::console;
use crate::reporter::{Abort, CommandResult, Reporter};
use crate::shared::inputs::find_all;
use crate::shared::output_file::refuse_source;
use crate::shared::sources::Sources;
use crate::shared::stdin_file::StdinFile;
use crate::shared::stdio;
use crate::shared::text_formats::TextFormatArgument;
use crate::shared::text_record::RecordFile;
use crate::shared::translations::{locales_of, source_locale};
use crate::shared::values::{parse_locale, refuse_locales};
use crate::shared::voices::recordings;
use clap::{Args, ValueEnum};
use deliver::deliver;
use lipz_compiler::{Input, Voices};
use lipz_diagnostics::{Report, escape};
use lipz_texts::{Division, Exchange, Progress, Shape, Unit, WriteOptions, WriteResult, write};
use std::collections::BTreeSet;
use std::path::PathBuf;

/// Export texts and translations into files for translators.
///
/// Clips without a text in the default locale are left out; the summary counts them.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz export texts po voices --locale de-de -o de-de.po
  lipz export texts po voices --locale de-de --state missing,stale -o to-do.po
  lipz export texts po voices --locale de-de --namespace Dialogue -o Content/Localization/Game/de/Game.po
  lipz export texts xlsx voices --locale de-de,fr-fr -o texts.xlsx
  lipz export texts unity voices -o dialogue.csv")]
pub(crate) struct ExportTexts {
    /// Format to write
    #[arg(value_enum, value_name = "FORMAT")]
    pub(super) text_format: TextFormatArgument,

    #[command(flatten)]
    sources: Sources,

    #[command(flatten)]
    stdin: StdinFile,

    /// File to write, or folder for a file of each locale; `-` is standard output
    #[arg(short, long, value_name = "FILE|FOLDER")]
    pub(super) output: PathBuf,

    /// Locales of the translations, also new ones, as in de-de,fr-fr [default: all]
    #[arg(long, value_name = "LOCALE", value_delimiter = ',', value_parser = parse_locale)]
    locale: Vec<String>,

    /// Source locale [default: `default-locale` of lipz.toml]
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale)]
    from: Option<String>,

    /// Only clips with a segment in one of these states: missing,stale
    #[arg(long, value_enum, value_name = "STATES", value_delimiter = ',')]
    state: Vec<StateName>,

    /// Unit of an entry [default: clip]
    #[arg(long, value_enum)]
    by: Option<EntryScope>,

    /// Write cells that look like formulas without a protecting apostrophe
    #[arg(long)]
    raw_cells: bool,

    /// Namespace of the string table in Unreal, for a PO file that Unreal imports
    #[arg(long, value_name = "NAME")]
    namespace: Option<String>,

    /// Replace existing files
    #[arg(long)]
    overwrite: bool,
}

impl ExportTexts {
    /// Whether the file goes to standard output.
    pub(super) fn is_printed(&self) -> bool {
        stdio::is_meant(&self.output)
    }

    /// Refuses a namespace that Unreal or an import could not read.
    fn refuse_namespace(&self, reporter: &mut Reporter) -> Result<(), Abort> {
        let Some(name) = &self.namespace else { return Ok(()) };
        if !name.is_empty() && name.trim().is_empty() || name.contains(|c: char| c == '\\' || c.is_control()) {
            let message = format!("{} cannot be a namespace", escape::quoted(name));
            return Err(
                reporter.usage(message, "write the name of the string table, without backslashes and line breaks")
            );
        }
        Ok(())
    }

    /// Refuses flags that have no effect for the format.
    fn refuse_idle_flags(&self, reporter: &mut Reporter) -> Result<(), Abort> {
        let knows_segments = matches!(self.text_format, TextFormatArgument::Xliff | TextFormatArgument::Json);
        let is_sheet = self.text_format.shape() == Some(Shape::Sheet);
        let (flag, why) = match self {
            ExportTexts { by: Some(_), .. } if knows_segments => {
                ("--by", "the format contains both clips and segments")
            }
            ExportTexts { raw_cells: true, .. } if !is_sheet => {
                ("--raw-cells", "it applies only to CSV tables for spreadsheets")
            }
            ExportTexts { namespace: Some(_), text_format, .. } if *text_format != TextFormatArgument::Po => {
                ("--namespace", "it applies only to `po`")
            }
            _ => return Ok(()),
        };
        Err(reporter.usage(format!("`{flag}` has no effect on this format"), &format!("leave it out, because {why}")))
    }

    /// Returns the states to select clips by.
    fn states(&self) -> impl Iterator<Item = Progress> {
        self.state.iter().map(|state| Progress::from(*state))
    }

    /// Leaves out clips that are in none of these states in any locale.
    fn keep_states(&self, exchange: &mut Exchange) {
        let locales = exchange.locales.len();
        let is_meant =
            |unit: &Unit| (0..locales).any(|locale| self.states().any(|progress| unit.has(locale, progress)));
        exchange.units.retain(|unit| self.state.is_empty() || is_meant(unit));
    }

    /// Returns the files of the exchange.
    fn write(&self, exchange: &Exchange) -> WriteResult {
        let format = lipz_texts::Format::from(self.text_format);
        let options = WriteOptions::new()
            .division(self.by.map_or(Division::Clip, Into::into))
            .shape(self.text_format.shape().unwrap_or(Shape::Sheet))
            .raw_cells(self.raw_cells)
            .namespace(self.namespace.clone());
        if self.state.is_empty() || !format.is_of_one_locale(&options) {
            return write(format, exchange, &options);
        }
        // Each locale has its own selection of clips.
        let mut all = WriteResult::default();
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

/// The most locales that the summary names.
const LOCALES_SHOWN: usize = 6;

/// Clips without an entry.
struct LeftOut {
    count: usize,
    /// The number of these that are dubs with the texts of their originals.
    dubs: usize,
}

impl LeftOut {
    fn count(inputs: &[Input], units: &[Unit], voices: &Voices) -> LeftOut {
        let keys: BTreeSet<&str> = inputs.iter().map(|input| input.key.as_str()).collect();
        let exported: BTreeSet<&str> = units.iter().map(|unit| unit.key.as_str()).collect();
        let is_dub = |key: &&&str| voices.original_of(key, |original| keys.contains(original)).is_some();
        let dubs = keys.difference(&exported).filter(is_dub).count();
        LeftOut { count: inputs.len() - exported.len(), dubs }
    }

    fn said(&self, source_locale: &str) -> String {
        let mut said = String::new();
        let others = self.count - self.dubs;
        if others > 0 {
            said += &format!("; left out {} without a text in {source_locale}", console::counted(others, "clip"));
        }
        if self.dubs > 0 {
            said += &format!("; left out {} with the texts of their originals", console::counted(self.dubs, "dub"));
        }
        said
    }
}

/// The progress of a translation, on the command line.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
enum StateName {
    /// Without a text
    Missing,
    /// Older than the source text
    Stale,
    /// Translated, but not reviewed
    Translated,
    /// Reviewed, but not final
    Reviewed,
    /// Final
    Final,
}

impl From<StateName> for Progress {
    fn from(name: StateName) -> Progress {
        match name {
            StateName::Missing => Progress::Missing,
            StateName::Stale => Progress::Stale,
            StateName::Translated => Progress::Translated,
            StateName::Reviewed => Progress::Reviewed,
            StateName::Final => Progress::Final,
        }
    }
}

/// The unit of an entry.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
enum EntryScope {
    /// A clip, with `|` between its segments
    Clip,
    /// A segment, so that a `|` cannot be lost
    Segment,
}

impl From<EntryScope> for Division {
    fn from(by: EntryScope) -> Division {
        match by {
            EntryScope::Clip => Division::Clip,
            EntryScope::Segment => Division::Segment,
        }
    }
}

impl Run for ExportTexts {
    fn prints_result(&self) -> bool {
        self.is_printed()
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        run(self, reporter)
    }
}

fn run(arguments: &ExportTexts, reporter: &mut Reporter) -> CommandResult {
    refuse_source(&arguments.output, reporter)?;
    arguments.refuse_idle_flags(reporter)?;
    arguments.refuse_namespace(reporter)?;
    arguments.stdin.apply(arguments.sources.paths(), reporter)?;
    let project = arguments.sources.project(reporter)?;
    let options = &project.settings.options;
    refuse_locales(arguments.locale.iter().chain(&arguments.from).map(String::as_str), options, reporter)?;
    let (inputs, mut reports) = find_all(&project.settings, reporter)?;
    let source_locale = source_locale(arguments.from.as_ref(), options, reporter)?;
    let is_template = arguments.text_format == TextFormatArgument::Pot;
    let locales = match arguments.locale.is_empty() {
        // A template has no translations.
        _ if is_template => vec![String::new()],
        true => locales_of(&inputs, options, &source_locale),
        false => unique(&arguments.locale, &source_locale),
    };
    if locales.is_empty() && !inputs.is_empty() {
        let message = format!("no clip has a text in a locale other than {source_locale}");
        return Err(reporter.usage(message, "name the locale of the translations with `--locale`, as in de-de"));
    }
    let record = match RecordFile::open(&project, &inputs) {
        Ok((record, odd_lines)) => {
            reports.extend(odd_lines);
            record
        }
        Err(report) => return Err(reporter.fail(report)),
    };
    let (recordings, unread) = recordings(&project.settings);
    reports.extend(unread);
    let is_quiet = arguments.sources.is_quiet();
    let files = UnitFiles { settings: &project.settings, record: &record, recordings: &recordings, is_quiet };
    let units = files.units(&inputs, (&source_locale, &locales), &mut reports);
    let left_out = LeftOut::count(&inputs, &units, &project.settings.voices());
    let mut exchange = Exchange { source_locale, locales, units };
    arguments.keep_states(&mut exchange);
    if exchange.units.is_empty() && left_out.count < inputs.len() {
        let message = format!("no text is {}", arguments.states().map(Progress::name).collect::<Vec<_>>().join(" or "));
        return Err(reporter.usage(message, "see the progress of the translations with `lipz coverage`"));
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
    let clips: BTreeSet<&str> = exchange.units.iter().map(|unit| unit.key.as_str()).collect();
    let clips = console::counted(clips.len(), "clip");
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

/// Returns each locale once, without the source locale.
fn unique(locales: &[String], source_locale: &str) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for locale in locales {
        if locale != source_locale && !all.contains(locale) {
            all.push(locale.clone());
        }
    }
    all
}
