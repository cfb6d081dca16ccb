//! Use of the record: units get their states from it, and imports are stored in it.

use super::{Standing, TextRecord};
use crate::exchange::model::{State, Unit};
use crate::exchange::variants::source_tag;
use crate::merge::ConfirmedTranslations;
use lipz_file::locale::variant_tag;

impl TextRecord {
    /// Sets the states, the source texts and the comments of a unit's translations, which are in these locales.
    pub fn describe(&self, file: &str, source_locale: &str, locales: &[String], unit: &mut Unit) {
        let sources: Vec<&str> = unit.segments.iter().map(|segment| segment.source.as_str()).collect();
        let tag = |locale: &str| variant_tag(locale, unit.variant.as_deref().unwrap_or(""));
        let source_locale = &tag(source_locale);
        for (locale, translation) in locales.iter().zip(&mut unit.translations) {
            let locale = &tag(locale);
            translation.comments = self.comments(file, locale).to_vec();
            if translation.is_empty() {
                continue;
            }
            let standings = self.standings(file, source_locale, locale, &sources, &translation.texts);
            let mut states = Vec::new();
            let mut made_from: Vec<String> = sources.iter().map(|source| (*source).to_owned()).collect();
            for (at, standing) in standings.into_iter().enumerate() {
                match standing {
                    Standing::Current(state) => states.push(state),
                    Standing::Stale { made_from: old, .. } => {
                        made_from.get_mut(at).into_iter().for_each(|slot| slot.clone_from(&old));
                    }
                    Standing::Unknown if translation.texts.get(at).is_some_and(|text| !text.is_empty()) => {
                        states.push(State::Translated);
                    }
                    Standing::Unknown => {}
                }
            }
            translation.state = states.into_iter().min().unwrap_or(State::Translated);
            let is_stale = made_from.iter().zip(&sources).any(|(made_from, source)| made_from != source);
            translation.made_from = is_stale.then_some(made_from);
        }
    }

    /// Stores the confirmations of an import. Returns the number of texts whose source text was different or unknown
    /// before.
    pub fn confirm(&mut self, file: &str, source_locale: &str, confirmed: &ConfirmedTranslations) -> usize {
        let ConfirmedTranslations { locale, sources, texts, states, is_rejected, is_looked_at, is_by_segment } =
            confirmed;
        let source_locale = &source_tag(source_locale, locale);
        let before = self.standings(file, source_locale, locale, sources, texts);
        // The export already marked a clip with such a segment.
        let needs_work =
            |before: &Standing| matches!(before, Standing::Stale { .. } | Standing::Current(State::Initial));
        let is_marked = !is_by_segment && before.iter().any(needs_work);
        let mut count = 0;
        // Of two copies of a file, the one that differs from the project was changed.
        let of_changed_copy = |before: &Standing, state: State, is_rejected: bool| match before {
            Standing::Stale { .. } | Standing::Current(State::Initial) => state,
            _ if is_rejected => State::Initial,
            _ => state,
        };
        let approved: Vec<Option<State>> = (before.iter().zip(states).zip(is_rejected).zip(is_looked_at))
            .map(|(((before, state), is_rejected), is_looked_at)| {
                match (before, of_changed_copy(before, (*state)?, *is_rejected)) {
                    // A rejected text, which did not change.
                    (Standing::Current(_), State::Initial) => Some(State::Initial).filter(|_| !is_marked),
                    (Standing::Current(known), state) if *is_looked_at => Some(state.max(*known)),
                    (Standing::Current(_), _) => None,
                    (Standing::Stale { .. }, State::Initial) => None,
                    (Standing::Stale { .. }, _) if !is_looked_at => None,
                    (_, state) => {
                        count += 1;
                        Some(state)
                    }
                }
            })
            .collect();
        if approved.iter().any(Option::is_some) {
            self.record(file, source_locale, locale, (sources, texts), &approved, true);
        }
        count
    }
}
