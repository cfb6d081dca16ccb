//! `[dubs]`: the sync status of lines.

use super::reading::SettingsReader;
use super::value::{NamedValue, span};
use super::{SyncStatus, SyncStatuses};
use lipz_diagnostics::{Code, Diagnostic, escape, suggest::nearest};
use toml::de::DeValue;

/// The statuses with names.
const NAMED: [SyncStatus; 3] =
    [SyncStatus::LipSync, SyncStatus::TimeConstrained(SyncStatus::TIME_CONSTRAINED_PERCENT), SyncStatus::VoiceOver];

const OTHERWISE: &str = "write \"lip-sync\", \"time-constrained\", \"voice-over\" for any length, or a whole number of percent from 1 to 100";

impl SettingsReader<'_> {
    /// Reads the sync status of the lines whose keys match `pattern`: its name, or a number of percent.
    pub(super) fn sync_status(&mut self, pattern: &str, value: &NamedValue<'_>) {
        let status = match value.node.get_ref() {
            DeValue::String(_) => self.named_status(value),
            DeValue::Integer(integer) => {
                let percent = u32::from_str_radix(integer.as_str(), integer.radix()).ok();
                let percent = percent.filter(|percent| (1..=100).contains(percent));
                if percent.is_none() {
                    self.refuse(value, "is not a percentage from 1 to 100", OTHERWISE);
                }
                percent.map(SyncStatus::TimeConstrained)
            }
            _ => {
                self.refuse(value, "is not a sync status", OTHERWISE);
                None
            }
        };
        let Some(status) = status else { return };
        let statuses: &mut SyncStatuses = &mut self.settings.audio.sync_statuses;
        if let Err(error) = statuses.insert(pattern, status, span(&value.key)) {
            let message = format!("{} is not a pattern of keys: {}", escape::quoted(pattern), error.msg);
            let help = "write keys such as `cutscenes/**`; `*` matches all but a slash";
            self.diagnostics.push(Diagnostic::at(Code::SettingValue, span(&value.key), message).help(help));
        }
    }

    fn named_status(&mut self, value: &NamedValue<'_>) -> Option<SyncStatus> {
        let text = value.text(&mut self.diagnostics)?;
        let found = NAMED.into_iter().find(|status| status.name() == text);
        if found.is_none() {
            let near = nearest(text, NAMED.map(SyncStatus::name));
            value.refuse_unknown::<()>("is not a sync status", near, OTHERWISE, &mut self.diagnostics);
        }
        found
    }
}
