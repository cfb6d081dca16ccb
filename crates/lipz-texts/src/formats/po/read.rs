//! Reading of PO files, with the position of every text.

use super::string::unescaped;
use super::{COMMENTS_EXPORTED, EXPORTED};
use crate::exchange::entry::{self, Entry, IncomingFile, ReadOptions, Words};
use crate::exchange::{Mark, State, decode};
use lipz_diagnostics::{Code, Diagnostic, Span};
use std::sync::Arc;

/// Reads a file with arbitrary content.
pub(crate) fn read(bytes: &[u8], options: &ReadOptions, incoming: &mut IncomingFile) {
    let Some(text) = decode::text(bytes, decode::label(bytes, b"charset="), &mut incoming.diagnostics) else {
        incoming.text = decode::readable(bytes);
        return;
    };
    let (message, plurals) = Default::default();
    let mut reader = Reader { options, locale: None, message, plurals, incoming };
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
    /// A text of a plural.
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
    plural: Option<Span>,
    text: Option<Words>,
    mark: Option<Mark>,
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
    message: Message,
    /// The entries with plural forms.
    plurals: Vec<Span>,
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
            if let Some(exported) = mark(extracted, EXPORTED) {
                self.message.mark = exported.ok();
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
        let (field, string) = match rest.strip_prefix('[').and_then(|rest| rest.split_once(']')) {
            Some(("0", string)) => (field, string),
            Some((_, string)) => (Field::OtherText, string),
            None => (field, rest),
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
            Field::Plural => self.message.plural = Some(Span::new(start, end)),
            Field::Text => self.message.text = Some(place()),
            Field::OtherText => {}
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
            Some(Field::Context) => &mut self.message.context,
            Some(Field::Source) => &mut self.message.source,
            Some(Field::Text) => &mut self.message.text,
            Some(Field::Plural | Field::OtherText) => return,
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
        if let Some(plural) = message.plural {
            self.plurals.push(plural);
            return;
        }
        // Texts of a game's menus have no context. The entry belongs to no clip, except by its text.
        let context = message.context.unwrap_or(Words { text: String::new(), span: source.span });
        let Some(locale) = self.locale.clone() else {
            self.locale = Some("".into()); // reported once
            return self.wrong_at(source.span, "the first entry has no header before it");
        };
        let (key, segment) = entry::id(&context.text);
        let is_done = !text.text.is_empty() && !message.is_fuzzy;
        self.incoming.entries.push(Entry {
            key: Words { text: key.to_owned(), span: context.span }.into(),
            segment,
            source: Some(source.into()),
            locale,
            state: if is_done { State::Translated } else { State::Initial },
            says_state: true,
            text,
            mark: message.mark,
            comments: message.comments,
            comments_mark: message.comments_mark,
            ..Entry::default()
        });
    }

    /// Reports the entries that texts of clips cannot be, and a file without any others.
    fn finish(&mut self) {
        if let Some(first) = self.plurals.first() {
            let message = match self.plurals.len() {
                1 => "an entry has plural forms, which texts of clips do not have; it is not imported".to_owned(),
                count => {
                    format!(
                        "{count} entries have plural forms, which texts of clips do not have; they are not imported"
                    )
                }
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

    /// Reads the first entry, which names the language.
    fn header(&mut self, text: &Words) {
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
