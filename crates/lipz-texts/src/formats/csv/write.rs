//! Writing of CSV files.

use super::cell::defused;
use super::columns::{COMMENT, LOCK};
use super::escape::{escaped, misread};
use super::row::YARN_LINE;
use crate::exchange::culture::english_name;
use crate::exchange::model::{Exchange, Item, Segment, Translation, seconds};
use crate::exchange::tag::{bcp47, underscored};
use crate::exchange::{Mark, Shape, WriteOptions};
use csv::{Terminator, WriterBuilder};
use lipz_diagnostics::{Code, Diagnostic, bound, escape};
use std::borrow::Cow;

/// Returns the file with all locales, or with the one at `at`.
pub(crate) fn write(
    exchange: &Exchange,
    at: Option<usize>,
    options: &WriteOptions,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<u8> {
    report(exchange, options.shape, diagnostics);
    let mut writer = WriterBuilder::new().terminator(Terminator::CRLF).from_writer(Vec::new());
    for row in rows(exchange, at, options) {
        let cells = row.iter().map(|cell| match options.shape {
            Shape::Godot | Shape::Unreal => escaped(cell),
            // Engines show an apostrophe before a text.
            Shape::Unity | Shape::Yarn => Cow::Borrowed(cell.as_str()),
            // A reader would mistake an apostrophe of the text for the mark of a text cell.
            Shape::Sheet if options.raw_cells && !cell.starts_with('\'') => Cow::Borrowed(cell.as_str()),
            Shape::Sheet => defused(cell),
        });
        // Writing to memory cannot fail.
        let _ = writer.write_record(cells.map(|cell| cell.into_owned().into_bytes()));
    }
    writer.into_inner().unwrap_or_default()
}

/// Reports what the engine cannot read.
fn report(exchange: &Exchange, shape: Shape, diagnostics: &mut Vec<Diagnostic>) {
    if shape == Shape::Unity {
        let locales = std::iter::once(&exchange.source_locale).chain(&exchange.locales);
        for locale in locales.filter(|locale| english_name(locale).is_none()) {
            let message = format!("lipz does not know the name of {} in Unity", escape::quoted(locale));
            let help = "rename its column as Unity's CSV export spells it, so that Unity finds the texts";
            diagnostics.push(Diagnostic::new(Code::ExchangeLoss, message).help(help));
        }
    }
    if matches!(shape, Shape::Godot | Shape::Unreal) {
        report_misread(exchange, diagnostics);
    }
}

/// Reports texts that engines which replace escapes cannot read.
pub(crate) fn report_misread(exchange: &Exchange, diagnostics: &mut Vec<Diagnostic>) {
    for unit in &exchange.units {
        let sources = unit.segments.iter().map(|segment| segment.source.as_str());
        let texts = unit.translations.iter().flat_map(|translation| &translation.texts).map(String::as_str);
        if let Some(escape) = sources.chain(texts).find_map(misread) {
            let id = unit.id();
            let key = escape::quoted(&id);
            let message = format!("a text of {key} has {escape}, which the engine reads as a different character");
            let help = "put a space after the backslash, or leave it out; the engine has no spelling for it";
            diagnostics.push(Diagnostic::new(Code::ExchangeLoss, message).help(help));
            bound::limit_many(diagnostics);
        }
    }
}

/// Returns the rows of the table with all locales, or with the one at `at`. The first has the names of the columns.
pub(crate) fn rows(exchange: &Exchange, at: Option<usize>, options: &WriteOptions) -> Vec<Vec<String>> {
    let locales = at.map_or(0..exchange.locales.len(), |at| at..at + 1).collect();
    let mut translations = exchange.units.iter().flat_map(|unit| &unit.translations);
    let has_comments = translations.any(|translation| !translation.comments.is_empty());
    let table = TableWriter { exchange, options, locales, has_comments };
    let rows = exchange.items(at, options.division).map(|item| table.row(&item));
    std::iter::once(table.header()).chain(rows).collect()
}

struct TableWriter<'a> {
    exchange: &'a Exchange,
    options: &'a WriteOptions,
    /// The indices of the locales.
    locales: Vec<usize>,
    /// Whether translators have commented on a clip. Only then, marks of comments are needed.
    has_comments: bool,
}

/// The columns with information for translators.
const CONTEXT: [&str; 5] = ["speaker", "time", "limit", "events", "recording"];

