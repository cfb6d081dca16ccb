//! Formatting, fixing and converting preserve the meaning of a file, for any contents.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

mod support;

use lipz_bank::VisemeType::{self, Blair, ToonBoom};
use lipz_bank::{Bank, Clip};
use lipz_compiler::{Compiler, Documents, Input, Options};
use lipz_diagnostics::{Code, Severity};
use lipz_file::format::{LineEnding, Style, format};
use lipz_file::{Document, RawJson, Value, text};
use lipz_testkit::dialogue;
use lipz_testkit::documents::document;
use proptest::prelude::*;
use unicode_segmentation::UnicodeSegmentation;
use unicode_width::UnicodeWidthStr;

/// Returns the bank of one file, without its source record.
fn bank(file: &str, options: &Options) -> Vec<u8> {
    let options = options.clone().strip(true);
    let compiled = Compiler::new(options.clone()).compile(&[Input::from_bytes("clip", file)]);
    compiled.bank.unwrap_or_else(|| panic!("{file}\n{:#?}", compiled.reports))
}

fn parsed(file: &str) -> Document<'_> {
    lipz_file::parse(file.as_bytes()).document.unwrap_or_else(|| panic!("{file}"))
}

fn formatted(file: &str, default_locale: Option<&str>) -> String {
    format(&parsed(file), Style { default_locale, line_ending: LineEnding::detect(file) })
}

/// Returns the document as a file, with those characters escaped for which `escaped` is true.
fn spelled(document: &Document<'_>, escaped: &[bool]) -> String {
    let mut escaped = escaped.iter().copied().cycle();
    let mut literal = |text: &str| {
        let mut out = String::from("\"");
        for c in text.chars() {
            if escaped.next() == Some(true) {
                out.extend(c.encode_utf16(&mut [0; 2]).iter().map(|unit| format!("\\u{unit:04x}")));
            } else {
                let literal = lipz_file::literal(c.encode_utf8(&mut [0; 4]));
                out.push_str(&literal[1..literal.len() - 1]);
            }
        }
        out + "\""
    };
    let elements: Vec<String> = document
        .elements
        .iter()
        .map(|element| {
            let value = match &element.value {
                Value::String(string) => literal(&string.text),
                Value::Number(raw) | Value::Other(raw) => raw.text.to_string(),
            };
            format!("{}:{value}", literal(&element.name.text))
        })
        .collect();
    format!("{{{}}}", elements.join(","))
}

/// Checks that every element is kept, except for white space at the ends of segments.
fn assert_same_elements(before: &Document<'_>, after: &Document<'_>) {
    assert_eq!(before.elements.len(), after.elements.len());
    for element in &before.elements {
        let name = element.name.text.as_ref();
        let other = &after.get(name).unwrap_or_else(|| panic!("{name:?} is gone")).value;
        match (&element.value, other) {
            (Value::String(string), Value::String(other)) if name == "events" || name.starts_with("text") => {
                let trimmed = |text: &str| -> Vec<String> {
                    text::segments(text).map(|range| text::trim(&text[range]).to_owned()).collect()
                };
                assert_eq!(trimmed(&string.text), trimmed(&other.text), "{name}");
            }
            // A curve has its own line.
            (Value::Other(raw), Value::Other(other)) if name == "curves" => {
                let words = |raw: &RawJson<'_>| raw.text.split_whitespace().collect::<String>();
                assert_eq!(words(raw), words(other));
            }
            (value, other) => assert_eq!(value, other, "{name}"),
        }
    }
}

/// Returns the columns of the `|` in the lines of texts and events.
fn columns(formatted: &str) -> Vec<Vec<usize>> {
    let is_padded = |line: &&str| line.starts_with("  \"text") || line.starts_with("  \"events\"");
    let width = |text: &str| text.graphemes(true).map(UnicodeWidthStr::width).sum();
    let delimiters = |line: &str| line.match_indices('|').map(|(at, _)| width(&line[..at])).collect();
    formatted.lines().filter(is_padded).map(delimiters).collect()
}

