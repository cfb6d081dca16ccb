//! The terms of a project, and their translations.

use csv::{ReaderBuilder, StringRecord};
use lipz_diagnostics::{Code, Diagnostic, Span, bound, escape};
use lipz_file::locale::{canonical_tag, language};
use lipz_file::text::display;
use std::collections::{BTreeMap, HashMap};
use unicode_segmentation::UnicodeSegmentation;

/// The separator of alternatives in a cell.
const OR: char = '|';

/// Terms with their translations: names, places, and words that always mean the same in a game.
#[derive(Clone, Debug, Default)]
pub struct Terms {
    terms: Vec<Term>,
    /// By the first word of a term, in lower case: the indices of terms.
    by_first_word: HashMap<String, Vec<usize>>,
}

#[derive(Clone, Debug)]
struct Term {
    /// As written.
    text: String,
    /// Its words in lower case.
    words: Vec<String>,
    /// By locale or language: the translations, any of which may be used.
    translations: BTreeMap<String, Vec<String>>,
}

impl Terms {
    /// Reads a CSV file with a column for each locale or language, named `en-us` or `en`. Each row is a term. `|` separates
    /// alternatives. Columns with other names, such as notes, are ignored.
    pub fn read(text: &str, source_locale: &str) -> (Terms, Vec<Diagnostic>) {
        let (mut terms, mut found) = (Terms::default(), Vec::new());
        let mut reader = ReaderBuilder::new().flexible(true).from_reader(text.as_bytes());
        let names = reader.headers().cloned().unwrap_or_default();
        let columns: Vec<Option<String>> = names.iter().map(column).collect();
        let is_source = |column: &Option<String>| {
            column.as_deref().is_some_and(|name| name == source_locale || name == language(source_locale))
        };
        let Some(source) = columns.iter().position(is_source) else {
            let end = text.lines().next().map_or(0, str::len);
            let message = format!("no column has the terms in {source_locale}");
            let help = "name a column after each locale in the first row: en-us,de-de";
            return (terms, vec![Diagnostic::at(Code::ExchangeSyntax, Span::new(0, end), message).help(help)]);
        };
        for row in reader.records() {
            match row {
                Ok(row) => terms.add(&row, &columns, source),
                Err(error) => {
                    let message = format!("the file is not CSV: {}", escape::text(&error.to_string()));
                    found.push(Diagnostic::new(Code::ExchangeSyntax, message));
                    bound::limit_many(&mut found);
                }
            }
        }
        (terms, found)
    }

    fn add(&mut self, row: &StringRecord, columns: &[Option<String>], source: usize) {
        let alternatives = |cell: &str| -> Vec<String> {
            cell.split(OR).map(|part| part.trim().to_owned()).filter(|part| !part.is_empty()).collect()
        };
        let translations: BTreeMap<String, Vec<String>> = (columns.iter().zip(row))
            .enumerate()
            .filter_map(|(at, (column, cell))| Some((column.clone().filter(|_| at != source)?, alternatives(cell))))
            .filter(|(_, texts)| !texts.is_empty())
            .collect();
        for text in alternatives(row.get(source).unwrap_or_default()) {
            let words: Vec<String> = text.unicode_words().map(str::to_lowercase).collect();
            let Some(first) = words.first().cloned() else { continue };
            self.by_first_word.entry(first).or_default().push(self.terms.len());
            self.terms.push(Term { text, words, translations: translations.clone() });
        }
    }

    /// Returns a message about the first term of a source text whose translation is missing.
    pub(super) fn difference(&self, source: &str, locale: &str, translation: &str) -> Option<String> {
        if self.terms.is_empty() {
            return None;
        }
        let shown = display(source).text.to_lowercase();
        let words: Vec<&str> = shown.unicode_words().collect();
        let translation = display(translation).text.to_lowercase();
        (0..words.len()).find_map(|at| {
            let rest = words.get(at..)?;
            let here = self.by_first_word.get(*rest.first()?).into_iter().flatten();
            let terms = here.filter_map(|number| self.terms.get(*number)).filter(|term| term.starts(rest));
            // Of `lamp` and `lamp oil`, the longer term applies.
            let term = terms.max_by_key(|term| term.words.len())?;
            let expected = term.translations.get(locale).or_else(|| term.translations.get(language(locale)))?;
            let is_there = expected.iter().any(|text| translation.contains(&text.to_lowercase()));
            (!is_there).then(|| {
                let expected = expected.iter().map(|text| escape::quoted(text).to_string()).collect::<Vec<_>>();
                format!("the translation lacks {} for the term {}", expected.join(" or "), escape::quoted(&term.text))
            })
        })
    }
}

impl Term {
    /// Whether the words begin with the term.
    fn starts(&self, words: &[&str]) -> bool {
        words.len() >= self.words.len() && self.words.iter().zip(words).all(|(own, word)| own == word)
    }
}

/// Returns the locale or language that a column is named after.
fn column(name: &str) -> Option<String> {
    let name = name.trim();
    let is_language = matches!(name.len(), 2 | 3) && name.bytes().all(|letter| letter.is_ascii_lowercase());
    if is_language { Some(name.to_owned()) } else { canonical_tag(name, true) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn terms() -> Terms {
        let table = "en-us,de-de,fr,note\nlighthouse,Leuchtturm,phare,a place\nlamp oil,Lampenöl|Petroleum,,\nlamp,Lampe,lampe,\n";
        let (terms, found) = Terms::read(table, "en-us");
        assert_eq!(found, []);
        terms
    }

    #[test]
    fn a_term_needs_one_of_its_translations() {
        let terms = terms();
        let german = |source: &str, text: &str| terms.difference(source, "de-de", text);
        for (source, text) in [
            ("The Lighthouse is dark.", "Der Leuchtturm ist dunkel."),
            ("The lighthouse's lamp.", "Die Lampe."),
            ("Buy lamp oil.", "Kauf Petroleum."),
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
        assert_eq!(terms.difference("The lighthouse.", "fr-fr", "Le phare."), None, "a column for the language");
        assert_eq!(terms.difference("The lighthouse.", "it-it", "Il faro."), None, "no translation is known");
    }

    #[test]
    fn a_table_needs_a_column_of_the_source_locale() {
        assert_eq!(Terms::read("de-de,note\na,b\n", "en-us").1.len(), 1);
        assert_eq!(Terms::read("", "en-us").1.len(), 1);
    }
}
