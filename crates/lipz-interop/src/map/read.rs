//! Reading of a mapping table from TOML.

use super::Map;
use lipz_diagnostics::{Code, Diagnostic, Span, escape, suggest};
use lipz_types::{Phone, VisemeType};
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The fields that describe a table, each with an example value.
const FIELDS: [(&str, &str); 9] = [
    ("name", "a name: \"our-rig\""),
    ("version", "a whole number to increase when a row changes: 1"),
    ("about", "a sentence about the table"),
    ("source", "the source of its rows"),
    ("viseme-type", "the viseme type of its codes: \"blair\", \"toonboom\" or \"rms\""),
    ("ignore-case", "true if upper and lower case are equal"),
    ("phones", "true if the symbols are phones, in ARPAbet or IPA"),
    ("guessed", "a list of symbols with a guessed code"),
    ("to-lipz", "a table of symbols with their codes: MBP = \"M\""),
];
/// The optional tables: codes to symbols, and symbols to phones.
const FROM_LIPZ: &str = "from-lipz";
const TO_PHONE: &str = "to-phone";

impl Map {
    /// Reads a mapping table.
    ///
    /// # Errors
    /// If the text is not TOML, if fields are missing, unknown or of the wrong type, or if codes do not belong to the
    /// viseme type.
    pub fn parse(text: &str) -> Result<Map, Vec<Diagnostic>> {
        let root = DeTable::parse(text).map_err(|error| {
            let message = format!("the mapping table is not TOML: {}", escape::text(error.message()));
            vec![
                refusal(error.span().unwrap_or_default(), message)
                    .help("put symbols and codes in quotes: \"F.V\" = \"F\""),
            ]
        })?;
        let mut reading = MapReader { root: root.get_ref(), diagnostics: Vec::new() };
        let map = reading.map();
        match map.filter(|_| reading.diagnostics.is_empty()) {
            Some(map) => Ok(map),
            None => Err(reading.diagnostics),
        }
    }
}

struct MapReader<'t> {
    root: &'t DeTable<'t>,
    diagnostics: Vec<Diagnostic>,
}

impl<'t> MapReader<'t> {
    fn map(&mut self) -> Option<Map> {
        self.unknown_fields();
        let name = self.string("name")?.0.to_owned();
        let version = self.version()?;
        let viseme_type = self.viseme_type()?;
        let mut to_lipz = Vec::new();
        let mut from_lipz = Vec::new();
        for (symbol, value, span) in self.rows("to-lipz")? {
            to_lipz.extend(self.code(value, span, viseme_type).map(|code| (symbol.to_owned(), code)));
        }
        if self.root.contains_key(FROM_LIPZ) {
            for (code, symbol, span) in self.rows(FROM_LIPZ)? {
                from_lipz.extend(self.code(code, span, viseme_type).map(|code| (code, symbol.to_owned())));
            }
        } else {
            // The first symbol of each code.
            for (symbol, code) in &to_lipz {
                if from_lipz.iter().all(|(known, _)| known != code) {
                    from_lipz.push((*code, symbol.clone()));
                }
            }
        }
        let to_phone = self.phones()?;
        Some(Map {
            name,
            version,
            about: self.optional("about")?,
            source: self.optional("source")?,
            viseme_type,
            guessed: self.guessed()?,
            ignores_case: self.boolean("ignore-case")?,
            to_lipz,
            from_lipz,
            names_phones: self.boolean("phones")?,
            to_phone,
        })
    }

    fn unknown_fields(&mut self) {
        let known = || FIELDS.iter().map(|(name, _)| *name).chain([FROM_LIPZ, TO_PHONE]);
        for (key, _) in self.root {
            let written: &str = key.get_ref();
            if known().all(|name| name != written) {
                let diagnostic =
                    refusal(key.span(), format!("a mapping table has no field {}", escape::quoted(written)));
                self.diagnostics.push(match suggest::nearest(written, known()) {
                    Some(name) => diagnostic.help(format!("did you mean `{name}`?")),
                    None => diagnostic.help(
                        "use name, version, about, source, viseme-type, ignore-case, phones, guessed, to-lipz, from-lipz or to-phone",
                    ),
                });
            }
        }
    }

    /// Returns the value of a required field.
    fn required(&mut self, field: &str) -> Option<&'t Spanned<DeValue<'t>>> {
        let found = self.root.get(field);
        if found.is_none() {
            let diagnostic = Diagnostic::new(Code::MapRefused, format!("the mapping table has no `{field}`"));
            self.diagnostics.push(diagnostic.help(what_to_write(field)));
        }
        found
    }

    fn wrong_type(&mut self, field: &str, span: Range<usize>) {
        self.diagnostics
            .push(refusal(span, format!("`{field}` has a value of the wrong type")).help(what_to_write(field)));
    }

    /// Returns a required text with its position.
    fn string(&mut self, field: &str) -> Option<(&'t str, Range<usize>)> {
        let value = self.required(field)?;
        match value.get_ref() {
            DeValue::String(text) => Some((text, value.span())),
            _ => {
                self.wrong_type(field, value.span());
                None
            }
        }
    }

    /// Returns an optional text.
    fn optional(&mut self, field: &str) -> Option<String> {
        if !self.root.contains_key(field) {
            return Some(String::new());
        }
        self.string(field).map(|(text, _)| text.to_owned())
    }

    fn version(&mut self) -> Option<u32> {
        let value = self.required("version")?;
        let number = match value.get_ref() {
            DeValue::Integer(integer) => u32::from_str_radix(integer.as_str(), integer.radix()).ok(),
            _ => None,
        };
        if number.is_none() {
            self.wrong_type("version", value.span());
        }
        number
    }

