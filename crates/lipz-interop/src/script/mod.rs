//! Scripts: the texts of many recordings in one file, identified by the names of the recordings.

mod columns;
mod exports;

use crate::fallout::msg;
use crate::to_utf8;
use encoding_rs::Encoding;
use lipz_diagnostics::{Code, Diagnostic, Source, Span, escape};
use lipz_file::without_byte_order_mark;
use std::collections::{BTreeMap, HashSet};
use std::path::Path;
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
    text: String,
    span: Span,
}

impl ScriptEntry {
    fn line(&self) -> ScriptLine<'_> {
        ScriptLine { path: &self.path, text: &self.text, span: self.span }
    }
}

/// A line of a script.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ScriptLine<'s> {
    /// The path or ID of the line, without extension, in lower case.
    pub path: &'s str,
    /// The text.
    pub text: &'s str,
    /// The position of the line in the text of the script.
    pub span: Span,
}

impl Script {
    /// Reads a script: a `.msg` file of Fallout, a JSON file of Ink or articy:draft, or otherwise a CSV file whose first
    /// line names its columns. The columns `file` and `text` are used, or those with other usual names, such as
    /// `Filename` and `Transcript`. In tables of Yarn Spinner and Ren'Py, it is the ID of the line rather than the file
    /// of the script. Commas, semicolons, tabs or bars separate columns.
    ///
    /// A JSON file of Ink has the compiled story, in which lines have tags such as `# id: mara_hello`. One of
    /// articy:draft has the exported packages, whose dialogue fragments have technical names.
    ///
    /// Files that are not UTF-8 are read in `encoding`, or else as Windows-1252, the usual encoding of old tools
    /// ([`to_utf8`]). The diagnostics refer to the text of the returned source.
    pub fn read(path: &str, bytes: &[u8], encoding: Option<&'static Encoding>) -> (Script, Source, Vec<Diagnostic>) {
        let mut diagnostics = Vec::new();
        let utf8 = to_utf8(bytes, encoding, true, &mut diagnostics);
        let text = String::from_utf8_lossy(without_byte_order_mark(&utf8)).into_owned();
        let is_msg = path.rsplit_once('.').is_some_and(|(_, extension)| extension.eq_ignore_ascii_case("msg"));
        let (mut script, found) = match () {
            () if is_msg => of_entries(&text),
            () if text.trim_start().starts_with('{') => exports::of_json(&text),
            () => of_rows(&text),
        };
        script.file = path.to_owned();
        diagnostics.extend(found);
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
        self.entry(path).map(|entry| entry.text.as_str())
    }

