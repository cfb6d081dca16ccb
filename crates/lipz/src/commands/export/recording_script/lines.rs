//! The lines of a recording script: their recordings, lengths and reasons to record them.

use crate::shared::characters::{Spellings, first_in_key};
use crate::shared::voices::originals;
use clap::ValueEnum;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Input, Voices};
use lipz_diagnostics::Report;
use lipz_sync::{FileFacts, Recordings, SyncRecord, record_place, unapproved_with_reports};
use lipz_texts::{ScriptLine, Translation, Unit};
use std::collections::{BTreeSet, HashSet};
use std::path::Path;

/// The state of a line's recording, on the command line.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum LineState {
    /// Not recorded
    Missing,
    /// The text has changed since
    Stale,
    /// Too short or too long for its sync status
    Length,
    /// Recorded, and up to date
    Recorded,
}

impl LineState {
    /// Returns the name on the command line.
    pub(super) fn name(&self) -> Option<String> {
        self.to_possible_value().map(|value| value.get_name().to_owned())
    }
}

/// The recordings of a project in one voice.
pub(super) struct Lines<'s> {
    settings: &'s Settings,
    /// The spoken locale; `None` for that of the originals.
    locale: Option<&'s str>,
    voices: Voices,
    recordings: &'s Recordings,
    /// The keys of the clips that are not dubs.
    originals: HashSet<&'s str>,
    /// The characters of the project.
    characters: Spellings,
    /// The keys of clips whose recording is older than its text.
    stale: BTreeSet<String>,
}

impl<'s> Lines<'s> {
    /// Returns the number of originals.
    pub(super) fn count(&self) -> usize {
        self.originals.len()
    }

    /// Compares the recordings of the voice with the sync record.
    pub(super) fn new(
        settings: &'s Settings,
        inputs: &'s [Input],
        locale: Option<&'s str>,
        recordings: &'s Recordings,
        reports: &mut Vec<Report>,
    ) -> Lines<'s> {
        let voices = settings.voices();
        let mut stale = BTreeSet::new();
        match SyncRecord::read(&record_place(settings)) {
            // Nothing is recorded yet.
            Ok(_) if recordings.iter().next().is_none() => {}
            Ok(record) => {
                let spoken = locale.or(voices.original.as_deref());
                let is_meant = |key: &str, _: Option<&str>| voices.locale_of(key) == spoken;
                let (unapproved, unread) = unapproved_with_reports(settings, inputs, &record, &is_meant, &|| ());
                stale.extend(unapproved.into_iter().filter(|recording| recording.is_outdated).map(|one| one.key));
                // Some of them were reported when the recordings were searched for.
                reports.extend(unread.into_iter().filter(|report| !reports.contains(report)).collect::<Vec<_>>());
            }
            Err(report) => reports.push(report),
        }
        let originals = originals(inputs, &voices).into_iter().map(|input| input.key.as_str()).collect();
        let mut characters = Spellings::default();
        for name in settings.options.get_known_names().get_characters().into_iter().flatten() {
            characters.of(name);
        }
        Lines { settings, locale, voices, recordings, originals, characters, stale }
    }

    /// Returns the lines of the originals among the units, each with the state of its recording.
    pub(super) fn of(&self, units: Vec<Unit>, reports: &mut Vec<Report>) -> Vec<(LineState, ScriptLine)> {
        let mut characters = self.characters.clone();
        for name in units.iter().flat_map(|unit| &unit.segments).filter_map(|segment| segment.speaker.as_deref()) {
            characters.of(name);
        }
        let names = characters.by_words();
        // A clip has one recording, whatever variant of its text the game shows.
        let texts = units.into_iter().filter(|unit| unit.variant.is_none());
        let originals = texts.filter(|unit| self.originals.contains(unit.key.as_str()));
        let lines = originals.map(|unit| {
            let character = speakers(&unit, &characters).or_else(|| first_in_key(&unit.key, &names));
            self.line(unit, character.unwrap_or_default(), reports)
        });
        lines.collect()
    }

    fn line(&self, unit: Unit, character: String, reports: &mut Vec<Report>) -> (LineState, ScriptLine) {
        let key = self.locale.and_then(|locale| self.voices.dub_of(&unit.key, locale));
        let key = key.as_deref().unwrap_or(&unit.key);
        let mut length_us = |path: &Path| FileFacts::length_us(path).map_err(|report| reports.push(report)).ok();
        let recorded = self.recordings.find(key).and_then(&mut length_us);
        let original_us = match (self.locale, self.recordings.find(&unit.key)) {
            (None, _) => recorded,
            (Some(_), Some(path)) => length_us(path),
            (Some(_), None) => None,
        };
        let visemes_us = unit.segments.iter().filter_map(|segment| segment.time_ms).map(|(_, end)| end * 1000).max();
        let original_us = original_us.or(visemes_us);
        let status = self.settings.audio.sync_statuses.of(&unit.key);
        // Only dubs follow an original.
        let allowed_us = self.locale.and(original_us).and_then(|original_us| status.range_us(original_us));
        let is_too = allowed_us.as_ref().zip(recorded).and_then(|(range, recorded)| match recorded {
            short if short < *range.start() => Some("too short"),
            long if long > *range.end() => Some("too long"),
            _ => None,
        });
        let (state, reason) = match (recorded, is_too) {
            (None, _) if unit.translations.first().is_some_and(Translation::is_empty) => {
                (LineState::Missing, Some("not translated".to_owned()))
            }
            (None, _) => (LineState::Missing, Some("not recorded".to_owned())),
            _ if self.stale.contains(key) => (LineState::Stale, Some("the text has changed".to_owned())),
            (Some(us), Some(how)) => (LineState::Length, Some(format!("{how} ({:.3} s)", us as f64 / 1e6))),
            _ => (LineState::Recorded, None),
        };
        let recording = self.recordings.place(key);
        let sync_status = if self.locale.is_some() { status.label() } else { String::new() };
        (state, ScriptLine { unit, character, session: 1, original_us, sync_status, allowed_us, recording, reason })
    }
}

/// Returns the speakers that the texts name, separated by `, `; `None` if they name none.
fn speakers(unit: &Unit, characters: &Spellings) -> Option<String> {
    let names = unit.segments.iter().filter_map(|segment| segment.speaker.as_deref());
    let names: BTreeSet<&str> = names.map(|name| characters.known(name)).collect();
    (!names.is_empty()).then(|| Vec::from_iter(names).join(", "))
}
