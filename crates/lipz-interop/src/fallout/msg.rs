//! The game's texts: `.msg` files of entries `{number}{sound}{text}`, parsed like in the game.

use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use std::collections::HashMap;

/// The most characters of a field that the game reads.
const MOST_CHARACTERS: usize = 1024;

/// An entry of a `.msg` file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Entry {
    /// The number with which scripts refer to it.
    pub number: i32,
    /// The name of its audio file, without extension; empty if it is not spoken.
    pub sound: String,
    /// The displayed text, without line breaks.
    pub text: String,
    /// The position of the text.
    pub span: Span,
}

/// Reads the entries of a `.msg` file. Text outside braces is a comment.
///
/// As in the game, line breaks in fields are removed, and of several entries with the same number, the last one counts.
/// Reading stops at an error, because the game then rejects the whole file.
///
/// ```
/// let (entries, diagnostics) = lipz_interop::fallout::msg::read("# Hakunin\n{104}{hak001}{Greetings, Chosen.}\n");
/// assert_eq!((entries[0].sound.as_str(), entries[0].text.as_str()), ("hak001", "Greetings, Chosen."));
/// assert!(diagnostics.is_empty());
/// ```
pub fn read(text: &str) -> (Vec<Entry>, Vec<Diagnostic>) {
    let mut reading = MsgReader { text, at: 0, found: Vec::new() };
    let mut entries = Vec::<Entry>::new();
    let mut places = HashMap::<i32, usize>::new();
    loop {
        let entry = match reading.entry() {
            Ok(Some(entry)) => entry,
            Ok(None) => break,
            Err(error) => {
                reading.found.push(*error);
                break;
            }
        };
        match places.get(&entry.number).and_then(|&index| entries.get_mut(index)) {
            Some(first) => {
                let message = format!("entry {} appears twice", entry.number);
                let diagnostic =
                    Diagnostic::at(Code::MsgEntry, entry.span, message).also(first.span, "first definition");
                reading.found.push(diagnostic.note("lipz uses the last one, as the game does"));
                *first = entry;
            }
            None => {
                places.insert(entry.number, entries.len());
                entries.push(entry);
            }
        }
    }
    (entries, reading.found)
}

/// Returns the entries by the names of their recordings, in lower case. If several have the same recording, the first
/// one counts.
pub fn by_sound(entries: &[Entry]) -> (HashMap<String, &Entry>, Vec<Diagnostic>) {
    let (mut texts, mut found) = (HashMap::<String, &Entry>::new(), Vec::new());
    for entry in entries.iter().filter(|entry| !entry.sound.is_empty()) {
        let first = *texts.entry(entry.sound.to_ascii_lowercase()).or_insert(entry);
        if first.text != entry.text {
            let message = format!("{} has a different text in entry {}", escape::quoted(&entry.sound), first.number);
            let diagnostic = Diagnostic::at(Code::MsgEntry, entry.span, message).also(first.span, "this text is used");
            found.push(diagnostic.help("write the same text into both entries; a clip has one text per sound file"));
        }
    }
    (texts, found)
}

/// The state of reading a file.
struct MsgReader<'t> {
    text: &'t str,
    /// The offset of the unread rest in bytes.
    at: usize,
    found: Vec<Diagnostic>,
}

/// The content of a pair of braces.
#[derive(Clone, Copy)]
struct Field<'t> {
    written: &'t str,
    start: usize,
}

impl Field<'_> {
    fn span(self) -> Span {
        Span::new(self.start, self.start + self.written.len())
    }

    /// Returns the field without line breaks, as in the game.
    fn joined(self) -> String {
        self.written.chars().filter(|c| !matches!(c, '\r' | '\n')).collect()
    }
}

type Result<T> = std::result::Result<T, Box<Diagnostic>>;

impl<'t> MsgReader<'t> {
    /// Returns the next entry; `None` at the end of the file.
    fn entry(&mut self) -> Result<Option<Entry>> {
        let Some(number) = self.field()? else { return Ok(None) };
        let sound = self.rest_of_entry(number)?;
        let text = self.rest_of_entry(number)?;
        let Some(parsed) = parse_number(&number.joined()) else {
            let message = format!("{} is not a number", escape::quoted(number.written));
            return Err(refusal(
                number.span(),
                message,
                "write {number}{sound}{text}, such as {104}{hak001}{Greetings.}",
            ));
        };
        self.look_at(text);
        Ok(Some(Entry { number: parsed, sound: sound.joined(), text: text.joined(), span: text.span() }))
    }

