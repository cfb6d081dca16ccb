//! Reading of PO files, with the position of every text.

mod forms;

use super::string::unescaped;
use super::{COMMENTS_EXPORTED, EXPORTED, SOURCES_EXPORTED};
use crate::exchange::entry::{self, Entry, IncomingFile, ReadOptions, Words};
use crate::exchange::{Mark, State, decode};
use crate::plural::PluralForms;
use forms::{Form, Marks, PluralMessage};
use lipz_diagnostics::{Code, Diagnostic, Span};
use std::sync::Arc;

/// Reads a file with arbitrary content.
pub(crate) fn read(bytes: &[u8], options: &ReadOptions, incoming: &mut IncomingFile) {
    let Some(text) = decode::text(bytes, decode::label(bytes, b"charset="), &mut incoming.diagnostics) else {
        incoming.text = decode::readable(bytes);
        return;
    };
    let (message, plurals, forms) = Default::default();
    let mut reader = Reader { options, locale: None, plural_header: None, message, plurals, forms, incoming };
    if let [only] = options.wanted.as_slice() {
        reader.locale = Some(only.as_str().into());
    }
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        reader.line(line.trim_end_matches(['\n', '\r']), at);
        at += line.len();
    }
    reader.finish_message();
    reader.finish();
    incoming.text = text.into_owned();
}

/// The field of a string.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Field {
    Context,
    Source,
    Plural,
    Text,
    /// A text of a plural, except the first.
    OtherText,
}

/// The keywords, the longer ones first.
const KEYWORDS: [(&str, Field); 4] =
    [("msgctxt", Field::Context), ("msgid_plural", Field::Plural), ("msgid", Field::Source), ("msgstr", Field::Text)];

/// An entry that is being read.
#[derive(Default)]
struct Message {
    context: Option<Words>,
    source: Option<Words>,
    plural: Option<Words>,
    text: Option<Words>,
    /// The other texts of a plural, each with its number.
    other_texts: Vec<(usize, Words)>,
    /// The mark of the text, or those of all texts of a plural.
    marks: Marks,
    source_marks: Marks,
    comments: Vec<String>,
    comments_mark: Option<Mark>,
    is_fuzzy: bool,
    /// The field that the next string without a keyword continues.
    field: Option<Field>,
}

struct Reader<'a> {
    options: &'a ReadOptions,
    /// The locale of the file.
    locale: Option<Arc<str>>,
    /// The header `Plural-Forms`.
    plural_header: Option<Words>,
    message: Message,
    /// The entries with plural forms that belong to no clip.
    plurals: Vec<Span>,
    /// The plural forms of the file, from the first entry that has some; `None` inside if they are unknown.
    forms: Option<Option<PluralForms>>,
    incoming: &'a mut IncomingFile,
}

