//! Scripts: the texts of many recordings in one file, identified by the names of the recordings.

mod json;
mod table;

use crate::fallout::msg;
use crate::to_utf8;
use encoding_rs::Encoding;
use lipz_diagnostics::{Code, Diagnostic, Source, Span};
use lipz_file::without_byte_order_mark;
use std::collections::{BTreeMap, HashSet};
use std::path::{Path, PathBuf};
use unicode_normalization::UnicodeNormalization;

/// A script: the texts of many recordings.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Script {
    /// The name of the file in messages.
    file: String,
    /// By the names of files without folders and extension, in lower case.
    entries: BTreeMap<String, Vec<ScriptEntry>>,
}

/// The text of a recording.
#[derive(Clone, PartialEq, Eq, Debug)]
struct ScriptEntry {
    /// The path in the script, without extension, in lower case and with `/`.
    path: String,
    /// The same, as written.
    written: String,
    text: LineText,
    span: Span,
}

/// A text of a script.
#[derive(Clone, PartialEq, Eq, Debug)]
struct LineText {
    text: String,
    /// See [`ScriptLine::parts`].
    parts: Vec<String>,
}

impl From<String> for LineText {
    fn from(text: String) -> LineText {
        LineText { text, parts: Vec::new() }
    }
}

impl ScriptEntry {
    fn line(&self) -> ScriptLine<'_> {
        ScriptLine { path: &self.written, text: &self.text.text, parts: &self.text.parts, span: self.span }
    }
}

/// A line of a script.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ScriptLine<'s> {
    /// The path or ID of the line, without extension, as written in the script.
    pub path: &'s str,
    /// The text; empty if it is unknown or different each time.
    pub text: &'s str,
    /// If it differs from `text`, the spoken text: without the name of its speaker, and divided at the gaps into which
    /// the game inserts other texts.
    pub parts: &'s [String],
    /// The position of the line in the text of the script.
    pub span: Span,
}

impl ScriptLine<'_> {
    /// Whether the path or ID is `path`, without regard to case and Unicode normalisation.
    pub fn has_path(&self, path: &str) -> bool {
        normal(self.path) == normal(path)
    }
}

/// The use of a script.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Purpose<'l> {
    /// The texts of recordings, which are named by their files.
    Recordings,
    /// The lines of a game, which have IDs.
    Lines {
        /// The locale of their texts, if it is known.
        locale: Option<&'l str>,
        /// The file with their texts, if it is a different one.
        texts: Option<&'l [u8]>,
    },
}

impl Script {
    /// Reads the texts of recordings: a `.msg` file of Fallout, a JSON file of Ink or articy:draft, or otherwise a CSV
    /// file whose first line names its columns. The columns `file` and `text` are used, or those with other usual names,
    /// such as `Filename` and `Transcript`. In tables of Yarn Spinner and Ren'Py, it is the ID of the line rather than
    /// the file of the script. Commas, semicolons, tabs or bars separate columns.
    ///
    /// A JSON file of Ink has the compiled story, in which lines have tags such as `# id: mara_hello`. One of
    /// articy:draft has the exported packages, or the objects of one package, whose dialogue fragments have technical
    /// names.
    ///
    /// Files that are not UTF-8 are read in `encoding`, or else as Windows-1252, the usual encoding of old tools
    /// ([`to_utf8`]). The diagnostics refer to the text of the returned source.
    pub fn read(path: &str, bytes: &[u8], encoding: Option<&'static Encoding>) -> (Script, Source, Vec<Diagnostic>) {
        Script::read_for(Purpose::Recordings, path, bytes, encoding)
    }

    /// Reads the lines of a game. Like [`read`](Script::read), but a column with IDs has priority over one with files.
    /// In a table with the texts of several locales, those in `locale` are used.
    pub fn read_lines(path: &str, bytes: &[u8], locale: Option<&str>) -> (Script, Source, Vec<Diagnostic>) {
        Script::read_for(Purpose::Lines { locale, texts: None }, path, bytes, None)
    }

    /// Reads the lines of a package of articy:draft X, whose texts are in a second file
    /// ([`texts_beside`](Script::texts_beside)).
    pub fn read_lines_with_texts(
        path: &str,
        bytes: &[u8],
        texts: &[u8],
        locale: Option<&str>,
    ) -> (Script, Source, Vec<Diagnostic>) {
        Script::read_for(Purpose::Lines { locale, texts: Some(texts) }, path, bytes, None)
    }

    /// Returns the path of the file with the texts of a package of articy:draft X; `None` for other scripts, whose
    /// texts are in the same file.
    pub fn texts_beside(path: &Path) -> Option<PathBuf> {
        json::articy_texts::path_beside(path)
    }

    fn read_for(
        purpose: Purpose<'_>,
        path: &str,
        bytes: &[u8],
        encoding: Option<&'static Encoding>,
    ) -> (Script, Source, Vec<Diagnostic>) {
        if bytes.starts_with(ZIP) {
            return (Script::default(), Source::new(path, ""), vec![without_text()]);
        }
        let mut diagnostics = Vec::new();
        let utf8 = to_utf8(bytes, encoding, true, &mut diagnostics);
        let text = String::from_utf8_lossy(without_byte_order_mark(&utf8)).into_owned();
        let extension = path.rsplit_once('.').map_or("", |(_, extension)| extension).to_ascii_lowercase();
        let (mut script, found) = match extension.as_str() {
            "msg" => of_entries(&text),
            "json" => json::of_json(&text, purpose),
            _ if text.trim_start().starts_with('{') => json::of_json(&text, purpose),
            _ => table::of_rows(&text, purpose),
        };
        script.file = path.to_owned();
        diagnostics.extend(found);
        if purpose != Purpose::Recordings && script.is_empty() && diagnostics.iter().all(|found| !found.is_error()) {
            let without = Diagnostic::new(Code::ForeignSyntax, "no entry of the script has a sound");
            diagnostics.push(without.help("write entries as {number}{sound}{text}, such as {104}{hak001}{Greetings.}"));
        }
        (script, Source::new(path, text), diagnostics)
    }

