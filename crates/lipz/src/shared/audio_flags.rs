//! The flags for what a project decides about its recordings: one for every setting of `[audio]`.

use crate::shared::project_flags::parse_locale;
use clap::{ArgAction, Args};
use lipz_compiler::settings::{Audio, refused_pattern};
use std::path::PathBuf;

pub(crate) const RECORDINGS: &str = "Recordings";

/// Flags that override settings.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct AudioFlags {
    /// The folder of the recordings
    #[arg(long = "audio", value_name = "FOLDER", help_heading = RECORDINGS)]
    folder: Option<PathBuf>,

    /// Path of a clip's recording below that folder; {key} is the key of the clip [default: {key}]
    #[arg(long = "audio-pattern", value_name = "PATTERN", value_parser = parse_pattern, help_heading = RECORDINGS)]
    pattern: Option<String>,

    /// Where the recordings of a language are below that folder: de-de=de-de/{key}
    #[arg(long, value_name = "LOCALE=PATTERN", value_parser = parse_voice, action = ArgAction::Append)]
    #[arg(help_heading = RECORDINGS)]
    voice: Vec<(String, String)>,

    /// Locale that is spoken in the recordings [default: the default locale]
    #[arg(long = "audio-locale", value_name = "LOCALE", value_parser = parse_locale, help_heading = RECORDINGS)]
    locale: Option<String>,

    /// Milliseconds by which the length of a clip may differ from that of its recording [default: a frame]
    #[arg(long = "audio-tolerance-ms", value_name = "COUNT", help_heading = RECORDINGS)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    tolerance_ms: Option<u32>,

    /// File in which `lipz sync` records what each mouth was made from [default: lipz-sync.txt beside the Lipz
    /// files]
    #[arg(long = "audio-record", value_name = "FILE", help_heading = RECORDINGS)]
    record: Option<PathBuf>,

    /// File in which `lipz check` remembers what it heard in recordings [default: `cache` of `[audio]`]
    #[arg(long, value_name = "FILE", help_heading = RECORDINGS)]
    audio_cache: Option<PathBuf>,

    /// Put the length and the content hash of each recording into the bank
    #[arg(long = "audio-in-bank", value_name = "BOOL", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "true", help_heading = RECORDINGS)]
    in_bank: Option<bool>,
}

impl AudioFlags {
    /// Sets what the flags name over the settings of the project.
    pub(crate) fn apply(&self, audio: &mut Audio) {
        audio.folder = self.folder.clone().or(audio.folder.take());
        audio.pattern = self.pattern.clone().or(audio.pattern.take());
        audio.voices.extend(self.voice.iter().cloned());
        audio.locale = self.locale.clone().or(audio.locale.take());
        audio.tolerance_ms = self.tolerance_ms.or(audio.tolerance_ms);
        audio.record = self.record.clone().or(audio.record.take());
        audio.cache = self.audio_cache.clone().or(audio.cache.take());
        audio.in_bank = self.in_bank.unwrap_or(audio.in_bank);
    }
}

fn parse_voice(text: &str) -> Result<(String, String), String> {
    let (locale, pattern) = text.split_once('=').ok_or("write the locale, `=`, and the pattern of its recordings")?;
    Ok((parse_locale(locale)?, parse_pattern(pattern)?))
}

fn parse_pattern(text: &str) -> Result<String, String> {
    match refused_pattern(text) {
        Some((what, help)) => Err(format!("it {what}: {help}")),
        None => Ok(text.to_owned()),
    }
}
