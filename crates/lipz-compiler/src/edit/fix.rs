//! Applying the certain fixes of a file's diagnostics until none are left.

use crate::check::{self, ClipSpeech};
use crate::clip::{ClipData, Locales};
use crate::project::Options;
use crate::run::Compiler;
use lipz_diagnostics::{Code, Diagnostic, Fix};
use std::collections::BTreeMap;

/// The most rounds of reading and fixing. Each round fixes everything it finds, but some mistakes are found only after
/// others are fixed: first syntax, then names and codes, then the white space between codes. No known file needs more
/// than three.
const ROUNDS: usize = 10;

/// A file after its certain fixes.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct FixedFile {
    /// The new text, without byte order mark.
    pub text: String,
    /// The number of fixed diagnostics of each code.
    pub counts: BTreeMap<Code, usize>,
}

impl Compiler<'_> {
    /// Returns a file with the certain fixes of its diagnostics applied; `None` if it does not have such a fix.
    ///
    /// A fix is certain if the bank made from the file is the same before and after, or, if an error prevents a bank,
    /// if the intent is beyond doubt. Everything else in the file keeps its spelling. Diagnostics of lints that the
    /// project allows are not fixed.
    ///
    /// ```
    /// use lipz_compiler::Compiler;
    /// let file = br#"{ "fps": "24", "visemes": "MA EO-", }"#;
    /// let fixed = Compiler::default().fix(file).ok_or("nothing to fix")?;
    /// assert_eq!(fixed.text, r#"{ "fps": 24, "visemes": "MAEO-" }"#);
    /// assert_eq!(fixed.counts.len(), 3);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn fix(&self, bytes: &[u8]) -> Option<FixedFile> {
        let mut fixed: Option<FixedFile> = None;
        for _ in 0..ROUNDS {
            match round(fixed.as_ref().map_or(bytes, |fixed| fixed.text.as_bytes()), &self.options) {
                Some(mut round) => {
                    for (code, count) in fixed.map(|fixed| fixed.counts).unwrap_or_default() {
                        *round.counts.entry(code).or_default() += count;
                    }
                    fixed = Some(round);
                }
                None => break,
            }
        }
        fixed
    }
}

/// Returns the file after one round of fixes, without fixes that overlap; `None` if there is nothing to fix.
fn round(bytes: &[u8], options: &Options) -> Option<FixedFile> {
    let (text, fixes) = fixes(bytes, options)?;
    let applied = Fix::apply_all(text, &fixes.iter().map(|(_, fix)| fix).collect::<Vec<_>>());
    let mut counts = BTreeMap::new();
    for (code, _) in applied.applied.iter().filter_map(|&index| fixes.get(index)) {
        *counts.entry(*code).or_default() += 1;
    }
    (!counts.is_empty()).then_some(FixedFile { text: applied.text, counts })
}

