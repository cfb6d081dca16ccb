//! JSON → bank → JSON: every packed element is restored; → bank again: the same bytes.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

mod support;

use lipz_bank::VisemeType;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Documents, Input, Options};
use lipz_diagnostics::{Code, Severity};
use lipz_file::locale::{TextName, split_variant, text_name};
use lipz_file::{Document, Element};
use lipz_testkit::dialogue;
use lipz_testkit::documents::document;
use proptest::prelude::*;
use proptest::{collection, option, sample};

type Files = Vec<(String, Vec<u8>)>;

fn packed(files: &Files, options: &Options) -> Vec<u8> {
    let inputs: Vec<Input> = files.iter().map(|(key, bytes)| Input::from_bytes(key, bytes.clone())).collect();
    let compiled = Compiler::new(options.clone()).compile(&inputs);
    compiled.bank.unwrap_or_else(|| panic!("{:#?}", compiled.reports))
}

fn unpacked(bytes: &[u8]) -> Files {
    dialogue!(bank = bytes);
    let documents = Documents::from_dialogue(&bank).unwrap();
    assert!(documents.is_exact());
    let file = |(key, document): (&str, Document<'_>)| (key.to_owned(), lipz_file::write(&document).into_bytes());
    documents.iter().map(|document| file(document.unwrap())).collect()
}

/// Returns the part of a file that a bank keeps: converted codes, and only the texts of the chosen locales.
fn kept(file: &[u8], options: &Options) -> Vec<u8> {
    let converted = options.get_viseme_type().and_then(|to| Compiler::new(options.clone()).convert(file, to).text);
    let file = converted.map_or(file.to_vec(), String::into_bytes);
    let mut document = lipz_file::parse(&file).document.unwrap();
    document.elements.retain(|element| match (options.get_locales(), text_name(&element.name.text)) {
        (Some(chosen), Some(TextName::Canonical(tag) | TextName::Misspelt(tag))) => {
            chosen.contains(split_variant(&tag).0)
        }
        _ => true,
    });
    lipz_file::write(&document).into_bytes()
}

/// Packs `files`, unpacks them in memory, compares, packs again, compares.
fn assert_round_trip(files: &Files, options: &Options) {
    let bytes = packed(files, options);
    let mut expected: Files = files.iter().map(|(key, file)| (key.clone(), kept(file, options))).collect();
    expected.sort();
    let there = unpacked(&bytes);
    assert_eq!(texts(&there), texts(&expected));
    let again = packed(&there, options);
    if options.get_locales().is_none() {
        assert_eq!(again, bytes);
    } else {
        // Chosen locales lose the fallback texts that were not packed.
        assert_eq!(texts(&unpacked(&again)), texts(&expected));
    }
}

fn texts(files: &Files) -> Vec<(&str, &str)> {
    files.iter().map(|(key, file)| (key.as_str(), std::str::from_utf8(file).unwrap())).collect()
}

#[test]
fn every_good_fixture_comes_back() {
    for folder in ["drama", "spec/repaired"] {
        let files = support::files(folder);
        assert!(!files.is_empty(), "{folder}");
        assert_round_trip(&files, &Options::default());
        assert_round_trip(&files, &Options::new().default_locale("de-de").unwrap().threads(2));
    }
}

#[test]
fn odd_spellings_come_back() {
    let odd = [
        "{}",
        r#"{"visemes":""}"#,
        r#"{"visemes":"||"}"#,
        r#"{"visemes":" AB | - ","text-en_us":" a | b ","text_EN-GB":"|"}"#,
        r#"{"text_de-de":"{m}|","events":" x |","visemes":"|"}"#,
        r#"{"events":"\u0000","text_en-us":"\ud83d\ude00"}"#,
        r#"{"fps":24.000,"viseme_type":"rms","nested":{"a":[1,2,{"b":-0.0e+5}],"a":null},"t":true}"#,
        r#"{"text_ja-jp":"　全角　|｜","visemes":"AM|O"}"#,
        r#"{"fps":23.976023976023976,"":"","\u0041":0}"#,
    ];
    let files: Vec<_> =
        odd.iter().enumerate().map(|(n, text)| (format!("odd-{n}"), text.as_bytes().to_vec())).collect();
    assert_round_trip(&files, &Options::default());
}

#[test]
fn a_stripped_bank_gives_display_forms() {
    let file = br#"{"text_en-us":" {loud} Hi | you","viseme_type":"blair","visemes":"MA|O-","fps":29.97,"x":1}"#;
    let options = Options::new().strip(true);
    let bytes = Compiler::new(options.clone()).compile(&[Input::from_bytes("a", file)]).bank.unwrap();
    dialogue!(bank = &bytes);
    let documents = Documents::from_dialogue(&bank).unwrap();
    assert!(!documents.is_exact());
    let (_, document) = documents.iter().next().unwrap().unwrap();
    let expected = "{\n  \"fps\": 29.97,\n  \"viseme_type\": \"blair\",\n  \"visemes\": \"MA|O-\",\n  \"text_en-us\": \"Hi|you\"\n}\n";
    assert_eq!(lipz_file::write(&document), expected);
    let again = Compiler::new(options.clone()).compile(&[Input::from_bytes("a", expected)]).bank.unwrap();
    assert_eq!(again, bytes);
}

/// Returns options that allow elements with different segments.
fn joining() -> Options {
    Options::new().levels(joined_segments())
}

fn joined_segments() -> [(Code, Option<Severity>); 1] {
    [(Code::SegmentCount, Some(Severity::Warning))]
}

/// Generates a document that combines the texts and events of a document with the other elements of a second one, which
/// has different segments.
fn uneven() -> impl Strategy<Value = Document<'static>> {
    let is_segmented = |element: &Element<'_>| element.name.text.starts_with("text") || element.name.text == "events";
    (document(), document()).prop_map(move |(one, other)| {
        let segmented = one.elements.into_iter().filter(is_segmented);
        let others = other.elements.into_iter().filter(|element| !is_segmented(element));
        Document { elements: segmented.chain(others).collect() }
    })
}

