//! CSV: a row for each clip or segment, in the columns of several tools.

mod cell;
mod columns;
mod header;
mod read;
mod row;
mod scan;
mod write;

pub use cell::defused;
pub(crate) use read::read;
pub(crate) use write::write;
#[cfg(feature = "xlsx")]
pub(crate) use {columns::LOCK, read::Table, row::Row, write::rows};

/// Which columns a CSV has, and how they are called. Readers know all of them by their names.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Shape {
    /// For spreadsheets: `key`, what translators should know, a column for each locale.
    #[default]
    Sheet,
    /// String tables of Unity's Localization package: `Key`, `Shared Comments`, `German(de-DE)`.
    Unity,
    /// Translations of Godot: `keys`, `en_US`, `de_DE`; Godot ignores columns that start with `_`.
    Godot,
    /// String tables of Unreal: `Key`, `SourceString`, and a column for each locale.
    Unreal,
    /// Strings of Yarn Spinner, a file for each locale: `language`, `id`, `text`, `file`, `node`, `lineNumber`, `lock`,
    /// `comment`. They have no source texts, but `lock`, which shows whether these changed.
    Yarn,
}

impl Shape {
    /// All shapes.
    pub const ALL: [Shape; 5] = [Shape::Sheet, Shape::Unity, Shape::Godot, Shape::Unreal, Shape::Yarn];
}
