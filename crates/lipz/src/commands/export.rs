//! `lipz export`: Lipz files as files of other tools.

use crate::Ended;
use crate::commands::Run;
use crate::interrupt::Files;
use crate::reporter::Reporter;
use crate::shared::format_examples::Direction;
use crate::shared::formats;
use crate::shared::inputs::find;
use crate::shared::sources::Sources;
use crate::shared::stdio;
use crate::{Outcome, console};
use clap::Args;
use lipz_compiler::{Compiler, Input, Options, key};
use lipz_diagnostics::{Diagnostic, Report, Severity};
use lipz_interop::{ExportOptions, Exported, Format, Map, export};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Export mouth shapes to files of other tools.
///
/// Each Lipz file becomes a file in the folder, named by its key. The formats have times and shapes; the
/// summary names what they leave out.
#[derive(Args, Debug)]
#[command(after_help = formats::examples(Direction::Export, |format| format.write.is_some()))]
pub(crate) struct Export {
    /// The format to write
    #[arg(value_name = "FORMAT", value_parser = formats::parser(|format| format.write.is_some()), hide_possible_values = true)]
    tool_format: &'static Format,

    #[command(flatten)]
    sources: Sources,

    /// The folder to write into; a file from standard input is written to standard output
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,

    /// Mapping table to use instead of the format's: a name that `lipz maps` lists, or a file
    #[arg(long, value_name = "NAME|FILE")]
    map: Option<String>,

    /// Number of the first frame in Moho files: 0 or 1
    #[arg(long, value_name = "NUMBER", default_value_t = 1, value_parser = clap::value_parser!(u64).range(0..=1))]
    dat_base: u64,

    /// Replace files that exist
    #[arg(long)]
    force: bool,
}

/// How one file fared.
struct Made {
    exported: Exported,
    report: Option<Report>,
}

impl Run for Export {
    fn prints_result(&self) -> bool {
        self.output.is_none()
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let format = self.tool_format;
        let project = self.sources.project(reporter)?;
        let options = &project.settings.options;
        let map = self.map.as_deref().map(|map| formats::map(map, reporter)).transpose()?;
        let (inputs, mut reports) = find(&project.settings);
        let is_printed = matches!(project.settings.sources.as_slice(), [only] if stdio::is_meant(only));
        if self.output.is_none() && !is_printed {
            let message = "no output is named";
            return Err(reporter.usage(message, "name a folder with `--output`"));
        }
        key::check(&inputs, &mut reports);
        if let Some(folder) = self.output.as_deref().filter(|_| !self.force) {
            let path = |input: &Input| formats::path(folder, &input.key, format.extension);
            reports.extend(inputs.iter().filter_map(|input| formats::in_the_way(&path(input))));
        }
        if !formats::may_write(&reports) {
            return Err(reporter.refuse(reports));
        }
        let map = map.as_ref().map(formats::MapChoice::map);
        let results = Compiler::new(options.clone())
            .each_file(&inputs, |input, bytes| one(format, input, bytes, options, (map, self.dat_base)));
        let files = Files::new();
        let (mut written, mut left_out) = (0, BTreeSet::new());
        for (input, result) in inputs.iter().zip(results) {
            let made = match result {
                Ok(made) => made,
                Err(report) => {
                    reports.push(report);
                    continue;
                }
            };
            reports.extend(made.report);
            let Some(bytes) = made.exported.bytes else { continue };
            left_out.extend(made.exported.left_out);
            match &self.output {
                None => {
                    reporter.add(reports);
                    reporter.print_bytes(&bytes)?;
                    return Ok(Outcome::Clean);
                }
                Some(folder) => match write(&files, folder, input, format, &bytes) {
                    Ok(()) => written += 1,
                    Err(report) => reports.push(report),
                },
            }
        }
        let unwritten = files.finish();
        written -= unwritten.len();
        reports.extend(unwritten);
        let outcome = Outcome::from_reports(&reports);
        reporter.add(reports);
        match self.output.as_deref().filter(|_| !self.sources.is_quiet() && written > 0) {
            None => Ok(outcome),
            Some(folder) => reporter.summary(&summary(format, written, folder, &left_out)).map(|()| outcome),
        }
    }
}

/// Exports one Lipz file.
fn one(format: &Format, input: &Input, bytes: &[u8], options: &Options, (map, dat_base): (Option<&Map>, u64)) -> Made {
    let parsed = lipz_file::parse(bytes);
    let mut diagnostics = parsed.diagnostics;
    let export_options = ExportOptions::new()
        .map(map)
        .default_rate(options.default_fps.map(formats::rate))
        .default_viseme_type(options.default_viseme_type)
        .dat_base(dat_base)
        .name(input.key.rsplit('/').next());
    let mut exported = parsed.document.map(|document| export(format, &document, &export_options)).unwrap_or_default();
    diagnostics.append(&mut exported.diagnostics);
    options.levels.apply(&mut diagnostics);
    if has_errors(&diagnostics) {
        exported.bytes = None;
    }
    let report = (!diagnostics.is_empty()).then(|| Report::from_bytes(input.name(), bytes, diagnostics));
    Made { exported, report }
}

fn has_errors(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|diagnostic| diagnostic.severity == Severity::Error)
}

fn write(files: &Files, folder: &Path, input: &Input, format: &Format, bytes: &[u8]) -> Result<(), Report> {
    files.replace(&formats::path(folder, &input.key, format.extension), bytes)
}

fn summary(format: &Format, written: usize, folder: &Path, left_out: &BTreeSet<&str>) -> String {
    let files = console::counted(written, "file");
    let left_out = match left_out.is_empty() {
        true => String::new(),
        false => format!("; the format has no place for {}", left_out.iter().copied().collect::<Vec<_>>().join(", ")),
    };
    format!("{files} exported to {} in {}{left_out}\n", format.name, console::path(folder))
}
