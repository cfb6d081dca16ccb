//! Tests of what counts as a difference.

use super::*;
use crate::bank::SplitBank;
use crate::project::Options;
use crate::project::settings::Settings;
use crate::run::Compiler;
use crate::sources::Input;
use lipz_bank::Dialogue;
use lipz_bank::babble::Babble;
use lipz_testkit::dialogues::{places, with};

/// Returns a bank of these files, by key and text.
pub(super) fn bank(files: &[(&str, &str)]) -> Vec<u8> {
    let inputs: Vec<_> = files.iter().map(|(key, text)| Input::from_bytes(*key, *text)).collect();
    let options = Options::new().default_locale("en-us").unwrap();
    Compiler::new(options.clone()).compile(&inputs).bank.unwrap()
}

fn compare<R>(old: &[(&str, &str)], new: &[(&str, &str)], look: impl FnOnce(&Difference<'_>) -> R) -> R {
    let (old, new) = (bank(old), bank(new));
    with(&[&old], |old| with(&[&new], |new| look(&diff(old, new))))
}

const AYE: &str = r#"{ "fps": 24, "viseme_type": "blair", "visemes": "AAA|MM-", "text_en-us": "Aye.|{to Mara} Aye!",
    "text_de-de": "Ja.|Ja!", "events": "|points door" }"#;

#[test]
fn the_same_clips_are_no_difference() {
    // A program does not see meta, blanks and the order of the elements.
    let other = r#"{ "events": "   |points door", "text_de-de": "Ja. |Ja!", "text_en-us": "Aye.|Aye!",
        "visemes": "AAA|MM-", "viseme_type": "blair", "fps": 24.0 }"#;
    compare(&[("a", AYE), ("b", AYE)], &[("a", other), ("b", AYE)], |difference| {
        assert!(difference.is_empty(), "{difference:?}");
        assert_eq!(difference.same, 2);
    });
}

#[test]
fn every_part_of_a_clip_is_compared() {
    let other = r#"{ "fps": 30, "viseme_type": "toonboom", "visemes": "AA|AAA-B", "text_en-us": "Aye.|No!",
        "text_ja-jp": "はい|いいえ", "events": "|points window" }"#;
    compare(&[("a", AYE)], &[("a", other)], |difference| {
        assert_eq!((&difference.added_locales[..], &difference.removed_locales[..]), (&["ja-jp"][..], &["de-de"][..]));
        let change = &difference.changed[0];
        assert_eq!(change.fps.map(|fps| fps.new.unwrap().numerator()), Some(30));
        assert_eq!(change.viseme_type.map(|kind| kind.new.unwrap().name()), Some("toonboom"));
        let counts = Change { old: Some(6), new: Some(7) };
        // AAAMM- against AAAAA-B: frames 3 and 4 differ, frame 6 is new.
        assert_eq!(change.frames, Some(FramesChange { counts, differing: 3, first: Some(3) }));
        assert_eq!(change.segment_starts, Some(Change { old: vec![0, 3], new: vec![0, 2] }));
        let texts = change.texts.iter().map(|text| (text.locale, text.segment, text.text.old, text.text.new));
        let texts: Vec<_> = texts.collect();
        let expected = [
            ("de-de", 0, Some("Ja."), None),
            ("de-de", 1, Some("Ja!"), None),
            ("en-us", 1, Some("Aye!"), Some("No!")),
            ("ja-jp", 0, None, Some("はい")),
            ("ja-jp", 1, None, Some("いいえ")),
        ];
        assert_eq!(texts, expected);
        let event = Change { old: Some("points door"), new: Some("points window") };
        assert_eq!(change.events, [EventChange { segment: 1, event }]);
    });
}

