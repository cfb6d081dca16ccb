//! The state of a clip's current translations according to the record.

use super::TextRecord;
use super::version::ApprovedMark;
use crate::exchange::{Mark, State};
use lipz_file::locale::split_variant;
use std::collections::{BTreeSet, HashMap, HashSet};

/// The relation of a translation to the current source text.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Standing {
    /// The translation was made from this source text, or changed later while the source text stayed the same.
    Current(State),
    /// The source text has changed since.
    Stale {
        /// The source text of the translation.
        made_from: String,
        /// Whether the translation has changed as well, without being approved.
        is_changed: bool,
    },
    /// The record has no information about it.
    Unknown,
}

/// The same, with its source in the record.
pub(super) enum Fact<'r> {
    Current {
        state: State,
        /// Whether an import put the text there.
        is_imported: bool,
        /// Whether the record has this text for the current source text.
        is_recorded: bool,
    },
    Stale {
        /// The index in the versions of the file.
        version: usize,
        /// The index in the segments of the version.
        segment: usize,
        made: ApprovedMark,
        source: &'r str,
        is_changed: bool,
    },
    Unknown,
}

/// An entry of the record about a locale of a file.
#[derive(Clone, Copy)]
struct AcceptedFact<'r> {
    version: usize,
    segment: usize,
    made: ApprovedMark,
    source: &'r str,
}

impl TextRecord {
    /// Returns the standing of each segment's translation; `Unknown` for those without a text.
    ///
    /// A segment may have moved within its clip, so pairs of texts are compared. `file` is the path of the Lipz file;
    /// `sources` and `texts` are the texts of its segments in both locales.
    pub fn standings<S: AsRef<str>, T: AsRef<str>>(
        &self,
        file: &str,
        source_locale: &str,
        locale: &str,
        sources: &[S],
        texts: &[T],
    ) -> Vec<Standing> {
        let facts = self.facts(file, source_locale, locale, sources, texts);
        let standing = |fact| match fact {
            Fact::Current { state, .. } => Standing::Current(state),
            Fact::Stale { source, is_changed, .. } => Standing::Stale { made_from: source.to_owned(), is_changed },
            Fact::Unknown => Standing::Unknown,
        };
        facts.into_iter().map(standing).collect()
    }

    /// Returns the information about each of the texts.
    pub(super) fn facts<S: AsRef<str>, T: AsRef<str>>(
        &self,
        file: &str,
        source_locale: &str,
        locale: &str,
        sources: &[S],
        texts: &[T],
    ) -> Vec<Fact<'_>> {
        let known = self.known(file, source_locale, locale);
        let marks: Vec<Mark> = texts.iter().map(|text| Mark::of(text.as_ref())).collect();
        let source = |at: usize| sources.get(at).map_or("", AsRef::as_ref);
        let has_text = |at: usize| texts.get(at).is_some_and(|text| !text.as_ref().is_empty());
        let mut pairs: HashMap<(Mark, &str), ApprovedMark> = HashMap::new();
        let mut by_mark: HashMap<Mark, Vec<&AcceptedFact<'_>>> = HashMap::new();
        for fact in &known {
            let pair = pairs.entry((fact.made.mark, fact.source)).or_insert(fact.made);
            pair.state = pair.state.max(fact.made.state);
            pair.is_imported |= fact.made.is_imported;
            by_mark.entry(fact.made.mark).or_default().push(fact);
        }
        let known_sources: HashSet<&str> = known.iter().map(|fact| fact.source).collect();
        let own_sources: HashSet<&str> = sources.iter().map(AsRef::as_ref).collect();
        let own_marks: HashSet<Mark> = marks.iter().copied().collect();
        let is_elsewhere =
            |fact: &AcceptedFact<'_>| own_marks.contains(&fact.made.mark) || own_sources.contains(fact.source);
        let mut first_of: HashMap<usize, &AcceptedFact<'_>> = HashMap::new();
        for fact in &known {
            first_of.entry(fact.segment).or_insert(fact);
        }
        let one = |at: usize, mark: Mark| {
            if !has_text(at) || known.is_empty() {
                return Fact::Unknown;
            }
            if let Some(ApprovedMark { state, is_imported, .. }) = pairs.get(&(mark, source(at))).copied() {
                return Fact::Current { state, is_imported, is_recorded: true };
            }
            let same = by_mark.get(&mark).map_or(&[][..], Vec::as_slice);
            if let Some(fact) = same.iter().find(|fact| fact.segment == at).or(same.first()) {
                return fact.stale(false);
            }
            if known_sources.contains(source(at)) {
                return Fact::Current { state: State::Translated, is_imported: false, is_recorded: false };
            }
            let before = first_of.get(&at).filter(|fact| !is_elsewhere(fact));
            before.map_or(Fact::Unknown, |fact| fact.stale(true))
        };
        marks.iter().enumerate().map(|(at, mark)| one(at, *mark)).collect()
    }

    /// Returns, by segment, whether the record has this translation of the current source text. Others may still be
    /// [`Standing::Current`], if they changed while the source text stayed the same.
    pub fn recorded<S: AsRef<str>, T: AsRef<str>>(
        &self,
        file: &str,
        source_locale: &str,
        locale: &str,
        sources: &[S],
        texts: &[T],
    ) -> Vec<bool> {
        let facts = self.facts(file, source_locale, locale, sources, texts);
        facts.iter().map(|fact| matches!(fact, Fact::Current { is_recorded: true, .. })).collect()
    }

    /// Returns the locales and marks of translations that an import put into the file, or found there unchanged.
    pub fn imported(&self, file: &str, source_locale: &str) -> BTreeSet<(String, Mark)> {
        let versions = self.files.get(file).map_or(&[][..], Vec::as_slice).iter();
        let made = versions
            .filter(|version| split_variant(&version.source_locale).0 == source_locale)
            .flat_map(|version| &version.made);
        let marks = made.flat_map(|(locale, made)| made.iter().flatten().map(move |made| (locale, made)));
        marks.filter(|(_, made)| made.is_imported).map(|(locale, made)| (locale.clone(), made.mark)).collect()
    }

    fn known(&self, file: &str, source_locale: &str, locale: &str) -> Vec<AcceptedFact<'_>> {
        let versions = self.files.get(file).map_or(&[][..], Vec::as_slice).iter().enumerate();
        let mut known = Vec::new();
        for (version, texts) in versions.filter(|(_, version)| version.source_locale == source_locale) {
            let made = texts.made.get(locale).map_or(&[][..], Vec::as_slice);
            for (segment, (made, source)) in made.iter().zip(&texts.sources).enumerate() {
                known.extend(made.map(|made| AcceptedFact { version, segment, made, source }));
            }
        }
        known
    }
}

impl<'r> AcceptedFact<'r> {
    fn stale(&self, is_changed: bool) -> Fact<'r> {
        let AcceptedFact { version, segment, made, source } = *self;
        Fact::Stale { version, segment, made, source, is_changed }
    }
}
