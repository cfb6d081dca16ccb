//! The content of a CSV's columns, determined by their names.

use crate::exchange::entry::{NoLocale, ReadOptions};
use std::sync::Arc;

/// The content of a column.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) enum CsvColumn {
    /// Keys, optionally with the number of a segment.
    Key,
    /// Source texts.
    Source,
    /// The locale of the row.
    Language,
    /// The translation into the locale of the row.
    Text,
    /// The translations into a locale.
    Locale(Arc<str>),
    /// The marks of the source texts.
    SourceMark,
    /// The marks of the translations into a locale.
    Mark(Arc<str>),
    /// The comments of translators on the translations into a locale.
    Comments(Arc<str>),
    /// The marks of these comments.
    CommentMark(Arc<str>),
    /// The state of the translation into the locale of the row.
    State,
    /// Whether the translation needs work.
    Fuzzy,
    /// The chosen takes of a recording script.
    Take,
    /// Information for people or other tools.
    Other,
}

/// A kind of columns that belong to a locale.
type LocaleColumn = fn(Arc<str>) -> CsvColumn;

/// The reason why a column is not imported.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum NoColumn {
    /// The name is unknown.
    Unknown,
    /// The name is that of a language which is not a locale of the project.
    Locale,
    /// The column has translations into a locale that the file does not name.
    Target,
}

/// Columns for people or other tools.
const OTHERS: [&str; 24] = [
    "",
    "allowed seconds",
    "characters",
    "comment",
    "comments",
    "context",
    "description",
    "direction",
    "events",
    "file",
    "limit",
    "line",
    "linenumber",
    "node",
    "note",
    "notes",
    "original seconds",
    "recording",
    "scene",
    "session",
    "speaker",
    "sync status",
    "time",
    "to record",
];

/// The prefix of the locale in the names of columns with marks.
pub(crate) const LOCK: &str = "lock";

/// The name of the column with the chosen takes of a recording script.
pub(crate) const TAKE: &str = "take";

/// The prefix of the locale in the names of columns with comments of translators.
pub(crate) const COMMENT: &str = "comment";

/// The program whose table it is, as far as it spells texts in its own way.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum CsvDialect {
    /// A spreadsheet, in which an apostrophe marks a text that looks like a formula.
    Sheet,
    /// An engine that shows cells as they are.
    Plain,
    /// An engine that replaces escapes: Godot or Unreal.
    Escaped,
    /// The dialogue script of Unreal, whose keys are the names of recordings.
    DialogueScript,
    /// Yarn Spinner, whose keys begin with `line:`, and whose old translations begin with a note.
    Yarn,
}

impl CsvDialect {
    /// Returns the dialect of a table with these columns, by their names and contents.
    pub(super) fn new(names: &[&str], columns: &[CsvColumn]) -> CsvDialect {
        let has = |known: &str| names.iter().any(|name| name.trim().eq_ignore_ascii_case(known));
        // A team's own column, such as `Notes (draft)`, does not count.
        let is_of_unity = |(name, column): (&&str, &CsvColumn)| {
            matches!(column, CsvColumn::Locale(_) | CsvColumn::Source) && name.trim().ends_with(')')
        };
        match () {
            () if has("language") && has("text") => CsvDialect::Yarn,
            () if is_dialogue_script(names) => CsvDialect::DialogueScript,
            () if has("keys") || has("sourcestring") => CsvDialect::Escaped,
            () if names.iter().zip(columns).any(is_of_unity) => CsvDialect::Plain,
            () => CsvDialect::Sheet,
        }
    }
}

/// The columns of Unreal's dialogue script with the recordings and with the texts in the language of the file.
const DIALOGUE_SCRIPT: [&str; 2] = ["AudioFileName", "SpokenDialogue"];

fn is_dialogue_script(names: &[&str]) -> bool {
    DIALOGUE_SCRIPT.iter().all(|known| names.iter().any(|name| name.trim().eq_ignore_ascii_case(known)))
}

