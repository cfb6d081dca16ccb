//! What the columns of a CSV are, by their names.

use crate::ReadOptions;
use crate::entry::NoLocale;
use std::sync::Arc;

/// What is in a column.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) enum Column {
    /// Keys, perhaps with the number of a segment.
    Key,
    /// Texts to be translated.
    Source,
    /// The locale of the row.
    Language,
    /// The translation into the locale of the row.
    Text,
    /// The translations into a locale.
    Locale(Arc<str>),
    /// The mark of the text to be translated.
    SourceMark,
    /// The marks of the translations into a locale.
    Mark(Arc<str>),
    /// How far the translation into the locale of the row is.
    State,
    /// For people, or for another tool.
    Other,
}

/// Why nothing of a column is imported.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum NoColumn {
    /// Nobody knows what it is.
    Unknown,
    /// It is called as a language, and that is no locale of the project.
    Locale,
}

/// Columns that are for people, or for other tools.
const OTHERS: [&str; 16] = [
    "",
    "characters",
    "comment",
    "comments",
    "context",
    "description",
    "events",
    "file",
    "limit",
    "linenumber",
    "node",
    "note",
    "notes",
    "recording",
    "speaker",
    "time",
];

/// What stands before the locale in the names of columns with marks.
pub(crate) const LOCK: &str = "lock";

/// What the columns with these names are; `Err` is one that is not imported.
pub(super) fn columns(names: &[&str], options: &ReadOptions) -> Vec<Result<Column, NoColumn>> {
    let is = |name: &str, known: &str| name.trim().eq_ignore_ascii_case(known);
    let has = |known: &str| names.iter().any(|name| is(name, known));
    let is_by_row = has("language") && has("text");
    let key = ["key", "keys", "id"].into_iter().find(|key| has(key)).unwrap_or_default();
    let column = |name: &&str| {
        let name = name.trim();
        let plain = name.trim_start_matches('_');
        // Unity numbers its rows in `Id`; in lower case it is Indonesian.
        let is_number = name == "Id" && key != "id";
        if is(name, key) {
            return Ok(Column::Key);
        } else if is_number
            || OTHERS.iter().any(|other| is(plain, other))
            || plain.to_ascii_lowercase().ends_with(" comments")
        {
            return Ok(Column::Other);
        } else if is(name, "source") || is(name, "sourcestring") {
            return Ok(Column::Source);
        } else if is_by_row && is(name, "language") {
            return Ok(Column::Language);
        } else if is_by_row && is(name, "text") {
            return Ok(Column::Text);
        } else if is(name, "state") {
            return Ok(Column::State);
        } else if is(name, LOCK) {
            return Ok(Column::SourceMark);
        }
        if let Some(locale) = plain.strip_prefix(LOCK).and_then(|rest| rest.strip_prefix(' ')) {
            return options.locale(locale).map(|locale| Column::Mark(locale.into())).map_err(|_| NoColumn::Unknown);
        }
        match locale(name, options) {
            Ok(locale) if locale == options.source_locale && !has("source") && !has("sourcestring") => {
                Ok(Column::Source)
            }
            Ok(locale) => Ok(Column::Locale(locale.into())),
            Err(_) if name.starts_with('_') || name.starts_with('?') => Ok(Column::Other),
            Err(NoLocale::Tag) => Err(NoColumn::Unknown),
            Err(NoLocale::Shape) => Err(NoColumn::Locale),
        }
    };
    names.iter().map(column).collect()
}

/// The locale of a column: `de-DE`, `German(de-DE)`, `German (Germany)(de-DE)`.
fn locale(name: &str, options: &ReadOptions) -> Result<String, NoLocale> {
    let inside = name.strip_suffix(')').and_then(|name| name.rsplit_once('(')).map(|(_, tag)| tag);
    options.locale(inside.unwrap_or(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(names: &[&str]) -> Vec<Result<Column, NoColumn>> {
        columns(names, &ReadOptions::new("en-us").known(["de-de"]))
    }

    #[test]
    fn headers_of_all_tools() {
        let locale = |tag: &str| Ok(Column::Locale(tag.into()));
        let other = || Ok(Column::Other);
        let no_locale = Err(NoColumn::Locale);
        assert_eq!(of(&["keys", "en", "de", "id"]), [Ok(Column::Key), Ok(Column::Source), locale("de-de"), no_locale]);
        assert_eq!(
            of(&["Key", "Id", "Shared Comments", "English(en)", "German(de)", "German(de) Comments"]),
            [Ok(Column::Key), other(), other(), Ok(Column::Source), locale("de-de"), other()]
        );
        assert_eq!(
            of(&["Key", "SourceString", "en-US", "Comment"]),
            [Ok(Column::Key), Ok(Column::Source), locale("en-us"), other()]
        );
        assert_eq!(
            of(&["language", "id", "text", "lock"]),
            [Ok(Column::Language), Ok(Column::Key), Ok(Column::Text), Ok(Column::SourceMark)]
        );
        assert_eq!(
            of(&["key", "_lock de_DE", "_ours", "Who knows"]),
            [Ok(Column::Key), Ok(Column::Mark("de-de".into())), other(), Err(NoColumn::Unknown)]
        );
    }
}
