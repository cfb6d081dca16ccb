//! `lipz export visemes`: exports Lipz files as lip-sync files for other tools.

use crate::CommandResult;
use crate::commands::Run;
use crate::interrupt::Files;
use crate::reporter::Reporter;
use crate::shared::format_examples::Direction;
use crate::shared::formats;
use crate::shared::inputs::find;
use crate::shared::output_file::{OVERWRITE, in_the_way, may_write};
use crate::shared::sources::Sources;
use crate::shared::stdin_file::StdinFile;
use crate::shared::stdio;
use crate::{Outcome, console};
use clap::Args;
use lipz_compiler::{Compiler, Input, Options, key};
use lipz_diagnostics::{Diagnostic, Report};
use lipz_interop::{ExportOptions, ExportResult, Format, Map, export};
use lipz_sync::GridExport;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Export visemes to lip-sync files of other tools.
///
/// Each Lipz file becomes a file in the folder, named after its key. The formats store only times and mouth shapes. The
/// summary lists the elements that are left out.
#[derive(Args, Debug)]
#[command(after_help = formats::names(Direction::Export, |format| format.write.is_some()))]
#[command(after_long_help = formats::examples(Direction::Export, |format| format.write.is_some()))]
pub(crate) struct ExportVisemes {
    /// Format to write
    #[arg(value_name = "FORMAT", value_parser = formats::parser(|format| format.write.is_some()), hide_possible_values = true)]
    tool_format: &'static Format,

    #[command(flatten)]
    sources: Sources,

    #[command(flatten)]
    stdin: StdinFile,

    /// Folder to write into; a file from standard input is written to standard output
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,

    /// Mapping table, by its name or as a file [default: that of the format]
    #[arg(long, value_name = "NAME|FILE")]
    map: Option<String>,

    /// First frame number of Moho files: 0 or 1
    #[arg(long, value_name = "NUMBER", default_value_t = 1, value_parser = clap::value_parser!(u64).range(0..=1))]
    dat_base: u64,

    /// Replace existing files
    #[arg(long)]
    overwrite: bool,
}

/// The result for one file.
struct ExportedVisemes {
    exported: ExportResult,
    report: Option<Report>,
    /// Whether it contains the times of words and phones.
    has_words: bool,
    has_phones: bool,
}

impl Run for ExportVisemes {
    fn prints_result(&self) -> bool {
        self.output.is_none()
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let format = self.tool_format;
        self.stdin.apply(self.sources.paths(), reporter)?;
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
        if let Some(folder) = self.output.as_deref().filter(|_| !self.overwrite) {
            let path = |input: &Input| formats::path(folder, &input.key, format.extension);
            reports.extend(inputs.iter().filter_map(|input| in_the_way(&path(input), OVERWRITE)));
        }
        if !may_write(&reports) {
            return Err(reporter.refuse(reports));
        }
        let map = map.as_ref().map(formats::MapChoice::map);
        let said = match format.name {
            "textgrid" => GridExport::new(&project.settings, &inputs).map_err(|report| reporter.fail(report))?,
            _ => None,
        };
        let made = Work { format, options, map, dat_base: self.dat_base, said };
        let results = Compiler::new(options.clone()).each_file(&inputs, |input, bytes| made.one(input, bytes));
        let files = Files::new();
        let (mut written, mut left_out, mut said) = (0, BTreeSet::new(), (0, 0));
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
            said = (said.0 + usize::from(made.has_words), said.1 + usize::from(made.has_phones));
            match &self.output {
                None => {
                    reporter.add(reports);
                    reporter.print_bytes(&bytes)?;
                    return Ok(Outcome::Clean);
                }
                Some(folder) => match files.replace(&formats::path(folder, &input.key, format.extension), &bytes) {
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
            Some(folder) => reporter.summary(&summary(format, written, folder, &left_out, said)).map(|()| outcome),
        }
    }
}

/// Data shared by all files of a run.
struct Work<'a> {
    format: &'a Format,
    options: &'a Options,
    map: Option<&'a Map>,
    dat_base: u64,
    /// The times of words and phones, for formats that can store them.
    said: Option<GridExport<'a>>,
}

impl Work<'_> {
    /// Exports one Lipz file.
    fn one(&self, input: &Input, bytes: &[u8]) -> ExportedVisemes {
        let parsed = lipz_file::parse(bytes);
        let mut diagnostics = parsed.diagnostics;
        let said = self.said.as_ref().map(|said| said.of(input)).unwrap_or_default();
        let (has_words, has_phones) = (said.words.is_some(), said.phones.is_some());
        let tiers: Vec<_> = said.words.into_iter().chain(said.phones).collect();
        let export_options = ExportOptions::new()
            .map(self.map)
            .default_rate(self.options.get_default_fps().map(formats::rate))
            .default_viseme_type(self.options.get_default_viseme_type())
            .dat_base(self.dat_base)
            .name(input.key.rsplit('/').next())
            .tiers(&tiers);
        let mut exported =
            parsed.document.map(|document| export(self.format, &document, &export_options)).unwrap_or_default();
        diagnostics.append(&mut exported.diagnostics);
        self.options.get_levels().apply(&mut diagnostics);
        if diagnostics.iter().any(Diagnostic::is_error) {
            exported.bytes = None;
        }
        let report = (!diagnostics.is_empty()).then(|| Report::from_bytes(input.name(), bytes, diagnostics));
        ExportedVisemes { exported, report, has_words, has_phones }
    }
}

fn summary(
    format: &Format,
    written: usize,
    folder: &Path,
    left_out: &BTreeSet<&str>,
    (words, phones): (usize, usize),
) -> String {
    let files = console::counted(written, "file");
    let left_out = match left_out.is_empty() {
        true => String::new(),
        false => format!("; the format cannot store {}", left_out.iter().copied().collect::<Vec<_>>().join(", ")),
    };
    let said = match (words, phones) {
        (0, 0) => String::new(),
        (words, phones) => format!("; {words} with words, {phones} with phones"),
    };
    format!("{files} exported to {} in {}{said}{left_out}\n", format.name, console::path(folder))
}
