//! The game's texts: `.msg` files of entries `{number}{sound}{text}`, read as the game reads them.

use lipz_diagnostics::{Code, Diagnostic, Span, escape};
use std::collections::HashMap;

/// Characters that the game reads of a field.
const MOST_CHARACTERS: usize = 1024;

/// An entry of a `.msg` file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Entry {
    /// The number by which scripts name it.
    pub number: i32,
    /// The file of its sound, without extension; empty if nobody speaks it.
    pub sound: String,
    /// What is displayed, without line breaks.
    pub text: String,
    /// Where the text is.
    pub span: Span,
}

/// Reads the entries of a `.msg` file. Text outside braces is a comment.
///
/// As in the game, line breaks in fields vanish, and the last of several entries with a number counts. An
/// error ends the reading: the game refuses the whole file then.
///
/// ```
/// let (entries, diagnostics) = lipz_interop::fallout::msg::read("# Hakunin\n{104}{hak001}{Greetings, Chosen.}\n");
/// assert_eq!((entries[0].sound.as_str(), entries[0].text.as_str()), ("hak001", "Greetings, Chosen."));
/// assert!(diagnostics.is_empty());
/// ```
pub fn read(text: &str) -> (Vec<Entry>, Vec<Diagnostic>) {
    let mut reading = Reading { text, at: 0, found: Vec::new() };
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
                let message = format!("entry {} is written twice", entry.number);
                let diagnostic = Diagnostic::at(Code::MsgEntry, entry.span, message).also(first.span, "the first one");
                reading.found.push(diagnostic.note("the game shows the last one; so does lipz"));
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

/// The texts by the names of their sounds, in lower case. The first of several that have a sound counts.
pub fn by_sound(entries: &[Entry]) -> (HashMap<String, &Entry>, Vec<Diagnostic>) {
    let (mut texts, mut found) = (HashMap::<String, &Entry>::new(), Vec::new());
    for entry in entries.iter().filter(|entry| !entry.sound.is_empty()) {
        let first = *texts.entry(entry.sound.to_ascii_lowercase()).or_insert(entry);
        if first.text != entry.text {
            let message = format!("{} has another text in entry {}", escape::quoted(&entry.sound), first.number);
            let diagnostic = Diagnostic::at(Code::MsgEntry, entry.span, message).also(first.span, "which is used");
            found.push(diagnostic.help("each sound has one text in the clip that is made of it"));
        }
    }
    (texts, found)
}

/// What is left of the file, and what was found.
struct Reading<'t> {
    text: &'t str,
    /// Bytes that were read.
    at: usize,
    found: Vec<Diagnostic>,
}

/// The inside of a pair of braces.
#[derive(Clone, Copy)]
struct Field<'t> {
    written: &'t str,
    start: usize,
}

impl Field<'_> {
    fn span(self) -> Span {
        Span::new(self.start, self.start + self.written.len())
    }

    /// The field as the game reads it.
    fn joined(self) -> String {
        self.written.chars().filter(|c| !matches!(c, '\r' | '\n')).collect()
    }
}

type Result<T> = std::result::Result<T, Box<Diagnostic>>;

impl<'t> Reading<'t> {
    /// The next entry; `None` at the end of the file.
    fn entry(&mut self) -> Result<Option<Entry>> {
        let Some(number) = self.field()? else { return Ok(None) };
        let sound = self.rest_of_entry(number)?;
        let text = self.rest_of_entry(number)?;
        let Some(parsed) = parse_number(&number.joined()) else {
            let message = format!("{} is no number", escape::quoted(number.written));
            return Err(refusal(
                number.span(),
                message,
                "an entry is {number}{sound}{text}: {104}{hak001}{Greetings.}",
            ));
        };
        self.look_at(text);
        Ok(Some(Entry { number: parsed, sound: sound.joined(), text: text.joined(), span: text.span() }))
    }

    fn rest_of_entry(&mut self, number: Field<'_>) -> Result<Field<'t>> {
        self.field()?.ok_or_else(|| {
            refusal(number.span(), "the entry has fewer than three fields".into(), "an entry is {number}{sound}{text}")
        })
    }

    /// The next pair of braces; `None` if there is none any more.
    fn field(&mut self) -> Result<Option<Field<'t>>> {
        let rest = self.text.get(self.at..).unwrap_or_default();
        let Some(brace) = rest.find(['{', '}']) else { return Ok(None) };
        let start = self.at + brace + 1;
        let inside = self.text.get(start..).unwrap_or_default();
        if rest.get(brace..).is_some_and(|found| found.starts_with('}')) {
            let help = "remove it, or write the `{` before it";
            return Err(refusal(Span::new(start - 1, start), "`}` closes no field".into(), help));
        }
        let Some(end) = inside.find('}') else {
            let span = Span::new(start - 1, start);
            return Err(refusal(span, "the field has no `}`".into(), "write `}` where the field ends"));
        };
        let field = Field { written: inside.get(..end).unwrap_or_default(), start };
        self.at = start + end + 1;
        let length = field.joined().chars().count();
        if length > MOST_CHARACTERS {
            let message = format!("the field has {length} characters; the game reads {MOST_CHARACTERS}");
            return Err(refusal(field.span(), message, "divide it into several entries"));
        }
        Ok(Some(field))
    }

    /// Looks for what the author of a text did not mean.
    fn look_at(&mut self, field: Field<'_>) {
        if let Some(at) = field.written.find('{') {
            let span = Span::new(field.start + at, field.start + at + 1);
            let diagnostic = Diagnostic::at(Code::MsgEntry, span, "a field starts within a text");
            self.found.push(diagnostic.note("the game displays `{`").help("write the `}` that is missing before it"));
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
                        .note("the game reads line breaks as nothing; so does lipz")
                        .help("write a space before the line break"),
                );
            }
            before = end;
        }
    }
}

fn refusal(span: Span, message: String, help: &str) -> Box<Diagnostic> {
    Box::new(Diagnostic::at(Code::MsgSyntax, span, message).note("the game refuses the whole file").help(help))
}

/// A number as the game reads it: a sign if there is one, then digits.
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
            ("{1}{}{a}}{2}{}{b}", "`}` closes no field"),
            ("{1}{}{a}{2}{}{b", "the field has no `}`"),
            ("{1}{}{a}{2}{}", "the entry has fewer than three fields"),
            ("{1}{}{a}{ 2}{}{b}", "` 2` is no number"),
            ("{1}{}{a}{}{}{b}", "`` is no number"),
            ("{1}{}{a}{99999999999}{}{b}", "`99999999999` is no number"),
        ] {
            let (entries, found) = read(text);
            assert_eq!((entries.len(), found.len()), (1, 1), "{text}: {found:?}");
            assert_eq!(found.first().map(|diagnostic| diagnostic.message.as_str()), Some(message));
        }
        let long = format!("{{1}}{{}}{{{}}}", "ü".repeat(1025));
        assert_eq!(headlines(&long), ["the field has 1025 characters; the game reads 1024"]);
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
