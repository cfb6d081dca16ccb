//! The options for writing an exchange file.

use crate::exchange::Division;

/// The options for writing a file.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct WriteOptions {
    /// Whether it has a text per clip or per segment. Formats with segments contain both.
    pub division: Division,
    /// The columns of a CSV.
    pub shape: Shape,
    /// Whether cells of a CSV are written as they are, even if a spreadsheet treats them as formulas.
    pub raw_cells: bool,
    /// The namespace of the texts in Unreal. With it, a PO file has the contexts and comments that Unreal needs.
    pub namespace: Option<String>,
}

impl WriteOptions {
    /// Returns the default options: a text per clip, and columns for spreadsheets.
    #[must_use]
    pub fn new() -> WriteOptions {
        WriteOptions::default()
    }

    /// Sets whether there is a text per clip or per segment.
    #[must_use]
    pub fn division(self, division: Division) -> WriteOptions {
        WriteOptions { division, ..self }
    }

    /// Sets the columns of a CSV.
    #[must_use]
    pub fn shape(self, shape: Shape) -> WriteOptions {
        WriteOptions { shape, ..self }
    }

    /// Sets whether cells of a CSV are written as they are.
    #[must_use]
    pub fn raw_cells(self, raw_cells: bool) -> WriteOptions {
        WriteOptions { raw_cells, ..self }
    }

    /// Sets the namespace of the texts in Unreal.
    #[must_use]
    pub fn namespace(self, namespace: Option<String>) -> WriteOptions {
        WriteOptions { namespace, ..self }
    }
}

/// The columns of a CSV, and their names. Readers recognise all of them by name.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Shape {
    /// For spreadsheets: `key`, information for translators, a column per locale.
    #[default]
    Sheet,
    /// String tables of Unity's Localization package: `Key`, `Shared Comments`, `German(de-DE)`.
    Unity,
    /// Translations of Godot: `keys`, `en_US`, `de_DE`; Godot ignores columns that start with `_`.
    Godot,
    /// String tables of Unreal: `Key`, `SourceString`, and a column per locale.
    Unreal,
    /// Strings of Yarn Spinner, a file per locale: `language`, `id`, `text`, `file`, `node`, `lineNumber`, `lock`,
    /// `comment`. They have no source texts, but `lock`, which shows whether these have changed.
    Yarn,
}

impl Shape {
    /// All shapes.
    pub const ALL: [Shape; 5] = [Shape::Sheet, Shape::Unity, Shape::Godot, Shape::Unreal, Shape::Yarn];
}
