//! `lipz convert`: converts Lipz files to a different viseme type, or adds the curves of their texts.

mod curves;
mod generated_curve;

use crate::Abort;
use crate::CommandResult;
use crate::commands::Run;
use crate::interrupt::Files;
use crate::reporter::Reporter;
use crate::shared::formats::path;
use crate::shared::output_file::in_the_way;
use crate::shared::rewrite_mode::{RewriteMode, files, is_standard_input, reads_standard_input};
use crate::shared::sources::Sources;
use crate::shared::stdin_file::StdinFile;
use crate::shared::stdio;
use crate::shared::values::parse_viseme_type;
use crate::{Outcome, console};
use clap::Args;
use lipz_bank::VisemeType;
use lipz_compiler::{Compiler, Input, Options, key};
use lipz_diagnostics::reports::count;
use lipz_diagnostics::{Diagnostic, Report, Severity};
use std::path::{Path, PathBuf};

/// Convert Lipz files to a different viseme type, or write their curves.
///
/// --viseme-type changes the visemes and `viseme_type`. Toon Boom's chart does not contain Blair's L and U, so lipz
/// reports files that lose them. rms cannot be converted.
///
/// --write-curves writes the curves that lipz generates from texts and events, to be edited: emotions, and with `keys` in
/// [face], gestures (docs/guides/faces.md). It never changes curves that a file already has. To have a curve generated
/// again, delete it from the file. Generated motion is written only if you name it: blink, headPitch, headYaw, headRoll,
/// eyePitch, eyeYaw. Prefix the name of a different character, as in mara.blink.
///
/// A file from standard input is written to standard output.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz convert voices --viseme-type toonboom -o voices-toonboom
  lipz convert voices --viseme-type blair --in-place
  lipz convert - --viseme-type blair < mayor.lipz
  lipz convert voices --write-curves --diff
  lipz convert voices --write-curves=nod,blink --in-place --config face.keys=words")]
pub(crate) struct Convert {
    #[command(flatten)]
    sources: Sources,

    #[command(flatten)]
    stdin: StdinFile,

    /// Viseme type to convert to: blair, toonboom [default: `viseme-type` of lipz.toml]
    #[arg(long, value_name = "TYPE", value_parser = parse_viseme_type, conflicts_with = "write_curves")]
    viseme_type: Option<VisemeType>,

    /// Write generated curves, all or those with these names
    #[arg(long, value_name = "CURVES", value_delimiter = ',', num_args = 0.., require_equals = true)]
    write_curves: Option<Vec<String>>,

    /// Replace the files
    #[arg(long)]
    in_place: bool,

    /// List the files that would change, and write nothing; exit code 1 if any
    #[arg(long, conflicts_with_all = ["in_place", "output", "diff"])]
    check: bool,

    /// Show the changes as a unified diff, and write nothing; exit code 1 if any
    #[arg(long, conflicts_with_all = ["in_place", "output"])]
    diff: bool,

    /// Write all files into this folder, converted or not, under their keys
    #[arg(short, long, value_name = "FOLDER", conflicts_with_all = ["in_place", "write_curves"])]
    output: Option<PathBuf>,
}

/// The destination of converted files.
#[derive(Clone, Copy)]
enum ConversionTarget<'a> {
    /// In place, or nowhere.
    Sources(RewriteMode),
    Folder(&'a Path),
}

impl Run for Convert {
    fn prints_result(&self) -> bool {
        self.check || self.diff || is_standard_input(self.sources.paths())
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        self.stdin.apply(self.sources.paths(), reporter)?;
        let project = self.sources.project(reporter)?;
        if let Some(names) = &self.write_curves {
            return curves::run(self, names, project, reporter);
        }
        let options = &project.settings.options;
        let Some(viseme_type) = self.viseme_type.or(options.get_viseme_type()) else {
            let tip = "name it with `--viseme-type`, or set `viseme-type` in lipz.toml";
            return Err(reporter.usage("the target viseme type is not set", tip));
        };
        if reads_standard_input(&project.settings.sources, reporter)? {
            return self.standard_input(viseme_type, options, reporter);
        }
        let target = self.target(reporter)?;
        let quiet = self.sources.is_quiet();
        let (inputs, mut reports) = project.settings.discover_with_reports();
        if let Some(outcome) = target.refusal(&inputs, &mut reports) {
            return Err(reporter.abort(reports, outcome));
        }
        let bar = console::progress_bar(inputs.len(), quiet);
        let compiler = Compiler::new(options.clone()).progress(|count| bar.inc(count));
        let files_to_write = Files::new();
        let results = compiler.each_file(&inputs, |input, bytes| {
            let converted = compiler.convert(bytes, viseme_type);
            let is_changed = converted.text.is_some();
            let written = match converted.diagnostics.iter().any(Diagnostic::is_error) {
                true => Ok(String::new()),
                false => target.write(&files_to_write, input, bytes, converted.text.as_deref()),
            };
            let found = !converted.diagnostics.is_empty();
            let report = found.then(|| Report::from_bytes(input.name(), bytes, converted.diagnostics));
            let (shown, unwritten) = written.map_or_else(|report| (String::new(), Some(report)), |shown| (shown, None));
            (is_changed, shown, report.into_iter().chain(unwritten).collect::<Vec<_>>())
        });
        let unwritten = files_to_write.finish();
        bar.finish_and_clear();
        let (mut changed, mut unchanged, mut shown) = (0_usize, 0, String::new());
        for result in results {
            let (is_changed, of_shown, of_file) = result.unwrap_or_else(|report| (false, String::new(), vec![report]));
            match (count(&of_file, Severity::Error), is_changed) {
                (0, true) => {
                    changed += 1;
                    shown.push_str(&of_shown);
                }
                (0, false) => unchanged += 1,
                _ => {}
            }
            reports.extend(of_file);
        }
        changed = changed.saturating_sub(unwritten.len());
        reports.extend(unwritten);
        let mut outcome = Outcome::from_reports(&reports);
        reporter.add(reports);
        let (counted, unchanged) = (files(changed), console::grouped(unchanged));
        if self.check || self.diff {
            if changed > 0 {
                outcome = outcome.max(Outcome::Errors);
            }
            reporter.print(&shown)?;
            if !quiet && !inputs.is_empty() {
                reporter.remark(&format!("{counted} would be converted to {viseme_type}, {unchanged} unchanged\n"));
            }
            return Ok(outcome);
        }
        if !quiet && !inputs.is_empty() {
            reporter.summary(&format!("{counted} converted to {viseme_type}, {unchanged} unchanged\n"))?;
        }
        Ok(outcome)
    }
}

