//! The results of merging.

use crate::exchange::{Mark, State};
use lipz_diagnostics::{Diagnostic, Span};

/// A Lipz file with translations.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct MergedFile {
    /// The new text of the file; `None` if nothing changes.
    pub text: Option<String>,
    /// The conflicts, each with the number of its exchange file.
    pub found: Vec<(usize, Diagnostic)>,
    /// The numbers of merged texts.
    pub counts: Counts,
    /// The source texts of translations that the file confirms, imported or unchanged.
    pub confirmed: Vec<ConfirmedTranslations>,
    /// The comments of translators, whether the translations were imported or not.
    pub comments: Vec<TranslatorComments>,
    /// The source texts of the clip's segments; empty if it has none.
    pub sources: Vec<String>,
    /// The source texts in the file that differ from those of the clip, with the number of the file. They are never
    /// imported.
    pub other_sources: Vec<(usize, Span)>,
}

/// The comments of translators on a clip's translations into a locale.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct TranslatorComments {
    /// The locale.
    pub locale: String,
    /// The comments, one line each.
    pub lines: Vec<String>,
    /// The mark of the comments at the time of the export, if there were any.
    pub exported: Option<Mark>,
}

/// Translations of a clip into a locale and their source texts, according to an exchange file. The source texts are the
/// current ones, or older ones if their translations were imported regardless.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct ConfirmedTranslations {
    /// The locale of the translations.
    pub locale: String,
    /// The source texts of the segments.
    pub sources: Vec<String>,
    /// Their translations after the import.
    pub texts: Vec<String>,
    /// The state of each segment, the highest one of several files; `None` if no file states it.
    pub states: Vec<Option<State>>,
    /// Whether a file rejects the text of the segment, although a different file may accept it.
    pub is_rejected: Vec<bool>,
    /// Whether the text of the segment was changed in the file, or the file states the state of each text. Other texts
    /// may only be new to the project's [record](crate::TextRecord), and possibly unchecked.
    pub is_looked_at: Vec<bool>,
    /// Whether the file has an entry for each segment, rather than one for the clip.
    pub is_by_segment: bool,
}

/// The numbers of texts of an exchange file, each for a clip in a locale.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct Counts {
    /// Clips that had no text in the locale.
    pub added: usize,
    /// Clips whose text changed.
    pub changed: usize,
    /// Clips whose text is the same in the file.
    pub unchanged: usize,
    /// Clips whose text has changed in the project since the export, but not in the file. They stay unchanged.
    pub newer: usize,
    /// Clips with conflicts. They stay unchanged.
    pub refused: usize,
    /// Texts that were replaced although the file had no mark of them at the export.
    pub unmarked: usize,
}

impl Counts {
    /// Adds the counts of `others`.
    pub fn add(&mut self, others: Counts) {
        self.added += others.added;
        self.changed += others.changed;
        self.unchanged += others.unchanged;
        self.newer += others.newer;
        self.refused += others.refused;
        self.unmarked += others.unmarked;
    }
}
