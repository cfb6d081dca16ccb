//! The terms of a project, and their translations.

use crate::exchange::decode;
use crate::formats::csv::separator_of;
use lipz_diagnostics::{Code, Diagnostic, Report, Source, Span, bound, escape};
use lipz_file::locale::{language, language_or_locale};
use lipz_file::table::{Cell, Rows};
use lipz_file::text::display;
use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};
use unicode_normalization::UnicodeNormalization;
use unicode_segmentation::UnicodeSegmentation;

/// The separator of alternatives in a cell.
const OR: char = '|';

/// The names of columns without translations, in lower case.
const NOTES: [&str; 5] = ["note", "notes", "comment", "comments", "description"];

/// Terms with their translations: names, places, and words that always mean the same in a game.
#[derive(Clone, Debug, Default)]
pub struct Terms {
    /// By their words, in lower case: the terms.
    terms: HashMap<Vec<String>, Term>,
    /// By the first word of terms, the numbers of their words, in descending order.
    lengths: HashMap<String, Vec<usize>>,
}

#[derive(Clone, Debug)]
struct Term {
    /// As written.
    text: String,
    /// By locale or language: the translations, any of which may be used.
    translations: BTreeMap<String, Vec<String>>,
}

impl Terms {
    /// Reads a CSV file with a column for each locale or language, named `en-us` or `en`. Each row is a term. `|` separates
    /// alternatives. Columns named `note` or `comment` are not read, and others are reported.
    pub fn read(path: impl Into<String>, bytes: &[u8], source_locale: &str) -> (Terms, Report) {
        let (mut terms, mut found) = (Terms::default(), Vec::new());
        let text = decode::text(bytes, None, &mut found);
        if let Some(text) = &text {
            terms.read_rows(text, source_locale, &mut found);
            bound::limit_many(&mut found);
        }
        let shown = text.map_or_else(|| decode::readable(bytes), Cow::into_owned);
        (terms, Report::new(Source::new(path, shown), found))
    }

    fn read_rows(&mut self, text: &str, source_locale: &str, found: &mut Vec<Diagnostic>) {
        let mut columns: Option<TermColumns> = None;
        for row in Rows::new(text, separator_of(text.lines().next().unwrap_or_default())) {
            let row = match row {
                Ok(row) => row,
                Err(fault) => return found.push(fault.diagnostic(Code::ExchangeSyntax)),
            };
            match &columns {
                Some(columns) => {
                    found.extend(columns.surplus(&row));
                    self.add(&row, columns);
                }
                None => match TermColumns::read(&row, source_locale, found) {
                    Some(header) => columns = Some(header),
                    None => return,
                },
            }
            bound::limit_many(found);
        }
        if columns.is_none() {
            found.push(no_source(source_locale, Span::default()));
        }
    }

    fn add(&mut self, row: &[Cell<'_>], columns: &TermColumns) {
        let alternatives = |cell: &Cell<'_>| -> Vec<String> {
            cell.text.split(OR).map(|part| part.trim().to_owned()).filter(|part| !part.is_empty()).collect()
        };
        let cells = (0..).zip(&columns.names).zip(row).filter(|((at, _), _)| *at != columns.source);
        let translations: Vec<(String, Vec<String>)> = cells
            .filter_map(|((_, name), cell)| Some((name.clone()?, alternatives(cell))))
            .filter(|(_, texts)| !texts.is_empty())
            .collect();
        for text in row.get(columns.source).map(alternatives).unwrap_or_default() {
            let words: Vec<String> = comparable(&text).unicode_words().map(str::to_owned).collect();
            let Some(first) = words.first().cloned() else { continue };
            let lengths = self.lengths.entry(first).or_default();
            if let Err(at) = lengths.binary_search_by(|length| words.len().cmp(length)) {
                lengths.insert(at, words.len());
            }
            // Several rows of a term add alternatives.
            let term = self.terms.entry(words).or_insert_with(|| Term { text, translations: BTreeMap::new() });
            for (locale, texts) in &translations {
                let known = term.translations.entry(locale.clone()).or_default();
                for text in texts {
                    if !known.contains(text) {
                        known.push(text.clone());
                    }
                }
            }
        }
    }

