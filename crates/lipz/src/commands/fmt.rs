//! `lipz fmt`: Lipz files in their canonical layout.

use crate::Ended;
use crate::commands::Run;
use crate::interrupt::Files;
use crate::reporter::Reporter;
use crate::shared::project_flags::parse_locale;
use crate::shared::rewriting::{Rewriting, diff, files, is_standard_input, reads_standard_input};
use crate::shared::settings_file::{Project, SettingsFile};
use crate::shared::sources::PROJECT;
use crate::shared::stdio;
use crate::{Outcome, console};
use clap::Args;
use lipz_compiler::Compiler;
use lipz_diagnostics::{Report, escape};
use lipz_file::format::{LineEnding, Style, format};
use std::path::PathBuf;

/// Format Lipz files in their canonical layout, without changing their meaning.
///
/// One element per line: visemes, texts, events, viseme_type, fps, then elements unknown to the format.
/// Spaces at the ends of segments align the `|` of all elements. Files that are not JSON are reported and
/// left unchanged.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz fmt voices
  lipz fmt --check voices
  lipz fmt - < mayor.lipz")]
pub(crate) struct Fmt {
    /// Folders, files or glob patterns; `-` formats standard input to standard output [default: those of
    /// lipz.toml]
    #[arg(value_name = "SOURCES")]
    sources: Vec<PathBuf>,

    #[command(flatten)]
    file: SettingsFile,

    /// Read hidden files and folders, too: those whose names start with a dot
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true",
          help_heading = PROJECT)]
    hidden: Option<bool>,

    /// List the files that would change, and write nothing; exit code 1 if there are any
    #[arg(long)]
    check: bool,

    /// Show what would change as a unified diff, and write nothing; exit code 1 if anything would
    #[arg(long)]
    diff: bool,

    /// The locale whose text comes first [default: the project's, else that of the first text]
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale, help_heading = PROJECT)]
    default_locale: Option<String>,

    /// Threads to use [default: one per core]
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,

    /// Show no progress and no summary, only diagnostics, files and differences
    #[arg(short, long)]
    quiet: bool,
}

impl Run for Fmt {
    fn prints_result(&self) -> bool {
        self.rewriting() != Rewriting::InPlace || is_standard_input(&self.sources)
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        let Project { mut settings, .. } = self.file.project(&self.sources, reporter)?;
        settings.options = std::mem::take(&mut settings.options).threads(self.threads.map(usize::from));
        settings.hidden = self.hidden.unwrap_or(settings.hidden);
        let default_locale = self.default_locale.as_deref().or(settings.options.get_default_locale());
        if reads_standard_input(&settings.sources, reporter)? {
            return standard_input(self, default_locale, reporter);
        }
        let (inputs, mut reports) = settings.discover_with_reports();
        let bar = console::progress_bar(inputs.len(), self.quiet);
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
        for (input, result) in std::iter::zip(&inputs, results) {
            match result.and_then(|result| result) {
                Ok(None) => unchanged += 1,
                Ok(Some(difference)) => {
                    changed += 1;
                    if self.check {
                        shown.push_str(&escape::text(&input.name()));
                        shown.push('\n');
                    }
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
            _ if self.quiet || inputs.is_empty() => {}
            Rewriting::InPlace => shown.push_str(&summary("formatted")),
            Rewriting::Nothing | Rewriting::Diff => reporter.remark(&summary("would change")),
        }
        if self.prints_result() {
            reporter.print(&shown)?;
        } else {
            reporter.summary(&shown)?;
        }
        let checked =
            if self.rewriting() != Rewriting::InPlace && changed > 0 { Outcome::Errors } else { Outcome::Clean };
        Ok(outcome.max(checked))
    }
}

impl Fmt {
    fn rewriting(&self) -> Rewriting {
        match (self.diff, self.check) {
            (true, _) => Rewriting::Diff,
            (false, true) => Rewriting::Nothing,
            (false, false) => Rewriting::InPlace,
        }
    }
}

/// Formats what comes from standard input.
fn standard_input(arguments: &Fmt, default_locale: Option<&str>, reporter: &mut Reporter) -> Ended {
    let formatted = stdio::lipz_bytes()
        .and_then(|before| formatted(&stdio::input_name(), &before, default_locale).map(|after| (before, after)));
    match formatted {
        Ok((before, after)) => {
            match arguments.rewriting() {
                Rewriting::InPlace => reporter.print(&after)?,
                Rewriting::Diff => reporter.print(&diff(&stdio::input_name(), &before, &after))?,
                Rewriting::Nothing => {}
            }
            let differs = arguments.rewriting() != Rewriting::InPlace && after.as_bytes() != before;
            Ok(if differs { Outcome::Errors } else { Outcome::Clean })
        }
        Err(report) => {
            let outcome = Outcome::from_reports(std::slice::from_ref(&report));
            Err(reporter.abort(vec![report], outcome))
        }
    }
}

/// The file in canonical layout, or why it cannot be read.
fn formatted(name: &str, bytes: &[u8], default_locale: Option<&str>) -> Result<String, Report> {
    let parsed = lipz_file::parse(bytes);
    let Some(document) = parsed.document else { return Err(Report::from_bytes(name, bytes, parsed.diagnostics)) };
    let line_ending = LineEnding::detect(&String::from_utf8_lossy(bytes));
    Ok(format(&document, Style { default_locale, line_ending }))
}
