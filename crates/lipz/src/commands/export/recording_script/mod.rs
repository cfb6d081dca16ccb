//! `lipz export recording-script`: the lines that a studio records.

mod lines;

use crate::commands::Run;
use crate::commands::export::units::UnitFiles;
use crate::console;
use crate::reporter::{CommandResult, Reporter};
use crate::shared::inputs::find_all;
use crate::shared::output_file::{OVERWRITE, in_the_way, may_write, refuse_source, write_all};
use crate::shared::sources::Sources;
use crate::shared::stdin_file::StdinFile;
use crate::shared::stdio;
use crate::shared::text_record::RecordFile;
use crate::shared::values::{parse_locale, refuse_locales};
use crate::shared::voices::{original_locale, recordings, refuse_unknown_voice};
use clap::{Args, ValueEnum};
use lines::{LineState, Lines};
use lipz_compiler::settings::Settings;
use lipz_diagnostics::{Code, Report, escape, reports::have_errors};
use lipz_texts::{RecordingScript, ScriptLine, Translation};
use std::path::{Path, PathBuf};

/// Export the lines of each character as a script for recording them.
///
/// Lines are ordered by character, scene and key. In print, each session starts on a new page. `lipz import recordings` copies
/// the chosen takes, and `lipz import texts` merges texts that changed in the studio.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz export recording-script html --locale de-de -o script.html
  lipz export recording-script xlsx --locale de-de --session-lines 120 -o script.xlsx
  lipz export recording-script xlsx --locale de-de --state missing,stale,length -o pick-ups.xlsx")]
pub(crate) struct ExportRecordingScript {
    /// Format to write
    #[arg(value_enum, value_name = "FORMAT")]
    script_format: ScriptFormatArgument,

    #[command(flatten)]
    sources: Sources,

    #[command(flatten)]
    stdin: StdinFile,

    /// File to write; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// Spoken locale [default: that of the originals]
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale)]
    locale: Option<String>,

    /// Only lines whose recording is in one of these states, such as missing,stale,length
    #[arg(long, value_enum, value_name = "STATES", value_delimiter = ',')]
    state: Vec<LineState>,

    /// Most lines of a character in one session [default: one session]
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u32).range(1..))]
    session_lines: Option<u32>,

    /// Replace an existing file
    #[arg(long)]
    overwrite: bool,
}

/// A format of scripts.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
enum ScriptFormatArgument {
    /// A spreadsheet, with a sheet of totals per character
    Xlsx,
    /// The same table without the totals
    Csv,
    /// A page to print, with boxes for takes
    Html,
}

