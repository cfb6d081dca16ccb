//! Emotions in texts and events become curves, which programs read as emotions.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::face::{Emotion, Emotions, FaceProfile, LookAt, Who};
use lipz_bank::{Bank, Fps, Micros};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Input, Options, WordTime, WordTimes};

/// Forty frames at 10 frames per second: two segments of 20.
const VISEMES: &str = "MAEOMAEOMAEOMAEOMAEO|MAEOMAEOMAEOMAEOMAEO";

fn options(settings: &str) -> Options {
    let settings = Settings::parse(settings, "lipz.toml", "").unwrap();
    let voices = settings.voices();
    settings.options.voices(voices)
}

/// Returns the curves of a clip with these additional elements.
fn curves(elements: &str, settings: &str) -> Vec<String> {
    let file = format!(r#"{{ "fps": 10, "visemes": "{VISEMES}", {elements} }}"#);
    let bytes = Compiler::new(options(settings)).compile(&[Input::from_bytes("a", file)]).into_bank().unwrap();
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    let clip = bank.clip_by_key("a").unwrap();
    clip.curves().map(|curve| format!("{} {curve}", curve.name())).collect()
}

#[test]
fn texts_change_the_face_at_their_words() {
    // Ten letters before, ten after: half of the segment.
    let text = r#""text_en-us": "{anger 2.2} abcde fghij {anger 6, joy 1} klmno pqrst|{calm} Bye.""#;
    assert_eq!(
        curves(text, ""),
        ["anger 0:2.2 10:2.2 14:6 20:6 24:0", "joy 10:0 14:1 20:1 24:0"],
        "ramps of 0.4 s: 4 frames, but the first face is there"
    );
    let step = "[emotions]\nover = 0\n";
    assert_eq!(curves(text, step)[1], "joy 9:0 10:1 19:1 20:0");
    let own_time = r#""text_en-us": "{joy 4 over 1s} abcde|x""#;
    assert_eq!(curves(own_time, step), ["joy 0:0 10:4"]);
    assert_eq!(curves(text, "[emotions]\ncurves = \"off\"\n"), [""; 0]);
    assert_eq!(curves(text, "[text]\nliteral-braces = true\n"), [""; 0]);
}

/// The locale of the recordings is that of the voice.
#[test]
fn the_emotions_of_the_voice_count() {
    let texts = r#""text_de-de": "{anger 1} a|b", "text_en-us": "{joy 1} a|b""#;
    let first = |settings| curves(texts, settings).remove(0);
    assert_eq!(first("default-locale = \"en-us\"\n[lints]\nemotion-locales = \"allow\"\n"), "joy 0:1");
    let voice = "default-locale = \"en-us\"\n[lints]\nemotion-locales = \"allow\"\n[audio]\nlocale = \"de-de\"\n";
    assert_eq!(first(voice), "anger 0:1");
}

#[test]
fn a_face_changes_when_the_word_is_said() {
    let text = "{joy 1}Ab {anger 2} cde fgh {calm}|{sadness 3} ij {fear 4} kl";
    let file = format!(r#"{{ "fps": 10, "visemes": "{VISEMES}", "text_en-us": "{text}" }}"#);
    let word = |word: &str, start_ms| {
        let at = text.find(word).unwrap();
        WordTime { range: at..at + word.len(), start_ms, end_ms: start_ms + 100, is_doubtful: false }
    };
    let words = [word("Ab", 300), word("cde", 1_650), word("fgh", 1_800), word("ij", 2_400), word("kl", 9_000)];
    let curves = |times: Option<WordTimes>| {
        let options = options("[emotions]\nover = 0\n").word_times(times.map(|times| ("a", times)));
        let bytes = Compiler::new(options).compile(&[Input::from_bytes("a", file.as_str())]).into_bank().unwrap();
        let bank = Bank::open(&bytes).unwrap().verify().unwrap();
        let clip = bank.clip_by_key("a").unwrap();
        clip.curves().map(|curve| format!("{} {curve}", curve.name())).collect::<Vec<_>>()
    };
    let by_letters = ["anger 4:0 5:2 19:2 20:0", "fear 29:0 30:4", "joy 0:1 4:1 5:0", "sadness 19:0 20:3 29:3 30:0"];
    assert_eq!(curves(None), by_letters);
    // At 1.65 s, and to the end of the last word. A word beyond the end of the clip has no effect.
    let by_times = ["anger 15:0 16:2 18:2 19:0", "joy 0:1 15:1 16:0", "sadness 19:0 20:3"];
    assert_eq!(curves(Some(WordTimes::new(text, &words))), by_times);
    assert_eq!(curves(Some(WordTimes::new("another text", &words))), by_letters, "from a different text");
}

/// An emotion is added to a text after `lipz sync`: its word is spoken at the same time as before.
#[test]
fn words_keep_their_times_when_a_text_is_edited() {
    let text = "No. I told you to leave.|Never.";
    let word = |word: &str, start_ms| {
        let at = text.find(word).unwrap();
        WordTime { range: at..at + word.len(), start_ms, end_ms: start_ms + 100, is_doubtful: false }
    };
    let words = [("No", 0), ("I", 500), ("told", 787), ("you", 900), ("to", 1_000), ("leave", 1_100), ("Never", 2_500)];
    let words: Vec<WordTime> = words.into_iter().map(|(text, ms)| word(text, ms)).collect();
    let times = WordTimes::new(text, &words);
    let check = |text: &str| {
        let file = format!(r#"{{ "fps": 10, "visemes": "{VISEMES}", "text_en-us": "{text}" }}"#);
        let options = options("default-locale = \"en-us\"\n[emotions]\nover = 0\n").word_times([("a", times.clone())]);
        let input = [Input::from_bytes("a", file)];
        let compiled = Compiler::new(options).compile(&input);
        let found = compiled.reports.iter().flat_map(|report| &report.diagnostics).map(ToString::to_string);
        let found: Vec<String> = found.collect();
        let bytes = compiled.bank.unwrap();
        let bank = Bank::open(&bytes).unwrap().verify().unwrap();
        let clip = bank.clip_by_key("a").unwrap();
        let curves = clip.curves().map(|curve| format!("{} {curve}", curve.name()));
        (curves.collect::<Vec<_>>().join("; "), found.join("; "))
    };
    let at_told = ("anger 6:0 7:6".to_owned(), String::new());
    assert_eq!(check("No. I {anger 6} told you to leave.|Never."), at_told);
    assert_eq!(check("No! I {anger 6}told you, to leave!|{louder}Never."), at_told, "notes and marks");
    assert_eq!(check("No. I {anger 6} told you to go away.|Never."), at_told, "other words");
    let (curves, found) = check("No. I {anger 6} ordered you to leave.|Never.");
    // Between `I`, which ends at 0.6 s, and `you`.
    assert_eq!(curves, "anger 5:0 6:6");
    assert!(found.contains("LZ1815") && found.contains("the time of `ordered` is unknown"), "{found}");
    assert_eq!(check("{anger 6} Not I told you to leave.|{joy 1} Never.").1, "", "the start of a segment is known");
}

#[test]
fn events_change_the_face_at_their_segments() {
    let events = r#""events": "feels anger 2.2 + joy 3 over 0.5s|mara feels evil, feels neutral""#;
    let expected =
        ["anger 0:0 5:2.2 20:2.2 24:0", "joy 0:0 5:3 20:3 24:0", "mara.anger 20:0 24:5", "mara.joy 20:0 24:5"];
    assert_eq!(curves(events, ""), expected);
}

/// A word has the project's usual value. A project that reads `feels sad` directly from the events can disable this.
#[test]
fn words_have_the_usual_value() {
    let old = r#""events": "feels sad|amy feels happy", "text_en-us": "{sad} a|{louder} b""#;
    assert_eq!(curves(old, ""), ["amy.joy 20:0 24:5", "sadness 0:5"]);
    assert_eq!(curves(old, "[emotions]\nvalue = 4\n"), ["amy.joy 20:0 24:4", "sadness 0:4"]);
    let values = "[emotions]\ncurves = \"values\"\n";
    assert_eq!(curves(old, values), [""; 0]);
    let one_value = r#""events": "feels sad|feels joy 1""#;
    assert_eq!(curves(one_value, values), ["joy 20:0 24:1", "sadness 0:5 20:5 24:0"]);
}

/// The examples of the specification move faces without any settings.
#[test]
fn the_examples_of_the_specification_move_faces() {
    let file = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/spec/repaired/06-three-moods.lipz"))
        .unwrap();
    let bytes = Compiler::default().compile(&[Input::from_bytes("a", file)]).into_bank().unwrap();
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    let names: Vec<String> =
        bank.clips().flat_map(|clip| clip.curves()).map(|curve| curve.name().to_string()).collect();
    assert!(names.iter().all(|name| Emotion::from_name(name).is_some()) && names.len() > 1, "{names:?}");
}

/// A segment in a different syntax is one string for the game, regardless of its commas.
#[test]
fn other_syntax_moves_no_face() {
    for events in ["feels anger 2,5|", "feels anger 2, jumps|", "say('feels anger 2'), feels anger 3|"] {
        assert_eq!(curves(&format!(r#""events": "{events}""#), ""), [""; 0], "{events}");
    }
}

#[test]
fn presets_have_values_and_projects_have_their_own() {
    let first = |blend: &str, settings: &str| curves(&format!(r#""text_en-us": "{{{blend}}} a|b""#), settings);
    assert_eq!(first("evil 2", ""), ["anger 0:2", "joy 0:2"]);
    assert_eq!(first("suspicious 4", ""), ["anger 0:2", "perplexed 0:4"]);
    assert_eq!(first("sad 7", ""), ["sadness 0:7"]);
    let own = "[emotions]\nsmug = \"joy 2 + disgust 1\"\nsad = \"sadness 3\"\n";
    assert_eq!(first("smug", own), ["disgust 0:1", "joy 0:2"]);
    assert_eq!(first("sad", own), ["sadness 0:3"]);
    assert_eq!(first("take 3", own), [""; 0], "a note");
}

#[test]
fn curves_of_the_file_win() {
    let file = r#""text_en-us": "{anger 2, joy 2} a|b", "curves": { "joy": "0:1", "jawOpen": "0:0.5" }"#;
    assert_eq!(curves(file, ""), ["anger 0:2", "jawOpen 0:0.5", "joy 0:1"]);
}

#[test]
fn programs_read_emotions_at_a_time() {
    let file = format!(
        r#"{{ "fps": 10, "visemes": "{VISEMES}", "text_en-us": "{{anger 6, joy 2 over 0.4s}} a|{{calm}} b" }}"#
    );
    let bytes = Compiler::default().compile(&[Input::from_bytes("a", file)]).into_bank().unwrap();
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    let clip = bank.clip_by_key("a").unwrap();
    let at = |us| clip.emotions_at(Micros(us), Who::Speaker);
    let half = at(200_000);
    assert_eq!((half.get(Emotion::Anger).thousandths(), half.get(Emotion::Fear).thousandths()), (3000, 0));
    assert_eq!((half.strongest().map(|(emotion, _)| emotion), half.sum().thousandths()), (Some(Emotion::Anger), 4000));
    assert_eq!(half.iter().filter(|(_, value)| value.thousandths() > 0).count(), 2);
    assert_eq!((at(3_000_000).strongest(), at(-1).sum().thousandths()), (None, 0));
}

/// The bank shows an extended event as its strongest emotion. The string keeps the rest.
#[test]
fn typed_events_have_the_strongest_emotion() {
    let file = r#"{ "events": "mara feels joy 1 + anger 2.2 over 0.4s" }"#;
    let bytes = Compiler::default().compile(&[Input::from_bytes("a", file)]).into_bank().unwrap();
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    let clip = bank.clip_by_key("a").unwrap();
    let segment = clip.segment(0).unwrap();
    let events: Vec<String> = segment.events().map(|event| event.to_string()).collect();
    assert_eq!(events, ["mara feels anger"]);
    assert_eq!(segment.event(), Some("mara feels joy 1 + anger 2.2 over 0.4s"));
}

#[test]
fn what_is_wrong_is_said() {
    let codes = |elements: &str| -> Vec<String> {
        let file = format!(r#"{{ "fps": 10, "visemes": "{VISEMES}", {elements} }}"#);
        let reports = Compiler::default().check(&[Input::from_bytes("a", file)]).reports;
        let diagnostics = reports.iter().flat_map(|report| &report.diagnostics);
        diagnostics.map(|diagnostic| format!("{}: {}", diagnostic.code, diagnostic.message)).collect()
    };
    assert_eq!(codes(r#""text_en-us": "{angr 2.2} a|b""#), ["LZ0702: `angr` is not a known emotion"]);
    assert_eq!(codes(r#""events": "feels anger 11|""#), ["LZ1807: anger 11 is outside 0 to 10"]);
    let sum = codes(r#""text_en-us": "a|b {anger 8, joy 5} c""#);
    assert_eq!(sum, ["LZ1808: the emotions add up to 13 from frame 30 (3.00 s) on"]);
    assert_eq!(codes(r#""text_en-us": "{anger 2,2} a|{louder} b""#).len(), 1);
    let registered = options("[registry]\nemotions = [\"smug\"]\n");
    let file = format!(r#"{{ "fps": 10, "visemes": "{VISEMES}", "events": "feels smug|" }}"#);
    let reports = Compiler::new(registered).check(&[Input::from_bytes("a", file)]).reports;
    assert_eq!(reports[0].diagnostics[0].message, "`smug` has no definition in [emotions] and makes no curve");
    let translated = r#""text_de-de": "{joy 2} a|b", "text_en-us": "{joy 1} a|b", "text_fr-fr": "a|b""#;
    assert_eq!(codes(translated), ["LZ1809: the text of the voice has a different emotion here, in segment 0"]);
    assert_eq!(codes(r#""text_en-us": "{take 3} a|{to amy} b {wait 0.5}""#), [""; 0]);
}

#[test]
fn a_dub_feels_what_its_own_language_says() {
    let settings = "default-locale = \"en-us\"\n[emotions]\nover = 0\n[lints]\nemotion-locales = \"allow\"\n[audio]\n\
                    locale = \"en-us\"\n[voices]\nde-de = \"de/{key}\"\n";
    let file =
        r#"{ "fps": 10, "visemes": "MAEOMAEOMA", "text_en-us": "Go {anger 5} on.", "text_de-de": "Los {joy 5} weg." }"#;
    let inputs = ["a", "de/a"].map(|key| Input::from_bytes(key, file));
    let bytes = Compiler::new(options(settings)).compile(&inputs).into_bank().unwrap();
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    let names = ["a", "de/a"].map(|key| {
        let clip = bank.clip_by_key(key).unwrap();
        clip.curves().map(|curve| curve.name().to_string()).collect::<Vec<_>>()
    });
    assert_eq!(names, [["anger"], ["joy"]]);
}

/// The number of frames in 0.4 s is unknown, so that the face changes within one, and gestures have no length. A rate
/// from the program is used. Without it, no time has a frame.
#[test]
fn without_a_frame_rate_a_face_changes_within_one_frame() {
    let text = "{joy 4 over 2s} abcde fghij {anger 6} klmno pqrst|x";
    let file = format!(r#"{{ "visemes": "{VISEMES}", "text_en-us": "{text}", "events": "nods 4|" }}"#);
    let bytes = Compiler::new(options("face.keys = \"words\"\n")).compile(&[Input::from_bytes("a", file)]);
    let bytes = bytes.into_bank().unwrap();
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    let clip = bank.clip_by_key("a").unwrap();
    let curves: Vec<String> = clip.curves().map(|curve| format!("{} {curve}", curve.name())).collect();
    assert_eq!(curves, ["anger 10:0 11:6", "joy 0:0 1:4 10:4 11:0"]);
    let (time, usual) = (Micros(1_050_000), FaceProfile::DEFAULT);
    assert_eq!(clip.emotions_at(time, Who::Speaker), Emotions::default());
    assert_eq!(
        clip.face_at(time, Who::Speaker, &usual, LookAt::AHEAD),
        usual.idle_at(time, clip.id().get(), LookAt::AHEAD)
    );
    let given = clip.or_fps(Fps::whole(10));
    let of = |emotion| given.emotions_at(time, Who::Speaker).get(emotion).thousandths();
    assert_eq!((of(Emotion::Anger), of(Emotion::Joy)), (3000, 2000));
    assert_ne!(given.face_at(time, Who::Speaker, &usual, LookAt::AHEAD).head_yaw.thousandths(), 0);
}
