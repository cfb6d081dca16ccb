//! The sync status of lines: how far the length of a dub may differ from that of its original.

use crate::util::patterns::MATCHING;
use glob::{Pattern, PatternError};
use lipz_diagnostics::Span;
use std::ops::RangeInclusive;

/// How closely a dub must follow the time of its original, in the terms of recording studios ("Surviving Audio
/// Localization", Gamasutra, 2007). Studios agree on percentages for each project; these are the defaults of lipz.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum SyncStatus {
    /// The speaker's mouth is visible: within [5 percent](SyncStatus::LIP_SYNC_PERCENT).
    LipSync,
    /// An animation or a camera waits for the line: within this many percent.
    TimeConstrained(u32),
    /// The line may have any length.
    #[default]
    VoiceOver,
}

impl SyncStatus {
    /// The allowed difference for [`SyncStatus::LipSync`], in percent of the original's time.
    pub const LIP_SYNC_PERCENT: u32 = 5;

    /// The allowed difference for a time-constrained line without its own, in percent of the original's time.
    pub const TIME_CONSTRAINED_PERCENT: u32 = 10;

    /// Returns the name of the status, as in `lipz.toml`.
    pub fn name(self) -> &'static str {
        match self {
            SyncStatus::LipSync => "lip-sync",
            SyncStatus::TimeConstrained(_) => "time-constrained",
            SyncStatus::VoiceOver => "voice-over",
        }
    }

    /// Returns the name with the percentage, unless that is the default: `time-constrained (3 %)`.
    pub fn label(self) -> String {
        match self {
            SyncStatus::TimeConstrained(percent) if percent != SyncStatus::TIME_CONSTRAINED_PERCENT => {
                format!("{} ({percent} %)", self.name())
            }
            _ => self.name().to_owned(),
        }
    }

    /// Returns the allowed difference, in percent of the original's time; `None` for any length.
    pub fn percent(self) -> Option<u32> {
        match self {
            SyncStatus::LipSync => Some(SyncStatus::LIP_SYNC_PERCENT),
            SyncStatus::TimeConstrained(percent) => Some(percent),
            SyncStatus::VoiceOver => None,
        }
    }

    /// Returns the allowed lengths of a dub whose original has this length, both in microseconds; `None` for any length.
    ///
    /// ```
    /// use lipz_compiler::settings::SyncStatus;
    /// assert_eq!(SyncStatus::LipSync.range_us(2_000_000), Some(1_900_000..=2_100_000));
    /// assert_eq!(SyncStatus::VoiceOver.range_us(2_000_000), None);
    /// ```
    pub fn range_us(self, original_us: u64) -> Option<RangeInclusive<u64>> {
        let margin = original_us.saturating_mul(u64::from(self.percent()?)) / 100;
        Some(original_us.saturating_sub(margin)..=original_us.saturating_add(margin))
    }
}

/// A pattern of keys.
#[derive(Clone, PartialEq, Eq, Debug)]
struct KeyPattern {
    pattern: Pattern,
    status: SyncStatus,
    /// Its position in the settings.
    span: Span,
}

/// The sync statuses of a project's lines, by patterns of the keys of their originals.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct SyncStatuses {
    /// In the order of the file.
    patterns: Vec<KeyPattern>,
}

impl SyncStatuses {
    /// Sets the status of the lines whose keys match a pattern such as `cutscenes/**`, which is at `span` in the settings.
    /// Later patterns override earlier ones.
    ///
    /// # Errors
    /// If the pattern is invalid.
    pub fn insert(&mut self, pattern: &str, status: SyncStatus, span: Span) -> Result<(), PatternError> {
        self.patterns.push(KeyPattern { pattern: Pattern::new(pattern)?, status, span });
        Ok(())
    }

    /// Returns the patterns that match none of these keys, with their positions in the settings.
    pub fn unused(&self, keys: &[&str]) -> Vec<(&str, Span)> {
        let unused = self.patterns.iter().filter(|one| !keys.iter().any(|key| one.matches(key)));
        unused.map(|one| (one.pattern.as_str(), one.span)).collect()
    }

    /// Returns the status of the line whose original has this key.
    pub fn of(&self, key: &str) -> SyncStatus {
        self.patterns.iter().rev().find(|one| one.matches(key)).map_or(SyncStatus::VoiceOver, |one| one.status)
    }
}

impl KeyPattern {
    fn matches(&self, key: &str) -> bool {
        self.pattern.matches_with(key, MATCHING)
    }
}
