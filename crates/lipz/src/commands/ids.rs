//! `lipz ids`: clip ids and locales as source code for programs.

use super::with_inputs;
use crate::bank_file::BankFile;
use crate::reporter::Reporter;
use crate::sources::{Sources, usage_error};
use crate::{Ended, Outcome, console, output_file};
use clap::error::ErrorKind;
use clap::{Args, ValueEnum};
use lipz_bank::Bank;
use lipz_compiler::ids::{Language, generate};
use lipz_diagnostics::Report;
use std::mem;
use std::path::{Path, PathBuf};

/// Write the ids of clips as constants for programs, so that a misspelt key does not compile.
///
/// SOURCES are Lipz files, which are checked and packed in memory, or one bank (.lipzbank).
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz ids dialogue.lipzbank --lang c -o dialogue_ids.h
  lipz ids voices --lang csharp --prefix Game.Dialogue -o DialogueIds.cs
  lipz ids voices --lang json")]
pub(crate) struct Ids {
    #[command(flatten)]
    sources: Sources,

    /// The language to write
    #[arg(short, long, value_name = "LANGUAGE")]
    lang: LanguageName,

    /// The file to write [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// What C names start with [default: LIPZ_ID_], or the C# namespace [default: Lipz]
    #[arg(long, value_name = "NAME")]
    prefix: Option<String>,
}

#[derive(ValueEnum, Clone, Copy, Debug)]
pub(crate) enum LanguageName {
    Rust,
    C,
    Csharp,
    Typescript,
    Json,
}

impl From<LanguageName> for Language {
    fn from(name: LanguageName) -> Language {
        match name {
            LanguageName::Rust => Language::Rust,
            LanguageName::C => Language::C,
            LanguageName::Csharp => Language::CSharp,
            LanguageName::Typescript => Language::TypeScript,
            LanguageName::Json => Language::Json,
        }
    }
}

impl Ids {
    /// Whether the ids go to standard output.
    pub(crate) fn prints_ids(&self) -> bool {
        self.output.is_none()
    }
}

pub(crate) fn run(arguments: &Ids, reporter: &mut Reporter) -> Ended {
    let language = Language::from(arguments.lang);
    if let Some(prefix) = arguments.prefix.as_ref().filter(|prefix| !language.accepts_prefix(prefix)) {
        let name = language.name();
        let (message, tip) = match language.default_prefix() {
            Some(default) if language == Language::C => (
                format!("'{prefix}' is not a prefix for C"),
                format!("take letters, digits and _ that lead to no name of lipz.h or of C; the default is {default}"),
            ),
            Some(default) => (format!("'{prefix}' is not a prefix for {name}"), format!("the default is {default}")),
            None => ("'--prefix' is for C and C#".to_owned(), format!("{name} has names of its own")),
        };
        return Err(usage_error(ErrorKind::ArgumentConflict, &message, &tip));
    }
    if let Some(output) = &arguments.output {
        output_file::refuse_source(output)?;
    }
    match arguments.sources.paths() {
        [bank] if is_bank(bank) => {
            let file = BankFile::open(bank, reporter)?;
            write(&file.name, &file.bank(reporter)?, arguments, reporter)
        }
        sources => of_sources(sources, arguments, reporter),
    }
}

fn is_bank(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("lipzbank")) && !path.is_dir()
}

/// The ids of the bank that would be packed.
fn of_sources(sources: &[PathBuf], arguments: &Ids, reporter: &mut Reporter) -> Ended {
    let project = arguments.sources.project(reporter)?;
    let mut run =
        with_inputs(&project.settings, arguments.sources.is_quiet(), |compiler, inputs| compiler.compile(inputs));
    let outcome = run.outcome();
    reporter.add(mem::take(&mut run.reports));
    match &run.compiled.bank {
        Some(bytes) if outcome == Outcome::Clean => match Bank::open(bytes) {
            Ok(bank) => {
                write(&sources.first().map(|path| console::path(path)).unwrap_or_default(), &bank, arguments, reporter)
            }
            Err(_) => Err(Outcome::Failed),
        },
        _ => Err(outcome),
    }
}

fn write(source: &str, bank: &Bank<'_>, arguments: &Ids, reporter: &mut Reporter) -> Ended {
    let text = generate(bank, arguments.lang.into(), arguments.prefix.as_deref()).map_err(|clashes| {
        reporter.add(vec![Report::all_about(source, clashes)]);
        Outcome::Errors
    })?;
    let Some(output) = &arguments.output else { return Ok(console::print(&text)) };
    output_file::write(output, text.as_bytes(), reporter)?;
    if arguments.sources.is_quiet() {
        return Ok(Outcome::Clean);
    }
    let ids = console::counted(bank.clip_count(), "id");
    Ok(reporter.summary(&format!("{ids} written to {}\n", console::path(output))))
}