/// Returns the text of a file without byte order mark, and the certain fixes of its diagnostics; `None` if it is not
/// UTF-8.
fn fixes<'f>(bytes: &'f [u8], options: &Options) -> Option<(&'f str, Vec<(Code, Fix)>)> {
    let text = std::str::from_utf8(lipz_file::without_byte_order_mark(bytes)).ok()?;
    let mut parsed = lipz_file::parse(bytes);
    match (&parsed.document, &parsed.fragment) {
        (Some(document), _) => {
            check::check(
                document,
                options,
                ClipSpeech::default(),
                &mut Locales::default(),
                &mut ClipData::default(),
                &mut parsed.diagnostics,
            );
        }
        (None, Some(fragment)) => check::fragment(fragment, options, &mut parsed.diagnostics),
        (None, None) => {}
    }
    options.levels.apply(&mut parsed.diagnostics);
    let of = |diagnostic: &Diagnostic| diagnostic.fixes().map(|fix| (diagnostic.code, fix)).collect::<Vec<_>>();
    Some((text, parsed.diagnostics.iter().flat_map(of).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fixed(file: &str) -> Option<String> {
        let options = Options::new().default_locale("en-us").unwrap();
        let fixed = Compiler::new(options.clone()).fix(file.as_bytes())?;
        assert_eq!(Compiler::new(options).fix(fixed.text.as_bytes()), None, "fixed again: {}", fixed.text);
        Some(fixed.text)
    }

    #[test]
    fn certain_fixes() {
        let cases = [
            ("\u{FEFF}{}", "{}"),
            (r#"{"visemes": "A \n\u0020B\t|\u002d",}"#, r#"{"visemes": "AB|-"}"#),
            (r#"{"text-en_us": "a", "text_DE-de": "b"}"#, r#"{"text_en-us": "a", "text_de-de": "b"}"#),
            (r#"{"text": "a"}"#, r#"{"text_en-us": "a"}"#),
            (r#"{"text_en-us ": "a"}"#, r#"{"text_en-us": "a"}"#),
            (r#"{"viseme_type": "Toon Boom"}"#, r#"{"viseme_type": "toonboom"}"#),
            (r#"{"fps": "23.976"}"#, r#"{"fps": 23.976}"#),
            (r#"{"fps": 23,976}"#, r#"{"fps": 23.976}"#),
            (r#"{"fps": 59,94}"#, r#"{"fps": 59.94}"#),
            ("{\u{a0}\"fps\":\u{2003}24}", r#"{ "fps": 24}"#),
            ("{\"fps\": 24\r\n\"visemes\": \"A\"\r\n}", "{\"fps\": 24,\r\n\"visemes\": \"A\"\r\n}"),
            (r#"{"fps" = 24,,}}"#, r#"{"fps" : 24}"#),
            // A comment stays, because it does no harm.
            ("{\"text-en_us\": \"a\" // b\n\"fps\": \"24\",}", "{\"text_en-us\": \"a\", // b\n\"fps\": 24}"),
            // First the codes, then the white space between them.
            (r#"{"visemes": "ma e-|sso"}"#, r#"{"visemes": "MAE-|SSO"}"#),
            (r#"{"visemes": "12:-", "viseme_type": "RMS"}"#, r#"{"visemes": "129-", "viseme_type": "rms"}"#),
        ];
        for (file, expected) in cases {
            assert_eq!(fixed(file).as_deref(), Some(expected), "{file}");
        }
    }

    /// Returns the file after all fixes, and the number of rounds.
    fn in_rounds(file: &str) -> (String, usize) {
        let options = Options::new().default_locale("en-us").unwrap();
        let (mut text, mut count) = (file.to_owned(), 0);
        while let Some(fixed) = round(text.as_bytes(), &options) {
            (text, count) = (fixed.text, count + 1);
        }
        (text, count)
    }

    /// Returns a file with many elements, and an additional one at the end.
    fn elements(count: usize, element: impl Fn(usize) -> String) -> String {
        format!("{{{}\"z\":1}}", (0..count).map(element).collect::<String>())
    }

    fn tag(number: usize) -> String {
        let letter = |place: u32| char::from(b'a' + (number / 26_usize.pow(place) % 26) as u8);
        format!("{}{}-{}{}", letter(3), letter(2), letter(1), letter(0))
    }

    #[test]
    fn a_file_is_read_a_few_times_however_much_is_fixed() {
        // More than a report contains.
        let many = 2 * lipz_diagnostics::bound::PER_FILE_AND_CODE;
        let visemes = |codes: &str| format!("{{\"visemes\":\"{}\"}}", codes.repeat(many));
        let name = |number: usize| format!("\"text_{}\":\"\",", tag(number));
        let cases = [
            (elements(many, |_| ",".to_owned()), "{\"z\":1}".to_owned()),
            (
                elements(many, |number| format!("\u{a0}\"x{number}\" =\u{2003}1,,\n")),
                elements(many, |number| format!(" \"x{number}\" : 1,\n")),
            ),
            (
                elements(many, |number| format!("\"x{number}\": 1\n")),
                elements(many, |number| format!("\"x{number}\": 1,\n")),
            ),
            (
                elements(many, |number| name(number).replace('-', "_").to_uppercase().replace("TEXT", "text")),
                elements(many, name),
            ),
            (visemes("m a "), visemes("MA")),
        ];
        for (file, expected) in cases {
            let (text, count) = in_rounds(&file);
            assert!(count <= 3, "{count} rounds: {}", &file[..100]);
            assert!(text == expected, "{} became {}", &file[..100], &text[..7]);
        }
    }

    #[test]
    fn names_stay_apart_also_where_diagnostics_are_only_counted() {
        // So many that the first ones are beyond the limit before the last one, which has the same name as the first,
        // is found.
        let last = 66_000;
        let file = |separator: &str| {
            elements(last + 1, |number| match number % last {
                0 => format!("\"text-{}_aa\":\"\",", if number == 0 { "aa" } else { "AA" }),
                _ => format!("\"text{separator}{}\":\"\",", tag(number)),
            })
        };
        assert!(in_rounds(&file("-")).0 == file("_"));
    }

    #[test]
    fn what_is_not_certain_stays() {
        let cases = [
            r#"{"visemes": "MAlEO"}"#,
            r#"{"visemes": "malle"}"#,
            r#"{"visemes": "M0O", "viseme_type": "blair"}"#,
            r#"{"visemes": "12:-"}"#,
            r#"{"visemes": "How are you?"}"#,
            r#"{"Visemes": "A", "visemeType": "blair"}"#,
            r#"{"fps": 1,000}"#,
            r#"{"fps": 3,0}"#,
            r#"{"fps": 2,5}"#,
            r#"{"fps": 24,25}"#,
            r#"{"fps": 12,500}"#,
            r#"{"fps": "024"}"#,
            r#"{"fps": "24."}"#,
            r#"{"x": 1,5}"#,
            r#"{"text_en-us": "the "Admiral": a parrot"}"#,
            r#"{"viseme_type": "blare"}"#,
            // An unreadable name may equal another.
            r#"{"text-en_us": "a", "t\ext_en-us": "b"}"#,
            // If a text ends too early, everything after it may be part of it.
            "{\"text_en-us\": \"say \"yes\",\n\"text-de_de\": \"b\",}",
            // Two names must not become equal.
            r#"{"text-en_us": "a", "text_EN-US": "b"}"#,
            r#"{"text": "a", "text_en-us": "b"}"#,
            r#"{"text_en-us ": "a", "text_en-us": "b"}"#,
            r#"{"text_en-us": "fine"}"#,
            "",
        ];
        for file in cases {
            assert_eq!(fixed(file), None, "{file}");
        }
    }

    #[test]
    fn the_default_locale_is_written_as_the_format_spells_it() {
        let fixed = |default: &str| {
            let options = Options::new().default_locale(default).unwrap();
            Compiler::new(options).fix(br#"{"text": "a"}"#)
        };
        let once = [(Code::TextWithoutLocale, 1)].into();
        assert_eq!(fixed("EN_us"), Some(FixedFile { text: r#"{"text_en-us": "a"}"#.into(), counts: once }));
    }

    #[test]
    fn diagnostics_of_an_allowed_lint_are_left_alone() {
        let options = Options::new().levels([(Code::LocaleSpelling, None)]);
        assert_eq!(Compiler::new(options).fix(br#"{"text-en_us": "a"}"#), None);
    }
}
