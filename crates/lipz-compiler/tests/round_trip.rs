//! JSON → bank → JSON: every element comes back as it was; → bank again: the same bytes.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

#[path = "support/documents.rs"]
mod documents;
mod support;

use documents::document;
use lipz::{Code, Document, Element, Level};
use lipz_bank::Bank;
use lipz_compiler::{Documents, Input, Options, compile};
use proptest::prelude::*;

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