/// Returns the content of the columns with these names; `Err` for one that is not imported.
pub(super) fn columns(names: &[&str], options: &ReadOptions) -> Vec<Result<CsvColumn, NoColumn>> {
    let is = |name: &str, known: &str| name.trim().eq_ignore_ascii_case(known);
    let has = |known: &str| names.iter().any(|name| is(name, known));
    let is_by_row = has("language") && has("text");
    // Tables that Weblate and the Translate Toolkit make of PO files.
    let is_of_po = has("context") && has("source") && has("target");
    let is_dialogue_script = is_dialogue_script(names);
    let [recording, spoken] = DIALOGUE_SCRIPT;
    let keys = match () {
        () if is_of_po => ["context"; 3],
        () if is_dialogue_script => [recording; 3],
        () => ["key", "keys", "id"],
    };
    let key = keys.into_iter().find(|key| has(key)).unwrap_or_default();
    let only = options.wanted.first().filter(|_| options.wanted.len() == 1);
    let column = |name: &&str| {
        let name = name.trim();
        let plain = name.trim_start_matches('_');
        // Unity numbers its rows in `Id`; `id` in lower case is Indonesian.
        let is_number = name == "Id" && key != "id";
        if !key.is_empty() && is(name, key) {
            return Ok(CsvColumn::Key);
        } else if is_dialogue_script && !is(name, spoken) {
            return Ok(CsvColumn::Other);
        } else if (is_of_po && is(name, "target")) || is_dialogue_script {
            return only.map(|locale| CsvColumn::Locale(locale.as_str().into())).ok_or(NoColumn::Target);
        } else if is_of_po && is(name, "translator_comments") && only.is_some() {
            return only.map(|locale| CsvColumn::Comments(locale.as_str().into())).ok_or(NoColumn::Unknown);
        } else if is_of_po && is(name, "fuzzy") {
            return Ok(CsvColumn::Fuzzy);
        } else if is_number
            || (is_of_po
                && ["id", "location", "translator_comments", "developer_comments"].iter().any(|other| is(name, other)))
            || OTHERS.iter().any(|other| is(plain, other))
            || plain.to_ascii_lowercase().ends_with(" comments")
        {
            return Ok(CsvColumn::Other);
        } else if is(name, "source") || is(name, "sourcestring") {
            return Ok(CsvColumn::Source);
        } else if is_by_row && is(name, "language") {
            return Ok(CsvColumn::Language);
        } else if is_by_row && is(name, "text") {
            return Ok(CsvColumn::Text);
        } else if is(name, "state") {
            return Ok(CsvColumn::State);
        } else if is(name, LOCK) {
            return Ok(CsvColumn::SourceMark);
        } else if is(name, TAKE) {
            return Ok(CsvColumn::Take);
        }
        // A longer prefix comes first.
        let kinds = [
            ("lock comment ", CsvColumn::CommentMark as LocaleColumn),
            ("lock ", CsvColumn::Mark),
            ("comment ", CsvColumn::Comments),
        ];
        if let Some((locale, kind)) = kinds.iter().find_map(|(prefix, kind)| Some((plain.strip_prefix(prefix)?, kind)))
        {
            return options.locale(locale).map(|locale| kind(locale.into())).map_err(|_| NoColumn::Unknown);
        }
        match locale(name, options) {
            Ok(locale) if locale == options.source_locale && !has("source") && !has("sourcestring") => {
                Ok(CsvColumn::Source)
            }
            Ok(locale) => Ok(CsvColumn::Locale(locale.into())),
            Err(_) if name.starts_with('_') || name.starts_with('?') => Ok(CsvColumn::Other),
            Err(NoLocale::Tag) => Err(NoColumn::Unknown),
            Err(NoLocale::Shape) => Err(NoColumn::Locale),
        }
    };
    names.iter().map(column).collect()
}

/// Returns the locale of a column: `de-DE`, `German(de-DE)`, `German (Germany)(de-DE)`.
fn locale(name: &str, options: &ReadOptions) -> Result<String, NoLocale> {
    let inside = name.strip_suffix(')').and_then(|name| name.rsplit_once('(')).map(|(_, tag)| tag);
    options.locale(inside.unwrap_or(name))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(names: &[&str]) -> Vec<Result<CsvColumn, NoColumn>> {
        columns(names, &ReadOptions::new("en-us").known(["de-de"]))
    }

    #[test]
    fn headers_of_all_tools() {
        let locale = |tag: &str| Ok(CsvColumn::Locale(tag.into()));
        let other = || Ok(CsvColumn::Other);
        let no_locale = Err(NoColumn::Locale);
        assert_eq!(
            of(&["keys", "en", "de", "id"]),
            [Ok(CsvColumn::Key), Ok(CsvColumn::Source), locale("de-de"), no_locale]
        );
        assert_eq!(
            of(&["Key", "Id", "Shared Comments", "English(en)", "German(de)", "German(de) Comments"]),
            [Ok(CsvColumn::Key), other(), other(), Ok(CsvColumn::Source), locale("de-de"), other()]
        );
        assert_eq!(
            of(&["Key", "SourceString", "en-US", "Comment"]),
            [Ok(CsvColumn::Key), Ok(CsvColumn::Source), locale("en-us"), other()]
        );
        assert_eq!(
            of(&["language", "id", "text", "lock"]),
            [Ok(CsvColumn::Language), Ok(CsvColumn::Key), Ok(CsvColumn::Text), Ok(CsvColumn::SourceMark)]
        );
        assert_eq!(
            of(&["key", "_lock de_DE", "_ours", "Who knows"]),
            [Ok(CsvColumn::Key), Ok(CsvColumn::Mark("de-de".into())), other(), Err(NoColumn::Unknown)]
        );
    }
}