    /// Returns a message about the first term of a source text whose translation is missing.
    pub(super) fn difference(&self, source: &str, locale: &str, translation: &str) -> Option<String> {
        if self.terms.is_empty() {
            return None;
        }
        let shown = comparable(&display(source).text);
        let words: Vec<String> = shown.unicode_words().map(str::to_owned).collect();
        let translation = comparable(&display(translation).text);
        let mut rest = words.as_slice();
        while let [_, after @ ..] = rest {
            let Some((length, term)) = self.at_start_of(rest) else {
                rest = after;
                continue;
            };
            // Of `lamp oil`, neither `lamp` nor `oil` is a term of its own.
            rest = rest.get(length..).unwrap_or_default();
            let translations = &term.translations;
            let Some(expected) = translations.get(locale).or_else(|| translations.get(language(locale))) else {
                continue;
            };
            if !expected.iter().any(|text| translation.contains(&comparable(text))) {
                let expected: Vec<String> = expected.iter().map(|text| escape::quoted(text).to_string()).collect();
                let term = escape::quoted(&term.text);
                return Some(format!("the translation lacks {} for the term {term}", expected.join(" or ")));
            }
        }
        None
    }

    /// Returns the longest term that the words begin with, and the number of its words.
    fn at_start_of(&self, words: &[String]) -> Option<(usize, &Term)> {
        let lengths = self.lengths.get(words.first()?)?;
        lengths.iter().find_map(|length| Some((*length, self.terms.get(words.get(..*length)?)?)))
    }
}

