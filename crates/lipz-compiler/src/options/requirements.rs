//! What a project requires of texts and of names.

use super::LocaleError;
use std::collections::{BTreeMap, BTreeSet};

/// Limits of display texts; those that are `None` are not checked.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
#[non_exhaustive]
pub struct TextLimits {
    /// Columns of a line; East Asian wide characters count two.
    pub(crate) line_columns: Option<u32>,
    /// Lines of a segment.
    pub(crate) lines: Option<u32>,
    /// Characters that a player reads in a second, over the time of the segment.
    pub(crate) characters_per_second: Option<f64>,
}

/// Shares of the clips that must have a text of their own, in percent from 0 to 100.
#[derive(Clone, PartialEq, Debug, Default)]
#[non_exhaustive]
pub struct MinCoverage {
    /// In every locale that is not named below.
    pub(crate) all: Option<f64>,
    /// In these locales.
    pub(crate) locales: BTreeMap<String, f64>,
}

/// Names that Character Event Syntax and curves may have; a list that is `None` is not checked.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct KnownNames {
    /// Characters of the scenes.
    pub(crate) characters: Option<BTreeSet<String>>,
    /// Things that characters look and point at.
    pub(crate) props: Option<BTreeSet<String>>,
    /// Emotions beyond those of the specification.
    pub(crate) emotions: BTreeSet<String>,
    /// Actions of `does`.
    pub(crate) actions: Option<BTreeSet<String>>,
    /// Curves beyond the emotions and the blend shapes of ARKit.
    pub(crate) curves: Option<BTreeSet<String>>,
}

impl TextLimits {
    /// No limits.
    #[must_use]
    pub fn new() -> TextLimits {
        TextLimits::default()
    }

    /// Sets the columns of a line; East Asian wide characters count two.
    #[must_use]
    pub fn line_columns(self, count: u32) -> TextLimits {
        TextLimits { line_columns: Some(count), ..self }
    }

    /// Sets the lines of a segment.
    #[must_use]
    pub fn lines(self, count: u32) -> TextLimits {
        TextLimits { lines: Some(count), ..self }
    }

    /// Sets the characters that a player reads in a second.
    #[must_use]
    pub fn characters_per_second(self, count: f64) -> TextLimits {
        TextLimits { characters_per_second: Some(count), ..self }
    }

    /// The columns of a line; `None` if they are not checked.
    pub fn get_line_columns(&self) -> Option<u32> {
        self.line_columns
    }

    /// The lines of a segment; `None` if they are not checked.
    pub fn get_lines(&self) -> Option<u32> {
        self.lines
    }

    /// The characters that a player reads in a second; `None` if they are not checked.
    pub fn get_characters_per_second(&self) -> Option<f64> {
        self.characters_per_second
    }
}

impl MinCoverage {
    /// No required coverage.
    #[must_use]
    pub fn new() -> MinCoverage {
        MinCoverage::default()
    }

    /// Requires this share of every locale that is not named, in percent.
    #[must_use]
    pub fn all(self, percent: f64) -> MinCoverage {
        MinCoverage { all: Some(percent), ..self }
    }

    /// Requires this share of one locale, in percent.
    ///
    /// # Errors
    /// If the tag is not a BCP 47 language tag. Whether the project accepts it is checked when a run starts.
    pub fn locale(mut self, tag: impl AsRef<str>, percent: f64) -> Result<MinCoverage, LocaleError> {
        self.locales.insert(LocaleError::check(tag.as_ref(), true)?, percent);
        Ok(self)
    }

    /// The share in every locale that is not named, in percent.
    pub fn get_all(&self) -> Option<f64> {
        self.all
    }

    /// The shares in the locales that are named, in percent.
    pub fn get_locales(&self) -> &BTreeMap<String, f64> {
        &self.locales
    }
}

impl KnownNames {
    /// No lists: any name is accepted, but for emotions, which are those of the specification.
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

    /// Sets the emotions beyond those of the specification.
    #[must_use]
    pub fn emotions<T: Into<String>>(self, names: impl IntoIterator<Item = T>) -> KnownNames {
        KnownNames { emotions: strings(names), ..self }
    }

    /// Sets the actions of `does`.
    #[must_use]
    pub fn actions<T: Into<String>>(self, names: impl IntoIterator<Item = T>) -> KnownNames {
        KnownNames { actions: Some(strings(names)), ..self }
    }

    /// Sets the curves beyond the emotions and the blend shapes of ARKit.
    #[must_use]
    pub fn curves<T: Into<String>>(self, names: impl IntoIterator<Item = T>) -> KnownNames {
        KnownNames { curves: Some(strings(names)), ..self }
    }

    /// The characters of the scenes; `None` if any name is accepted.
    pub fn get_characters(&self) -> Option<&BTreeSet<String>> {
        self.characters.as_ref()
    }

    /// The things that characters look and point at; `None` if any name is accepted.
    pub fn get_props(&self) -> Option<&BTreeSet<String>> {
        self.props.as_ref()
    }

    /// The emotions beyond those of the specification.
    pub fn get_emotions(&self) -> &BTreeSet<String> {
        &self.emotions
    }

    /// The actions of `does`; `None` if any name is accepted.
    pub fn get_actions(&self) -> Option<&BTreeSet<String>> {
        self.actions.as_ref()
    }

    /// The curves beyond the emotions and the blend shapes of ARKit; `None` if any name is accepted.
    pub fn get_curves(&self) -> Option<&BTreeSet<String>> {
        self.curves.as_ref()
    }
}

/// The items as a set of strings.
fn strings<T: Into<String>>(items: impl IntoIterator<Item = T>) -> BTreeSet<String> {
    items.into_iter().map(Into::into).collect()
}
