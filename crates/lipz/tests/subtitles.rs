//! `lipz subtitles`: the files that are written and read, and the diagnostics.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::{Scene, lipz, repository};

const CLIP: &str =
    r#"{ "fps": 24, "viseme_type": "blair", "visemes": "--MA|EO--", "text_en-us": "|{speaker: Mara} Hello & bye." }"#;

#[test]
fn the_drama_returns() {
    let scene = Scene::new();
    let voices = repository().join("fixtures/drama");
    let voices = voices.to_str().unwrap();
    for format in ["srt", "vtt"] {
        let folder = format!("{format}-files");
        scene.prepare(&["unpack", &drama(&scene), "-o", format, "--quiet"]);
        scene.prepare(&["export", "subtitles", format, voices, "-o", &folder, "--config", "default-fps=24", "--quiet"]);
        // The files contain all speakers and times, and restore the texts.
        let before = bank(&scene, format);
        scene.prepare(&["import", "subtitles", &folder, "-o", format, "--fps", "24", "--quiet"]);
        let diff = lipz(scene.path(), ["diff", &before, format]);
        assert!(diff.code == 0 && diff.stdout.contains("no differences in 48 clips"), "{diff:?}");
    }
}

fn drama(scene: &Scene) -> String {
    let voices = repository().join("fixtures/drama");
    scene.prepare(&["pack", voices.to_str().unwrap(), "-o", "drama.lipzbank", "--quiet"]);
    "drama.lipzbank".into()
}

fn bank(scene: &Scene, folder: &str) -> String {
    let bank = format!("{folder}.lipzbank");
    scene.prepare(&["pack", folder, "-o", &bank, "--quiet", "--no-config"]);
    bank
}

#[test]
fn files_have_key_and_locale_in_their_names() {
    let scene = Scene::new();
    scene.write("voices/act1/mayor.lipz", CLIP);
    scene.prepare(&["export", "subtitles", "vtt", "voices", "-o", "out"]);
    let vtt = fs::read_to_string(scene.path().join("out/act1/mayor.en-us.vtt")).unwrap();
    assert_eq!(vtt, "WEBVTT\n\n00:00:00.167 --> 00:00:00.333\n<v Mara>Hello &amp; bye.\n");
    scene.prepare(&["export", "subtitles", "srt", "voices", "-o", "out"]);
    let srt = fs::read_to_string(scene.path().join("out/act1/mayor.en-us.srt")).unwrap();
    assert_eq!(srt, "1\n00:00:00,167 --> 00:00:00,333\nHello & bye.\n\n");
    let again = lipz(scene.path(), ["export", "subtitles", "srt", "voices", "-o", "out"]);
    assert!(again.code == 1 && again.stderr.contains("already exists"), "{again:?}");
    let other = lipz(scene.path(), ["export", "subtitles", "srt", "voices", "-o", "other", "--locale", "de_DE"]);
    assert_eq!((other.code, scene.path().join("other").exists()), (0, false));
}

#[test]
fn a_clip_that_is_not_there_is_made() {
    let scene = Scene::new();
    scene.write("in/mayor.de-de.srt", "1\n00:00:00,500 --> 00:00:01,000\nGuten Abend.\n");
    scene.write("in/readme.txt", "not a subtitle");
    scene.prepare(&["import", "subtitles", "in", "-o", "voices", "--fps", "4"]);
    let made = fs::read_to_string(scene.path().join("voices/mayor.lipz")).unwrap();
    assert!(made.contains("--|--") && made.contains("Guten Abend."), "{made}");
    let nowhere = lipz(scene.path(), ["import", "subtitles", "in/readme.txt", "-o", "voices"]);
    assert_eq!(nowhere.code, 2);
}

#[test]
fn folders_without_subtitles_and_files_that_are_missing() {
    let scene = Scene::new();
    scene.write("empty/readme.txt", "not a subtitle");
    let import = |named| lipz(scene.path(), ["import", "subtitles", named, "-o", "voices"]);
    let empty = import("empty");
    assert_eq!((empty.code, empty.stdout.as_str()), (2, ""));
    assert!(empty.stderr.contains("error[LZ0805]: no subtitle files in `empty`"), "{empty:?}");
    let missing = import("no.srt");
    assert_eq!((missing.code, missing.stdout.as_str()), (2, ""));
    assert!(missing.stderr.contains("`no.srt` does not exist"), "{missing:?}");
}