/// Returns all segments of a converted clip as code strings.
fn codes(bytes: &[u8]) -> Vec<String> {
    let bank = Bank::open(bytes).and_then(Bank::verify).unwrap();
    let of = |clip: Clip<'_>| clip.segments().map(|segment| String::from_utf8_lossy(segment.frames()).into()).collect();
    bank.clip_by_key("clip").map(of).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn formatting_keeps_the_meaning(
        document in document(),
        escaped in proptest::collection::vec(proptest::bool::weighted(0.2), 1..50),
        default_locale in proptest::option::of("(en-us|de-de|ko-kr)"),
    ) {
        let file = spelled(&document, &escaped);
        prop_assert_eq!(&parsed(&file), &document, "the test's own spelling: {}", file);
        let once = formatted(&file, default_locale.as_deref());
        assert_same_elements(&document, &parsed(&once));
        prop_assert_eq!(bank(&file, &Options::default()), bank(&once, &Options::default()));
        prop_assert_eq!(formatted(&once, default_locale.as_deref()), once.as_str());
        let columns = columns(&once);
        prop_assert!(columns.windows(2).all(|two| two[0] == two[1]), "{}", once);
    }

    #[test]
    fn the_order_of_elements_means_nothing_where_segments_are_joined(
        elements in proptest::collection::btree_map("text_(en-us|de-de|fr-fr)|events|visemes", "[AB|]{0,5}", 1..5)
            .prop_map(|elements| elements.into_iter().collect::<Vec<_>>()).prop_shuffle(),
        default in proptest::option::of("en-us|fr-fr"),
    ) {
        let elements: Vec<String> = elements.iter().map(|(name, value)| format!("\"{name}\": \"{value}\"")).collect();
        let file = format!("{{ {} }}", elements.join(", "));
        let lowered = Options::new().levels([(Code::SegmentCount, Some(Severity::Warning))]);
        let options = default.iter().fold(lowered, |options, tag| options.default_locale(tag).unwrap());
        prop_assert_eq!(bank(&file, &options), bank(&formatted(&file, Some("en-us")), &options));
        prop_assert_eq!(bank(&file, &options), bank(&formatted(&file, Some("fr-fr")), &options));
    }

    #[test]
    fn fixing_keeps_the_meaning(document in document(), has_mark: bool, has_comma: bool) {
        let options = Options::new().default_locale("de-de").unwrap();
        let valid = lipz_file::write(&document);
        let mut file = if has_mark { format!("\u{FEFF}{valid}") } else { valid.clone() };
        if has_comma && !document.elements.is_empty() {
            file.insert(file.rfind('}').unwrap(), ',');
        }
        let fixed = Compiler::new(options.clone()).fix(file.as_bytes());
        let text = fixed.map_or(file, |fixed| fixed.text);
        prop_assert_eq!(Compiler::new(options.clone()).fix(text.as_bytes()), None);
        prop_assert_eq!(bank(&valid, &options), bank(&text, &options));
        let left = lipz_file::parse(text.as_bytes()).diagnostics;
        prop_assert!(left.iter().all(|diagnostic| diagnostic.fix.is_none()), "{left:?}");
    }

    #[test]
    fn packing_converts_as_the_file_is_converted(document in document(), to in prop_oneof![Just(Blair), Just(ToonBoom)]) {
        let file = lipz_file::write(&document);
        let converted = Compiler::default().convert(file.as_bytes(), to);
        let packing = Options::new().viseme_type(to);
        let packed = Compiler::new(packing.clone()).compile(&[Input::from_bytes("clip", file.as_str())]);
        let of_packing = packed.reports.into_iter().flat_map(|report| report.diagnostics);
        let is_about_it = |diagnostic: &lipz_diagnostics::Diagnostic| ["LZ0404", "LZ0405"].contains(&diagnostic.code.number());
        prop_assert_eq!(of_packing.filter(is_about_it).collect::<Vec<_>>(), converted.diagnostics);
        let Some(bytes) = packed.bank else { return Ok(()) };
        let text = converted.text.unwrap_or(file);
        prop_assert_eq!(bank(&text, &Options::default()), bank(&text, &packing));
        // The unpacked file is the converted one, and packs to the same bank without conversion.
        dialogue!(bank = &bytes);
        let documents = Documents::from_dialogue(&bank).unwrap();
        let (_, unpacked) = documents.iter().next().unwrap().unwrap();
        prop_assert_eq!(&unpacked, &parsed(&text));
        let again = Compiler::default().compile(&[Input::from_bytes("clip", lipz_file::write(&unpacked))]);
        prop_assert_eq!(again.bank.unwrap(), bytes);
    }

    #[test]
    fn toonboom_comes_back_from_blair(visemes in "[-ABCDEFG|]{0,40}") {
        let file = format!(r#"{{ "viseme_type": "toonboom", "visemes": "{visemes}" }}"#);
        let there = Compiler::default().convert(file.as_bytes(), Blair);
        prop_assert_eq!(&there.diagnostics, &[]);
        let back = Compiler::default().convert(there.text.unwrap().as_bytes(), ToonBoom);
        prop_assert_eq!(&back.diagnostics, &[]);
        prop_assert_eq!(back.text.unwrap(), file);
    }
}

#[test]
fn fixing_bad_files_makes_nothing_worse() {
    let options = Options::new().default_locale("ja-jp").unwrap();
    let mut mended = 0;
    for (name, bytes) in support::files("bad").into_iter().chain(support::files("spec/as-printed")) {
        let Some(fixed) = Compiler::new(options.clone()).fix(&bytes) else { continue };
        mended += 1;
        let packed = |bytes: &[u8]| {
            let options = options.clone().strip(true);
            Compiler::new(options.clone()).compile(&[Input::from_bytes("clip", bytes)]).bank
        };
        let (before, after) = (lipz_file::parse(&bytes).document, lipz_file::parse(fixed.text.as_bytes()).document);
        assert!(before.is_none() || after.is_some(), "{name}");
        assert!(packed(&bytes).is_none_or(|bank| Some(bank) == packed(fixed.text.as_bytes())), "{name}");
        assert_eq!(Compiler::new(options.clone()).fix(fixed.text.as_bytes()), None, "{name}");
    }
    assert!(mended > 20, "{mended}");
}

fn converted(file: &str, to: VisemeType, options: &Options) -> (Option<String>, Vec<String>) {
    let converted = Compiler::new(options.clone()).convert(file.as_bytes(), to);
    (converted.text, converted.diagnostics.iter().map(|found| format!("{}: {}", found.code, found.message)).collect())
}

#[test]
fn only_codes_and_type_are_edited() {
    let default = Options::new().default_viseme_type(Blair);
    let cases = [
        // The byte order mark, line endings, escapes and unusual blanks elsewhere are kept.
        (
            "\u{FEFF}{\r\n\t\"visemes\" :  \"\\u004dA |-\",\r\n\t\"x\":[ 1 ],\"viseme_type\":\"blair\"  }",
            "\u{FEFF}{\r\n\t\"visemes\" :  \"AD |-\",\r\n\t\"x\":[ 1 ],\"viseme_type\":\"toonboom\"  }",
        ),
        // A file whose type comes from the project now sets it itself.
        (
            "{\n  \"visemes\" : \"MA\",\n  \"fps\" : 24\n}",
            "{\n  \"visemes\" : \"AD\",\n  \"viseme_type\" : \"toonboom\",\n  \"fps\" : 24\n}",
        ),
        (r#"{"visemes":"MA"}"#, r#"{"visemes":"AD","viseme_type":"toonboom"}"#),
        (r#"{"viseme_type":"blair"}"#, r#"{"viseme_type":"toonboom"}"#),
    ];
    for (file, expected) in cases {
        assert_eq!(converted(file, ToonBoom, &default), (Some(expected.into()), vec![]), "{file}");
    }
}

#[test]
fn files_without_a_type() {
    let none = Options::default();
    assert_eq!(
        converted(r#"{"visemes":"MA-"}"#, ToonBoom, &none).0.unwrap(),
        r#"{"visemes":"AD-","viseme_type":"toonboom"}"#
    );
    let ambiguous = "LZ0405: these codes cannot be converted because they may be blair or toonboom";
    for to in [Blair, ToonBoom] {
        assert_eq!(converted(r#"{"visemes":"AEF-"}"#, to, &none), (None, vec![ambiguous.into()]));
    }
    for unchanged in [r#"{"visemes":"--|-"}"#, r#"{"visemes":""}"#, r#"{"fps":24}"#, r#"{"visemes":"BD"}"#] {
        assert_eq!(converted(unchanged, ToonBoom, &none), (None, vec![]), "{unchanged}");
    }
}

#[test]
fn loudness_is_refused_and_rest_is_not() {
    let refused = |from: VisemeType, to| vec![format!("LZ0405: {from} codes cannot be converted to {to}")];
    let rms = r#"{"viseme_type":"rms","visemes":"0-9"}"#;
    assert_eq!(converted(rms, Blair, &Options::default()), (None, refused(VisemeType::Rms, Blair)));
    let blair = r#"{"viseme_type":"blair","visemes":"MA"}"#;
    assert_eq!(converted(blair, VisemeType::Rms, &Options::default()), (None, refused(Blair, VisemeType::Rms)));
    let rest = r#"{"viseme_type":"rms","visemes":"-|-"}"#;
    assert_eq!(converted(rest, Blair, &Options::default()).0.unwrap(), rest.replace("rms", "blair"));
}

#[test]
fn what_is_lost_has_the_level_of_the_project() {
    let file = br#"{"viseme_type":"blair","visemes":"LUL"}"#;
    let with = |level| {
        let options = Options::new().levels([(Code::ConversionLoss, level)]);
        let converted = Compiler::new(options.clone()).convert(file, ToonBoom);
        (converted.text.is_some(), converted.diagnostics.iter().map(|found| found.severity).collect::<Vec<_>>())
    };
    assert_eq!(with(Some(Severity::Warning)), (true, vec![Severity::Warning]));
    assert_eq!(with(None), (true, vec![]));
    assert_eq!(with(Some(Severity::Error)), (false, vec![Severity::Error]));
}

#[test]
fn packing_converts_and_reports_what_is_lost() {
    let file = r#"{"viseme_type":"blair","visemes":"MASOWEF-|LUL"}"#;
    let options = Options::new().viseme_type(ToonBoom);
    let compiled = Compiler::new(options.clone()).compile(&[Input::from_bytes("clip", file)]);
    let [diagnostic] = &compiled.reports[0].diagnostics[..] else { panic!("{:?}", compiled.reports) };
    assert_eq!(diagnostic.message, "3 frames lose their own mouth shape because toonboom has no `L` or `U`");
    assert_eq!(diagnostic.notes, ["`L` becomes `B` in 2 frames", "`U` becomes `F` in 1 frame"]);
    let bytes = compiled.bank.unwrap();
    assert_eq!(codes(&bytes), ["ADBEFCG-", "BFB"]);
    let bank = Bank::open(&bytes).and_then(Bank::verify).unwrap();
    assert_eq!(bank.clip_by_key("clip").unwrap().viseme_type(), Some(ToonBoom));
}
