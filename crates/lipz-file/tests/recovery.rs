//! Files with several errors: each is reported once, and the readable part is returned.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

use lipz_diagnostics::{Diagnostic, Fix};
use lipz_file::{Fragment, ParsedFile, parse};

/// Returns line, message and marked characters of each diagnostic.
fn told(text: &str) -> Vec<(usize, String, &str)> {
    let one = |found: &Diagnostic| {
        let span = found.primary.as_ref().unwrap().span.range();
        (1 + text[..span.start].matches('\n').count(), found.message.clone(), &text[span])
    };
    parse(text.as_bytes()).diagnostics.iter().map(one).collect()
}

fn messages(text: &str) -> Vec<String> {
    told(text).into_iter().map(|(_, message, _)| message).collect()
}

fn fragment(text: &str) -> Fragment<'_> {
    let ParsedFile { document, fragment, .. } = parse(text.as_bytes());
    assert!(document.is_none());
    fragment.unwrap()
}

/// Returns the names of the readable elements.
fn names(text: &str) -> Vec<String> {
    fragment(text).document.elements.iter().map(|element| element.name.text.to_string()).collect()
}

const MANY: &str = r#"{
  "visemes": "MAZ-",
  "viseme_type": 'blair'
  // taken twice
  fps: 3,0,
  "text_en-us": "C:\voices",
  "text_de-de" = "Hallo",
  "events": [1, "2", ],,
  "x": True,
  "y": { "z": 024, },
}
"#;

#[test]
fn each_mistake_is_told_once() {
    let expected = [
        (3, "a name or string does not start with a straight double quote", "'"),
        (3, "a comma is missing between two elements", ""),
        (4, "JSON has no comments", "// taken twice"),
        (5, "`fps` has no double quotes", "fps"),
        (5, "`3,0` has a decimal comma", ","),
        (6, "`\\v` is not a JSON escape", "\\v"),
        (7, "`=` is used instead of a colon", "="),
        (8, "a comma follows the last element", ","),
        (8, "one comma too many", ","),
        (9, "`True` is not a JSON value", "True"),
        (10, "`024` is not a JSON number", "024"),
        (10, "a comma follows the last element", ","),
        (10, "a comma follows the last element", ","),
    ];
    let expected = expected.map(|(line, message, marked)| (line, message.to_owned(), marked));
    assert_eq!(told(MANY), expected);
    assert_eq!(names(MANY), ["visemes", "viseme_type", "text_de-de"]);
    assert_eq!(fragment(MANY).document.string("viseme_type"), Some("blair"));
    assert!(!fragment(MANY).is_complete, "fps is not known");
}

#[test]
fn mistakes_between_elements_leave_all_of_them() {
    let text = "// a clip\n{ 'fps': 24,,\n \"visemes\": \"MA\"\n \"x\" = [1, {\"a\": 2}], /* two */\n}\n# end\n";
    let found = fragment(text);
    assert!(found.is_complete);
    assert_eq!(names(text), ["fps", "visemes", "x"]);
    let fps = &found.document.elements[0];
    assert_eq!((&text[fps.name.span().range()], &text[fps.value.span().range()]), ("fps", "24"));
    assert_eq!(messages(text).len(), 8, "{:?}", messages(text));
}

#[test]
fn fixes_of_one_file_go_together() {
    let mut text =
        "{ \"fps\": 23,976\n  \"visemes\" = \"MA\"\n  \"x\": [1,],,\n\u{a0}\u{a0}\"events\": \"\",,\n}}\n".to_owned();
    for _ in 0..2 {
        let parsed = parse(text.as_bytes());
        let fixes: Vec<&Fix> = parsed.diagnostics.iter().filter_map(|found| found.fix.as_ref()).collect();
        text = Fix::apply_all(&text, &fixes).text;
    }
    assert_eq!(text, "{ \"fps\": 23.976,\n  \"visemes\" : \"MA\",\n  \"x\": [1],\n  \"events\": \"\"\n}\n");
    assert!(parse(text.as_bytes()).diagnostics.is_empty());
}