impl Reader<'_> {
    fn line(&mut self, line: &str, at: usize) {
        let start = at + line.len() - line.trim_start().len();
        let line = line.trim();
        if let Some(comment) = line.strip_prefix('#') {
            // Obsolete entries are skipped with the comments above them. Other comments belong to the next entry.
            let is_obsolete = comment.starts_with('~');
            if is_obsolete && self.message.context.is_none() && self.message.source.is_none() {
                self.message = Message::default();
            } else if self.message.text.is_some() && !is_obsolete {
                self.finish_message();
            }
            self.comment(comment);
        } else if line.starts_with('"') {
            self.string(line, start);
        } else if let Some((keyword, field)) = KEYWORDS.into_iter().find(|(keyword, _)| line.starts_with(keyword)) {
            let rest = line.get(keyword.len()..).unwrap_or_default();
            self.keyword(field, rest, start, start + keyword.len());
        } else if !line.is_empty() {
            self.wrong(start, line.len(), "the line is not a comment, keyword or string of a PO file");
        }
    }

    fn comment(&mut self, comment: &str) {
        let mark = |text: &str, name: &str| text.trim().strip_prefix(name.trim_end()).map(str::parse);
        if let Some(flags) = comment.strip_prefix(',') {
            self.message.is_fuzzy |= flags.split(',').any(|flag| flag.trim() == "fuzzy");
        } else if let Some(extracted) = comment.strip_prefix('.') {
            let marks = |name: &str| extracted.trim().strip_prefix(name.trim_end()).map(Marks::parse);
            if let Some(exported) = marks(EXPORTED) {
                self.message.marks = exported;
            } else if let Some(exported) = marks(SOURCES_EXPORTED) {
                self.message.source_marks = exported;
            } else if let Some(exported) = mark(extracted, COMMENTS_EXPORTED) {
                self.message.comments_mark = exported.ok();
            }
        } else if comment.starts_with(' ') && !comment.trim().is_empty() {
            self.message.comments.push(comment.trim().to_owned());
        }
    }

    fn keyword(&mut self, field: Field, rest: &str, start: usize, end: usize) {
        let begins = match field {
            Field::Context => self.message.context.is_some() || self.message.source.is_some(),
            Field::Source => self.message.source.is_some(),
            _ => false,
        };
        if begins {
            self.finish_message();
        }
        // `msgstr[0]` is the text; the others belong to a plural.
        let (field, form, string) = match rest.strip_prefix('[').and_then(|rest| rest.split_once(']')) {
            Some(("0", string)) => (field, 0, string),
            Some((form, string)) => match form.parse() {
                Ok(form) => (Field::OtherText, form, string),
                Err(_) => return self.wrong(start, end - start, "the number of the plural form cannot be read"),
            },
            None => (field, 0, rest),
        };
        let string_start = end + rest.len() - string.len() + string.len() - string.trim_start().len();
        let string = string.trim_start();
        if !string.starts_with('"') {
            self.wrong(start, end - start, "the keyword is not followed by a string");
            return;
        }
        let place = || Words { text: String::new(), span: Span::new(string_start, string_start) };
        match field {
            Field::Context => self.message.context = Some(place()),
            Field::Source => self.message.source = Some(place()),
            Field::Plural => self.message.plural = Some(place()),
            Field::Text => self.message.text = Some(place()),
            Field::OtherText => self.message.other_texts.push((form, place())),
        }
        self.message.field = Some(field);
        self.string(string, string_start);
    }

    /// Appends a string to the field of the keyword before it.
    fn string(&mut self, string: &str, at: usize) {
        let inner = string.get(1..).and_then(|rest| rest.strip_suffix('"'));
        let text = match inner.map(unescaped) {
            Some(Ok(text)) => text,
            Some(Err(place)) => {
                return self.wrong(at + 1 + place, 1, "the string contains a `\\` or `\"` that PO files do not allow");
            }
            None => return self.wrong(at, string.len(), "the string is not closed on its line"),
        };
        let words = match self.message.field {
            Some(Field::Context) => self.message.context.as_mut(),
            Some(Field::Source) => self.message.source.as_mut(),
            Some(Field::Text) => self.message.text.as_mut(),
            Some(Field::Plural) => self.message.plural.as_mut(),
            Some(Field::OtherText) => self.message.other_texts.last_mut().map(|(_, words)| words),
            None => return self.wrong(at, string.len(), "the string has no keyword before it"),
        };
        if let Some(words) = words {
            if words.text.is_empty() {
                words.span.start = Span::new(at, at).start;
            }
            words.text.push_str(&text);
            words.span.end = Span::new(at, at + string.len()).end;
        }
    }

    fn finish_message(&mut self) {
        let message = std::mem::take(&mut self.message);
        let (source, text) = match (message.source, message.text) {
            (Some(source), Some(text)) => (source, text),
            (Some(source), None) => return self.wrong_at(source.span, "the entry has no `msgstr`"),
            (None, Some(text)) => return self.wrong_at(text.span, "the entry has no `msgid`"),
            (None, None) => return,
        };
        if message.context.is_none() && source.text.is_empty() {
            return self.header(&text);
        }
        // Texts of a game's menus have no context. The entry belongs to no clip, except by its text.
        if let (Some(plural), None) = (&message.plural, &message.context) {
            self.plurals.push(plural.span);
            return;
        }
        let context = message.context.unwrap_or(Words { text: String::new(), span: source.span });
        let Some(locale) = self.locale.clone() else {
            self.locale = Some("".into()); // reported once
            return self.wrong_at(source.span, "the first entry has no header before it");
        };
        let (key, segment) = entry::id(&context.text);
        let entry = |text: Words, mark: Option<Mark>| Entry {
            key: Words { text: key.to_owned(), span: context.span }.into(),
            segment,
            locale: Arc::clone(&locale),
            state: if text.text.is_empty() || message.is_fuzzy { State::Initial } else { State::Translated },
            says_state: true,
            text,
            mark,
            comments: message.comments.clone(),
            comments_mark: message.comments_mark,
            ..Entry::default()
        };
        let Some(plural) = message.plural else {
            let one = entry(text, message.marks.of(""));
            self.incoming.entries.push(Entry { source: Some(source.into()), ..one });
            return;
        };
        let texts = std::iter::once((0, text)).chain(message.other_texts);
        let forms = texts.map(|(number, text)| Form { number, entry: entry(text, None) }).collect();
        let sources = [Arc::new(source), Arc::new(plural)];
        let plural = PluralMessage { sources, marks: message.marks, source_marks: message.source_marks };
        self.plural_entries(&plural, forms);
    }

    /// Reports the entries that texts of clips cannot be, and a file without any others.
    fn finish(&mut self) {
        if let Some(first) = self.plurals.first() {
            let message = match self.plurals.len() {
                1 => "an entry with plural forms does not name a clip, and is not imported".to_owned(),
                count => format!("{count} entries with plural forms do not name a clip, and are not imported"),
            };
            self.incoming.diagnostics.push(Diagnostic::at(Code::UnknownTextKey, *first, message));
        }
        if self.incoming.entries.is_empty() && !self.incoming.diagnostics.iter().any(Diagnostic::is_error) {
            self.incoming.diagnostics.push(
                Diagnostic::new(Code::ExchangeSyntax, "the file has no entry that belongs to a clip")
                    .help("check that it is the translated file; obsolete entries (`#~`) do not count"),
            );
        }
    }

    /// Reads the first entry, which names the language and the plural forms.
    fn header(&mut self, text: &Words) {
        let forms = text.text.lines().find_map(|line| line.strip_prefix("Plural-Forms:"));
        self.plural_header = forms.map(|forms| Words { text: forms.trim().to_owned(), span: text.span });
        if self.locale.is_some() {
            return; // the project determines the language
        }
        let language = text.text.lines().find_map(|line| line.strip_prefix("Language:")).unwrap_or_default().trim();
        let locale = self.options.locale(language).map_err(|why| match language {
            "" => Diagnostic::at(Code::ExchangeSyntax, text.span, "the header does not name a language")
                .help("name the locale of the file with `--locale`, as in de-de"),
            _ => why.diagnostic(language, text.span),
        });
        // Reported once.
        let locale = locale.map_err(|diagnostic| self.incoming.diagnostics.push(diagnostic)).unwrap_or_default();
        self.locale = Some(locale.into());
    }

    fn wrong(&mut self, at: usize, length: usize, what: &str) {
        self.wrong_at(Span::new(at, at + length), what);
    }

    fn wrong_at(&mut self, span: Span, what: &str) {
        if self.incoming.diagnostics.len() > 10_000 {
            return; // not a PO file at all
        }
        let diagnostic = Diagnostic::at(Code::ExchangeSyntax, span, what);
        self.incoming.diagnostics.push(diagnostic.help("check the file with `msgfmt -c` of gettext"));
    }
}
