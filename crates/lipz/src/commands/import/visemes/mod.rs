//! `lipz import visemes`: imports lip-sync files of other tools as Lipz files.

mod joined;
mod options;
mod pending_clip;
mod phones;
mod recordings;
mod report;
mod summary;
mod text;

use crate::CommandResult;
use crate::Outcome;
use crate::commands::Run;
use crate::interrupt::Files;
use crate::reporter::Reporter;
use crate::shared::format_examples::Direction;
use crate::shared::formats;
use crate::shared::run_flags::QuietFlag;
use crate::shared::{patterns, stdio};
use clap::Args;
use lipz_interop::Format;
use std::path::PathBuf;

/// Import visemes from lip-sync files of other tools.
///
/// Each file becomes a Lipz file of the same name in the folder; a file with several speakers becomes several. Closed lips, F
/// and V keep at least one frame where there is room, and lipz reports lost shapes. Files with errors are not imported.
///
/// In an existing Lipz file, only visemes, viseme_type and fps change, and each `|` moves to the start of its segment. Texts,
/// translations, events, unknown elements and the layout stay.
#[derive(Args, Debug)]
#[command(after_help = formats::names(Direction::Import, |format| format.read.is_some()))]
#[command(after_long_help = formats::examples(Direction::Import, |format| format.read.is_some()))]
pub(crate) struct ImportVisemes {
    /// Format of the files
    #[arg(value_name = "FORMAT", value_parser = formats::parser(|format| format.read.is_some()), hide_possible_values = true)]
    tool_format: &'static Format,

    /// Files or patterns; `-` is standard input
    #[arg(value_name = "FILES", required = true)]
    files: Vec<PathBuf>,

    /// Folder to write into; `-` is standard output
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,

    /// Folder below which files keep their paths
    #[arg(long, value_name = "FOLDER")]
    root: Option<PathBuf>,

    /// Replace whole Lipz files, and report lost texts and other elements
    #[arg(long)]
    overwrite: bool,

    #[command(flatten)]
    options: options::Options,

    #[command(flatten)]
    quiet: QuietFlag,
}

impl Run for ImportVisemes {
    fn prints_result(&self) -> bool {
        match &self.output {
            Some(output) => stdio::is_meant(output),
            None => matches!(self.files.as_slice(), [file] if stdio::is_meant(file)),
        }
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let is_printed = self.prints_result();
        let files = patterns::files(&self.files);
        let (output, several) = (self.output.as_deref(), files.len() > 1);
        if (output.is_none() && !is_printed) || (is_printed && several) {
            let message = "no output is named for the Lipz files";
            return Err(reporter.usage(message, "name a folder with `--output`"));
        }
        let folder = output.filter(|_| !is_printed);
        let settings = self.options.settings(&self.files, folder, reporter)?;
        let mut reports = Vec::new();
        let texts = self.options.recordings.texts(several, &mut reports).map_err(|report| reporter.fail(report))?;
        let script = self.options.recordings.script(reporter)?;
        let made = pending_clip::read(self, &files, folder, &settings, &texts, &script, &mut reports);
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
                    let message = "the file has several speakers, but standard output takes one clip";
                    Err(reporter.usage(message, "name a folder with `--output`"))
                }
            };
        };
        let mut places = Vec::new();
        let files = Files::new();
        for made in &made {
            match made.write(&files, self.overwrite, folder, &settings, &mut reports) {
                Ok(place) => places.push((made.output(folder).name(), place)),
                Err(report) => reports.push(report),
            }
        }
        let unwritten = files.finish();
        let mut written = summary::WrittenCounts::default();
        for (_, place) in places.iter().filter(|(name, _)| unwritten.iter().all(|report| report.source.path != *name)) {
            written.add(*place);
        }
        reports.extend(unwritten);
        reporter.add_result("import", || {
            report::ImportDocument::new(self.tool_format, made.iter().map(|made| (&made.input, &made.clip)))
        });
        let outcome = Outcome::from_reports(&reports);
        reporter.add(reports);
        if self.quiet.is_set() || written.is_nothing() {
            return Ok(outcome);
        }
        reporter.summary(&summary::summary(self.tool_format, &made, &written, folder)).map(|()| outcome)
    }
}
