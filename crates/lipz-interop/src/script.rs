//! Scripts: the texts of many recordings in one file, found by the names of the recordings.

use crate::fallout::msg;
use crate::to_utf8;
use encoding_rs::Encoding;
use lipz_diagnostics::{Code, Diagnostic, Source, Span, escape};
use lipz_file::without_byte_order_mark;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// The columns of a CSV that are used.
const FILE: &str = "file";
const TEXT: &str = "text";

/// The texts of many recordings.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Script {
    /// By names of files without folders and extension, in lower case.
    texts: HashMap<String, String>,
}

impl Script {
    /// Reads a script: a `.msg` file of Fallout, or, if its name ends otherwise, a CSV whose first line
    /// names its columns, of which `file` and `text` are used.
    ///
    /// Files that are not UTF-8 are read in `encoding`, or as Windows-1252, in which the tools of the
    /// time wrote ([`to_utf8`]). The source that is returned has the text to which the diagnostics refer.
    pub fn read(path: &str, bytes: &[u8], encoding: Option<&'static Encoding>) -> (Script, Source, Vec<Diagnostic>) {
        let mut diagnostics = Vec::new();
        let utf8 = to_utf8(bytes, encoding, true, &mut diagnostics);
        let text = String::from_utf8_lossy(without_byte_order_mark(&utf8)).into_owned();
        let is_msg = path.rsplit_once('.').is_some_and(|(_, extension)| extension.eq_ignore_ascii_case("msg"));
        let (script, found) = if is_msg { of_entries(&text) } else { of_rows(&text) };
        diagnostics.extend(found);
        (script, Source::new(path, text), diagnostics)
    }

    /// The names of all recordings that have a text, in lower case and in order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        let mut names: Vec<&str> = self.texts.keys().map(String::as_str).collect();
        names.sort_unstable();
        names.into_iter()
    }

    /// The text of the recording in the file `stem`, a name without folders and extension. The case of letters
    /// makes no difference.
    pub fn text_of(&self, stem: &str) -> Option<&str> {
        self.texts.get(&stem.to_lowercase()).map(String::as_str)
    }
}

fn of_entries(text: &str) -> (Script, Vec<Diagnostic>) {
    let (entries, mut found) = msg::read(text);
    let (by_sound, ambiguous) = msg::by_sound(&entries);
    found.extend(ambiguous);
    let texts = by_sound.into_iter().map(|(sound, entry)| (sound, entry.text.clone())).collect();
    (Script { texts }, found)
}

fn of_rows(text: &str) -> (Script, Vec<Diagnostic>) {
    let mut rows = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text.as_bytes());
    let mut rows = rows.records().peekable();
    let (mut script, mut found) = (Script::default(), Vec::new());
    let column = |name: &str, row: Option<&Result<csv::StringRecord, csv::Error>>| {
        let row = row?.as_ref().ok()?;
        row.iter().position(|column| column.trim().eq_ignore_ascii_case(name))
    };
    let (Some(file), Some(line)) = (column(FILE, rows.peek()), column(TEXT, rows.peek())) else {
        let end = text.find('\n').unwrap_or(text.len());
        let diagnostic =
            Diagnostic::at(Code::ForeignSyntax, Span::new(0, end), "the first line does not name the columns");
        found.push(diagnostic.help("a script starts with `file,text`; other columns are not used"));
        return (script, found);
    };
    for row in rows.skip(1) {
        match row {
            Ok(row) => {
                let (Some(name), Some(text)) = (row.get(file), row.get(line)) else {
                    let start = row.position().map_or(0, |position| usize::try_from(position.byte()).unwrap_or(0));
                    let span = Span::new(start, start);
                    found.push(Diagnostic::at(Code::ForeignSyntax, span, "the row has no file or no text"));
                    continue;
                };
                let text = text.to_owned();
                match script.texts.entry(stem(name).to_lowercase()) {
                    Entry::Vacant(place) => drop(place.insert(text)),
                    Entry::Occupied(first) if *first.get() == text => {}
                    Entry::Occupied(_) => {
                        let start = row.position().map_or(0, |position| usize::try_from(position.byte()).unwrap_or(0));
                        let message = format!("{} has another text in a row above", escape::quoted(name));
                        let diagnostic = Diagnostic::at(Code::ForeignOddity, Span::new(start, start), message);
                        found.push(diagnostic.note("the first one is used"));
                    }
                }
            }
            Err(error) => found.push(Diagnostic::new(Code::ForeignSyntax, format!("the script is not CSV: {error}"))),
        }
    }
    (script, found)
}

/// The name of a file without folders and extension.
fn stem(path: &str) -> &str {
    let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
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
}