impl Convert {
    fn target(&self, reporter: &mut Reporter) -> Result<ConversionTarget<'_>, Abort> {
        match &self.output {
            Some(folder) => Ok(ConversionTarget::Folder(folder)),
            None => self.rewriting(reporter).map(ConversionTarget::Sources),
        }
    }

    /// Returns whether to rewrite, check or diff the sources.
    fn rewriting(&self, reporter: &mut Reporter) -> Result<RewriteMode, Abort> {
        match self {
            Convert { diff: true, .. } => Ok(RewriteMode::Diff),
            Convert { check: true, .. } => Ok(RewriteMode::Nothing),
            Convert { in_place: true, .. } => Ok(RewriteMode::InPlace),
            _ => {
                let tip =
                    "replace the files with `--in-place`, show changes with `--diff`, or name a folder with `--output`";
                Err(reporter.usage("no output is named for the converted files", tip))
            }
        }
    }

    /// Converts standard input.
    fn standard_input(&self, viseme_type: VisemeType, options: &Options, reporter: &mut Reporter) -> CommandResult {
        let rewriting = self.rewriting_standard_input(reporter)?;
        let bytes = stdio::lipz_bytes().map_err(|report| reporter.fail(report))?;
        let converted = Compiler::new(options.clone()).convert(&bytes, viseme_type);
        let report = Report::from_bytes(stdio::input_name(), &bytes, converted.diagnostics);
        let has_errors = report.has_errors();
        if has_errors {
            return Err(reporter.refuse(vec![report]));
        }
        reporter.add(vec![report]);
        match (&converted.text, rewriting) {
            (Some(after), _) => {
                reporter.print_bytes(rewriting.shown(&stdio::input_name(), &bytes, after).as_bytes())?;
            }
            (None, RewriteMode::InPlace) => reporter.print_bytes(&bytes)?,
            (None, _) => {}
        }
        let would_change = rewriting != RewriteMode::InPlace && converted.text.is_some();
        Ok(if would_change { Outcome::Errors } else { Outcome::Clean })
    }

    /// Returns whether to convert, check or diff standard input.
    fn rewriting_standard_input(&self, reporter: &mut Reporter) -> Result<RewriteMode, Abort> {
        if self.in_place || self.output.is_some() {
            let tip = "leave out `--in-place` and `--output`";
            return Err(reporter.usage("a file from standard input is converted to standard output", tip));
        }
        if self.check || self.diff { self.rewriting(reporter) } else { Ok(RewriteMode::InPlace) }
    }
}

impl ConversionTarget<'_> {
    /// How the run ends if not all files can be written into the folder. Adds why to the reports.
    fn refusal(self, inputs: &[Input], reports: &mut Vec<Report>) -> Option<Outcome> {
        let ConversionTarget::Folder(folder) = self else { return None };
        key::check(inputs, reports);
        let help = "write into another folder, or replace the sources with --in-place";
        reports.extend(inputs.iter().filter_map(|input| in_the_way(&path(folder, &input.key, key::EXTENSION), help)));
        (!reports.is_empty()).then(|| Outcome::from_reports(reports).max(Outcome::Errors))
    }

    /// Writes a file, whose new text is `after` if it has one.
    fn write(self, files: &Files, input: &Input, before: &[u8], after: Option<&str>) -> Result<String, Report> {
        match (self, after) {
            (ConversionTarget::Folder(folder), after) => {
                let after = after.map_or(before, str::as_bytes);
                files.replace(&path(folder, &input.key, key::EXTENSION), after).map(|()| String::new())
            }
            (ConversionTarget::Sources(rewriting), Some(after)) => rewriting.rewrite(files, input, before, after),
            (ConversionTarget::Sources(_), None) => Ok(String::new()),
        }
    }
}
