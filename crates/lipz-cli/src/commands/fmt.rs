//! `lipz fmt`: Lipz files in their canonical layout.

use crate::rewriting::{Rewriting, failure, files};
use crate::sources::parse_locale;
use crate::{Outcome, console, render};
use clap::Args;
use lipz::diagnostic::show;
use lipz::format::{LineEnding, Style, format};
use lipz_compiler::{Options, Report, discover, each_file};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// How messages name standard input.
const STANDARD_INPUT: &str = "<standard input>";

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
    /// Folders, files or glob patterns; `-` formats standard input to standard output
    #[arg(value_name = "SOURCES", required = true)]
    sources: Vec<PathBuf>,

    /// List the files that would change, and write nothing; exit code 1 if there are any
    #[arg(long)]
    check: bool,

    /// Show what would change as a unified diff, and write nothing
    #[arg(long)]
    diff: bool,

    /// The locale whose text stands first [default: that of the first text in the file]
    #[arg(long, value_name = "LOCALE", value_parser = parse_locale)]
    default_locale: Option<String>,

    /// Threads to use [default: one per core]
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,

    /// Show no progress and no summary, only findings, files and differences
    #[arg(short, long)]
    quiet: bool,
}

pub(crate) fn run(arguments: &Fmt) -> Outcome {
    if arguments.sources == [Path::new("-")] {
        return standard_input(arguments);
    }
    let (inputs, mut reports) = discover(&arguments.sources, None);
    let options = Options { threads: arguments.threads.map(usize::from), ..Options::default() };
    let bar = console::progress_bar(inputs.len(), arguments.quiet);
    let results = each_file(&inputs, &options, &|count| bar.inc(count), |input, bytes| {
        let after = formatted(&input.name, bytes, arguments)?;
        if after.as_bytes() == bytes {
            return Ok(None);
        }
        arguments.rewriting().rewrite(input, bytes, &after).map(Some)
    });
    bar.finish_and_clear();
    let (mut changed, mut unchanged, mut shown) = (0, 0, String::new());
    for (input, result) in std::iter::zip(&inputs, results) {
        match result.and_then(|result| result) {
            Ok(None) => unchanged += 1,
            Ok(Some(difference)) => {
                changed += 1;
                if arguments.check {
                    shown.push_str(&show::text(&input.name));
                    shown.push('\n');
                }
                shown.push_str(&difference);
            }
            Err(report) => reports.push(report),
        }
    }
    render::findings(&reports);
    let summary = |what| format!("{} {what}, {} unchanged\n", files(changed), console::grouped(unchanged));
    match arguments.rewriting() {
        _ if arguments.quiet || inputs.is_empty() => {}
        Rewriting::InPlace => shown.push_str(&summary("formatted")),
        Rewriting::Nothing | Rewriting::Diff => console::remark(&summary("would change")),
    }
    let printed = console::print(&shown);
    match printed {
        _ if !reports.is_empty() => failure(&reports),
        Outcome::Clean if arguments.check && changed > 0 => Outcome::Findings,
        printed => printed,
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
fn standard_input(arguments: &Fmt) -> Outcome {
    let mut bytes = Vec::new();
    // One byte too many shows that the file is too large.
    let limit = lipz::MAX_FILE_BYTES as u64 + 1;
    if let Err(error) = io::stdin().lock().take(limit).read_to_end(&mut bytes) {
        console::remark(&format!("error: standard input cannot be read: {error}\n"));
        return Outcome::Failed;
    }
    match formatted(STANDARD_INPUT, &bytes, arguments) {
        Ok(after) if arguments.check => {
            if after.as_bytes() == bytes {
                Outcome::Clean
            } else {
                Outcome::Findings
            }
        }
        Ok(after) => console::print(&after),
        Err(report) => {
            render::findings(&[report]);
            Outcome::Findings
        }
    }
}

/// The file in canonical layout, or why it cannot be read.
fn formatted(name: &str, bytes: &[u8], arguments: &Fmt) -> Result<String, Report> {
    let parsed = lipz::parse(bytes);
    let Some(document) = parsed.document else { return Err(Report::of_file(name, bytes, parsed.diagnostics)) };
    let line_ending = LineEnding::of(&String::from_utf8_lossy(bytes));
    Ok(format(&document, Style { default_locale: arguments.default_locale.as_deref(), line_ending }))
}
