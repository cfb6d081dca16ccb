//! `lipz import`: files of other tools as Lipz files.

mod options;
mod recordings;
mod report;
mod text;

use crate::Ended;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::shared::format_examples::Direction;
use crate::shared::formats;
use crate::shared::{output_file, patterns, stdio};
use crate::{Outcome, console, interrupt};
use clap::Args;
use lipz_compiler::{Content, Input, key, replace_file};
use lipz_diagnostics::{Report, Severity};
use lipz_file::format::{Style, format};
use lipz_interop::{Clip, Format, Imported, Script, import};
use options::Settings;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Import mouth shapes from files of other tools.
///
/// Each file becomes a Lipz file in the folder, named after it; a file with several speakers becomes several.
/// Closed lips, F and V keep a frame whenever there is one; lost shapes are reported. Nothing is written for files
/// with errors.
#[derive(Args, Debug)]
#[command(after_help = formats::examples(Direction::Import, |format| format.read.is_some()))]
pub(crate) struct Import {
    /// The format of the files
    #[arg(value_name = "FORMAT", value_parser = formats::parser(|format| format.read.is_some()), hide_possible_values = true)]
    tool_format: &'static Format,

    /// The files, or patterns of them; `-` reads one from standard input
    #[arg(value_name = "FILES", required = true)]
    files: Vec<PathBuf>,

    /// The folder to write into; `-` is standard output, the default for standard input
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,

    /// Replace files that exist
    #[arg(long)]
    force: bool,

    /// Write a JSON report to FILE: tables used and shapes lost, clip by clip
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,

    #[command(flatten)]
    options: options::Options,

    /// Show no summary, only diagnostics
    #[arg(short, long)]
    quiet: bool,
}

/// A clip on its way to its file.
struct Made {
    input: Input,
    clip: Clip,
}

impl Run for Import {
    fn prints_result(&self) -> bool {
        match &self.output {
            Some(output) => stdio::is_meant(output),
            None => matches!(self.files.as_slice(), [file] if stdio::is_meant(file)),
        }
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let format = self.tool_format;
        if let Some(report) = &self.report {
            output_file::refuse_source(report, reporter)?;
        }
        let is_printed = self.prints_result();
        let files = patterns::files(&self.files);
        let (folder, several) = (self.output.as_deref(), files.len() > 1);
        if (folder.is_none() && !is_printed) || (is_printed && several) {
            let message = "no output is named for the Lipz files";
            return Err(reporter.usage(message, "name a folder with `--output`"));
        }
        let settings = self.options.settings(folder.filter(|_| !is_printed), reporter)?;
        let texts = text::Texts::from_argument(self.options.text.as_deref(), several)
            .map_err(|report| reporter.fail(report))?;
        let script = self.options.recordings.script(reporter)?;
        let (made, mut reports) = read(self, &files, &settings, &texts, &script);
        let inputs: Vec<Input> = made.iter().map(|made| made.input.clone()).collect();
        key::check(&inputs, &mut reports);
        if let Some(folder) = folder.filter(|_| !is_printed && !self.force) {
            reports.extend(
                made.iter()
                    .filter_map(|made| formats::in_the_way(&formats::path(folder, &made.input.key, key::EXTENSION))),
            );
        }
        if let [only] = made.as_slice()
            && is_printed
        {
            let outcome = Outcome::from_reports(&reports);
            if outcome != Outcome::Clean {
                return Err(reporter.abort(reports, outcome));
            }
            reporter.add(reports);
            reporter.print(&layout(only, &settings))?;
            return Ok(outcome);
        }
        if is_printed && made.len() > 1 {
            let message = "the file has several speakers, and standard output takes one clip";
            return Err(reporter.usage(message, "name a folder with `--output`"));
        }
        let mut written = 0;
        if formats::may_write(&reports)
            && let Some(folder) = folder
        {
            for made in &made {
                let path = formats::path(folder, &made.input.key, key::EXTENSION);
                match interrupt::whole(|| replace_file(&path, layout(made, &settings).as_bytes())) {
                    Ok(()) => written += 1,
                    Err(report) => reports.push(report),
                }
            }
        }
        if let Some(path) = &self.report {
            let report = report::json(format, made.iter().map(|made| (&made.input, &made.clip)));
            output_file::write(path, report.as_bytes(), reporter)?;
        }
        let outcome = Outcome::from_reports(&reports);
        reporter.add(reports);
        match folder.filter(|_| !self.quiet && written > 0) {
            None => Ok(outcome),
            Some(folder) => reporter.summary(&summary(format, &made, written, folder)).map(|()| outcome),
        }
    }
}

/// Reads every file. Those with errors give no clips.
fn read(
    arguments: &Import,
    files: &[PathBuf],
    settings: &Settings<'_>,
    texts: &text::Texts,
    script: &Script,
) -> (Vec<Made>, Vec<Report>) {
    let format = arguments.tool_format;
    let (mut made, mut reports) = (Vec::new(), Vec::new());
    for file in files {
        let source = match formats::Source::read(file, format) {
            Ok(source) => source,
            Err(report) => {
                reports.push(report);
                continue;
            }
        };
        let text = match texts.of_key(&source.key) {
            Ok(text) => text,
            Err(report) => {
                reports.push(report);
                continue;
            }
        };
        let mut options = settings.import_options().text(text.as_deref());
        arguments.options.recordings.apply(file, &source.key, script, &mut options);
        let Imported { clips, mut diagnostics, .. } = import(format, &source.bytes, &options);
        settings.apply_levels(&mut diagnostics);
        let is_wrong = diagnostics.iter().any(|diagnostic| diagnostic.severity == Severity::Error);
        reports.extend(source.report(format, diagnostics));
        if !is_wrong {
            made.extend(clips.into_iter().map(|clip| {
                let key = match &clip.name {
                    Some(name) => format!("{}-{}", source.key, formats::file_name(name)),
                    None => source.key.clone(),
                };
                Made { input: Input { key, content: Content::File(file.clone()) }, clip }
            }));
        }
    }
    (made, reports)
}

/// The clip as a Lipz file in canonical layout.
fn layout(made: &Made, settings: &Settings<'_>) -> String {
    let style = Style { default_locale: settings.default_locale(), ..Style::default() };
    format(&made.clip.document, style)
}

fn summary(format: &Format, made: &[Made], written: usize, folder: &Path) -> String {
    let mut maps: Vec<&str> = made.iter().map(|made| made.clip.map.as_str()).collect();
    maps.sort_unstable();
    maps.dedup();
    let lost: usize = made.iter().map(|made| made.clip.lost.len()).sum();
    let lost =
        if lost == 0 { String::new() } else { format!(", {} without a frame", console::counted(lost, "mouth shape")) };
    let (files, tables) = (console::counted(written, "file"), maps.join(", "));
    format!(
        "{files} imported from {} into {}, by the mapping table {tables}{lost}\n{}",
        format.name,
        console::path(folder),
        remarks(made)
    )
}

/// How the files were read where there was a choice, one kind a line.
fn remarks(made: &[Made]) -> String {
    let mut files = BTreeMap::<&str, usize>::new();
    for remark in made.iter().flat_map(|made| &made.clip.remarks) {
        *files.entry(remark).or_default() += 1;
    }
    files.into_iter().map(|(remark, count)| format!("{}: {remark}\n", console::counted(count, "file"))).collect()
}
