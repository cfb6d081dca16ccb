//! The flags for how mouths are made: one for every setting of `[sync]`.

use crate::shared::project_flags::parse_positive;
use clap::Args;
use lipz_compiler::settings::Sync;
use std::path::PathBuf;

const MOUTHS: &str = "Mouth shapes";

/// Flags that override settings.
#[derive(Args, Clone, Debug, Default)]
pub(super) struct SyncFlags {
    /// File with the pronunciations of the project's own words: WESNOTH  W EH S N AO TH
    #[arg(long, value_name = "FILE", help_heading = MOUTHS)]
    lexicon: Option<PathBuf>,

    /// File with a model of the project's own voices, which --train makes [default: the model that is built in]
    #[arg(long, value_name = "FILE", help_heading = MOUTHS)]
    model: Option<PathBuf>,

    /// File with a neural network that hears phones where there is no text: see `lipz recogniser`
    #[arg(long, value_name = "FILE", help_heading = MOUTHS)]
    recogniser: Option<PathBuf>,

    /// Folder of TextGrids with the times of words and phones: one that is there makes the mouth, the others are written
    #[arg(long, value_name = "FOLDER", help_heading = MOUTHS)]
    textgrids: Option<PathBuf>,

    /// Milliseconds by which a shape is ahead of its sound [default: 40]
    #[arg(long, value_name = "COUNT", help_heading = MOUTHS)]
    lead_ms: Option<u32>,

    /// Milliseconds for which closed lips, and the lip under the teeth, stay at least [default: 83]
    #[arg(long, value_name = "COUNT", help_heading = MOUTHS)]
    hold_ms: Option<u32>,

    /// Let the shapes of the other consonants (t, s, l, w, …) stay as long, as far as vowels have time to spare
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true",
          help_heading = MOUTHS)]
    hold_consonants: Option<bool>,

    /// Milliseconds below which a vowel does not open the mouth wide [default: 42]
    #[arg(long, value_name = "COUNT", help_heading = MOUTHS)]
    shortest_wide_ms: Option<u32>,

    /// Milliseconds below which a pause does not bring the mouth to rest [default: 150]
    #[arg(long, value_name = "COUNT", help_heading = MOUTHS)]
    shortest_pause_ms: Option<u32>,

    /// rms: decibels below the loud parts of a recording at which the mouth is closed [default: 30]
    #[arg(long, value_name = "NUMBER", value_parser = parse_positive, help_heading = MOUTHS)]
    rms_threshold_db: Option<f64>,

    /// rms: how far the mouth opens with the amplitude of the voice; 1 is in proportion [default: 0.5]
    #[arg(long, value_name = "NUMBER", value_parser = parse_positive, help_heading = MOUTHS)]
    rms_exponent: Option<f64>,
}

impl SyncFlags {
    /// Sets what the flags name over the settings of the project.
    pub(super) fn apply(&self, sync: &mut Sync) {
        sync.lexicon = self.lexicon.clone().or(sync.lexicon.take());
        sync.model = self.model.clone().or(sync.model.take());
        sync.recogniser = self.recogniser.clone().or(sync.recogniser.take());
        sync.textgrids = self.textgrids.clone().or(sync.textgrids.take());
        sync.lead_ms = self.lead_ms.or(sync.lead_ms);
        sync.hold_ms = self.hold_ms.or(sync.hold_ms);
        sync.hold_consonants = self.hold_consonants.unwrap_or(sync.hold_consonants);
        sync.shortest_wide_ms = self.shortest_wide_ms.or(sync.shortest_wide_ms);
        sync.shortest_pause_ms = self.shortest_pause_ms.or(sync.shortest_pause_ms);
        sync.rms_threshold_db = self.rms_threshold_db.or(sync.rms_threshold_db);
        sync.rms_exponent = self.rms_exponent.or(sync.rms_exponent);
    }
}
