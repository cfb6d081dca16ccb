//! Lines of stories of Ink, compared with the output of Ink's runtime.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_interop::Script;
use std::path::Path;

fn lines(script: &Script) -> Vec<(&str, &str)> {
    script.lines().iter().map(|line| (line.path, line.text)).collect()
}

fn tavern() -> Vec<u8> {
    std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/scripts/tavern.ink.json")).unwrap()
}

/// The expected texts are those that the runtime of inkjs 2.4.0 prints. Those that vary between runs are empty.
#[test]
fn a_story_has_the_lines_of_its_runtime() {
    let (script, source, found) = Script::read_lines("tavern.ink.json", &tavern(), None);
    assert_eq!(found, []);
    let expected = [
        ("mara_hello", "Hello, Otto."),
        ("mara_name", ""),
        ("mara_met", ""),
        ("mara_friend", "Old friend."),
        ("mara_stranger", "A stranger."),
        ("mara_back", "Welcome back."),
        ("mara_sit", "Sit down."),
        ("mara_who", "Who goes there?"),
        ("mara_only", "Only sometimes."),
        ("mara_count", ""),
        ("mara_first", "First visit."),
        ("mara_second", "Again you."),
        ("mara_mixed", ""),
        ("mara_a", "A."),
        ("mara_b", "B."),
        ("mara_c", "C."),
        ("mara_warm", "Come in. It is warm."),
        ("mara_cold", "It is cold."),
        ("mara_ask", "What is this place?"),
        ("otto_tavern", "A tavern."),
        ("mara_leave", "Leave now."),
        ("otto_bye", "Bye."),
        ("mara_again", "Say \"hello\""),
        // The runtime continues the line with the text behind the divert.
        ("mara_go", ""),
        ("mara_dear", ""),
        ("mara_part", ""),
        ("mara_rest", ""),
        ("mara_still", "Still here."),
        ("mara_together", "Together."),
        ("mara_well", "Well."),
        ("mara_above", "The door is closed."),
        ("mara_red", "Red."),
        ("mara_blue", "Blue."),
        ("mara_cats", ""),
        ("mara_done", "Done."),
        ("mara_quote", "Mara: \"Quote \\ é\"."),
        ("mara_dark", "It is dark."),
        ("mara_air", "Fresh air."),
        ("mara_rain", "It rains."),
    ];
    let mut sorted = expected;
    sorted.sort_unstable();
    let mut actual = lines(&script);
    actual.sort_unstable();
    assert_eq!(actual, sorted);
    for line in script.lines() {
        assert!(source.text[..line.span.start as usize].ends_with("^id: "), "{} is in a tag", line.path);
        assert_eq!(&source.text[line.span.range()], line.path);
    }
    let (of_recordings, _, _) = Script::read("tavern.ink.json", &tavern(), None);
    assert_eq!((of_recordings.text_of("mara_cold"), of_recordings.text_of("mara_name")), (Some("It is cold."), None));
}

#[test]
fn stories_without_alternatives() {
    let read = |root: &str| {
        let story = format!("{{\"inkVersion\":20,\"root\":{root},\"listDefs\":{{}}}}");
        Script::read_lines("a.json", story.as_bytes(), None)
    };
    // Until version 20, tags are objects.
    let (script, _, _) = read(r##"[["^Hello.",{"#":"id: Mara_Hello"},"\n","end",null],"done",null]"##);
    assert_eq!(lines(&script), [("Mara_Hello", "Hello.")]);
    let (script, source, _) = read(r##"["^A.",{"#":"id: id"},"\n",null]"##);
    assert!(source.text[..script.lines()[0].span.start as usize].ends_with("id: "), "the end of the tag");
    // An ID that is computed, and one without a name.
    let computed =
        r##"[["^A.","#","^id: ","ev",{"VAR?":"x"},"out","/ev","/#","\n","^B.","#","^id: ","/#","\n",null],null]"##;
    let (_, _, found) = read(computed);
    assert_eq!(found.len(), 1, "{found:?}");
    // Gathers are inside each other.
    let gather = |inside: String| format!(r##"["^Hi.","#","^id: a","/#","\n",{inside}]"##);
    let deep = (0..500).fold("null".to_owned(), |inside, _| gather(inside + ",null"));
    let (script, _, found) = read(&format!("[{deep},null]"));
    assert_eq!((found, lines(&script)), (Vec::new(), vec![("a", "Hi.")]));
}

#[test]
fn damaged_stories_are_read_in_bounded_time() {
    let story = |root: String| format!("{{\"inkVersion\":21,\"root\":{root}}}");
    let nested = |open: &str, close: &str, count: usize| {
        story(format!("[{}\"^a\"{},null]", open.repeat(count), close.repeat(count)))
    };
    let itself = r#"["str",{"->":".^.s"},"/str",{"s":["^a",{"->":".^.^.s"},{"->":".^.^.s"},{"->":"s"},null]}]"#;
    // Each alternative doubles the number of texts.
    let one = r#"["ev",true,"/ev",{"->":".^.b","c":true},{"b":["^b",{"->":".^.^.^.1"},null]}],"nop","#;
    let two = r#"[["ev",true,"/ev",{"->":".^.b","c":true},{"b":["^b",null]}],null],"nop","#;
    for text in [
        nested("[", ",null]", 5000),
        nested("[", ",0,null]", 5000),
        nested("[0,{\"a\":", "}]", 5000),
        story(itself.to_owned()),
        story(format!("[{}\"#\",\"^id: a\",\"/#\",\"\\n\",null]", one.repeat(1000))),
        story(format!("[{}\"#\",\"^id: a\",\"/#\",\"\\n\",null]", two.repeat(1000))),
    ] {
        let (_, _, found) = Script::read_lines("a.json", text.as_bytes(), None);
        assert!(found.len() <= 1, "{found:?}");
    }
    let (_, _, found) = Script::read_lines("a.json", nested("[", ",0,null]", 200).as_bytes(), None);
    assert_eq!(found[0].message, "the containers of the story are nested too deeply");
    let whole = String::from_utf8(tavern()).unwrap();
    for end in whole.char_indices().map(|(at, _)| at).step_by(97) {
        assert_ne!(Script::read_lines("a.json", &whole.as_bytes()[..end], None).2, []);
    }
}
