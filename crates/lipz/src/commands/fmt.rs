//! `lipz fmt`: Lipz files in their canonical layout.

use crate::project::parse_locale;
use crate::reporter::Reporter;
use crate::rewriting::{Rewriting, diff, files, is_standard_input, reads_standard_input};
use crate::settings_file::{Project, SettingsFile};
use crate::sources::PROJECT;
use crate::{Ended, Outcome, console, interrupt, standard};
use clap::Args;
use lipz_compiler::Compiler;
use lipz_diagnostics::{Report, escape};
use lipz_file::format::{LineEnding, Style, format};
use std::path::PathBuf;

/// Bring Lipz files into their canonical layout; what they mean stays the same.
///
/// One element a line: visemes, texts, events, viseme_type, fps, then elements that are not of the
/// format. Blanks at the ends of segments bring the `|` of all elements under each other. Files that
/// cannot be read as JSON are reported and left alone.
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

    /// List the files that would change, and write nothing; exit code 1 if there are any
    #[arg(long)]
    check: bool,

    /// Show what would change as a unified diff, and write nothing
    #[arg(long)]
    diff: bool,

    /// The locale whose text stands first [default: the project's, else that of the first text]
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale, help_heading = PROJECT)]
    default_locale: Option<String>,

    /// Threads to use [default: one per core]
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,

    /// Show no progress and no summary, only findings, files and differences
    #[arg(short, long)]
    quiet: bool,
}

pub(crate) fn run(arguments: &Fmt, reporter: &mut Reporter) -> Ended {
    let Project { mut settings, .. } = arguments.file.project(&arguments.sources, reporter)?;
    settings.options.threads = arguments.threads.map(usize::from);
    let default_locale = arguments.default_locale.as_deref().or(settings.options.default_locale.as_deref());
    if reads_standard_input(&settings.sources)? {
        return Ok(standard_input(arguments, default_locale, reporter));
    }
    let (inputs, mut reports) = settings.discover();
    let bar = console::progress_bar(inputs.len(), arguments.quiet);
    let compiler = Compiler::new(settings.options.clone()).progress(|count| bar.inc(count));
    let results = compiler.each_file(&inputs, |input, bytes| {
        let after = formatted(&input.name(), bytes, default_locale)?;
        if after.as_bytes() == bytes {
            return Ok(None);
        }
        interrupt::whole(|| arguments.rewriting().rewrite(input, bytes, &after)).map(Some)
    });
    bar.finish_and_clear();
    let (mut changed, mut unchanged, mut shown) = (0, 0, String::new());
    for (input, result) in std::iter::zip(&inputs, results) {
        match result.and_then(|result| result) {
            Ok(None) => unchanged += 1,
            Ok(Some(difference)) => {
                changed += 1;
                if arguments.check {
                    shown.push_str(&escape::text(&input.name()));
                    shown.push('\n');
                }
                shown.push_str(&difference);
            }
            Err(report) => reports.push(report),
        }
    }
    let outcome = Outcome::of(&reports);
    reporter.add(reports);
    let summary = |what| format!("{} {what}, {} unchanged\n", files(changed), console::grouped(unchanged));
    match arguments.rewriting() {
        _ if arguments.quiet || inputs.is_empty() => {}
        Rewriting::InPlace => shown.push_str(&summary("formatted")),
        Rewriting::Nothing | Rewriting::Diff => console::remark(&summary("would change")),
    }
    let printed = if arguments.prints_result() { console::print(&shown) } else { reporter.summary(&shown) };
    let checked = if arguments.check && changed > 0 { Outcome::Errors } else { Outcome::Clean };
    Ok(outcome.max(printed).max(checked))
}

impl Fmt {
    /// Whether standard output is for files, differences or the names of files.
    pub(crate) fn prints_result(&self) -> bool {
        self.rewriting() != Rewriting::InPlace || is_standard_input(&self.sources)
    }

    fn rewriting(&self) -> Rewriting {
        match (self.diff, self.check) {
            (true, _) => Rewriting::Diff,
            (false, true) => Rewriting::Nothing,
            (false, false) => Rewriting::InPlace,
        }
    }
}

/// Formats what comes from standard input.
fn standard_input(arguments: &Fmt, default_locale: Option<&str>, reporter: &mut Reporter) -> Outcome {
    let formatted = standard::lipz_bytes()
        .and_then(|before| formatted(standard::INPUT_NAME, &before, default_locale).map(|after| (before, after)));
    match formatted {
        Ok((before, after)) => {
            let printed = match arguments.rewriting() {
                Rewriting::InPlace => console::print(&after),
                Rewriting::Diff => console::print(&diff(standard::INPUT_NAME, &before, &after)),
                Rewriting::Nothing => Outcome::Clean,
            };
            let differs = arguments.check && after.as_bytes() != before;
            if differs && printed == Outcome::Clean { Outcome::Errors } else { printed }
        }
        Err(report) => {
            let outcome = Outcome::of(std::slice::from_ref(&report));
            reporter.add(vec![report]);
            outcome
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