/// Returns a text in the form for comparison: in lower case and composed, with single spaces and plain apostrophes.
fn comparable(text: &str) -> String {
    let text: String = text.to_lowercase().nfc().map(|one| if one == '\u{2019}' { '\'' } else { one }).collect();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The columns of a table of terms.
struct TermColumns {
    /// The locale or language of each; `None` for notes.
    names: Vec<Option<String>>,
    /// The column of the terms.
    source: usize,
}

impl TermColumns {
    /// Reads the header; `None` if no column has the terms.
    fn read(row: &[Cell<'_>], source_locale: &str, found: &mut Vec<Diagnostic>) -> Option<TermColumns> {
        let names: Vec<Option<String>> = row.iter().map(|cell| language_or_locale(cell.text.trim(), true)).collect();
        let position = |locale: &str| names.iter().position(|name| name.as_deref() == Some(locale));
        let Some(source) = position(source_locale).or_else(|| position(language(source_locale))) else {
            let ends = row.first().zip(row.last());
            let span = ends.map(|(first, last)| Span { start: first.span.start, end: last.span.end });
            found.push(no_source(source_locale, span.unwrap_or_default()));
            return None;
        };
        for (cell, _) in row.iter().zip(&names).filter(|(_, name)| name.is_none()) {
            let name = cell.text.trim();
            if !name.is_empty() && !NOTES.contains(&name.to_lowercase().as_str()) {
                let message = format!("the column {} is not read", escape::quoted(name));
                let help = "name it after a locale or language, as in de-de or de, or `note`";
                found.push(Diagnostic::at(Code::ExchangeLoss, cell.span, message).help(help));
            }
        }
        Some(TermColumns { names, source })
    }

    /// Returns the diagnostic for text to the right of all columns.
    fn surplus(&self, row: &[Cell<'_>]) -> Option<Diagnostic> {
        let cell = row.iter().skip(self.names.len()).find(|cell| !cell.text.trim().is_empty())?;
        let found = Diagnostic::at(Code::ExchangeSyntax, cell.span, "the cell has no column");
        Some(found.help("put a text with separators between quotes: \"Stop, you!\""))
    }
}

fn no_source(source_locale: &str, span: Span) -> Diagnostic {
    let message = format!("no column has the terms in {}", escape::text(source_locale));
    Diagnostic::at(Code::ExchangeSyntax, span, message)
        .help("name a column after each locale in the first row: en-us,de-de")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn terms() -> Terms {
        let table = "en-us,de-de,fr,note\nlighthouse,Leuchtturm,phare,a place\nlamp oil,Lampenöl|Petroleum,,\nlamp,Lampe,lampe,\noil,Öl,huile,\n";
        let (terms, report) = Terms::read("terms.csv", table.as_bytes(), "en-us");
        assert_eq!(report.diagnostics, []);
        terms
    }

    /// Returns the messages about a table, each with its offset.
    fn found(table: &[u8]) -> Vec<(String, u32)> {
        let report = Terms::read("terms.csv", table, "en-us").1;
        report.diagnostics.into_iter().map(|found| (found.message.clone(), found.start())).collect()
    }

    #[test]
    fn a_term_needs_one_of_its_translations() {
        let terms = terms();
        let german = |source: &str, text: &str| terms.difference(source, "de-de", text);
        for (source, text) in [
            ("The Lighthouse is dark.", "Der Leuchtturm ist dunkel."),
            ("The lighthouse's lamp.", "Die Lampe."),
            ("Buy lamp oil.", "Kauf Petroleum."),
            ("Oil for the lamp.", "Öl für die Lampe."),
            ("Light houses everywhere.", "Helle Häuser überall."),
            ("{to: lighthouse} Hello.", "Hallo."),
        ] {
            assert_eq!(german(source, text), None, "{source}");
        }
        assert_eq!(
            german("At the lighthouse!", "Beim Feuerturm!").as_deref(),
            Some("the translation lacks `Leuchtturm` for the term `lighthouse`")
        );
        assert_eq!(
            german("Lamp oil?", "Eine Lampe?").as_deref(),
            Some("the translation lacks `Lampenöl` or `Petroleum` for the term `lamp oil`")
        );
        let table = "en-us,de-de\nlamp,Lampe\nlamp,Leuchte\nDragon's Den,O\u{308}dland\n";
        let terms_again = Terms::read("terms.csv", table.as_bytes(), "en-us").0;
        for (source, text) in
            [("The lamp.", "Die Lampe."), ("A lamp!", "Eine Leuchte!"), ("Dragon\u{2019}s  den", "Ödland")]
        {
            assert_eq!(terms_again.difference(source, "de-de", text), None, "{source}");
        }
        assert!(terms_again.difference("Dragon\u{2019}s Den", "de-de", "Höhle").is_some());
        assert_eq!(terms.difference("The lighthouse.", "fr-fr", "Le phare."), None, "a column for the language");
        assert_eq!(terms.difference("The lighthouse.", "it-it", "Il faro."), None, "no translation is known");
    }

    #[test]
    fn a_table_needs_a_column_of_the_source_locale() {
        let none = [("no column has the terms in en-us".to_owned(), 0)];
        assert_eq!(found(b"de-de,note\na,b\n"), none);
        assert_eq!(found(b""), none);
    }

    #[test]
    fn tables_of_spreadsheets_are_read_and_faults_have_positions() {
        assert_eq!(found("en-us;de-de\nlighthouse;Leuchtturm, rot\n".as_bytes()), []);
        let wide: Vec<u8> = "\u{feff}en\tde\nlamp\tLampe\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert_eq!(found(&wide), []);
        assert_eq!(found(b"en,german,Note\nlamp,Lampe,x\n"), [("the column `german` is not read".to_owned(), 3)]);
        assert_eq!(found(b"en,de\nlamp,Lampe, hell,\n"), [("the cell has no column".to_owned(), 17)]);
        let open = "the cell that starts with this quote is not closed";
        assert_eq!(found(b"en,de\nlamp,\"Lampe\noil,\xc3\x96l\n"), [(open.to_owned(), 11)]);
        assert_eq!(found(b"en,de\nlamp,\xff\n").len(), 1);
    }
}
