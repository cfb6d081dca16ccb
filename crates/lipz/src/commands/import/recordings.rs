//! What lies beside the files of other tools: texts in a script, sounds with their lengths.

use super::options::{TEXT, parse_time};
use crate::Abort;
use crate::reporter::Reporter;
use crate::shared::formats::{self, Source};
use crate::shared::{script_file, stdio};
use clap::Args;
use lipz_interop::fallout::sound;
use lipz_interop::{Encoding, ImportOptions, Script, Time};
use std::fs::File;
use std::path::{Path, PathBuf};

const FALLOUT: &str = "Fallout";

/// Extensions of sounds, as they are spelled in folders of games.
const SOUNDS: [&str; 4] = ["wav", "WAV", "acm", "ACM"];

#[derive(Args, Debug)]
pub(super) struct Recordings {
    /// Texts (lines) by file name: a .msg file of Fallout, or a CSV string table with the columns `file` and `text`
    #[arg(long, value_name = "FILE", conflicts_with = "text", help_heading = TEXT)]
    pub(super) script: Option<PathBuf>,

    /// Encoding of imported files, scripts and texts that are not UTF-8: windows-1251, shift_jis [default: windows-1252
    /// for scripts, and for formats of older tools]
    #[arg(long, value_name = "NAME", value_parser = formats::encoding, help_heading = TEXT)]
    pub(super) encoding: Option<&'static Encoding>,

    /// Units in a second of Fallout's LIP files: 44100, 88200, 88400 or any other [default: derived from the
    /// length of the sound, or 44100]
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..), help_heading = FALLOUT)]
    units_per_second: Option<u32>,

    /// Length of the sound of a Fallout LIP file [default: that of the WAV or ACM file beside it]
    #[arg(long, value_name = "SECONDS", value_parser = parse_time, conflicts_with = "units_per_second", help_heading = FALLOUT)]
    audio_length: Option<Time>,
}

impl Recordings {
    /// The script, if one is named. Reports what is wrong with it.
    pub(super) fn script(&self, reporter: &mut Reporter) -> Result<Script, Abort> {
        match &self.script {
            Some(path) => script_file::read(path, self.encoding, reporter),
            None => Ok(Script::default()),
        }
    }

    /// Adds what is known about the recording of a file to the options of its import.
    pub(super) fn apply<'a>(
        &self,
        path: &Path,
        source: &'a Source,
        script: &'a Script,
        options: &mut ImportOptions<'a>,
    ) {
        options.name = (!stdio::is_meant(path)).then_some(source.stem());
        options.text = script.text_of_file(path, &source.key).or(options.text);
        options.units_per_second = self.units_per_second;
        options.sound_length = self.audio_length.or_else(|| length_beside(path));
    }
}

/// The length of the sound beside a file, under its name.
fn length_beside(path: &Path) -> Option<Time> {
    SOUNDS.into_iter().find_map(|extension| sound::length(File::open(path.with_extension(extension)).ok()?))
}
