//! Formats of files for translators.

use clap::ValueEnum;
use lipz_texts::Shape;

/// A format for translators, for the command line.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum TextFormatArgument {
    /// gettext, for Poedit, Weblate and others: a file for each locale
    Po,
    /// A gettext template without translations, from which tools create a PO file for each locale
    Pot,
    /// XLIFF 2.1: a unit for each clip with its segments, placeholders and states; a file for each locale
    Xliff,
    /// XLIFF 1.2, for tools that do not support XLIFF 2
    #[value(name = "xliff-1.2")]
    Xliff12,
    /// A table for spreadsheets, with a column for each locale
    Csv,
    /// A CSV string table of Unity: Key, Shared Comments, German (Germany)(de-DE)
    Unity,
    /// A CSV of Godot: keys, en_US, de_DE
    Godot,
    /// A CSV string table of Unreal: Key, SourceString, de-DE, Comment
    Unreal,
    /// A CSV of Yarn Spinner, a file for each locale
    Yarn,
    /// A spreadsheet, with the columns of csv
    Xlsx,
    /// All data about the texts, for programs
    Json,
}

impl From<TextFormatArgument> for lipz_texts::Format {
    fn from(format: TextFormatArgument) -> lipz_texts::Format {
        match format {
            TextFormatArgument::Po | TextFormatArgument::Pot => lipz_texts::Format::Po,
            TextFormatArgument::Xliff => lipz_texts::Format::Xliff,
            TextFormatArgument::Xliff12 => lipz_texts::Format::Xliff12,
            TextFormatArgument::Csv
            | TextFormatArgument::Unity
            | TextFormatArgument::Godot
            | TextFormatArgument::Unreal
            | TextFormatArgument::Yarn => lipz_texts::Format::Csv,
            TextFormatArgument::Xlsx => lipz_texts::Format::Xlsx,
            TextFormatArgument::Json => lipz_texts::Format::Json,
        }
    }
}

impl TextFormatArgument {
    /// Returns the extension of its files.
    pub(crate) fn extension(self) -> &'static str {
        match self {
            TextFormatArgument::Pot => "pot",
            format => lipz_texts::Format::from(format).extension(),
        }
    }

    /// Returns the columns of a CSV in this format; `None` if it is not a CSV.
    pub(crate) fn shape(self) -> Option<Shape> {
        Some(match self {
            TextFormatArgument::Csv => Shape::Sheet,
            TextFormatArgument::Unity => Shape::Unity,
            TextFormatArgument::Godot => Shape::Godot,
            TextFormatArgument::Unreal => Shape::Unreal,
            TextFormatArgument::Yarn => Shape::Yarn,
            TextFormatArgument::Po
            | TextFormatArgument::Pot
            | TextFormatArgument::Xliff
            | TextFormatArgument::Xliff12
            | TextFormatArgument::Xlsx
            | TextFormatArgument::Json => return None,
        })
    }
}