#[test]
fn elements_that_are_joined_come_back() {
    let uneven = [
        r#"{"visemes":"AM","text_en-us":"a|b","events":"x|y"}"#,
        r#"{"visemes":"A|M","text_en-us":" Hello ","text_de-de":"a|b|c","events":"feels sad||feels happy"}"#,
        r#"{"text_en-us":"a|b","events":"x y"}"#,
        r#"{"viseme_type":"rms","visemes":"1|2|3|4","text_en-us":"a b c"}"#,
    ];
    let files: Vec<_> =
        uneven.iter().enumerate().map(|(n, text)| (format!("uneven-{n}"), text.as_bytes().to_vec())).collect();
    assert_round_trip(&files, &joining());
}

/// Generates options of projects.
fn options() -> impl Strategy<Value = Options> {
    let tags = ["ar-eg", "de-ch", "de-de", "en-us", "en-xa", "es-mx", "fr-ca", "pt-br"];
    let locales = option::of(collection::btree_set(sample::select(tags.to_vec()), 0..5));
    let default_locale = option::of(sample::select(&["de-de", "en-us", "it-it"][..]));
    let viseme_type = || option::of(sample::select(&VisemeType::ALL[..]));
    let faces = ["", "[face]\nkeys = \"words\"\nblink = 3\n", "face.keys = \"off\"\nemotions.curves = \"values\"\n"];
    (locales, default_locale, viseme_type(), viseme_type(), any::<[bool; 2]>(), sample::select(faces.to_vec()))
        .prop_map(|(locales, default_locale, viseme_type, default_viseme_type, [literal_braces, pseudo], faces)| {
            let settings = Settings::parse(faces, "lipz.toml", "").unwrap();
            let options = settings.options.levels(joined_segments()).literal_braces(literal_braces);
            let options = options.pseudo(pseudo && default_locale.is_some());
            let options = options.viseme_type(viseme_type).default_viseme_type(default_viseme_type);
            let options = locales.into_iter().fold(options, |options, tags| options.locales(tags).unwrap());
            default_locale.into_iter().fold(options, |options, tag| options.default_locale(tag).unwrap())
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn what_is_packed_comes_back_whatever_a_project_decides(
        documents in collection::vec(prop_oneof![document(), uneven()], 1..8),
        options in options(),
    ) {
        // Some codes are not of the default type, or cannot be converted.
        let is_good = |file: &Vec<u8>| Compiler::new(options.clone()).compile(&[Input::from_bytes("clip", file.clone())]).bank.is_some();
        let files = documents.iter().map(|document| lipz_file::write(document).into_bytes()).filter(is_good);
        let files = files.enumerate().map(|(number, file)| (format!("clip-{number}"), file)).collect();
        assert_round_trip(&files, &options);
    }

    #[test]
    fn any_documents_come_back(documents in collection::vec(document(), 1..8)) {
        let files: Vec<_> = documents
            .iter()
            .enumerate()
            .map(|(number, document)| (format!("clip-{number}"), lipz_file::write(document).into_bytes()))
            .collect();
        assert_round_trip(&files, &Options::default());
    }

    #[test]
    fn any_documents_with_segments_that_differ_come_back(documents in collection::vec(uneven(), 1..8)) {
        let files: Vec<_> = documents
            .iter()
            .enumerate()
            .map(|(number, document)| (format!("clip-{number}"), lipz_file::write(document).into_bytes()))
            .collect();
        assert_round_trip(&files, &joining());
    }

    #[test]
    fn writing_and_reading_is_the_identity(document in document()) {
        let text = lipz_file::write(&document);
        let parsed = lipz_file::parse(text.as_bytes());
        prop_assert_eq!(parsed.document.unwrap(), document);
    }
}