    fn rest_of_entry(&mut self, number: Field<'_>) -> Result<Field<'t>> {
        self.field()?.ok_or_else(|| {
            refusal(number.span(), "the entry has fewer than three fields".into(), "write {number}{sound}{text}")
        })
    }

    /// Returns the next pair of braces; `None` if there are no more.
    fn field(&mut self) -> Result<Option<Field<'t>>> {
        let rest = self.text.get(self.at..).unwrap_or_default();
        let Some(brace) = rest.find(['{', '}']) else { return Ok(None) };
        let start = self.at + brace + 1;
        let inside = self.text.get(start..).unwrap_or_default();
        if rest.get(brace..).is_some_and(|found| found.starts_with('}')) {
            let help = "remove it, or write the `{` before it";
            return Err(refusal(Span::new(start - 1, start), "`}` does not close a field".into(), help));
        }
        let Some(end) = inside.find('}') else {
            let span = Span::new(start - 1, start);
            return Err(refusal(span, "the field has no `}`".into(), "write `}` at the end of the field"));
        };
        let field = Field { written: inside.get(..end).unwrap_or_default(), start };
        self.at = start + end + 1;
        let length = field.joined().chars().count();
        if length > MOST_CHARACTERS {
            let message = format!("the field has {length} characters, but the game reads {MOST_CHARACTERS}");
            return Err(refusal(field.span(), message, "split it into several entries"));
        }
        Ok(Some(field))
    }

    /// Checks a field for likely mistakes.
    fn look_at(&mut self, field: Field<'_>) {
        if let Some(at) = field.written.find('{') {
            let span = Span::new(field.start + at, field.start + at + 1);
            let diagnostic = Diagnostic::at(Code::MsgEntry, span, "a field starts within a text");
            self.found.push(diagnostic.note("the game displays `{`").help("write the missing `}` before it"));
        }
        let mut before = 0;
        for line in field.written.split_inclusive('\n') {
            let end = before + line.len();
            let next = field.written.get(end..).unwrap_or_default();
            let ends_in_word = line.trim_end_matches(['\r', '\n']).ends_with(|c: char| !c.is_whitespace());
            if line.ends_with('\n') && ends_in_word && next.starts_with(|c: char| !c.is_whitespace()) {
                let span = Span::new(field.start + end, field.start + end);
                let diagnostic = Diagnostic::at(Code::MsgEntry, span, "words run together at a line break");
                self.found.push(
                    diagnostic
                        .note("lipz ignores line breaks, as the game does")
                        .help("write a space before the line break"),
                );
            }
            before = end;
        }
    }
}

fn refusal(span: Span, message: String, help: &str) -> Box<Diagnostic> {
    Box::new(Diagnostic::at(Code::MsgSyntax, span, message).note("the game rejects the whole file").help(help))
}

/// Parses a number as the game does: an optional sign, then digits.
fn parse_number(text: &str) -> Option<i32> {
    text.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn headlines(text: &str) -> Vec<String> {
        read(text).1.into_iter().map(|diagnostic| diagnostic.message).collect()
    }

    #[test]
    fn entries_stand_in_braces() {
        let text = "# remark\r\n{100}{}{You see \r\nElder.}\r\n{-1}{eld_1} remark {Hello!}{+7}\n{}\n{}";
        let (entries, found) = read(text);
        assert_eq!(found, []);
        let read: Vec<_> =
            entries.iter().map(|entry| (entry.number, entry.sound.as_str(), entry.text.as_str())).collect();
        assert_eq!(read, [(100, "", "You see Elder."), (-1, "eld_1", "Hello!"), (7, "", "")]);
        assert_eq!(entries.get(1).and_then(|entry| text.get(entry.span.range())), Some("Hello!"));
    }

    #[test]
    fn errors_end_the_reading() {
        for (text, message) in [
            ("{1}{}{a}}{2}{}{b}", "`}` does not close a field"),
            ("{1}{}{a}{2}{}{b", "the field has no `}`"),
            ("{1}{}{a}{2}{}", "the entry has fewer than three fields"),
            ("{1}{}{a}{ 2}{}{b}", "` 2` is not a number"),
            ("{1}{}{a}{}{}{b}", "`` is not a number"),
            ("{1}{}{a}{99999999999}{}{b}", "`99999999999` is not a number"),
        ] {
            let (entries, found) = read(text);
            assert_eq!((entries.len(), found.len()), (1, 1), "{text}: {found:?}");
            assert_eq!(found.first().map(|diagnostic| diagnostic.message.as_str()), Some(message));
        }
        let long = format!("{{1}}{{}}{{{}}}", "ü".repeat(1025));
        assert_eq!(headlines(&long), ["the field has 1025 characters, but the game reads 1024"]);
        assert!(headlines(&long.replacen('ü', "", 1)).is_empty());
    }

    #[test]
    fn what_the_game_shows_otherwise() {
        assert_eq!(headlines("{1}{}{Hi\nthere}"), ["words run together at a line break"]);
        assert_eq!(
            headlines("{1}{}{Hi {2}{}{there}"),
            ["a field starts within a text", "the entry has fewer than three fields"]
        );
        let (entries, found) = read("{1}{a}{old}\n{1}{a}{new}");
        assert_eq!((entries.len(), found.len()), (1, 1));
        assert_eq!(entries.first().map(|entry| entry.text.as_str()), Some("new"));
    }

    #[test]
    fn a_sound_has_one_text() {
        let (entries, _) = read("{1}{ELD_1}{Sir.}{2}{eld_1}{Madam.}{3}{eld_1}{Sir.}{4}{}{Nobody.}");
        let (texts, found) = by_sound(&entries);
        assert_eq!(texts.get("eld_1").map(|entry| entry.number), Some(1));
        assert_eq!((texts.len(), found.len()), (1, 1));
    }
}