impl Run for ExportRecordingScript {
    fn prints_result(&self) -> bool {
        stdio::is_meant(&self.output)
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        refuse_source(&self.output, reporter)?;
        self.stdin.apply(self.sources.paths(), reporter)?;
        let project = self.sources.project(reporter)?;
        let settings = &project.settings;
        let options = &settings.options;
        refuse_locales(self.locale.iter().map(String::as_str), options, reporter)?;
        let (inputs, mut reports) = find_all(settings, reporter)?;
        let source_locale = original_locale(settings, reporter)?;
        let locale = self.locale.as_ref().filter(|locale| **locale != source_locale).cloned();
        refuse_unknown_voice(locale.as_deref(), settings, reporter)?;
        if self.output.is_dir() {
            let message = format!("`{}` is a folder", console::path(&self.output));
            return Err(reporter.usage(message, "name the file of the script"));
        }
        let (record, odd_lines) = RecordFile::open(&project, &inputs).map_err(|report| reporter.fail(report))?;
        reports.extend(odd_lines);
        let locales: Vec<String> = locale.iter().cloned().collect();
        let (recordings, unread) = recordings(settings);
        reports.extend(unread);
        let is_quiet = self.sources.is_quiet();
        let files = UnitFiles { settings, record: &record, recordings: &recordings, is_quiet };
        let units = files.units(&inputs, (&source_locale, &locales), &mut reports);
        let lines = Lines::new(settings, &inputs, locale.as_deref(), &recordings, &mut reports);
        let of_originals = lines.of(units, &mut reports);
        let without_text = lines.count() - of_originals.len();
        let is_meant = |state: &LineState| self.state.is_empty() || self.state.contains(state);
        let mut script = RecordingScript {
            title: title(settings),
            source_locale,
            locale: locale.clone(),
            lines: of_originals.into_iter().filter(|(state, _)| is_meant(state)).map(|(_, line)| line).collect(),
        };
        script.arrange(self.session_lines.map(|most| most as usize));
        if script.lines.is_empty() && !have_errors(&reports) {
            let states: Vec<String> = self.state.iter().filter_map(LineState::name).collect();
            let message = match states.as_slice() {
                [] => "no clip has a text to record".to_owned(),
                states => format!("no line is in the state {}", states.join(" or ")),
            };
            return Err(
                reporter.usage(message, "see the progress of the recordings with `lipz coverage --show voices`")
            );
        }
        let left_out = match without_text {
            0 => String::new(),
            count => {
                let clips = console::counted(count, "clip");
                format!("; left out {clips} without a text in {}", escape::text(&script.source_locale))
            }
        };
        let folder = settings.audio.folder.as_deref().filter(|folder| !folder.exists());
        let no_recordings = folder.map(|folder| format!("; no recordings: `{}` does not exist", console::path(folder)));
        let left_out = left_out + &no_recordings.unwrap_or_default();
        self.deliver(&script, &left_out, reports, reporter)
    }
}

/// Returns the name of the bank, or else a general title.
fn title(settings: &Settings) -> String {
    let name = settings.output.as_deref().and_then(Path::file_stem);
    name.map_or_else(|| "the project".to_owned(), |name| name.to_string_lossy().into_owned())
}

impl ExportRecordingScript {
    /// Writes the script, and prints a summary.
    fn deliver(
        &self,
        script: &RecordingScript,
        left_out: &str,
        mut reports: Vec<Report>,
        reporter: &mut Reporter,
    ) -> CommandResult {
        let name = console::path(&self.output);
        let bytes = match self.script_format {
            ScriptFormatArgument::Csv => Ok(script.csv()),
            ScriptFormatArgument::Html => Ok(script.page().into_bytes()),
            ScriptFormatArgument::Xlsx => script.xlsx(),
        };
        let bytes = bytes.map_err(|why| {
            let message = format!("the script does not fit into a spreadsheet: {why}");
            reporter.fail(Report::failure(name.clone(), Code::OutputFailed, message, "export it as csv or html"))
        })?;
        if have_errors(&reports) {
            return reporter.end(reports, None);
        }
        if stdio::is_meant(&self.output) {
            reporter.print_bytes(&bytes)?;
            return reporter.end(reports, None);
        }
        if !self.overwrite {
            reports.extend(in_the_way(&self.output, OVERWRITE));
        }
        let is_free = may_write(&reports);
        let file = is_free.then(|| (self.output.clone(), bytes.as_slice()));
        let written = write_all(file, &mut reports);
        let cues = script.cues();
        let words = cues.iter().map(|cues| cues.words).sum();
        let is_untranslated = |line: &&ScriptLine| line.unit.translations.first().is_some_and(Translation::is_empty);
        let untranslated = match script.lines.iter().filter(is_untranslated).count() {
            0 => String::new(),
            count => format!("; {} without a translation", console::counted(count, "line")),
        };
        let summary = format!(
            "{} with {} for {} written into {name}{untranslated}{left_out}\n",
            console::counted(script.lines.len(), "line"),
            console::counted(words, "word"),
            console::counted(cues.len(), "character")
        );
        reporter.end(reports, (!self.sources.is_quiet() && written > 0).then_some(summary))
    }
}
