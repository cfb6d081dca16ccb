//! A new lip-sync track for an existing clip: preserved elements, and the positions of segments.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_file::{Document, rate};
use lipz_interop::{ImportOptions, MergeOptions, MergedClip, Mouth, Time, TimedText, formats, import, merge};
use lipz_types::VisemeType;
use proptest::prelude::*;

fn document(file: &str) -> Document<'_> {
    lipz_file::parse(file.as_bytes()).document.unwrap()
}

fn mouth(fps: &str, codes: &str) -> Mouth {
    Mouth::new(codes, rate::parse(fps).unwrap(), VisemeType::Blair)
}

/// Returns the visemes of a clip with a new lip-sync track, and the number of diagnostics.
fn visemes(file: &str, mouth: &Mouth) -> (String, usize) {
    let MergedClip { document, diagnostics, .. } = merge(&document(file), mouth, &MergeOptions::new());
    (document.string("visemes").unwrap().to_owned(), diagnostics.len())
}

#[test]
fn everything_but_the_mouth_stays() {
    let file = r#"{ "mood": [1], "text_de-de": "Ja.|Nein.", "visemes": "MA|EO", "events": "|nods",
                    "text_en-us": "Yes.|{sad} No.", "fps": 4.0, "other": "x", "viseme_type": "toonboom" }"#;
    let before = document(file);
    let merged = merge(&before, &mouth("4", "MAA--EEO"), &MergeOptions::new().min_pause(Time::new(1, 2)));
    let names = |document: &Document<'_>| {
        document.elements.iter().map(|element| element.name.text.to_string()).collect::<Vec<_>>()
    };
    assert_eq!(names(&merged.document), names(&before));
    for element in &before.elements {
        let name = element.name.text.as_ref();
        let is_same = merged.document.get(name) == Some(element);
        assert_eq!(is_same, !matches!(name, "visemes" | "viseme_type"), "{name}");
    }
    assert_eq!(merged.document.string("visemes"), Some("MAA--|EEO"));
    assert_eq!(merged.document.string("viseme_type"), Some("blair"));
    assert_eq!(merged.diagnostics, []);
}

