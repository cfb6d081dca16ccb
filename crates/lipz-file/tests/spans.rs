//! Spans mark exactly the right characters, in any context and with any escapes.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use lipz_file::{Document, Value};
use proptest::prelude::*;

/// Returns the source characters of a range of the decoded text of element `name`.
fn spelled<'s>(text: &'s str, document: &Document<'_>, name: &str, part: &str) -> &'s str {
    let Value::String(string) = &document.get(name).unwrap().value else { panic!("not a string") };
    let at = string.text.find(part).unwrap();
    &text[string.span_of(at..at + part.len()).range()]
}

#[test]
fn characters_behind_escapes_and_other_scripts() {
    let text = r#"{ "text_ja-jp" : "\u65e5本\ud83d\ude00\\\/ \"|x\"é", "\u0065vents": "q" }"#;
    let document = lipz_file::parse(text.as_bytes()).document.unwrap();
    let cases = [
        ("日", "\\u65e5"),
        ("本", "本"),
        ("😀", "\\ud83d\\ude00"),
        ("\\", "\\\\"),
        ("/", "\\/"),
        ("|x", "|x"),
        ("\"é", "\\\"é"),
        ("日本😀", "\\u65e5本\\ud83d\\ude00"),
    ];
    for (part, expected) in cases {
        assert_eq!(spelled(text, &document, "text_ja-jp", part), expected);
    }
    let events = document.get("events").unwrap();
    assert_eq!(&text[events.name.span().range()], r#""\u0065vents""#);
    assert_eq!(&text[events.value.span().range()], r#""q""#);
}

#[test]
fn spans_count_behind_the_byte_order_mark() {
    let bytes = b"\xEF\xBB\xBF{\"fps\": 24}";
    let document = lipz_file::parse(bytes).document.unwrap();
    let span = document.get("fps").unwrap().value.span();
    assert_eq!(&bytes[3..][span.range()], b"24");
}

/// Spells a character in one of the ways of JSON.
fn spell(character: char, way: u8) -> String {
    let mut units = [0; 2];
    match (way % 3, character) {
        (_, '"') => "\\\"".into(),
        (_, '\\') => "\\\\".into(),
        (0, c) if c >= ' ' => c.into(),
        (1, '/') => "\\/".into(),
        (_, '\n') => "\\n".into(),
        (_, c) => c.encode_utf16(&mut units).iter().map(|unit| format!("\\u{unit:04X}")).collect(),
    }
}

proptest! {
    #[test]
    fn every_character_is_found_where_it_stands(characters in proptest::collection::vec((any::<char>(), any::<u8>()), 0..40)) {
        let spellings: Vec<String> = characters.iter().map(|&(character, way)| spell(character, way)).collect();
        let text = format!("\n{{ \"events\": \"{}\" }}", spellings.concat());
        let document = lipz_file::parse(text.as_bytes()).document.unwrap();
        let Value::String(string) = &document.get("events").unwrap().value else { panic!("not a string") };
        let mut at = 0;
        for (&(character, _), spelling) in characters.iter().zip(&spellings) {
            prop_assert!(string.text[at..].starts_with(character));
            let span = string.span_of(at..at + character.len_utf8());
            prop_assert_eq!(&text[span.range()], spelling);
            at += character.len_utf8();
        }
        prop_assert_eq!(at, string.text.len());
    }

    #[test]
    fn any_bytes_give_diagnostics_and_no_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        let parsed = lipz_file::parse(&bytes);
        prop_assert!(parsed.document.is_some() || !parsed.diagnostics.is_empty());
    }

    #[test]
    fn damaged_files_give_diagnostics_inside_the_text(at in 0..200_usize, with in "[\\x00-\\x7F]{0,3}", delete in 0..4_usize) {
        let mut text = include_str!("../../../fixtures/drama/act1/mara-good-evening.lipz").to_owned();
        let start = text.char_indices().map(|(at, _)| at).nth(at).unwrap();
        let end = text[start..].char_indices().map(|(length, _)| start + length).nth(delete).unwrap();
        text.replace_range(start..end, &with);
        let parsed = lipz_file::parse(text.as_bytes());
        for diagnostic in &parsed.diagnostics {
            for label in diagnostic.primary.iter().chain(&diagnostic.labels) {
                prop_assert!(text.get(label.span.range()).is_some(), "{diagnostic:?}");
            }
        }
    }
}
