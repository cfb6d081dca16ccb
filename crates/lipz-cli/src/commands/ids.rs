//! `lipz ids`: clip ids and locales as source code for programs.

use super::with_inputs;
use crate::args::Arguments;
use crate::bank_file::with_bank;
use crate::sources::Sources;
use crate::{Outcome, console, render};
use clap::error::ErrorKind;
use clap::{Args, CommandFactory, ValueEnum};
use lipz::Level;
use lipz_bank::Bank;
use lipz_compiler::ids::{Language, generate};
use lipz_compiler::{Report, compile, count, replace_file};
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
    pub(crate) sources: Sources,

    /// The language to write
    #[arg(short, long, value_name = "LANGUAGE")]
    pub(crate) lang: LanguageName,

    /// The file to write [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,

    /// What C names start with [default: LIPZ_], or the C# namespace [default: Lipz]
    #[arg(long, value_name = "NAME")]
    pub(crate) prefix: Option<String>,
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
    /// What the parser cannot see by itself: a prefix that does not suit the language.
    ///
    /// # Errors
    /// A usage error for the command line.
    pub(crate) fn validate(&self) -> Result<(), clap::Error> {
        self.sources.validate()?;
        let language = Language::from(self.lang);
        let Some(prefix) = self.prefix.as_ref().filter(|prefix| !language.accepts_prefix(prefix)) else {
            return Ok(());
        };
        let message = match language.default_prefix() {
            Some(default) => {
                format!("'{prefix}' is not a prefix for {}\n\n  tip: the default is {default}", language.name())
            }
            None => format!("'--prefix' is for C and C#; {} has names of its own", language.name()),
        };
        Err(Arguments::command().error(ErrorKind::ArgumentConflict, message))
    }
}

pub(crate) fn run(arguments: &Ids) -> Outcome {
    match arguments.sources.sources.as_slice() {
        [bank] if is_bank(bank) => with_bank(bank, |path, bank| write(path, bank, arguments)),
        sources => of_sources(sources, arguments),
    }
}

fn is_bank(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("lipzbank")) && !path.is_dir()
}

/// The ids of the bank that would be packed.
fn of_sources(sources: &[PathBuf], arguments: &Ids) -> Outcome {
    let run = with_inputs(&arguments.sources, &arguments.sources.options(), compile);
    render::findings(&run.reports);
    match &run.compiled.bank {
        Some(bytes) if count(&run.reports, Level::Error) == 0 => match Bank::open(bytes) {
            Ok(bank) => write(&sources.first().map(|path| console::path(path)).unwrap_or_default(), &bank, arguments),
            Err(_) => Outcome::Failed,
        },
        _ => run.failure(),
    }
}

fn write(source: &str, bank: &Bank<'_>, arguments: &Ids) -> Outcome {
    let text = match generate(bank, arguments.lang.into(), arguments.prefix.as_deref()) {
        Ok(text) => text,
        Err(clashes) => {
            render::findings(&[Report::all_about(source, clashes)]);
            return Outcome::Findings;
        }
    };
    let Some(output) = &arguments.output else { return console::print(&text) };
    if let Err(report) = replace_file(output, text.as_bytes()) {
        render::findings(&[report]);
        return Outcome::Failed;
    }
    if arguments.sources.quiet {
        return Outcome::Clean;
    }
    let clips = console::counted(bank.clip_count(), "id");
    console::print(&format!("{clips} written to {}\n", console::path(output)))
}
