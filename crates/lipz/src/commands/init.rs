//! `lipz init`: creates a project that packs, with commented settings.

use crate::commands::Run;
use crate::reporter::Reporter;
use crate::shared::input_file::unreadable;
use crate::shared::output_file;
use crate::shared::run_flags::QuietFlag;
use crate::{Abort, CommandResult, Outcome, console};
use clap::Args;
use lipz_compiler::settings::{FILE_NAME, Settings, short_template, template};
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::path::{Path, PathBuf};
use std::{fs, io};

/// A first clip in canonical layout: one viseme per frame, a text, and an event.
const FIRST_CLIP: &str = r#"{
  "visemes" :    "--EEELLOOOWW----|LEESASSMEEEEESS--",
  "text_en-us" : "Hello.          |Let us begin.",
  "events" :     "                |feels happy",
  "fps" :        24
}
"#;

const VOICES: &str = "voices";
const FIRST_PATH: &str = "voices/hello.lipz";
const BANK: &str = "dialogue.lipzbank";
const IGNORED: &str = ".gitignore";
/// Files of a run that was killed while it was writing. The next run removes them.
const TEMPORARY: &str = ".*.lipztmp";

const ATTRIBUTES: &str = ".gitattributes";

/// How Git merges the files of a project. A merge of the record keeps the lines of both branches, and with them the
/// approvals of both. The driver for Lipz files is [`MERGE_DRIVER`]; without it, Git merges them by lines.
const MERGED: [&str; 2] = ["lipz-texts.txt merge=union", "*.lipz merge=lipz"];

/// The command that tells Git how to merge Lipz files. Git does not read it from a file of the project, because a
/// repository must not run programs without being asked.
const MERGE_DRIVER: &str = "git config merge.lipz.driver 'lipz merge --versions %O %A %B -o %A --name %P'";

/// Create a project: lipz.toml, a first clip, and entries for git.
///
/// No clip is written with --audio, or if the folder already has Lipz files. The entries for git ignore the bank and
/// unfinished files, and merge Lipz files and the record of translations. Existing .gitignore and .gitattributes files get these lines too.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz init
  lipz init game --audio recordings
  lipz init game/dialogue")]
pub(crate) struct Init {
    /// Folder of the project; created if needed
    #[arg(value_name = "FOLDER", default_value = ".")]
    folder: PathBuf,

    /// Create this folder for recordings
    #[arg(long, value_name = "FOLDER")]
    audio: Option<PathBuf>,

    /// Write every setting into lipz.toml, explained and commented out
    #[arg(long)]
    full: bool,

    /// Replace an existing lipz.toml
    #[arg(long)]
    overwrite: bool,

    #[command(flatten)]
    quiet: QuietFlag,
}

