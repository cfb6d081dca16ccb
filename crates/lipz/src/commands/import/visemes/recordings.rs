//! Files next to those of other tools: scripts with texts, and recordings with their lengths.

use super::options::TEXT;
use super::text::{self, TextSource};
use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::formats::{self, ToolFile};
use crate::shared::{script_file, stdio};
use clap::Args;
use lipz_diagnostics::Report;
use lipz_interop::fallout::sound;
use lipz_interop::{Encoding, ImportOptions, Script, Time};
use std::fs::File;
use std::path::{Path, PathBuf};

/// The extensions of recordings, in the spellings found in game folders.
const SOUNDS: [&str; 4] = ["wav", "WAV", "acm", "ACM"];

#[derive(Args, Debug)]
pub(super) struct Recordings {
    /// Transcripts: a text file, a folder of KEY.txt files, or a table
    ///
    /// A table is a CSV file with the columns `file` and `text`, or a .msg file of Fallout 2.
    #[arg(long, value_name = "FILE|FOLDER", help_heading = TEXT)]
    pub(super) script: Option<PathBuf>,

    /// Encoding of files that are not UTF-8, such as shift_jis
    ///
    /// The default is windows-1252 for scripts and for formats of older tools.
    #[arg(long, value_name = "NAME", value_parser = formats::encoding, help_heading = TEXT)]
    pub(super) encoding: Option<&'static Encoding>,
}

impl Recordings {
    /// Returns the texts by clip key, unless the script is a table. Reports errors in reading them.
    pub(super) fn texts(&self, several: bool, reports: &mut Vec<Report>) -> Result<TextSource, Report> {
        let named = self.script.as_deref().filter(|path| !is_table(path));
        TextSource::from_argument(named, several, self.encoding, reports)
    }

    /// Returns the table of texts, if the arguments name one. Reports its problems.
    pub(super) fn script(&self, reporter: &mut Reporter) -> Result<Script, Abort> {
        match self.script.as_deref().filter(|path| is_table(path)) {
            Some(path) => script_file::read(path, self.encoding, reporter),
            None => Ok(Script::default()),
        }
    }

    /// Adds data about the recording of a file to the options of its import.
    pub(super) fn apply<'a>(
        &self,
        path: &Path,
        source: &'a ToolFile,
        script: &'a Script,
        options: &mut ImportOptions<'a>,
    ) {
        options.name = (!stdio::is_meant(path)).then_some(source.stem());
        options.text = script.text_of_file(path, &source.key).or(options.text);
        options.sound_length = length_beside(path).filter(|_| options.units_per_second.is_none());
    }
}

/// Whether a script is a table with the texts of many files.
fn is_table(path: &Path) -> bool {
    !path.is_dir() && !path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(text::EXTENSION))
}

/// Returns the length of the recording next to a file with the same name.
fn length_beside(path: &Path) -> Option<Time> {
    SOUNDS.into_iter().find_map(|extension| sound::length(File::open(path.with_extension(extension)).ok()?))
}
