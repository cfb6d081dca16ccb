//! Gestures: movements of faces during speech and listening become curves.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::face::{FaceProfile, LookAt, Who};
use lipz_bank::{Bank, Clip, Micros};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Documents, Input, Options, WordTime, WordTimes};
use lipz_testkit::dialogue;

/// Eighty frames at 20 per second: two segments of 40. The mouth rests at the end.
const VISEMES: &str = "MAEOMAEOMAEOMAEOMAEOMAEOMAEOMAEOMAEOMAEO|MAEOMAEOMAEOMAEOMAEOMAEOMAEO------------";
const WORDS: &str = "default-locale = \"en-us\"\n[face]\nkeys = \"words\"\n";

fn options(settings: &str) -> Options {
    let settings = Settings::parse(settings, "lipz.toml", "").unwrap();
    let voices = settings.voices();
    settings.options.voices(voices)
}

fn bank(elements: &str, options: Options) -> Vec<u8> {
    let file = format!(r#"{{ "fps": 20, "visemes": "{VISEMES}", {elements} }}"#);
    Compiler::new(options).compile(&[Input::from_bytes("a", file)]).into_bank().unwrap()
}

fn curves_of(clip: &Clip<'_>) -> Vec<String> {
    clip.curves().map(|curve| format!("{} {curve}", curve.name())).collect()
}

/// Returns the curves of a clip with these additional elements.
fn curves(elements: &str, options: Options) -> Vec<String> {
    let bytes = bank(elements, options);
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    curves_of(&bank.clip_by_key("a").unwrap())
}

/// Returns the keys of one curve of a clip with this text; empty if it has no such curve.
fn keys(name: &str, locale: &str, text: &str, settings: &str) -> String {
    let curves = curves(&format!(r#""text_{locale}": "{text}""#), options(settings));
    let own = curves.iter().find_map(|curve| curve.strip_prefix(name)?.strip_prefix(' '));
    own.unwrap_or_default().to_owned()
}

#[test]
fn heads_nod_and_shake_at_their_words() {
    let nod = |text: &str| keys("nod", "en-us", text, WORDS);
    // Ten letters of twenty before it: half of the segment. Swings of 2, 1, 0.5.
    assert_eq!(nod("abcde fghij agreed klmn|x"), "20:5 23:3 26:6 29:4.5 32:5");
    assert_eq!(nod("abcde fghij disagreed k|x"), "");
    assert_eq!(keys("shake", "en-us", "abcde fghij disagreed k|x", WORDS), "20:5 23:7 26:4 29:5.5 32:5");
    assert_eq!(keys("shake", "en-us", "Not sure|x", WORDS), "0:5 3:7 6:4 9:5.5 12:5", "the longest phrase counts");
    assert_eq!(nod("Not sure|x"), "");
    assert_eq!(nod("{yes} abc|x"), "", "a note is not spoken");
    assert_eq!(keys("shrug", "en-us", "Maybe|x", WORDS), "0:0 4:0.6 12:0.6 18:0");
    assert_eq!(keys("nod", "de-de", "Natürlich|x", WORDS), "0:5 3:3 6:6 9:4.5 12:5");
    assert_eq!(keys("shake", "he-il", "לא|x", WORDS), "0:5 3:7 6:4 9:5.5 12:5");
    let strong = format!("{WORDS}nods = 10\n");
    assert_eq!(keys("nod", "en-us", "Yes|x", &strong), "0:5 3:0 6:7.5 9:3.75 12:5");
    assert_eq!(keys("nod", "en-us", "Yes|x", "default-locale = \"en-us\"\n"), "", "they are not enabled");
}

#[test]
fn words_are_where_they_are_heard() {
    let text = "Well yes|x";
    let times = WordTimes::new(text, &[WordTime { range: 5..8, start_ms: 300, end_ms: 900, is_doubtful: false }]);
    let options = options(WORDS).word_times([("a", times)]);
    let heard = curves(&format!(r#""text_en-us": "{text}""#), options);
    assert!(heard.contains(&"nod 6:5 9:3 12:6 15:4.5 18:5".to_owned()), "{heard:?}");
}

/// The head turns at each word and at each pause: at the times of the words, or else at their share of the segment.
#[test]
fn each_word_and_each_pause_has_a_pose() {
    let text = "I was so sure|it was him";
    let pose = |elements: &str, options: Options| -> String {
        let curves = curves(elements, options);
        curves.iter().find_map(|curve| curve.strip_prefix("pose ")).unwrap_or_default().to_owned()
    };
    let words = format!(r#""text_en-us": "{text}""#);
    // One letter, three and two of ten in 40 frames; then two and three of eight in the 28 frames that are spoken. The
    // rest at the end is not a pose.
    assert_eq!(pose(&words, options(WORDS)), "0:1 4:1 16:1 24:1 40:1 47:1 58:1");
    let heard = |range, start_ms, end_ms| WordTime { range, start_ms, end_ms, is_doubtful: false };
    let times = WordTimes::new(text, &[heard(2..5, 300, 500), heard(9..13, 1000, 1400)]);
    assert_eq!(
        pose(&words, options(WORDS).word_times([("a", times)])),
        "0:1 6:1 10:1 20:1 40:1 47:1 58:1",
        "`so` is between the others"
    );
    assert_eq!(pose(&words, options("default-locale = \"en-us\"\n")), "", "they are not enabled");
    assert_eq!(pose(r#""text_en-us": "...|{louder}""#, options(WORDS)), "", "there are no spoken words");
}

/// A pause has its own pose and contains no word. Scripts without blanks have poses at the usual intervals of words.
#[test]
fn poses_follow_the_mouth() {
    let pose = |visemes: &str, text: &str| {
        let file = format!(r#"{{ "fps": 20, "visemes": "{visemes}", "text_en-us": "{text}" }}"#);
        let bytes = Compiler::new(options(WORDS)).compile(&[Input::from_bytes("a", file)]).into_bank().unwrap();
        let bank = Bank::open(&bytes).unwrap().verify().unwrap();
        let clip = bank.clip_by_key("a").unwrap();
        clip.curve("pose").map(|curve| curve.to_string()).unwrap_or_default()
    };
    // The words share the 13 frames that are not rest. A rest of two frames has no pose.
    assert_eq!(pose("--MAEO--AEMA-------MAEOM", "ab cd ef gh"), "2:1 5:1 11:1 12:1 21:1");
    assert_eq!(pose("MAEOMAEO", "ab"), "0:1");
    assert_eq!(pose("MAEOMAEOMAEOMAEOMAEOMAEOMAEOMAEO", "はいそうです"), "0:1 8:1 16:1 24:1");
}

#[test]
fn breath_comes_behind_sentences_and_deeper_with_effort() {
    let breath = |text: &str, settings: &str| keys("breath", "en-us", text, settings);
    // After five letters of ten, and where the mouth comes to rest at the end.
    assert_eq!(breath("Abcde. fghij|klm", WORDS), "20:0 26:1 40:0 68:0 74:1 80:0");
    assert_eq!(breath("a|klm", &format!("{WORDS}breath = 4\n")), "68:0 74:4 80:0");
    assert_eq!(breath("{exertion 5} a|klm", WORDS), "68:0 74:5.5 80:0", "1 and half of what is above");
    assert_eq!(breath("{fear 10} a|klm", WORDS), "68:0 74:10 80:0");
    assert_eq!(breath("{joy 10} a|klm", WORDS), "68:0 74:1 80:0");
}

#[test]
fn stressed_words_move_brows_and_head() {
    let brows = |text: &str| keys("brows", "en-us", text, WORDS);
    assert_eq!(brows("abcde *fghij*|x"), "20:0 22:0.6 27:0.6 33:0");
    assert_eq!(keys("nod", "en-us", "abcde FGHIJ|x", WORDS), "20:5 22:4.25 28:5");
    assert_eq!(brows("ABCDE FGHIJ|x"), "", "a text in capitals only has no stress");
    assert_eq!(brows("abcde fghij?|x"), "20:0 22:0.4 27:0.4 33:0");
    assert_eq!(brows("abcde fghij.|x"), "");
}

/// Events need no setting, and take precedence over words at the same time.
#[test]
fn events_make_gestures() {
    let of = |events: &str, settings: &str| {
        curves(&format!(r#""events": "{events}", "text_en-us": "Yes|x""#), options(settings))
    };
    let nods = "nod 0:5 3:2 6:6.5 9:4.25 12:5";
    assert_eq!(of("nods 6|", ""), [nods]);
    assert!(of("nods 6|", WORDS).contains(&nods.to_owned()));
    assert_eq!(of("shakes|", ""), ["shake 0:5 3:7 6:4 9:5.5 12:5"]);
    assert_eq!(of("breathes 6|", ""), ["breath 0:0 6:6 20:0"]);
    assert_eq!(of("|mara blinks", ""), ["mara.lids 40:0 41:1 42:1 45:0"]);
    assert_eq!(
        of("|looks away, nods 2", ""),
        ["lookPitch 40:0 43:-8 63:-8 66:0", "lookYaw 40:0 43:25 63:25 66:0", "nod 40:5 43:4 46:5.5 49:4.75 52:5",]
    );
    assert_eq!(of("nods 6|", "[face]\nkeys = \"off\"\n"), [""; 0]);
    assert_eq!(of("nods, feels blue, jumps|", ""), [""; 0], "a different syntax");
}

#[test]
fn gestures_that_cannot_be_seen_are_told() {
    let of = |elements: &str| {
        let file = format!(r#"{{ "fps": 20, "visemes": "{VISEMES}", {elements} }}"#);
        let compiled = Compiler::new(options(WORDS)).check(&[Input::from_bytes("a", file)]);
        let found = compiled.reports.iter().flat_map(|report| &report.diagnostics);
        found.map(|found| format!("{}: {}", found.code, found.message)).collect::<Vec<_>>()
    };
    assert_eq!(of(r#""events": "nods 40|""#), ["LZ1810: nods 40 is outside 0 to 10"]);
    let in_file = r#""events": "nods 4|", "curves": { "nod": "0:5" }"#;
    let still = "LZ1811: the gesture has no effect because the curve `nod` of the file is constant at that time";
    assert_eq!(of(in_file), [still]);
    assert_eq!(of(r#""events": "nods 4|", "curves": { "nod": "0:5 2:4" }"#), [""; 0], "the gesture is drawn by hand");
    let both = "LZ1811: the gesture has no effect because another gesture is in progress on its curve";
    assert_eq!(of(r#""events": "nods 4, nods 6|""#), [both]);
    assert_eq!(of(r#""events": "nods 4, mara nods|shakes""#), [""; 0]);
    assert_eq!(of(r#""events": "nodds 4|""#), ["LZ0706: `nodds` is not a verb of Character Event Syntax"]);
}

/// A mouth that rests for long belongs to a listener.
#[test]
fn who_listens_moves_now_and_then() {
    let visemes = format!("MAEO{}MAEO", "-".repeat(200));
    let file = format!(r#"{{ "fps": 20, "visemes": "{visemes}" }}"#);
    let bytes = Compiler::new(options(WORDS)).compile(&[Input::from_bytes("a", file)]).into_bank().unwrap();
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    let clip = bank.clip_by_key("a").unwrap();
    // From 0.9 s on, one every three seconds.
    let expected = [
        "brows 22:0 24:0.4 29:0.4 35:0",
        "nod 82:5 85:4.25 88:5.375 91:4.813 94:5",
        "shrug 142:0 146:0.3 154:0.3 160:0",
    ];
    assert_eq!(curves_of(&clip), expected);
    let face = clip.face_at(Micros(1_300_000), Who::Speaker, &FaceProfile::DEFAULT, LookAt::AHEAD);
    assert_eq!(face.brows.thousandths(), 400);
}

#[test]
fn curves_of_the_file_win_and_files_without_times_get_none() {
    let own = r#""text_en-us": "Yes.|x", "curves": { "nod": "0:5", "breath": "0:0", "pose": "3:1" }"#;
    assert_eq!(curves(own, options(WORDS)), ["breath 0:0", "nod 0:5", "pose 3:1"]);
    let file = r#"{ "text_en-us": "Yes." }"#;
    let bytes = Compiler::new(options(WORDS)).compile(&[Input::from_bytes("a", file)]).into_bank().unwrap();
    assert_eq!(Bank::open(&bytes).unwrap().clip_by_key("a").unwrap().curves().count(), 0);
}

/// Without `keys`, and with it off, the bytes of a bank do not change.
#[test]
fn banks_change_only_if_asked() {
    let text = r#""text_en-us": "Yes, no! Maybe?|x""#;
    let plain = bank(text, options("default-locale = \"en-us\"\n"));
    assert_eq!(bank(text, options("default-locale = \"en-us\"\nface.keys = \"off\"\n")), plain);
    assert_ne!(bank(text, options(WORDS)), plain);
}

/// Generated gestures are not written back: the file has no curves.
#[test]
fn gestures_do_not_come_back_as_curves() {
    let text = r#""text_en-us": "Yes, {joy 2} no!|x""#;
    let bytes = bank(text, options(WORDS));
    dialogue!(bank_with = &bytes);
    let clip = bank_with.clip_by_key("a").unwrap();
    assert!(clip.curves().count() > 2);
    let documents = Documents::from_dialogue(&bank_with).unwrap();
    let (_, document) = documents.iter().next().unwrap().unwrap();
    let written = lipz_file::write(&document);
    assert!(!written.contains("curves"), "{written}");
    let again = Compiler::new(options(WORDS)).compile(&[Input::from_bytes("a", written)]).into_bank().unwrap();
    assert_eq!(again, bytes);
}

#[test]
fn settings_of_gestures_are_checked() {
    let cases = [
        ("keys = \"word\"", "did you mean \"words\"?"),
        ("keys = \"always\"", "write \"words\" for gestures that match the text, \"events\" or \"off\""),
        ("nods = 11", "write a number such as 0.4"),
        ("breaths = 1", "did you mean `breath`?"),
        ("robot = { nods = 1 }", "write it in [face]; it applies to all characters"),
    ];
    for (line, help) in cases {
        let report = Settings::parse(format!("[face]\n{line}\n"), "lipz.toml", "").unwrap_err();
        assert_eq!(report.diagnostics.len(), 1, "{line}");
        assert_eq!(report.diagnostics[0].help.as_deref(), Some(help), "{line}");
    }
}
