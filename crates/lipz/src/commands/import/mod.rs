//! `lipz import`: files of other tools as Lipz files.

mod joined;
mod made;
mod options;
mod phones;
mod recordings;
mod report;
mod summary;
mod text;

use crate::Ended;
use crate::Outcome;
use crate::commands::Run;
use crate::interrupt::Files;
use crate::reporter::Reporter;
use crate::shared::format_examples::Direction;
use crate::shared::formats;
use crate::shared::{output_file, patterns, stdio};
use clap::Args;
use lipz_interop::Format;
use std::path::PathBuf;

/// Import mouth shapes from files of other tools.
///
/// Each file becomes a Lipz file in the folder, named after it; a file with several speakers becomes several.
/// Closed lips, F and V keep a frame whenever there is one; lost shapes are reported. Nothing is written for files
/// with errors.
///
/// A Lipz file that exists gets the new mouth (visemes, viseme_type, fps) and keeps everything else: texts,
/// translations, events, unknown elements, its layout. Its `|` move to where the segments start in the new mouth.
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

    /// Folder below which files keep their folders: FOLDER/act1/mayor.tsv becomes act1/mayor.lipz
    #[arg(long, value_name = "FOLDER")]
    root: Option<PathBuf>,

    /// Replace Lipz files that exist, instead of only their mouths; reports which texts and other elements are lost
    #[arg(long)]
    replace: bool,

    /// Accepted as with other commands, and without effect: existing files keep their texts
    #[arg(long, hide = true, conflicts_with = "replace")]
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

impl Run for Import {
    fn prints_result(&self) -> bool {
        match &self.output {
            Some(output) => stdio::is_meant(output),
            None => matches!(self.files.as_slice(), [file] if stdio::is_meant(file)),
        }
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        if let Some(report) = &self.report {
            output_file::refuse_source(report, reporter)?;
        }
        let is_printed = self.prints_result();
        let files = patterns::files(&self.files);
        let (output, several) = (self.output.as_deref(), files.len() > 1);
        if (output.is_none() && !is_printed) || (is_printed && several) {
            let message = "no output is named for the Lipz files";
            return Err(reporter.usage(message, "name a folder with `--output`"));
        }
        let folder = output.filter(|_| !is_printed);
        let settings = self.options.settings(folder, reporter)?;
        let mut reports = Vec::new();
        let encoding = self.options.recordings.encoding;
        let texts = text::Texts::from_argument(self.options.text.as_deref(), several, encoding, &mut reports)
            .map_err(|report| reporter.fail(report))?;
        let script = self.options.recordings.script(reporter)?;
        let made = made::read(self, &files, folder, &settings, &texts, &script, &mut reports);
        let Some(folder) = folder else {
            return match made.as_slice() {
                [only] if Outcome::from_reports(&reports) == Outcome::Clean => {
                    reporter.add(reports);
                    reporter.print(&only.layout(&settings))?;
                    Ok(Outcome::Clean)
                }
                [] | [_] => {
                    let outcome = Outcome::from_reports(&reports);
                    Err(reporter.abort(reports, outcome))
                }
                _ => {
                    let message = "the file has several speakers, and standard output takes one clip";
                    Err(reporter.usage(message, "name a folder with `--output`"))
                }
            };
        };
        let mut written = summary::Written::default();
        let files = Files::new();
        for made in &made {
            match made.write(&files, self.replace, folder, &settings, &mut reports) {
                Ok(place) => written.add(place),
                Err(report) => reports.push(report),
            }
        }
        reports.extend(files.finish());
        if let Some(path) = &self.report {
            let report = report::json(self.tool_format, made.iter().map(|made| (&made.input, &made.clip)));
            output_file::write(path, report.as_bytes(), reporter)?;
        }
        let outcome = Outcome::from_reports(&reports);
        reporter.add(reports);
        if self.quiet || written.is_nothing() {
            return Ok(outcome);
        }
        reporter.summary(&summary::summary(self.tool_format, &made, &written, folder)).map(|()| outcome)
    }
}