impl Run for Init {
    fn prints_result(&self) -> bool {
        false
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        let is_here = self.folder.as_os_str() == ".";
        let file = if is_here { PathBuf::from(FILE_NAME) } else { self.folder.join(FILE_NAME) };
        let shown = console::path(&file);
        if !self.overwrite && file.symlink_metadata().is_ok() {
            let diagnostic = Diagnostic::new(Code::WouldOverwrite, format!("`{shown}` already exists"));
            let diagnostic = diagnostic.note("nothing was written").help("edit it, or replace it with --overwrite");
            return Err(reporter.refuse(vec![Report::about(shown, diagnostic)]));
        }
        let bank = format!("\"{BANK}\"");
        let audio = self.audio.as_ref().map(|folder| lipz_file::literal(&folder.to_string_lossy()));
        // Show newcomers nods, breaths, a pose for each word, and mouths of three-dimensional faces.
        let mut set = vec![("", "output", bank.as_str()), ("face", "keys", "\"words\""), ("sync", "phones", "true")];
        let is_new = !has_clips(&self.folder);
        if is_new {
            set.extend([("", "sources", "[\"voices\"]"), ("", "default-locale", "\"en-us\"")]);
        }
        let folders = self.audio.iter().flat_map(|audio| [self.folder.join(VOICES), self.folder.join(audio)]);
        let folders: Vec<PathBuf> = folders.collect();
        // Nothing is written if something is in the way.
        folders.iter().try_for_each(|folder| output_file::refuse_file(folder, reporter))?;
        let lines = [format!("/{BANK}"), TEMPORARY.to_owned()];
        let ignored = with_lines(self.folder.join(IGNORED), &lines, is_ignored, reporter)?;
        let attributes = with_lines(self.folder.join(ATTRIBUTES), &MERGED.map(str::to_owned), is_merged, reporter)?;
        for folder in &folders {
            fs::create_dir_all(folder).map_err(|error| reporter.fail(output_file::unwritable(folder, &error)))?;
        }
        if is_new && self.audio.is_none() {
            output_file::write(&self.folder.join(FIRST_PATH), FIRST_CLIP.as_bytes(), reporter)?;
        }
        for (file, text) in ignored.into_iter().chain(attributes) {
            output_file::write(&file, text.as_bytes(), reporter)?;
        }
        set.extend(audio.as_deref().map(|audio| ("audio", "folder", audio)));
        let text = if self.full { template(&set) } else { short_template(&set) };
        output_file::write(&file, text.as_bytes(), reporter)?;
        if self.quiet.is_set() {
            return Ok(Outcome::Clean);
        }
        let takes = self.audio.iter().map(|folder| console::path(&self.folder.join(folder))).next().unwrap_or_default();
        let first_take = format!("record a line as {takes}/KEY.wav, and make its clip with `lipz new KEY TEXT`");
        let next = match is_new {
            true if self.audio.is_some() => &first_take,
            true => "run `lipz pack` there to pack the first clip, or `lipz new KEY TEXT` to add one",
            false => "run `lipz check` there to check all Lipz files in the folder",
        };
        let merging = format!("to merge Lipz files by text instead of by line, run:\n  {MERGE_DRIVER}");
        reporter.summary(&format!("{shown} written\nnext: {next}\n{merging}\n"))?;
        Ok(Outcome::Clean)
    }
}

/// Whether the folder contains Lipz files, at any depth.
fn has_clips(folder: &Path) -> bool {
    let mut settings = Settings::default();
    settings.sources = vec![folder.to_owned()];
    folder.is_dir() && !settings.discover_with_reports().0.is_empty()
}

/// Whether a line of .gitignore replaces `line`. All banks can be rebuilt from the Lipz files.
fn is_ignored(known: &str, line: &str) -> bool {
    line != TEMPORARY && (known == BANK || known == "*.lipzbank")
}

/// Whether a line of .gitattributes is about the same files as `line`.
fn is_merged(known: &str, line: &str) -> bool {
    known.split_whitespace().next() == line.split_whitespace().next()
}

/// Returns the path of a git file and its text with additional lines. Returns `None` if it already contains each line, or
/// one that `replaces` it.
fn with_lines(
    file: PathBuf,
    lines: &[String],
    replaces: impl Fn(&str, &str) -> bool,
    reporter: &mut Reporter,
) -> Result<Option<(PathBuf, String)>, Abort> {
    let mut text = match fs::read_to_string(&file) {
        Ok(text) => text,
        Err(error) if error.kind() == io::ErrorKind::NotFound => String::new(),
        Err(error) => return Err(reporter.fail(unreadable(&file, &error))),
    };
    let is_missing = |line: &&String| !text.lines().any(|known| known == *line || replaces(known, line));
    let missing: Vec<&String> = lines.iter().filter(is_missing).collect();
    if missing.is_empty() {
        return Ok(None);
    }
    if !text.is_empty() && !text.ends_with('\n') {
        text.push('\n');
    }
    missing.into_iter().for_each(|line| text.extend([line.as_str(), "\n"]));
    Ok(Some((file, text)))
}