#[test]
fn absent_and_empty_are_not_the_same() {
    compare(&[("a", r#"{ "visemes": "" }"#)], &[("a", r#"{ "events": "" }"#)], |difference| {
        let change = &difference.changed[0];
        assert_eq!(change.frames.unwrap().counts, Change { old: Some(0), new: None });
        assert_eq!(change.events[0].event, Change { old: None, new: Some("") });
    });
}

#[test]
fn another_fallback_is_a_difference_of_its_own() {
    // The clip falls back to en-us in both banks. Only the default locale differs.
    let clips = [("a", r#"{ "text_en-us": "Aye.", "text_de-de": "Ja." }"#), ("b", r#"{ "text_ja-jp": "はい" }"#)];
    let pack = |default: &str| {
        let inputs = clips.map(|(key, text)| Input::from_bytes(key, text));
        let options = Options::new().default_locale(default).unwrap();
        Compiler::new(options.clone()).compile(&inputs).bank.unwrap()
    };
    let (old, new) = (pack("en-us"), pack("de-de"));
    let (mut old_files, mut new_files) = (places(1), places(1));
    let old = Dialogue::open(&mut old_files, [old.as_slice()]).unwrap();
    let new = Dialogue::open(&mut new_files, [new.as_slice()]).unwrap();
    let difference = diff(&old, &new);
    assert_eq!(difference.default_locale, Some(Change { old: Some("en-us"), new: Some("de-de") }));
    let text = &difference.changed[0].texts[0];
    assert_eq!((text.locale, text.text), ("ja-jp", Change { old: Some("Aye."), new: Some("Ja.") }));
    assert!(text.is_fallback);
}

#[test]
fn fallbacks_and_babble_of_the_bank_are_compared() {
    let clip = Input::from_bytes("a", r#"{ "text_en-us": "Aye.", "text_de-de": "Ja.", "text_de-at": "Ja." }"#);
    let other = Input::from_bytes("b", r#"{ "text_en-us": "No.", "text_de-de": "No." }"#);
    let pack = |options: Options| Compiler::new(options.clone()).compile(&[clip.clone(), other.clone()]).bank.unwrap();
    let project = |toml: &str| pack(Settings::parse(toml, "", "").unwrap().options);
    let old = project("[fallbacks]\nde-at = [\"de-de\"]\n[babble.robot]\nrate = 12\n[babble.ghost]\n");
    let new = project("[fallbacks]\nde-at = [\"en-us\"]\n[babble.robot]\nrate = 30\n");
    let (mut old_files, mut new_files) = (places(1), places(1));
    let old = Dialogue::open(&mut old_files, [old.as_slice()]).unwrap();
    let new = Dialogue::open(&mut new_files, [new.as_slice()]).unwrap();
    let difference = diff(&old, &new);
    let from = |tag: &str| [tag.to_owned()].into();
    let change = Change { old: from("de-de"), new: from("en-us") };
    assert_eq!(difference.fallbacks, [FallbackChange { locale: "de-at", from: change }]);
    assert!(difference.changed.is_empty(), "the texts are the same");
    let rates = difference.babble.iter().map(|change| {
        let rate = |babble: Option<Babble<'_>>| babble.map(|babble| babble.rate().numerator());
        (change.name, rate(change.profile.old), rate(change.profile.new))
    });
    assert_eq!(rates.collect::<Vec<_>>(), [("ghost", Some(24), None), ("robot", Some(12), Some(30))]);
    assert!(!difference.is_empty() && diff(&old, &old).is_empty());
}

#[test]
fn a_split_bank_is_the_whole() {
    let whole = bank(&[("a", AYE), ("b", r#"{ "text_en-us": "No." }"#)]);
    let split = SplitBank::from_bytes(&whole).unwrap();
    let files: Vec<&[u8]> =
        std::iter::once(&split.base).chain(split.texts.iter().map(|(_, texts)| texts)).map(Vec::as_slice).collect();
    with(&[&whole], |whole| {
        with(&files, |split| {
            let difference = diff(whole, split);
            assert!(difference.is_empty(), "{difference:?}");
        });
        with(&[files[0], files[2]], |split| assert_eq!(diff(whole, split).removed_locales, ["de-de"]));
    });
}

#[test]
fn a_new_locale_changes_the_clips_that_have_it_only() {
    let ja = r#"{ "text_en-us": "No.", "text_ja-jp": "いいえ" }"#;
    let no = r#"{ "text_en-us": "No." }"#;
    compare(&[("a", AYE), ("b", no)], &[("a", AYE), ("b", ja)], |difference| {
        assert_eq!(difference.added_locales, ["ja-jp"]);
        let changed: Vec<_> = difference.changed.iter().map(|change| change.key).collect();
        assert_eq!((changed, difference.same), (vec!["b"], 1));
    });
}

#[test]
fn clips_are_added_removed_and_renamed() {
    let (no, empty) = (r#"{ "text_en-us": "No." }"#, "{}");
    let old = [("a", AYE), ("gone", no), ("old-name", AYE), ("same", no)];
    let new = [("a", AYE), ("here", empty), ("new-name", AYE), ("same", no)];
    compare(&old, &new, |difference| {
        assert_eq!((&difference.added[..], &difference.removed[..]), (&["here"][..], &["gone"][..]));
        assert_eq!(difference.renamed, [RenamedClip { old: "old-name", new: "new-name" }]);
        assert_eq!((difference.changed.len(), difference.same), (0, 2));
    });
}

#[test]
fn equal_clips_are_paired_once_each() {
    compare(&[("a", AYE), ("b", AYE)], &[("c", AYE), ("d", AYE), ("e", AYE)], |difference| {
        let pairs = [RenamedClip { old: "a", new: "c" }, RenamedClip { old: "b", new: "d" }];
        assert_eq!(difference.renamed, pairs);
        assert_eq!((&difference.added[..], difference.removed.len()), (&["e"][..], 0));
    });
}
