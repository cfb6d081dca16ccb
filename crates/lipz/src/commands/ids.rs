//! `lipz ids`: clip ids and locales as source code for programs.

use crate::CommandResult;
use crate::commands::Run;
use crate::reporter::Reporter;
use crate::shared::bank_or_sources::packed;
use crate::shared::dialogue_files::DialogueFiles;
use crate::shared::sources::Sources;
use crate::shared::stack;
use crate::shared::stdin_file::StdinFile;
use crate::shared::{input_file, output_file};
use crate::{Outcome, console};
use clap::{Args, ValueEnum};
use lipz_compiler::ids::{Language, generate};
use lipz_compiler::shard::SET_EXTENSION;
use lipz_diagnostics::Report;
use lipz_layout::{MAGIC, SET_MAGIC};
use std::ffi::OsStr;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Write clip IDs as constants for programs.
///
/// Constants let the compiler detect misspelt keys. SOURCES are Lipz files, which are packed in memory, or a bank or set. An
/// up-to-date file keeps its time, so that build systems do not compile it again.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz ids dialogue.lipzbank --lang c -o dialogue_ids.h
  lipz ids dialogue.lipzset --lang rust
  lipz ids voices --lang csharp --prefix Game.Dialogue -o DialogueIds.cs
  lipz ids voices --lang json")]
pub(crate) struct Ids {
    #[command(flatten)]
    sources: Sources,

    #[command(flatten)]
    stdin: StdinFile,

    /// Language to write
    #[arg(short, long, value_name = "LANGUAGE")]
    lang: LanguageName,

    /// File to write [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Prefix of C names [default: LIPZ_ID_], or C# namespace [default: Lipz]
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

impl Run for Ids {
    fn prints_result(&self) -> bool {
        self.output.is_none()
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let language = Language::from(self.lang);
        if let Some(prefix) = self.prefix.as_ref().filter(|prefix| !language.accepts_prefix(prefix)) {
            let name = language.name();
            let (message, tip) = match language.default_prefix() {
                Some(default) if language == Language::C => (
                    format!("`{prefix}` is not a prefix for C"),
                    format!("use letters, digits and _, but not a name of lipz.h or C; the default is {default}"),
                ),
                Some(default) => {
                    (format!("`{prefix}` is not a prefix for {name}"), format!("use a namespace, such as {default}"))
                }
                None => (format!("`--prefix` has no effect on {name}"), "use it only for C and C#".to_owned()),
            };
            return Err(reporter.usage(message, &tip));
        }
        if let Some(output) = &self.output {
            output_file::refuse_source(output, reporter)?;
        }
        self.stdin.apply(self.sources.paths(), reporter)?;
        match self.sources.paths() {
            [bank] if is_bank_file(bank) => {
                self.sources.refuse_with_bank(bank, reporter)?;
                let files = DialogueFiles::open(bank, reporter)?;
                write(&files.name, &files, self, reporter)
            }
            sources => of_sources(sources, self, reporter),
        }
    }
}

/// Whether the file is a bank, a set or a stack of banks, judging by its extension or its first bytes.
fn is_bank_file(path: &Path) -> bool {
    let first = stack::paths(path).into_iter().next().unwrap_or_default();
    let path = first.as_path();
    let is_bank =
        |extension: &OsStr| ["lipzbank", SET_EXTENSION].iter().any(|known| extension.eq_ignore_ascii_case(known));
    let is_named = path.extension().is_some_and(is_bank);
    let begins = || {
        let mut start = [0; MAGIC.len()];
        let is_magic = |start| start == MAGIC || start == SET_MAGIC;
        path.is_file() && File::open(path).is_ok_and(|mut file| file.read_exact(&mut start).is_ok() && is_magic(start))
    };
    is_named && !path.is_dir() || begins()
}

/// Returns the ids of the bank that these sources would be packed into.
fn of_sources(sources: &[PathBuf], arguments: &Ids, reporter: &mut Reporter) -> CommandResult {
    let project = arguments.sources.project(reporter)?;
    let file = packed(&project.settings, arguments.sources.is_quiet(), reporter)?;
    let source = sources.first().map(|path| console::path(path)).unwrap_or_default();
    let files = DialogueFiles::one(file);
    write(&source, &files, arguments, reporter)
}

fn write(source: &str, named: &DialogueFiles, arguments: &Ids, reporter: &mut Reporter) -> CommandResult {
    if let Some(output) = &arguments.output {
        named.refuse_output(("the bank", "the output"), output, reporter)?;
    }
    let files = named.verified(reporter)?;
    let dialogue = named.dialogue(&files, reporter)?;
    let text = generate(&dialogue, arguments.lang.into(), arguments.prefix.as_deref())
        .map_err(|clashes| reporter.refuse(vec![Report::all_about(source, clashes)]))?;
    let Some(output) = &arguments.output else {
        reporter.print(&text)?;
        return Ok(Outcome::Clean);
    };
    // Build systems compare file times: rewriting an unchanged file would recompile every file that includes it.
    let is_there = input_file::read(output).is_ok_and(|bytes| bytes == text.as_bytes());
    if !is_there {
        output_file::write(output, text.as_bytes(), reporter)?;
    }
    if arguments.sources.is_quiet() {
        return Ok(Outcome::Clean);
    }
    let ids = console::counted(dialogue.clip_count(), "id");
    let done = if is_there { "unchanged in" } else { "written to" };
    reporter.summary(&format!("{ids} {done} {}\n", console::path(output)))?;
    Ok(Outcome::Clean)
}
