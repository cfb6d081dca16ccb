//! JSON → bank → JSON: every element comes back as it was; → bank again: the same bytes.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

mod support;

use lipz::{Code, Document, Element, Level, Raw, Value};
use lipz_bank::Bank;
use lipz_compiler::{Documents, Input, Options, compile};
use proptest::prelude::*;
use std::borrow::Cow;

/// Packs `files`, unpacks them in memory, compares, packs again, compares.
fn assert_round_trip(files: &[(String, Vec<u8>)], options: &Options) {
    let inputs: Vec<Input> = files.iter().map(|(key, bytes)| Input::from_bytes(key, bytes.clone())).collect();
    let compiled = compile(&inputs, options, &|_| {});
    let bytes = compiled.bank.unwrap_or_else(|| panic!("{:#?}", compiled.reports));
    let bank = Bank::open(&bytes).and_then(Bank::verify).unwrap();
    let documents = Documents::of(&bank).unwrap();
    assert!(documents.is_exact());
    let mut again = Vec::new();
    for document in documents.iter() {
        let (key, document) = document.unwrap();
        let original = &files.iter().find(|(known, _)| known == key).unwrap().1;
        let original = lipz::parse(original).document.unwrap();
        assert_eq!(document, original, "{key}");
        again.push(Input::from_bytes(key, lipz::write(&document)));
    }
    assert_eq!(again.len(), files.len());
    assert_eq!(compile(&again, options, &|_| {}).bank.unwrap(), bytes);
}

#[test]
fn every_good_fixture_comes_back() {
    for folder in ["drama", "spec/repaired"] {
        let files = support::files(folder);
        assert!(!files.is_empty(), "{folder}");
        assert_round_trip(&files, &Options::default());
        assert_round_trip(
            &files,
            &Options { default_locale: Some("de-de".into()), threads: Some(2), ..Options::default() },
        );
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
    let options = Options { strip: true, ..Options::default() };
    let bytes = compile(&[Input::from_bytes("a", file)], &options, &|_| {}).bank.unwrap();
    let bank = Bank::open(&bytes).and_then(Bank::verify).unwrap();
    let documents = Documents::of(&bank).unwrap();
    assert!(!documents.is_exact());
    let (_, document) = documents.iter().next().unwrap().unwrap();
    let expected = "{\n  \"fps\": 29.97,\n  \"viseme_type\": \"blair\",\n  \"visemes\": \"MA|O-\",\n  \"text_en-us\": \"Hi|you\"\n}\n";
    assert_eq!(lipz::write(&document), expected);
    let again = compile(&[Input::from_bytes("a", expected)], &options, &|_| {}).bank.unwrap();
    assert_eq!(again, bytes);
}

/// A text of any characters but delimiters, which the caller adds.
fn segment() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => "[ \\t]{0,3}[a-zA-Zéß日本ع😀{}\\\\\"'\u{a0}\u{200b}\n ]{0,12}[ ]{0,4}",
        1 => any::<String>().prop_map(|text| text.replace('|', "/")),
        1 => Just(String::new()),
    ]
}

fn joined(segments: &[String]) -> Value<'static> {
    Value::String(Cow::<str>::Owned(segments.join("|")).into())
}

fn element(name: impl Into<String>, value: Value<'static>) -> Element<'static> {
    Element { name: Cow::<str>::Owned(name.into()).into(), value }
}

/// Any document that has no errors.
fn document() -> impl Strategy<Value = Document<'static>> {
    (1..6_usize, 0..4_usize).prop_flat_map(|(segments, code_set)| {
        let codes = ["[-AMOSWEFLU]{0,20}", "[-ABCDEFG]{0,20}", "[-0-9]{0,20}", "[-AEF ]{0,20}"][code_set];
        let types = ["blair", "toonboom", "rms", "blair"];
        let visemes = proptest::collection::vec(codes, segments).prop_map(|parts| element("visemes", joined(&parts)));
        let viseme_type = Just(element("viseme_type", joined(&[types[code_set].into()])));
        let fps = "(24|30\\.00|2\\.5e1|23\\.976|999\\.999|1|1e3|12\\.3456789012345678)"
            .prop_map(|number| element("fps", Value::Number(Raw::new(number))));
        let events = proptest::collection::vec(segment(), segments).prop_map(|parts| element("events", joined(&parts)));
        let names = "text_(en-us|de-de|ja-jp|ar-eg|pt-br)|text-fr_ca|text_ES-MX";
        let texts = proptest::collection::btree_map(names, proptest::collection::vec(segment(), segments), 0..4)
            .prop_map(|texts| texts.into_iter().map(|(name, parts)| element(name, joined(&parts))).collect::<Vec<_>>());
        let unknown =
            ("[xyz]{1,3}\\PC{0,3}", "(null|true|\\[1, 2\\]|\\{\"a\": \"\\|\"\\}|-0\\.50)").prop_map(|(name, json)| {
                let is_number = json.starts_with('-');
                element(name, if is_number { Value::Number(Raw::new(json)) } else { Value::Other(Raw::new(json)) })
            });
        let optional = (
            proptest::option::of(visemes),
            proptest::option::of(viseme_type),
            proptest::option::of(fps),
            proptest::option::of(events),
            texts,
            proptest::option::of(unknown),
        );
        optional
            .prop_map(|(visemes, viseme_type, fps, events, texts, unknown)| {
                let named = [visemes, viseme_type, fps, events, unknown].into_iter().flatten();
                named.chain(texts).collect::<Vec<_>>()
            })
            .prop_shuffle()
            .prop_map(|elements| Document { elements })
    })
}

/// Options under which elements may differ in segments.
fn joining() -> Options {
    Options { levels: [(Code::SegmentCount, Some(Level::Warning))].into(), ..Options::default() }
}

/// The texts and events of one document with the other elements of another: segments that differ.
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

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn any_documents_come_back(documents in proptest::collection::vec(document(), 1..8)) {
        let files: Vec<_> = documents
            .iter()
            .enumerate()
            .map(|(number, document)| (format!("clip-{number}"), lipz::write(document).into_bytes()))
            .collect();
        assert_round_trip(&files, &Options::default());
    }

    #[test]
    fn any_documents_with_segments_that_differ_come_back(documents in proptest::collection::vec(uneven(), 1..8)) {
        let files: Vec<_> = documents
            .iter()
            .enumerate()
            .map(|(number, document)| (format!("clip-{number}"), lipz::write(document).into_bytes()))
            .collect();
        assert_round_trip(&files, &joining());
    }

    #[test]
    fn writing_and_reading_is_the_identity(document in document()) {
        let text = lipz::write(&document);
        let parsed = lipz::parse(text.as_bytes());
        prop_assert_eq!(parsed.document.unwrap(), document);
    }
}