#[test]
fn a_clip_of_the_projects_rate_and_type_needs_none_of_its_own() {
    let rate = rate::parse("4");
    let options = MergeOptions::new().default_rate(rate).default_viseme_type(VisemeType::Blair);
    let names = |file: &str, fps: &str| {
        let document = merge(&document(file), &mouth(fps, "MA"), &options).document;
        document.elements.iter().map(|element| element.name.text.to_string()).collect::<Vec<_>>().join(" ")
    };
    assert_eq!(names(r#"{ "text_en-us": "Ah.", "note": 1 }"#, "4"), "visemes text_en-us note");
    assert_eq!(names(r#"{ "text_en-us": "Ah.", "note": 1 }"#, "5"), "visemes text_en-us fps note");
    assert_eq!(names(r#"{ "visemes": "-", "fps": 30 }"#, "4"), "visemes fps");
}

#[test]
fn segments_go_where_something_tells() {
    let two = r#"{ "fps": 4, "visemes": "MAEO|MAEO", "text_en-us": "Hello there.|You?" }"#;
    // Without frames, nothing is a guess.
    let empty = r#"{ "fps": 4, "visemes": "||", "text_en-us": "A.|B.|C." }"#;
    assert_eq!(visemes(empty, &mouth("4", "")), ("||".into(), 0));
    assert_eq!(visemes(two, &mouth("4", "")), ("|".into(), 0));
    // The same recording, analysed again: positions that were chosen by hand stay.
    assert_eq!(visemes(two, &mouth("4", "MAEOMAEO")), ("MAEO|MAEO".into(), 0));
    assert_eq!(visemes(two, &mouth("4", "MMEOMMEE")), ("MMEO|MMEE".into(), 0));
    assert_eq!(visemes(two, &mouth("8", "MMAAEEOOMMAAEEOO")), ("MMAAEEOO|MMAAEEOO".into(), 0));
    // A longer recording: the segment starts at the nearest pause in its speech.
    assert_eq!(visemes(two, &mouth("4", "-MAAEO--MAEEO-")), ("-MAAEO--|MAEEO-".into(), 0));
    // A different tempo, but as many pauses as segments that began after one.
    let after_pause = r#"{ "fps": 4, "visemes": "MAE---|MAEOMAEO", "text_en-us": "Hello there.|You?" }"#;
    assert_eq!(visemes(after_pause, &mouth("4", "MAEOEOMAEEE--MAO-")), ("MAEOEOMAEEE--|MAO-".into(), 0));
    assert_eq!(visemes(after_pause, &mouth("4", "MAEOEOMAEOEOMAEO--MA--MAO-")).1, 1, "two pauses for one");
    // There is no pause nearby, which is reported.
    assert_eq!(visemes(two, &mouth("4", "MAAEOMAEEOOOOO")), ("MAAEOMA|EEOOOOO".into(), 1));
    // The tool's file has better information.
    let words = |text: &str| text.split(' ').zip(0..).map(|(word, at)| timed(word, at)).collect::<Vec<_>>();
    let spoken = mouth("4", "MAAEOMAEEOOOOO").words(words("hello there YOU"));
    assert_eq!(visemes(two, &spoken), ("MAAEOMAE|EOOOOO".into(), 0));
    let more = mouth("4", "MAAEOMAEEOOOOO").words(words("uh Hello, you there you"));
    assert_eq!(visemes(two, &more), ("MAAEOMAEEOOOOO|".into(), 0), "an extra word, and a misrecognised one");
    let phrases = mouth("4", "MAAEOMAEEOOOOO").phrases(vec![timed("", 0), timed("", 1)]);
    assert_eq!(visemes(two, &phrases), ("MAAE|OMAEEOOOOO".into(), 0));
    let known = phrases.segment_starts(vec![Time::new(1, 2)]);
    assert_eq!(visemes(two, &known), ("MA|AEOMAEEOOOOO".into(), 0));
}

fn timed(text: &str, second: u64) -> TimedText {
    TimedText { start: Time::new(second, 1), text: text.to_owned() }
}

#[test]
fn segments_without_speech_and_clips_without_a_mouth() {
    let pause = r#"{ "fps": 4, "visemes": "--|MA|----|EO", "events": "a|b|c|d" }"#;
    assert_eq!(visemes(pause, &mouth("4", "---MAE-----EOE-")), ("---|MAE|-----|EOE-".into(), 0));
    let subtitles = r#"{ "fps": 4, "visemes": "----|----", "text_en-us": "|Hello." }"#;
    assert_eq!(visemes(subtitles, &mouth("8", "---------MAAEO--")), ("--------|-MAAEO--".into(), 0));
    let text = r#"{ "text_en-us": "One.|Two." }"#;
    assert_eq!(visemes(text, &mouth("4", "MAE---EOE")), ("MAE---|EOE".into(), 0));
    assert_eq!(visemes(text, &mouth("4", "MAEEOE")), ("MAE|EOE".into(), 1));
    assert_eq!(visemes(r#"{ "visemes": "M|", "events": "x|" }"#, &mouth("4", "")), ("|".into(), 0));
    assert_eq!(visemes("{}", &mouth("4", "MA")), ("MA".into(), 0));
}

#[test]
fn elements_that_did_not_agree_are_named() {
    let file = r#"{ "text_en-us": "a|b", "text_de-de": "c", "events": "d|e|f" }"#; // and a guess
    let merged = merge(&document(file), &mouth("4", "MAEO"), &MergeOptions::new());
    let messages: Vec<&str> = merged.diagnostics.iter().map(|diagnostic| diagnostic.message.as_str()).collect();
    assert_eq!(messages.len(), 3, "{messages:?}");
    assert_eq!(messages[0], "`text_de-de` has 1 segment, but the new visemes have 2");
}

#[test]
fn what_only_the_import_has_is_added() {
    let format = formats::find("rhubarb-tsv").unwrap();
    let tsv = b"0.00\tX\n0.25\tD\n0.50\tX\n1.00\tC\n1.25\tX\n1.50\tX\n";
    let of_import = |text: &'static str, locale: &'static str| {
        let options = ImportOptions::new().text(text).locale(locale);
        import(format, tsv, &options).clips.remove(0)
    };
    let clip = r#"{ "text_en-us": "Yes?|No!" }"#;
    let merged = |text, locale| of_import(text, locale).merge(&document(clip), &MergeOptions::new());
    let german = merged("Ja?|Nein!", "de-de");
    assert_eq!((german.document.string("text_de-de"), german.diagnostics.len()), (Some("Ja?|Nein!"), 0));
    let undivided = merged("Ja? Nein!", "de-de");
    assert_eq!((undivided.document.string("text_de-de"), undivided.diagnostics.len()), (Some("Ja?|Nein!"), 1));
    let same = merged("Yes? No!", "en-us");
    assert_eq!((same.document.string("text_en-us"), same.diagnostics.len()), (Some("Yes?|No!"), 0));
    let other = merged("Yes? Oh no!", "en-us");
    assert_eq!((other.document.string("text_en-us"), other.diagnostics.len()), (Some("Yes?|No!"), 1));
    assert_eq!(other.diagnostics[0].code.to_string(), "LZ1114");
    let english = MergeOptions::new().default_locale("en-us");
    let plain = of_import("Yes? No!", "en-us").merge(&document(r#"{ "text": "Yes?|No!" }"#), &english);
    let names: Vec<&str> = plain.document.elements.iter().map(|element| element.name.text.as_ref()).collect();
    assert!(names.contains(&"text") && !names.contains(&"text_en-us"), "the text is in the default locale: {names:?}");
    let own = of_import("Yes?|No!", "en-us").merge(&document(r#"{ "fps": 24, "note": 1 }"#), &MergeOptions::new());
    assert_eq!(own.document.string("text_en-us"), Some("Yes?|No!"));
    assert_eq!(own.document.string("visemes").unwrap().matches('|').count(), 1);
}

proptest! {
    #[test]
    fn segments_stay_as_many_and_codes_are_those_of_the_mouth(
        old in prop::option::of("[-AME|]{0,30}"), text in "[ab .|]{0,20}", new in "[-AMEO]{0,40}",
        old_fps in prop::sample::select(vec!["4", "24", "29.97"]),
    ) {
        let old = old.map(|old| format!("\"visemes\": \"{old}\", ")).unwrap_or_default();
        let file = format!("{{ {old}\"fps\": {old_fps}, \"text_en-us\": \"{text}\" }}");
        let (visemes, _) = visemes(&file, &mouth("24", &new));
        prop_assert_eq!(visemes.matches('|').count(), text.matches('|').count());
        prop_assert_eq!(visemes.replace('|', ""), new);
    }

    #[test]
    fn the_same_mouth_changes_nothing(visemes in "[-AMEO|]{1,40}") {
        let text = visemes.replace(|c| c != '|', "x");
        let file = format!("{{ \"visemes\": \"{visemes}\", \"text_en-us\": \"{text}\", \"fps\": 24, \"viseme_type\": \"blair\" }}");
        let merged = merge(&document(&file), &mouth("24", &visemes), &MergeOptions::new());
        prop_assert_eq!(merged.document, document(&file));
        prop_assert_eq!(merged.diagnostics.len(), 0);
    }
}
