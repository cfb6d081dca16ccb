//! Generated documents for property tests.

use lipz_file::{Document, Element, RawJson, Value};
use proptest::prelude::*;
use std::borrow::Cow;

/// A text of any characters except delimiters, which the caller adds.
fn segment() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => "[ \\t]{0,3}[a-zA-Zéß日本علا😀e\u{301}\u{202e}👩\u{200d}{}\\\\\"'\u{a0}\u{200b}\n ]{0,12}[ ]{0,4}",
        1 => any::<String>().prop_map(|text| text.replace('|', "/")),
        1 => Just(String::new()),
    ]
}

/// Blends of emotions and gestures, in a text and in events.
const MARKED: [&str; 5] =
    ["{anger 2.2} Yes, {joy 3, fear 1} sure!", "No{calm}.", "{sad} Perhaps?", "Never *ever*.", "はい"];
const FELT: [&str; 5] = [
    "feels anger 2.2 + joy 3 over 0.4s",
    "mara feels fear 4, feels neutral",
    "nods 4, mara looks away",
    "feels sad",
    "blinks",
];

fn joined(segments: &[String]) -> Value<'static> {
    Value::String(Cow::<str>::Owned(segments.join("|")).into())
}

fn element(name: impl Into<String>, value: Value<'static>) -> Element<'static> {
    Element { name: Cow::<str>::Owned(name.into()).into(), value }
}

/// Returns any document without errors.
pub fn document() -> impl Strategy<Value = Document<'static>> {
    (1..6_usize, 0..4_usize).prop_flat_map(|(segments, code_set)| {
        let codes = ["[-AMOSWEFLU]{0,20}", "[-ABCDEFG]{0,20}", "[-0-9]{0,20}", "[-AEF ]{0,20}"][code_set];
        let types = ["blair", "toonboom", "rms", "blair"];
        let visemes = proptest::collection::vec(codes, segments).prop_map(|parts| element("visemes", joined(&parts)));
        let viseme_type = Just(element("viseme_type", joined(&[types[code_set].into()])));
        let fps = "(24|30\\.00|2\\.5e1|23\\.976|999\\.999|1|1e3|12\\.3456789012345678)"
            .prop_map(|number| element("fps", Value::Number(RawJson::new(number))));
        let event = prop_oneof![3 => segment(), 1 => proptest::sample::select(&FELT[..]).prop_map(str::to_owned)];
        let events = proptest::collection::vec(event, segments).prop_map(|parts| element("events", joined(&parts)));
        let names = "text_(en-us|de-de|ja-jp|ar-eg|pt-br)|text-fr_ca|text_ES-MX|text_(de-de|en-us)-x-(few|few-fem|fem)";
        let text = prop_oneof![3 => segment(), 1 => proptest::sample::select(&MARKED[..]).prop_map(str::to_owned)];
        let texts = proptest::collection::btree_map(names, proptest::collection::vec(text, segments), 0..4)
            .prop_map(|texts| texts.into_iter().map(|(name, parts)| element(name, joined(&parts))).collect::<Vec<_>>());
        let unknown =
            ("[xyz]{1,3}\\PC{0,3}", "(null|true|\\[1, 2\\]|\\{\"a\": \"\\|\"\\}|-0\\.50)").prop_map(|(name, json)| {
                let is_number = json.starts_with('-');
                element(
                    name,
                    if is_number { Value::Number(RawJson::new(json)) } else { Value::Other(RawJson::new(json)) },
                )
            });
        let curves = "\\{ \"(anger|nod|k)\": \"0:-?[0-9]\\.5\" \\}"
            .prop_map(|json| element("curves", Value::Other(RawJson::new(json))));
        let optional = (
            proptest::option::of(visemes),
            proptest::option::of(viseme_type),
            proptest::option::of(fps),
            proptest::option::of(events),
            texts,
            proptest::option::of(curves),
            proptest::option::of(unknown),
        );
        optional
            .prop_map(|(visemes, viseme_type, fps, events, texts, curves, unknown)| {
                let named = [visemes, viseme_type, fps, events, curves, unknown].into_iter().flatten();
                named.chain(texts).collect::<Vec<_>>()
            })
            .prop_shuffle()
            .prop_map(|elements| Document { elements })
    })
}
