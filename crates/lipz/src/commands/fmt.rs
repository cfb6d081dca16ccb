//! `lipz fmt`: formats Lipz files in their canonical layout.

use crate::CommandResult;
use crate::commands::Run;
use crate::interrupt::Files;
use crate::reporter::Reporter;
use crate::shared::rewrite_mode::{RewriteMode, files, is_standard_input, reads_standard_input};
use crate::shared::run_flags::{JobsFlag, QuietFlag};
use crate::shared::settings_file::{Project, SettingsFile};
use crate::shared::stdin_file::StdinFile;
use crate::shared::stdio;
use crate::{Outcome, console};
use clap::Args;
use lipz_compiler::Compiler;
use lipz_diagnostics::Report;
use lipz_file::format::{LineEnding, Style, format};
use std::path::PathBuf;

/// Format Lipz files in their canonical layout, without changing their meaning.
///
/// Writes one element per line: visemes, texts, events, viseme_type, fps, then other elements. Spaces at the ends of segments
/// align each `|`. Files that are not JSON are reported and left unchanged.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz fmt voices
  lipz fmt --check voices
  lipz fmt - < mayor.lipz")]
pub(crate) struct Fmt {
    /// Folders, files or patterns; `-` formats standard input [default: those of lipz.toml]
    #[arg(value_name = "SOURCES")]
    sources: Vec<PathBuf>,

    #[command(flatten)]
    file: SettingsFile,

    #[command(flatten)]
    stdin: StdinFile,

    /// List the files that would change, and write nothing; exit code 1 if any
    #[arg(long, conflicts_with = "diff")]
    check: bool,

    /// Show the changes as a unified diff, and write nothing; exit code 1 if any
    #[arg(long)]
    diff: bool,

    #[command(flatten)]
    jobs: JobsFlag,

    #[command(flatten)]
    quiet: QuietFlag,
}

impl Run for Fmt {
    fn prints_result(&self) -> bool {
        self.rewriting() != RewriteMode::InPlace || is_standard_input(&self.sources)
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        self.stdin.apply(&self.sources, reporter)?;
        let Project { mut settings, .. } = self.file.project(&self.sources, reporter)?;
        settings.options = std::mem::take(&mut settings.options).threads(self.jobs.threads());
        let default_locale = settings.options.get_default_locale();
        if reads_standard_input(&settings.sources, reporter)? {
            return standard_input(self, default_locale, reporter);
        }
        let (inputs, mut reports) = settings.discover_with_reports();
        let bar = console::progress_bar(inputs.len(), self.quiet.is_set());
        let compiler = Compiler::new(settings.options.clone()).progress(|count| bar.inc(count));
        let files_to_write = Files::new();
        let results = compiler.each_file(&inputs, |input, bytes| {
            let after = formatted(&input.name(), bytes, default_locale)?;
            if after.as_bytes() == bytes {
                return Ok(None);
            }
            self.rewriting().rewrite(&files_to_write, input, bytes, &after).map(Some)
        });
        let unwritten = files_to_write.finish();
        bar.finish_and_clear();
        let (mut changed, mut unchanged, mut shown) = (0, 0, String::new());
        for result in results {
            match result.and_then(|result| result) {
                Ok(None) => unchanged += 1,
                Ok(Some(difference)) => {
                    changed += 1;
                    shown.push_str(&difference);
                }
                Err(report) => reports.push(report),
            }
        }
        changed -= unwritten.len();
        reports.extend(unwritten);
        let outcome = Outcome::from_reports(&reports);
        reporter.add(reports);
        let summary = |what| format!("{} {what}, {} unchanged\n", files(changed), console::grouped(unchanged));
        match self.rewriting() {
            _ if self.quiet.is_set() || inputs.is_empty() => {}
            RewriteMode::InPlace => shown.push_str(&summary("formatted")),
            RewriteMode::Nothing | RewriteMode::Diff => reporter.remark(&summary("would change")),
        }
        if self.prints_result() {
            reporter.print(&shown)?;
        } else {
            reporter.summary(&shown)?;
        }
        let checked =
            if self.rewriting() != RewriteMode::InPlace && changed > 0 { Outcome::Errors } else { Outcome::Clean };
        Ok(outcome.max(checked))
    }
}

impl Fmt {
    fn rewriting(&self) -> RewriteMode {
        match (self.diff, self.check) {
            (true, _) => RewriteMode::Diff,
            (false, true) => RewriteMode::Nothing,
            (false, false) => RewriteMode::InPlace,
        }
    }
}

/// Formats standard input.
fn standard_input(arguments: &Fmt, default_locale: Option<&str>, reporter: &mut Reporter) -> CommandResult {
    let formatted = stdio::lipz_bytes()
        .and_then(|before| formatted(&stdio::input_name(), &before, default_locale).map(|after| (before, after)));
    match formatted {
        Ok((before, after)) => {
            let rewriting = arguments.rewriting();
            let is_changed = after.as_bytes() != before;
            if rewriting == RewriteMode::InPlace || is_changed {
                reporter.print(&rewriting.shown(&stdio::input_name(), &before, &after))?;
            }
            Ok(if rewriting != RewriteMode::InPlace && is_changed { Outcome::Errors } else { Outcome::Clean })
        }
        Err(report) => {
            let outcome = Outcome::from_reports(std::slice::from_ref(&report));
            Err(reporter.abort(vec![report], outcome))
        }
    }
}

/// Returns the file in canonical layout.
fn formatted(name: &str, bytes: &[u8], default_locale: Option<&str>) -> Result<String, Report> {
    let parsed = lipz_file::parse(bytes);
    let Some(document) = parsed.document else { return Err(Report::from_bytes(name, bytes, parsed.diagnostics)) };
    let line_ending = LineEnding::detect(&String::from_utf8_lossy(bytes));
    Ok(format(&document, Style { default_locale, line_ending }))
}
