//! The source texts of translations according to an exchange file, whether imported or not.

use super::ConfirmedTranslations;
use super::clip::mark_of;
use crate::exchange::Entry;
use crate::exchange::clip_texts::trimmed;
use crate::exchange::model::{State, joined};
use lipz_diagnostics::Span;
use lipz_file::text::trim;
use std::collections::BTreeMap;

impl ConfirmedTranslations {
    /// Returns the texts of a clip after the import, with nothing confirmed.
    pub(super) fn new(
        locale: &str,
        sources: &[String],
        own: Option<&[String]>,
        imported: &BTreeMap<usize, String>,
    ) -> ConfirmedTranslations {
        let count = sources.len();
        let mut texts = own.map_or_else(|| vec![String::new(); count], <[String]>::to_vec);
        texts.resize(count, String::new());
        for (at, text) in imported {
            texts.get_mut(*at).into_iter().for_each(|slot| slot.clone_from(text));
        }
        ConfirmedTranslations {
            locale: locale.to_owned(),
            sources: sources.to_vec(),
            texts,
            states: vec![None; count],
            is_rejected: vec![false; count],
            is_looked_at: vec![false; count],
            is_by_segment: false,
        }
    }
}

/// Returns the source texts of translations that were imported although their source has changed; `None` if there are
/// none.
pub(super) fn of_older(
    mut older: ConfirmedTranslations,
    entries: &[&Entry],
    imported: &BTreeMap<usize, String>,
) -> Option<ConfirmedTranslations> {
    for entry in entries {
        let Some(source) = &entry.source else { continue };
        let sources: Vec<(usize, String)> = match entry.segment {
            Some(number) => vec![(number.saturating_sub(1), trim(&source.text).to_owned())],
            None => trimmed(&source.text).into_iter().enumerate().collect(),
        };
        if entry.segment.is_none() && sources.len() != older.sources.len() {
            continue;
        }
        for (at, source) in sources {
            let is_imported = imported.contains_key(&at);
            let (Some(slot), Some(state)) = (older.sources.get_mut(at), older.states.get_mut(at)) else { continue };
            if is_imported && *slot != source {
                *slot = source;
                *state = Some(entry.state);
                older.is_looked_at.get_mut(at).into_iter().for_each(|is_looked_at| *is_looked_at = true);
            }
        }
    }
    older.states.iter().any(Option::is_some).then_some(older)
}

/// Returns the confirmations by the entries of the clip in the locale; `None` if there are none.
pub(super) fn of_entries(mut confirmed: ConfirmedTranslations, entries: &[&Entry]) -> Option<ConfirmedTranslations> {
    for entry in entries.iter().filter(|entry| entry.says_state || entry.state >= State::Translated) {
        let parts: Vec<(usize, String)> = match entry.segment {
            Some(number) => vec![(number.saturating_sub(1), trim(&entry.text.text).to_owned())],
            None => trimmed(&entry.text.text).into_iter().enumerate().collect(),
        };
        let now = match entry.segment {
            Some(number) => confirmed.sources.get(number.saturating_sub(1)).cloned().unwrap_or_default(),
            None => joined(&confirmed.sources),
        };
        if !is_made_from(entry, &now) {
            continue;
        }
        confirmed.is_by_segment |= entry.segment.is_some();
        let is_changed = entry.mark.is_some_and(|mark| mark != mark_of(&parts));
        for (at, text) in parts {
            if text.is_empty() || confirmed.texts.get(at) != Some(&text) {
                continue;
            }
            let looked_at = confirmed.is_looked_at.get_mut(at);
            looked_at.into_iter().for_each(|is_looked_at| *is_looked_at |= is_changed || entry.says_state);
            let is_rejected = confirmed.is_rejected.get_mut(at);
            is_rejected.into_iter().for_each(|is_rejected| *is_rejected |= entry.state == State::Initial);
            let state = confirmed.states.get_mut(at);
            state.into_iter().for_each(|state| *state = (*state).max(Some(entry.state)));
        }
    }
    confirmed.states.iter().any(Option::is_some).then_some(confirmed)
}

/// Returns the positions of source texts in the entries that differ from the current ones.
pub(super) fn other_sources(sources: &[String], entries: &[&Entry]) -> Vec<(usize, Span)> {
    let now = joined(sources);
    let is_other = |entry: &&&Entry| {
        let own = entry.segment.map(|number| sources.get(number.saturating_sub(1)).map_or("", String::as_str));
        entry.source.is_some() && !is_made_from(entry, own.unwrap_or(&now))
    };
    entries.iter().filter(is_other).filter_map(|entry| Some((entry.file, entry.source.as_ref()?.span))).collect()
}

/// Whether the file states that the translation was made from this text.
fn is_made_from(entry: &Entry, now: &str) -> bool {
    match (&entry.source, entry.source_mark) {
        (Some(source), _) if entry.segment.is_some() => trim(&source.text) == now,
        (Some(source), _) => joined(&trimmed(&source.text)) == now,
        (None, Some(mark)) => mark.is_of(now),
        (None, None) => false,
    }
}
