//! `lipz convert`: Lipz files with the codes of another viseme type.

use crate::Abort;
use crate::Ended;
use crate::commands::Run;
use crate::interrupt::Files;
use crate::reporter::Reporter;
use crate::shared::project_flags::hide_of_banks;
use crate::shared::rewriting::{Rewriting, files, is_standard_input, reads_standard_input};
use crate::shared::sources::Sources;
use crate::shared::stdio;
use crate::{Outcome, console};
use clap::Args;
use lipz_bank::VisemeType;
use lipz_compiler::{Compiler, Input, Options, key};
use lipz_diagnostics::reports::count;
use lipz_diagnostics::{Code, Diagnostic, Report, Severity};
use std::path::{Path, PathBuf};

/// Convert Lipz files to another viseme type: blair to toonboom, toonboom to blair.
///
/// Only the codes and `viseme_type` change. Toon Boom's chart has no shapes for Blair's L and U; files that
/// lose them are reported. rms cannot be converted. A file from standard input is written to standard
/// output.
#[derive(Args, Debug)]
#[command(mut_args(hide_of_banks))]
#[command(after_help = "Examples:
  lipz convert voices --viseme-type toonboom -o voices-toonboom
  lipz convert voices --viseme-type blair --in-place
  lipz convert - --viseme-type blair < mayor.lipz")]
pub(crate) struct Convert {
    #[command(flatten)]
    sources: Sources,

    /// Replace the files
    #[arg(long)]
    in_place: bool,

    /// Write all files into this folder, converted or not, under their keys
    #[arg(short, long, value_name = "FOLDER", conflicts_with = "in_place")]
    output: Option<PathBuf>,
}

/// Where converted files go.
#[derive(Clone, Copy)]
enum Target<'a> {
    InPlace,
    Folder(&'a Path),
}

impl Run for Convert {
    fn prints_result(&self) -> bool {
        is_standard_input(self.sources.paths())
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let project = self.sources.project(reporter)?;
        let options = &project.settings.options;
        let Some(viseme_type) = options.get_viseme_type() else {
            let tip = "name it with `--viseme-type`, or set `viseme-type` in lipz.toml";
            return Err(reporter.usage("no viseme type to convert to is named", tip));
        };
        if reads_standard_input(&project.settings.sources, reporter)? {
            return self.standard_input(viseme_type, options, reporter);
        }
        let target = self.target(reporter)?;
        let quiet = self.sources.is_quiet();
        let (inputs, mut reports) = project.settings.discover_with_reports();
        if let Target::Folder(folder) = target {
            key::check(&inputs, &mut reports);
            reports.extend(inputs.iter().filter_map(|input| in_the_way(folder, input)));
            if !reports.is_empty() {
                let outcome = Outcome::from_reports(&reports).max(Outcome::Errors);
                return Err(reporter.abort(reports, outcome));
            }
        }
        let bar = console::progress_bar(inputs.len(), quiet);
        let compiler = Compiler::new(options.clone()).progress(|count| bar.inc(count));
        let files_to_write = Files::new();
        let results = compiler.each_file(&inputs, |input, bytes| {
            let converted = compiler.convert(bytes, viseme_type);
            let is_changed = converted.text.is_some();
            let written = match converted.diagnostics.iter().any(|diagnostic| diagnostic.severity == Severity::Error) {
                true => Ok(()),
                false => target.write(&files_to_write, input, bytes, converted.text.as_deref()),
            };
            let found = !converted.diagnostics.is_empty();
            let report = found.then(|| Report::from_bytes(input.name(), bytes, converted.diagnostics));
            (is_changed, report.into_iter().chain(written.err()).collect::<Vec<_>>())
        });
        let unwritten = files_to_write.finish();
        bar.finish_and_clear();
        let (mut changed, mut unchanged) = (0_usize, 0);
        for result in results {
            let (is_changed, of_file) = result.unwrap_or_else(|report| (false, vec![report]));
            match (count(&of_file, Severity::Error), is_changed) {
                (0, true) => changed += 1,
                (0, false) => unchanged += 1,
                _ => {}
            }
            reports.extend(of_file);
        }
        changed = changed.saturating_sub(unwritten.len());
        reports.extend(unwritten);
        let outcome = Outcome::from_reports(&reports);
        reporter.add(reports);
        if quiet || inputs.is_empty() {
            return Ok(outcome);
        }
        let (changed, unchanged) = (files(changed), console::grouped(unchanged));
        reporter.summary(&format!("{changed} converted to {viseme_type}, {unchanged} unchanged\n"))?;
        Ok(outcome)
    }
}

impl Convert {
    fn target(&self, reporter: &mut Reporter) -> Result<Target<'_>, Abort> {
        match &self.output {
            Some(folder) => Ok(Target::Folder(folder)),
            None if self.in_place => Ok(Target::InPlace),
            None => {
                let tip = "replace the files with `--in-place`, or name a folder with `--output`";
                let message = "no output is named for the converted files";
                Err(reporter.usage(message, tip))
            }
        }
    }

    /// Converts what comes from standard input.
    fn standard_input(&self, viseme_type: VisemeType, options: &Options, reporter: &mut Reporter) -> Ended {
        if self.in_place || self.output.is_some() {
            let tip = "leave out `--in-place` and `--output`";
            let message = "a file from standard input is converted to standard output";
            return Err(reporter.usage(message, tip));
        }
        let bytes = stdio::lipz_bytes().map_err(|report| reporter.fail(report))?;
        let converted = Compiler::new(options.clone()).convert(&bytes, viseme_type);
        let report = Report::from_bytes(stdio::input_name(), &bytes, converted.diagnostics);
        let has_errors = report.has_errors();
        if has_errors {
            return Err(reporter.refuse(vec![report]));
        }
        reporter.add(vec![report]);
        reporter.print_bytes(converted.text.as_ref().map_or(&bytes, |text| text.as_bytes()))?;
        Ok(Outcome::Clean)
    }
}

impl Target<'_> {
    /// Writes a file, whose new text is `after` if it has one.
    fn write(self, files: &Files, input: &Input, before: &[u8], after: Option<&str>) -> Result<(), Report> {
        match (self, after) {
            (Target::Folder(folder), after) => {
                let after = after.map_or(before, str::as_bytes);
                files.replace(&output(folder, input), after)
            }
            (Target::InPlace, Some(after)) => Rewriting::InPlace.rewrite(files, input, before, after).map(|_| ()),
            (Target::InPlace, None) => Ok(()),
        }
    }
}

/// Where the converted file is written.
fn output(folder: &Path, input: &Input) -> PathBuf {
    folder.join(format!("{}.{}", input.key, key::EXTENSION))
}

/// The diagnostic for an output file that exists.
fn in_the_way(folder: &Path, input: &Input) -> Option<Report> {
    let path = output(folder, input);
    path.symlink_metadata().ok()?;
    let shown = console::path(&path);
    let diagnostic = Diagnostic::new(Code::WouldOverwrite, format!("`{shown}` exists already"));
    Some(Report::about(
        shown,
        diagnostic
            .note("nothing was written")
            .help("write into another folder, or replace the sources with --in-place"),
    ))
}
