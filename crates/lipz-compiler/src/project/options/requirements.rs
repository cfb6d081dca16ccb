//! Requirements of a project for texts and names.

use super::LocaleError;
use std::collections::{BTreeMap, BTreeSet};

/// Limits of display texts. Limits that are `None` are not checked.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
#[non_exhaustive]
pub struct TextLimits {
    /// The most columns of a line. East Asian wide characters count two.
    pub(crate) line_columns: Option<u32>,
    /// The most lines of a segment.
    pub(crate) lines: Option<u32>,
    /// The most characters per second that a player reads, during the segment.
    pub(crate) characters_per_second: Option<f64>,
    /// The shortest time in seconds for which a segment with a text is shown.
    pub(crate) shortest_seconds: Option<f64>,
}

/// The percentages of clips that must have a text of their own, from 0 to 100.
#[derive(Clone, PartialEq, Debug, Default)]
#[non_exhaustive]
pub struct MinCoverage {
    /// In every locale not named below.
    pub(crate) all: Option<f64>,
    /// In these locales.
    pub(crate) locales: BTreeMap<String, f64>,
}

/// Names that Character Event Syntax and curves may use. Lists that are `None` are not checked.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct KnownNames {
    /// Characters of the scenes.
    pub(crate) characters: Option<BTreeSet<String>>,
    /// Things that characters look and point at.
    pub(crate) props: Option<BTreeSet<String>>,
    /// Emotions in addition to those of the specification.
    pub(crate) emotions: BTreeSet<String>,
    /// Actions of `does`.
    pub(crate) actions: Option<BTreeSet<String>>,
    /// Curves in addition to the emotions and the blend shapes of ARKit.
    pub(crate) curves: Option<BTreeSet<String>>,
}

impl TextLimits {
    /// Creates limits that allow everything.
    #[must_use]
    pub fn new() -> TextLimits {
        TextLimits::default()
    }

    /// Sets the most columns of a line. East Asian wide characters count two.
    #[must_use]
    pub fn line_columns(self, count: u32) -> TextLimits {
        TextLimits { line_columns: Some(count), ..self }
    }

    /// Sets the most lines of a segment.
    #[must_use]
    pub fn lines(self, count: u32) -> TextLimits {
        TextLimits { lines: Some(count), ..self }
    }

    /// Sets the most characters per second that a player reads.
    #[must_use]
    pub fn characters_per_second(self, count: f64) -> TextLimits {
        TextLimits { characters_per_second: Some(count), ..self }
    }

    /// Sets the shortest time in seconds for which a segment with a text is shown.
    #[must_use]
    pub fn shortest_seconds(self, seconds: f64) -> TextLimits {
        TextLimits { shortest_seconds: Some(seconds), ..self }
    }

    /// Returns these limits, with those of `others` where these are `None`.
    pub(crate) fn or(self, others: TextLimits) -> TextLimits {
        TextLimits {
            line_columns: self.line_columns.or(others.line_columns),
            lines: self.lines.or(others.lines),
            characters_per_second: self.characters_per_second.or(others.characters_per_second),
            shortest_seconds: self.shortest_seconds.or(others.shortest_seconds),
        }
    }

    /// Returns the most columns of a line; `None` if they are not checked.
    pub fn get_line_columns(&self) -> Option<u32> {
        self.line_columns
    }

    /// Returns the most lines of a segment; `None` if they are not checked.
    pub fn get_lines(&self) -> Option<u32> {
        self.lines
    }

    /// Returns the most characters per second that a player reads; `None` if they are not checked.
    pub fn get_characters_per_second(&self) -> Option<f64> {
        self.characters_per_second
    }

    /// Returns the shortest time in seconds for which a segment with a text is shown; `None` if it is not checked.
    pub fn get_shortest_seconds(&self) -> Option<f64> {
        self.shortest_seconds
    }
}

impl MinCoverage {
    /// Creates a requirement of no coverage.
    #[must_use]
    pub fn new() -> MinCoverage {
        MinCoverage::default()
    }

    /// Requires this percentage in every locale that is not named.
    #[must_use]
    pub fn all(self, percent: f64) -> MinCoverage {
        MinCoverage { all: Some(percent), ..self }
    }

    /// Requires this percentage in one locale.
    ///
    /// # Errors
    /// If the tag is not a BCP 47 language tag. A run checks at its start whether the project accepts the tag.
    pub fn locale(mut self, tag: impl AsRef<str>, percent: f64) -> Result<MinCoverage, LocaleError> {
        self.locales.insert(LocaleError::check(tag.as_ref(), true)?, percent);
        Ok(self)
    }

    /// Returns the percentage required in every locale that is not named.
    pub fn get_all(&self) -> Option<f64> {
        self.all
    }

    /// Returns the percentages required in the named locales.
    pub fn get_locales(&self) -> &BTreeMap<String, f64> {
        &self.locales
    }
}

impl KnownNames {
    /// Creates empty lists: any name is accepted, except for emotions, which are those of the specification.
    #[must_use]
    pub fn new() -> KnownNames {
        KnownNames::default()
    }

    /// Sets the characters of the scenes.
    #[must_use]
    pub fn characters<T: Into<String>>(self, names: impl IntoIterator<Item = T>) -> KnownNames {
        KnownNames { characters: Some(strings(names)), ..self }
    }

    /// Sets the things that characters look and point at.
    #[must_use]
    pub fn props<T: Into<String>>(self, names: impl IntoIterator<Item = T>) -> KnownNames {
        KnownNames { props: Some(strings(names)), ..self }
    }

    /// Sets the emotions in addition to those of the specification.
    #[must_use]
    pub fn emotions<T: Into<String>>(self, names: impl IntoIterator<Item = T>) -> KnownNames {
        KnownNames { emotions: strings(names), ..self }
    }

    /// Sets the actions of `does`.
    #[must_use]
    pub fn actions<T: Into<String>>(self, names: impl IntoIterator<Item = T>) -> KnownNames {
        KnownNames { actions: Some(strings(names)), ..self }
    }

    /// Sets the curves in addition to the emotions and the blend shapes of ARKit.
    #[must_use]
    pub fn curves<T: Into<String>>(self, names: impl IntoIterator<Item = T>) -> KnownNames {
        KnownNames { curves: Some(strings(names)), ..self }
    }

    /// Returns the characters of the scenes; `None` if any name is accepted.
    pub fn get_characters(&self) -> Option<&BTreeSet<String>> {
        self.characters.as_ref()
    }

    /// Returns the things that characters look and point at; `None` if any name is accepted.
    pub fn get_props(&self) -> Option<&BTreeSet<String>> {
        self.props.as_ref()
    }

    /// Returns the emotions in addition to those of the specification.
    pub fn get_emotions(&self) -> &BTreeSet<String> {
        &self.emotions
    }

    /// Returns the actions of `does`; `None` if any name is accepted.
    pub fn get_actions(&self) -> Option<&BTreeSet<String>> {
        self.actions.as_ref()
    }

    /// Returns the curves in addition to the emotions and the blend shapes of ARKit; `None` if any name is accepted.
    pub fn get_curves(&self) -> Option<&BTreeSet<String>> {
        self.curves.as_ref()
    }
}

/// Returns the items as a set of strings.
fn strings<T: Into<String>>(items: impl IntoIterator<Item = T>) -> BTreeSet<String> {
    items.into_iter().map(Into::into).collect()
}