    /// Returns the text of a recording by the path of its file, or else by its name.
    pub fn text_of_file(&self, file: &Path, name: &str) -> Option<&str> {
        self.entry_of_file(file, name).map(|entry| entry.text.as_str())
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

    /// Adds a text, unless the recording has a different one. Returns whether it was added.
    fn add(&mut self, path: String, text: String, span: Span) -> bool {
        let entries = self.entries.entry(name(&path).to_owned()).or_default();
        match entries.iter().find(|entry| entry.path == path) {
            Some(first) => first.text == text,
            None => {
                entries.push(ScriptEntry { path, text, span });
                true
            }
        }
    }
}

fn of_entries(text: &str) -> (Script, Vec<Diagnostic>) {
    let (entries, mut found) = msg::read(text);
    let (by_sound, ambiguous) = msg::by_sound(&entries);
    found.extend(ambiguous);
    let mut script = Script::default();
    for (sound, entry) in by_sound {
        script.add(sound, entry.text.clone(), entry.span);
    }
    (script, found)
}

/// The prefix of the IDs of Yarn Spinner.
const YARN_LINE: &str = "line:";

fn of_rows(text: &str) -> (Script, Vec<Diagnostic>) {
    let (mut script, mut found) = (Script::default(), Vec::new());
    let columns::Columns { delimiter, file, text: line, is_id } = match columns::find(text) {
        Ok(columns) => columns,
        Err(diagnostic) => return (script, vec![*diagnostic]),
    };
    let mut rows = csv::ReaderBuilder::new().delimiter(delimiter).flexible(true).from_reader(text.as_bytes());
    for row in rows.records() {
        let row = match row {
            Ok(row) => row,
            Err(error) => {
                found.push(Diagnostic::new(Code::ForeignSyntax, format!("the script is not CSV: {error}")));
                continue;
            }
        };
        let start = row.position().map_or(0, |position| usize::try_from(position.byte()).unwrap_or(0));
        let start =
            start + text.get(start..).map_or(0, |rest| rest.len() - rest.trim_start_matches(['\r', '\n']).len());
        let length = text.get(start..).and_then(|rest| rest.lines().next()).map_or(0, str::len);
        let span = Span::new(start, start + length);
        match (row.get(file).map(str::trim), row.get(line)) {
            (Some(name), Some(line)) if !name.is_empty() => {
                let name = if is_id { name.strip_prefix(YARN_LINE).unwrap_or(name) } else { name };
                let path = if is_id { normal(name) } else { without_extension(&normal(name)).to_owned() };
                if !script.add(path, line.to_owned(), span) {
                    let message = format!("{} has a different text in a row above", escape::quoted(name));
                    found.push(Diagnostic::at(Code::ForeignOddity, span, message).note("the first text is used"));
                }
            }
            (_, line) => {
                let what = if line.is_some() { "the row has no file name" } else { "the row has no text" };
                let help = "write both, or remove the row; put a text with commas in quotes";
                found.push(Diagnostic::at(Code::ForeignSyntax, span, what).help(help));
            }
        }
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
    let extension = name(path).rsplit_once('.').map_or(0, |(_, extension)| extension.len() + 1);
    &path[..path.len() - extension]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_found_by_the_names_of_recordings() {
        let csv = "Speaker,File,Text\r\nElder,speech\\ELD_1.WAV,\"Greetings, Chosen.\"\r\nElder,eld_2,\"A \"\"word\"\".\"\r\n";
        let (script, _, found) = Script::read("script.csv", csv.as_bytes(), None);
        assert_eq!(found, []);
        assert_eq!(script.text_of("eld_1"), Some("Greetings, Chosen."));
        assert_eq!(script.text_of("Eld_2"), Some("A \"word\"."));
        assert_eq!(script.text_of("eld_3"), None);
        let (script, _, _) = Script::read("a.csv", "file,text\nM\u{e4}ry,One.\nO\u{308}L,Two.\n".as_bytes(), None);
        assert_eq!(script.text_of("ma\u{308}ry"), Some("One."), "decomposed");
        assert_eq!(script.text_of("\u{d6}l"), Some("Two."), "composed");
        let (script, _, _) = Script::read("ELDER.MSG", b"{100}{eld_1}{Greetings.}", None);
        assert_eq!(script.text_of("ELD_1"), Some("Greetings."));
    }

    #[test]
    fn encodings_of_the_time() {
        let french = b"{1}{eld_1}{D\xE9j\xE0 vu.}";
        assert_eq!(Script::read("a.msg", french, None).0.text_of("eld_1"), Some("Déjà vu."));
        let russian = b"{1}{eld_1}{\xC4\xE0.}";
        let windows_1251 = Encoding::for_label(b"windows-1251");
        assert_eq!(Script::read("a.msg", russian, windows_1251).0.text_of("eld_1"), Some("Да."));
        let (script, _, found) = Script::read("a.msg", "{1}{eld_1}{Да.}".as_bytes(), windows_1251);
        assert_eq!((script.text_of("eld_1"), found.len()), (Some("Да."), 1), "it is UTF-8");
        let utf8 = "\u{feff}{1}{eld_1}{Да.}";
        assert_eq!(Script::read("a.msg", utf8.as_bytes(), None).0.text_of("eld_1"), Some("Да."));
    }

    #[test]
    fn a_csv_without_the_columns_is_no_script() {
        for text in ["", "a,b\n1,2\n", "file\nx\n"] {
            assert_eq!(Script::read("a.csv", text.as_bytes(), None).2.len(), 1, "{text}");
        }
        assert_eq!(Script::read("a.csv", b"file,text\nonly-file\n", None).2.len(), 1);
        let twice = b"file,text\na.wav,One.\na.ogg,One.\nA.mp3,Two.\n";
        let (script, _, found) = Script::read("a.csv", twice, None);
        assert_eq!((script.text_of("a"), found.len()), (Some("One."), 1));
    }

    #[test]
    fn folders_tell_recordings_of_one_name_apart() {
        let csv = "file,text\nact1/mayor.wav,One.\nact2\\mayor,Two.\nmara,Three.\nact1/mara,Four.\n";
        let (script, _, found) = Script::read("script.csv", csv.as_bytes(), None);
        assert_eq!((found, script.len()), (Vec::new(), 4));
        let texts = ["act1/mayor", "rec/Act2/mayor", "mayor", "act3/mayor", "act2/mara", "act1/mara", "contract1/mara"];
        let texts = texts.map(|path| script.text_of(path).unwrap_or_default());
        assert_eq!(texts, ["One.", "Two.", "", "", "Three.", "Four.", "Three."]);
        assert_eq!(
            script.names_without(
                [("rec/act1/mayor.wav", "mayor"), ("x/mara.wav", "mara")].map(|(file, name)| (Path::new(file), name))
            ),
            ["act1/mara", "act2/mayor"]
        );
    }

    #[test]
    fn columns_may_be_divided_as_spreadsheets_do_it() {
        for csv in ["file;text\na;Well, yes.\n", "text\tFILE\nWell, yes.\ta\n"] {
            let (script, _, found) = Script::read("a.csv", csv.as_bytes(), None);
            assert_eq!((found, script.text_of("a")), (Vec::new(), Some("Well, yes.")));
        }
    }

    #[test]
    fn rows_that_say_nothing_are_marked() {
        let csv = "file,text\r\na,One.\r\n,Two.\r\nb\r\n";
        let (_, source, found) = Script::read("a.csv", csv.as_bytes(), None);
        let marked = found.iter().map(|found| {
            let span = found.primary.as_ref().unwrap().span;
            (found.message.as_str(), &source.text[span.start as usize..span.end as usize])
        });
        let expected = [("the row has no file name", ",Two."), ("the row has no text", "b")];
        assert_eq!(marked.collect::<Vec<_>>(), expected);
        let (_, _, found) = Script::read("a.csv", b"file,words\na,One.\n", None);
        assert_eq!(found[0].message, "the first line has no column `text`");
    }
}