impl TableWriter<'_> {
    fn header(&self) -> Vec<String> {
        let own = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        let source = self.exchange.source_locale.as_str();
        let with =
            |before: &str, name: fn(&str) -> String| self.tags().map(|tag| format!("{before}{}", name(tag))).collect();
        let locks: Vec<String> = with(&format!("{LOCK} "), str::to_owned);
        let comments =
            [with(&format!("{COMMENT} "), str::to_owned), with(&format!("{LOCK} {COMMENT} "), str::to_owned)];
        match self.options.shape {
            Shape::Sheet => {
                let [comments, comment_locks] = comments;
                let texts = with("", str::to_owned);
                let comment_locks = if self.has_comments { comment_locks } else { Vec::new() };
                [own(&["key"]), own(&CONTEXT), own(&[source]), texts, comments, locks, comment_locks].concat()
            }
            Shape::Unity => [own(&["Key", "Shared Comments"]), vec![unity(source)], with("", unity), locks].concat(),
            Shape::Godot => {
                let notes = CONTEXT.iter().map(|name| format!("_{name}")).collect();
                let locks = with(&format!("_{LOCK} "), underscored);
                [own(&["keys"]), vec![underscored(source)], with("", underscored), notes, locks].concat()
            }
            Shape::Unreal => [own(&["Key", "SourceString"]), with("", bcp47), own(&["Comment"]), locks].concat(),
            Shape::Yarn => {
                [own(&["language", "id", "text", "file", "node", "lineNumber", "lock", "comment"]), locks].concat()
            }
        }
    }

    fn row(&self, item: &Item<'_>) -> Vec<String> {
        let none = Translation::default();
        let translations = || self.locales.iter().map(|at| item.unit.translations.get(*at).unwrap_or(&none));
        let texts: Vec<String> = translations().map(|translation| item.text(translation)).collect();
        let locks: Vec<String> = translations().map(|translation| item.mark(translation).to_string()).collect();
        let head = vec![item.id()];
        let source = vec![item.source()];
        match self.options.shape {
            Shape::Sheet => {
                let of_item = || translations().map(|translation| item.translator_comments(translation));
                let comments = of_item().map(|comments| comments.join("\n")).collect();
                let mark = |comments: &[String]| Mark::of_comments(comments).to_string();
                let comment_locks = of_item().filter(|_| self.has_comments).map(mark).collect();
                [head, context(item), source, texts, comments, locks, comment_locks].concat()
            }
            Shape::Unity => [head, vec![comment(item)], source, texts, locks].concat(),
            Shape::Godot => [head, source, texts, context(item), locks].concat(),
            Shape::Unreal => [head, source, texts, vec![comment(item)], locks].concat(),
            Shape::Yarn => {
                let node = item.unit.key.rsplit_once('/').map_or("", |(folder, _)| folder).to_owned();
                let language = self.tags().next().map(bcp47).unwrap_or_default();
                let file = item.unit.file.clone().unwrap_or_default();
                let line = item.number.map_or_else(String::new, |number| number.to_string());
                let lock = Mark::of_yarn(&item.source()).to_string();
                let comment = [item.source(), comment(item)].into_iter().filter(|part| !part.is_empty());
                let comment = comment.collect::<Vec<_>>().join("; ");
                let id = format!("{YARN_LINE}{}", item.id());
                [vec![language, id], texts, vec![file, node, line, lock, comment], locks].concat()
            }
        }
    }

    fn tags(&self) -> impl Iterator<Item = &str> {
        self.locales.iter().filter_map(|at| self.exchange.locales.get(*at)).map(String::as_str)
    }
}

/// Returns the cells of the columns of [`CONTEXT`].
fn context(item: &Item<'_>) -> Vec<String> {
    let mut speakers: Vec<&str> = item.segments.iter().filter_map(|(_, segment)| segment.speaker.as_deref()).collect();
    speakers.dedup();
    let time = |segment: &Segment| segment.time_ms;
    let first = item.segments.first().and_then(|(_, segment)| time(segment));
    let last = item.segments.last().and_then(|(_, segment)| time(segment));
    let time = first.zip(last).map(|((start, _), (_, end))| format!("{} to {} s", seconds(start), seconds(end)));
    let each = |of: &dyn Fn(&Segment) -> Option<String>| {
        let all: Vec<String> = item.segments.iter().map(|(_, segment)| of(segment).unwrap_or_default()).collect();
        if all.iter().all(String::is_empty) { String::new() } else { all.join(" | ") }
    };
    vec![
        speakers.join(", "),
        time.unwrap_or_default(),
        each(&|segment| segment.max_characters.map(|most| most.to_string())),
        each(&|segment| segment.events.clone()),
        item.unit.recording.clone().unwrap_or_default(),
    ]
}

/// Returns the same in one cell.
fn comment(item: &Item<'_>) -> String {
    let cells = context(item).into_iter().zip(CONTEXT).filter(|(cell, _)| !cell.is_empty());
    cells.map(|(cell, name)| format!("{name}: {cell}")).collect::<Vec<_>>().join("; ")
}

/// Returns a column name as in Unity: `German (Germany)(de-DE)`.
fn unity(locale: &str) -> String {
    let code = bcp47(locale);
    format!("{}({code})", english_name(locale).unwrap_or(&code))
}