#[test]
fn nothing_follows_from_a_mistake() {
    let cases = [
        (r#"{ "a": "the "Admiral": a parrot", "b": 1 }"#, "the text ends at this quotation mark, and a name follows"),
        ("{\n\"a\": \"He said \"no\" and left\",\n\"b\": 1\n}", "the text ends at this quotation mark"),
        ("{\n\"a\": \"open,\n\"b\": 1\n}", "a string contains a line break"),
        ("{\n\"a\": \"one\n\n\ntwo\",\n\"b\": 1\n}", "a string contains a line break"),
        ("{\n\"a\": \"open\n}", "a string contains a line break"),
        ("{\n\"a\": \"cut\n off", "a string contains a line break"),
        ("{\n\"a\": Hello there, friend\n}", "`Hello` has no double quotes"),
        ("{\n\"a\": Hello there, friend,\n\"b\": 1\n}", "`Hello` has no double quotes"),
        ("{\n\"x\": [1, 2},\n\"b\": 1\n}", "a comma or a closing brace is missing here"),
        ("{\n\"a\": 1,\n{ \"b\": 1 }\n}", "an element starts with its name in double quotes"),
        ("{ \"a\": 1, /* open", "JSON has no comments"),
        ("{ \"a\": , \"b\": 1 }", "a value is missing here"),
        ("{ \"a\", \"b\": 1 }", "a colon is missing between name and value"),
        ("{ \"a\": 1 }, \"b\": 1 }", "the object is closed too early"),
        ("{ \"a\": 1 } }", "one closing brace too many"),
        ("{ \"a\": 1; \"b\": 1 }", "a comma or a closing brace is missing here"),
        ("{ \"a\": 24000/1001, \"b\": 1 }", "`24000/1001` is a fraction, which JSON does not have"),
        ("{ \"a\": 24 fps, \"b\": 1 }", "a number is followed by a word"),
        ("{ \"a\": −24, \"b\": 1 }", "`−` (U+2212) is not a minus sign in JSON"),
        ("{ \"a\": “one\", \"b\": 1 }", "a name or string does not start with a straight double quote"),
        ("{ \"a\": 'don't go', \"b\": 1 }", "a name or string does not start with a straight double quote"),
        ("{ \"a\": tru, \"b\": 1 }", "`tru` has no double quotes"),
        ("{ \"a\": -, \"b\": 1 }", "`-` is not a JSON number"),
        ("{ \"a\": 1.e5, \"b\": 1 }", "`1.e5` is not a JSON number"),
        ("{ \"a\": \"\\u12\", \"b\": 1 }", "`\\u12` is not a JSON escape"),
        ("{ \"a\": \"a\t\t\tb\", \"b\": 1 }", "a string contains a tab"),
        ("{ \"a\": [1", "the file ends before its object is closed"),
        ("{ \"a\": tru", "the file ends before its object is closed"),
        ("{ \"a\": 2.", "the file ends before its object is closed"),
    ];
    for (text, expected) in cases {
        assert_eq!(messages(text), [expected], "{text}");
        // A bracket that closes something else, or an object without a name, may belong to any element.
        let reads_on = text.contains("\"b\"") && !text.contains("2}") && !text.contains("{ \"b\"");
        assert_eq!(names(text).contains(&"b".to_owned()), reads_on, "{text}: {:?}", names(text));
    }
}

#[test]
fn a_file_cut_off_is_told_beside_other_mistakes() {
    let found = messages("{\n  'fps': 24,\n  \"visemes\": \"MA\",");
    assert_eq!(
        found,
        ["a name or string does not start with a straight double quote", "the file ends before its object is closed"]
    );
}

#[test]
fn elements_that_appear_twice_are_read_once() {
    let text = r#"{ "fps": 24, "x": 1, "fps": 25, "y": "\ud83d", "fps": 30 }"#;
    assert_eq!(names(text), ["fps", "x"]);
    assert_eq!(messages(text).len(), 3);
    assert_eq!(text[fragment(text).document.elements[0].value.span().range()], *"24");
}

#[test]
fn something_else_than_json_does_not_flood() {
    let program = "{\n  for (let i = 0; i < 10; i++) { console.log(`${i}: hi`); }\n".repeat(1_000);
    assert!(messages(&program).len() < 50, "{:?}", messages(&program));
}