    fn viseme_type(&mut self) -> Option<VisemeType> {
        let (name, span) = self.string("viseme-type")?;
        let found = name.parse::<VisemeType>().ok();
        if found.is_none() {
            let message = format!("{} is not a viseme type", escape::quoted(name));
            self.diagnostics.push(refusal(span, message).help("write blair, toonboom or rms"));
        }
        found
    }

    /// Returns an optional boolean; `false` if it is missing.
    fn boolean(&mut self, field: &str) -> Option<bool> {
        match self.root.get(field).map(|value| (value, value.get_ref())) {
            None => Some(false),
            Some((_, DeValue::Boolean(is_true))) => Some(*is_true),
            Some((value, _)) => {
                self.wrong_type(field, value.span());
                None
            }
        }
    }

    /// Returns the phones of symbols.
    fn phones(&mut self) -> Option<Vec<(String, Phone)>> {
        let mut phones = Vec::new();
        if !self.root.contains_key(TO_PHONE) {
            return Some(phones);
        }
        for (symbol, name, span) in self.rows(TO_PHONE)? {
            match name.parse() {
                Ok(phone) => phones.push((symbol.to_owned(), phone)),
                Err(_) => self.diagnostics.push(
                    refusal(span, format!("{} is not a known phone", escape::quoted(name)))
                        .help("write ARPAbet in capitals without stress, IPA, or `sil` for silence"),
                ),
            }
        }
        Some(phones)
    }

    fn guessed(&mut self) -> Option<Vec<String>> {
        let Some(value) = self.root.get("guessed") else { return Some(Vec::new()) };
        let items = match value.get_ref() {
            DeValue::Array(items) => items.iter().map(|item| match item.get_ref() {
                DeValue::String(symbol) => Some(symbol.clone().into_owned()),
                _ => None,
            }),
            _ => {
                self.wrong_type("guessed", value.span());
                return None;
            }
        };
        let symbols: Option<Vec<String>> = items.collect();
        if symbols.is_none() {
            self.wrong_type("guessed", value.span());
        }
        symbols
    }

    /// Returns the rows of a table of texts: key, value and position.
    fn rows(&mut self, field: &str) -> Option<Vec<(&'t str, &'t str, Range<usize>)>> {
        let value = self.required(field)?;
        let DeValue::Table(table) = value.get_ref() else {
            self.wrong_type(field, value.span());
            return None;
        };
        // The parser sorts keys, but the order in the file decides which symbol of a code is the first.
        let mut rows = Vec::with_capacity(table.len());
        for (key, value) in table {
            match value.get_ref() {
                DeValue::String(text) => {
                    let key_text: &str = key.get_ref();
                    let text: &str = text;
                    rows.push((key_text, text, key.span().start..value.span().end));
                }
                _ => self.wrong_type(field, value.span()),
            }
        }
        rows.sort_by_key(|(.., span)| span.start);
        Some(rows)
    }

    /// Returns the code if a text consists of one.
    fn code(&mut self, text: &str, span: Range<usize>, viseme_type: VisemeType) -> Option<u8> {
        let code = match text.as_bytes() {
            [code] if viseme_type.contains(*code) => Some(*code),
            _ => None,
        };
        if code.is_none() {
            let message = format!("{} is not a code of the viseme type {viseme_type}", escape::quoted(text));
            let help = format!("use one of its codes: {}", viseme_type.codes());
            self.diagnostics.push(refusal(span, message).help(help));
        }
        code
    }
}

fn what_to_write(field: &str) -> String {
    let what =
        FIELDS.iter().find(|(name, _)| *name == field).map_or("symbols by their codes: M = \"MBP\"", |(_, what)| what);
    format!("`{field}` is {what}")
}

fn refusal(span: Range<usize>, message: String) -> Diagnostic {
    Diagnostic::at(Code::MapRefused, Span::new(span.start, span.end), message)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    const START: &str = "name = \"x\"\nversion = 1\nviseme-type = \"blair\"\n";

    fn headlines(text: &str) -> Vec<String> {
        Map::parse(text).unwrap_err().into_iter().map(|diagnostic| diagnostic.message).collect()
    }

    #[test]
    fn the_first_symbol_of_a_code_is_the_one_that_is_written() {
        let map = Map::parse(&format!("{START}[to-lipz]\nrest = \"-\"\nZ = \"S\"\nA = \"S\"\n")).unwrap();
        assert_eq!((map.symbol(b'S'), map.code("A"), map.code("a")), (Some("Z"), Some(b'S'), None));
        assert!(!map.is_lossless());
        let back = Map::parse(&format!("{START}[to-lipz]\nZ = \"S\"\nA = \"S\"\n[from-lipz]\nS = \"A\"\n")).unwrap();
        assert_eq!(back.symbol(b'S'), Some("A"));
    }

    #[test]
    fn what_is_wrong_is_named() {
        assert_eq!(headlines("name = x").len(), 1);
        assert_eq!(headlines("version = 1\n"), ["the mapping table has no `name`"]);
        assert_eq!(headlines(&format!("{START}to-lips = 1\n[to-lipz]\n")), ["a mapping table has no field `to-lips`"]);
        assert_eq!(
            headlines(&format!("{START}[to-lipz]\nA = \"Z\"\n")),
            ["`Z` is not a code of the viseme type blair"]
        );
        assert_eq!(headlines(&format!("{START}[to-lipz]\nA = 1\n")), ["`to-lipz` has a value of the wrong type"]);
    }
}