#[test]
fn diagnostics() {
    let mut scene = Scene::new();
    scene.write("voices/mayor.lipz", r#"{ "fps": 24, "visemes": "MAAA|EEOO|", "text_en-us": "Yes.|a --> b|Gone." }"#);
    let import = |file| ["import", "subtitles", file, "-o", "voices", "--quiet"];
    let files = [
        ("LZ1301-subtitle-syntax", "a.en-us.srt", "Who?\n\n1\n00:00:01,000 --> 00:00:0x\nGood evening.\n"),
        ("LZ1301-subtitle-syntax-vtt", "b.en-us.vtt", "1\n00:01.000 --> 00:02.000\nGood evening.\n"),
        ("LZ1301-subtitle-syntax-end", "c.ja-jp.srt", "1\n00:00:03,000 --> 00:00:02,000\nこんばんは。\n"),
        (
            "LZ1302-subtitle-times",
            "d.en-us.srt",
            "1\n00:00:02,000 --> 00:00:03,000\nTwo.\n\n2\n00:00:01,000 --> 00:00:02,500\nOne.\n",
        ),
        ("LZ1303-subtitle-place", "mayor.de-de.srt", "1\n00:00:00,000 --> 00:00:00,333\nGuten Abend.\n"),
        ("LZ1306-subtitle-outside", "mayor.fr-fr.srt", "1\n00:00:05,000 --> 00:00:06,000\nBonsoir.\n"),
        ("LZ1306-subtitle-outside-long", "g.en-us.srt", "1\n00:00:00,000 --> 99999:59:59,000\nGood evening.\n"),
        ("LZ1302-subtitle-times-hour", "i.en-us.srt", "1\n10:00:00,000 --> 10:00:01,000\nGood evening.\n"),
        ("LZ1301-subtitle-syntax-skipped", "k.en-us.vtt", "WEBVTT\n\n00:00.000 --> 00:01.000\nGood\n\nevening.\n"),
        (
            "LZ1304-subtitle-text-times",
            "l.en-us.srt",
            "1\n00:00:00,000 --> 00:00:01,000\nGood\n2\n00:00:01,000 --> 00:00:02,000\nevening.\n",
        ),
        ("LZ1304-subtitle-text-empty-line", "h.en-us.srt", "1\n00:00:00 --> 00:00:01\nGood\n\nevening.\n"),
        ("LZ1304-subtitle-text", "e.en-us.srt", "1\n00:00:00,000 --> 00:00:00,333\nA <i>good</i>\nevening | night.\n"),
    ];
    for (name, file, content) in files {
        scene.write(file, content);
        scene.expect(name, &import(file));
    }
    scene.expect("LZ1305-subtitle-loss", &["export", "subtitles", "srt", "voices", "-o", "out", "--quiet"]);
    scene.write("f.srt", "1\n00:00:01,000 --> 00:00:02,000\nGood evening.\n");
    scene.expect("LZ1110-text-left-out-subtitles", &import("f.srt"));
    scene.write("f.de.srt", "1\n00:00:01,000 --> 00:00:02,000\nGuten Abend.\n");
    scene.expect("LZ1110-text-left-out-language", &[&import("f.de.srt")[..], &["--locale", "en-us"]].concat());
    scene.write("more/lines.lipz", r#"{ "fps": 24, "visemes": "MA", "text_en-us": "Good \n \n evening." }"#);
    let export = ["export", "subtitles", "vtt", "more", "-o", "out", "--quiet"];
    scene.expect("LZ1305-subtitle-loss-lines", &export);
    scene.finish(16);
}

/// Subtitles of a programme, or of a longer clip, emptied the translation.
#[test]
fn subtitles_outside_a_clip_leave_its_translation() {
    let scene = Scene::new();
    let clip = "{ \"visemes\": \"--------|--------\", \"text_de-de\": \"Guten Tag. |Auf Wiedersehen.\", \"fps\": 8 }\n";
    scene.write("voices/line.lipz", clip);
    let import = ["import", "subtitles", "line.de-de.srt", "-o", "voices", "--quiet"];
    let read = || fs::read_to_string(scene.path().join("voices/line.lipz")).unwrap();
    scene.write("line.de-de.srt", "00:00:05,000 --> 00:00:06,000\nHallo.\n\n00:00:06,000 --> 00:00:07,000\nTschau.\n");
    let late = lipz(scene.path(), import);
    assert!(late.code == 1 && late.stderr.contains("error[LZ1306]"), "{late:?}");
    assert_eq!(read(), clip);
    scene.write("line.de-de.srt", "01:00:00,000 --> 01:00:01,000\nHallo.\n\n01:00:01,000 --> 01:00:02,000\nTschau.\n");
    let programme = lipz(scene.path(), import);
    assert!(programme.code == 0 && programme.stderr.contains("warning[LZ1302]"), "{programme:?}");
    assert_eq!(read(), clip.replace("Guten Tag. |Auf Wiedersehen.", "Hallo.|Tschau."));
}

#[test]
fn files_of_other_systems_and_times() {
    let scene = Scene::new();
    let srt = "1\n00:00:01 --> 00:00:02\nGr\u{fc}n.\n\n2\n00:00:02 --> 00:00:03\nBlau.\n";
    let latin: Vec<u8> = srt.replace('\n', "\r").chars().map(|c| u8::try_from(c).unwrap()).collect();
    let utf16: Vec<u8> = format!("\u{feff}{srt}").encode_utf16().flat_map(u16::to_be_bytes).collect();
    scene.write("a.de-de.srt", srt);
    scene.write("b.de-de.srt", latin);
    scene.write("c.de-de.srt", utf16);
    let import = |file: &str| ["import", "subtitles", file, "-o", "voices", "--quiet"].map(str::to_owned);
    scene.prepare(&import("a.de-de.srt").each_ref().map(String::as_str));
    let guessed = lipz(scene.path(), import("b.de-de.srt"));
    assert!(guessed.code == 0 && guessed.stderr.contains("is read as Windows-1252"), "{}", guessed.stderr);
    let wide = lipz(scene.path(), import("c.de-de.srt"));
    assert_eq!((wide.code, wide.stderr.as_str()), (0, ""));
    let clip = |key: &str| fs::read_to_string(scene.path().join(format!("voices/{key}.lipz"))).unwrap();
    assert!(clip("a").contains("Grün.") && clip("a").contains("Blau."), "{}", clip("a"));
    assert_eq!((clip("b"), clip("c")), (clip("a"), clip("a")));
}

#[test]
fn white_space_and_speakers_return() {
    let scene = Scene::new();
    let text = "\u{a0}Hi {speaker: Bob}there\u{a0}|Ho \u{2003}";
    scene.write("voices/a.lipz", format!(r#"{{ "fps": 24, "visemes": "MA|EO", "text_en-us": "{text}" }}"#));
    for format in ["srt", "vtt"] {
        scene.write("new/a.lipz", r#"{ "fps": 24, "visemes": "MA|EO" }"#);
        scene.prepare(&["pack", "voices", "-o", "old.lipzbank", "--quiet"]);
        let export = lipz(scene.path(), ["export", "subtitles", format, "voices", "-o", format, "--quiet"]);
        // A change of speakers within a text is lost in SubRip.
        let loss = "the subtitle does not show that `Bob` speaks a part of the text";
        assert_eq!((export.code, export.stderr.contains(loss)), (0, format == "srt"), "{}", export.stderr);
        scene.prepare(&["import", "subtitles", format, "-o", "new", "--quiet"]);
        let diff = lipz(scene.path(), ["diff", "old.lipzbank", "new"]);
        assert_eq!(diff.code, 0, "{diff:?}");
    }
}

/// Subtitles show texts without braces, so their translators cannot know the placeholders.
#[test]
fn placeholders_that_subtitles_lack_are_reported() {
    let scene = Scene::new();
    scene.write("lipz.toml", "default-locale = \"en-us\"\ndefault-fps = 24\n");
    scene.write("voices/otto.lipz", r#"{ "visemes": "MAEO", "text_en-us": "Who goes there, {name}?" }"#);
    scene.prepare(&["export", "subtitles", "srt", "voices", "-o", "out"]);
    let srt = fs::read_to_string(scene.path().join("out/otto.en-us.srt")).unwrap();
    scene.write("out/otto.de-de.srt", srt.replace("Who goes there, ?", "Wer da, ?"));
    let imported = lipz(scene.path(), ["import", "subtitles", "out/otto.de-de.srt", "-o", "voices"]);
    assert!(imported.code == 0 && imported.stderr.contains("LZ1906"), "{imported:?}");
    assert!(imported.stderr.contains("the translation lacks `{name}`") && imported.stderr.contains("otto.de-de.srt"));
    let denied =
        lipz(scene.path(), ["import", "subtitles", "out/otto.de-de.srt", "-o", "voices", "--deny", "placeholder"]);
    assert_eq!(denied.code, 1, "{denied:?}");
    scene.write("voices/otto.lipz", r#"{ "visemes": "MAEO", "text_en-us": "Who goes there, {name}?" }"#);
    let denied =
        lipz(scene.path(), ["import", "subtitles", "out/otto.de-de.srt", "-o", "voices", "--deny", "placeholder"]);
    assert_eq!(denied.code, 1, "{denied:?}");
    assert!(!fs::read_to_string(scene.path().join("voices/otto.lipz")).unwrap().contains("de-de"));
    // The text without a locale is that of the default locale.
    scene.write("voices/otto.lipz", r#"{ "visemes": "MAEO", "text": "Who goes there, {name}?" }"#);
    let imported = lipz(scene.path(), ["import", "subtitles", "out/otto.de-de.srt", "-o", "voices"]);
    assert!(imported.code == 0 && imported.stderr.contains("the translation lacks `{name}`"), "{imported:?}");
}

/// A clip with both `text` and `text_en-us` would have two texts in one locale, an error.
#[test]
fn the_text_of_the_default_locale_needs_no_locale_in_its_name() {
    let scene = Scene::new();
    scene.write("lipz.toml", "default-locale = \"en-us\"\ndefault-fps = 24\nlints.text-without-locale = \"allow\"\n");
    scene.write("voices/otto.lipz", r#"{ "visemes": "MAEO|MAEO", "text": "Good evening. |{softly} Who?" }"#);
    scene.prepare(&["export", "subtitles", "srt", "voices", "-o", "out"]);
    let srt = fs::read_to_string(scene.path().join("out/otto.en-us.srt")).unwrap();
    scene.write("otto.srt", srt.replace("Who?", "What?").replace("Good evening.", "Good morning."));
    scene.prepare(&["import", "subtitles", "otto.srt", "-o", "voices"]);
    let file = || fs::read_to_string(scene.path().join("voices/otto.lipz")).unwrap();
    assert!(file().contains(r#""text": "Good morning.|What?""#) && !file().contains("text_"), "{}", file());
    // A locale of files without one in their names does not change the locale of the project's texts.
    scene.write("otto.srt", srt.replace("Who?", "Wer?").replace("Good evening.", "Guten Abend."));
    scene.prepare(&["import", "subtitles", "otto.srt", "-o", "voices", "--locale", "de-de"]);
    assert!(file().contains(r#""text": "Good morning.|What?""#), "{}", file());
    assert!(file().contains(r#""text_de-de": "Guten Abend.|Wer?""#), "{}", file());
    assert_eq!(lipz(scene.path(), ["check", "voices", "--quiet"]).stderr, "");
    // A different spelling of the locale is the same text.
    scene.write("voices/otto.lipz", r#"{ "visemes": "MAEO|MAEO", "text_de_DE": "Guten Tag. |Wer?" }"#);
    scene.prepare(&["import", "subtitles", "otto.srt", "-o", "voices", "--locale", "de-de"]);
    assert!(file().contains(r#""text_de_DE": "Guten Abend.|Wer?""#) && !file().contains("text_de-de"), "{}", file());
}

/// A text without a locale is as undivided as one with a locale, so subtitles do not divide the visemes under it.
#[test]
fn a_text_without_a_locale_keeps_its_segment() {
    let scene = Scene::new();
    scene.write("lipz.toml", "default-locale = \"en-us\"\ndefault-fps = 24\n");
    scene.write("voices/otto.lipz", r#"{ "visemes": "MAEO----MAEO----", "text": "Who goes there? Halt!" }"#);
    scene.write(
        "otto.de-de.srt",
        "1\n00:00:00,000 --> 00:00:00,300\nWer da?\n\n2\n00:00:00,350 --> 00:00:00,600\nHalt!\n",
    );
    let imported = lipz(scene.path(), ["import", "subtitles", "otto.de-de.srt", "-o", "voices"]);
    assert_eq!(imported.code, 0, "{imported:?}");
    let file = fs::read_to_string(scene.path().join("voices/otto.lipz")).unwrap();
    assert!(file.contains("\"MAEO----MAEO----\""), "{file}");
    assert_eq!(lipz(scene.path(), ["check", "voices"]).code, 0, "{file}");
}