    /// Returns the name of the file that was passed to [`read`](Script::read).
    pub fn path(&self) -> &str {
        &self.file
    }

    /// Returns the number of recordings with a text.
    pub fn len(&self) -> usize {
        self.entries.values().map(Vec::len).sum()
    }

    /// Whether no recording has a text.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Returns the names of recordings that have a text but are missing from `recordings`, which are files with their
    /// names. The result is sorted, in lower case.
    pub fn names_without<'r>(&self, recordings: impl IntoIterator<Item = (&'r Path, &'r str)>) -> Vec<&str> {
        let used = recordings.into_iter().filter_map(|(file, name)| self.entry_of_file(file, name));
        let used: HashSet<&str> = used.map(|entry| entry.path.as_str()).collect();
        let all = self.entries.values().flatten().map(|entry| entry.path.as_str());
        let mut names: Vec<&str> = all.filter(|path| !used.contains(path)).collect();
        names.sort_unstable();
        names
    }

    /// Returns all lines, ordered by their positions.
    pub fn lines(&self) -> Vec<ScriptLine<'_>> {
        let mut lines: Vec<ScriptLine<'_>> = self.entries.values().flatten().map(ScriptEntry::line).collect();
        lines.sort_by_key(|line| line.span);
        lines
    }

    /// Returns the line of the clip or recording at `path`, without extension; see [`text_of`](Script::text_of).
    pub fn line_of(&self, path: &str) -> Option<ScriptLine<'_>> {
        self.entry(path).map(ScriptEntry::line)
    }

    /// Returns the text of the recording at `path`, without extension. Case and Unicode normalisation are ignored.
    ///
    /// Either of `path` and the path in the script may have more leading folders than the other: `mayor` and
    /// `act1/mayor` in the script both match `rec/act1/mayor`, and the one with more folders has priority. A path with
    /// several equal matches has a text only if their texts are the same.
    pub fn text_of(&self, path: &str) -> Option<&str> {
        self.entry(path).map(|entry| entry.text.text.as_str())
    }

    /// Returns the text of a recording by the path of its file, or else by its name.
    pub fn text_of_file(&self, file: &Path, name: &str) -> Option<&str> {
        self.entry_of_file(file, name).map(|entry| entry.text.text.as_str())
    }

    fn entry_of_file(&self, file: &Path, name: &str) -> Option<&ScriptEntry> {
        let by_path = || self.entry(file.with_extension("").to_str()?);
        by_path().or_else(|| self.entry(name))
    }

    fn entry(&self, path: &str) -> Option<&ScriptEntry> {
        let path = normal(path);
        let entries = self.entries.get(name(&path))?;
        let is_end =
            |of: &str, end: &str| of.strip_suffix(end).is_some_and(|rest| rest.is_empty() || rest.ends_with('/'));
        let inside = entries.iter().filter(|entry| is_end(&path, &entry.path)).max_by_key(|entry| entry.path.len());
        if inside.is_some() {
            return inside;
        }
        let mut around = entries.iter().filter(|entry| is_end(&entry.path, &path));
        let first = around.next()?;
        around.all(|other| other.text == first.text).then_some(first)
    }

    /// Adds a text, unless the recording has a different one. Returns whether the recording now has this text.
    fn add(&mut self, written: &str, text: impl Into<LineText>, span: Span) -> bool {
        let text = text.into();
        let path = normal(written);
        let entries = self.entries.entry(name(&path).to_owned()).or_default();
        match entries.iter().find(|entry| entry.path == path) {
            Some(first) => first.text == text,
            None => {
                entries.push(ScriptEntry { path, written: written.to_owned(), text, span });
                true
            }
        }
    }
}

/// The start of ZIP archives, such as `.xlsx` and `.ods` files.
const ZIP: &[u8] = b"PK\x03\x04";

fn without_text() -> Diagnostic {
    Diagnostic::new(Code::ForeignSyntax, "the script is a spreadsheet or an archive")
        .help("save the spreadsheet as CSV")
}

fn of_entries(text: &str) -> (Script, Vec<Diagnostic>) {
    let (entries, mut found) = msg::read(text);
    let (by_sound, ambiguous) = msg::by_sound(&entries);
    found.extend(ambiguous);
    let mut script = Script::default();
    for entry in by_sound.into_values() {
        script.add(&entry.sound, entry.text.clone(), entry.span);
    }
    (script, found)
}

/// Returns a path in the form for comparison: in lower case, composed, with `/`. macOS decomposes the names of files.
fn normal(path: &str) -> String {
    let path = path.replace('\\', "/").to_lowercase();
    if path.is_ascii() { path } else { path.nfc().collect() }
}

/// Returns the last part of a path.
fn name(path: &str) -> &str {
    path.rsplit('/').next().unwrap_or(path)
}

fn without_extension(path: &str) -> &str {
    let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
    let extension = name.rsplit_once('.').map_or(0, |(_, extension)| extension.len() + 1);
    &path[..path.len() - extension]
}

#[cfg(test)]
mod tests;
