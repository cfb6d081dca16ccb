//! Recordings that do not match their texts: missing and extra words with their positions, with a human voice.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::sound::wav;
use support::{Scene, lipz, repository};

/// "Bobby ripped the ledger.", from 0.07 to 1.12 s.
const SENTENCE: &str = "Bobby ripped the ledger.";
const RATE_HZ: u32 = 48_000;
/// The length of the file's header in bytes.
const HEADER_BYTES: usize = 44;

/// Returns the sentence repeated `times` times, with pauses of 0.4 s: one every 1.595 s.
fn said(times: usize) -> Vec<u8> {
    let file = fs::read(repository().join("fixtures/speech/bobby.wav")).unwrap();
    let sample = |bytes: &[u8]| i16::from_le_bytes([bytes[0], bytes[1]]);
    let once: Vec<i16> = file[HEADER_BYTES..].chunks_exact(2).map(sample).collect();
    let pause = vec![0; (RATE_HZ / 10 * 4) as usize];
    let mut samples = once.clone();
    for _ in 1..times {
        samples.extend(pause.iter().chain(&once));
    }
    wav(RATE_HZ, &samples)
}

/// Returns the diagnostics of `lipz sync` for a recording of the sentence with this text.
fn found(times: usize, text: &str) -> String {
    let scene = Scene::new();
    scene.write("rec/a.wav", said(times));
    scene.write("rec/a.txt", text);
    let run = lipz(scene.path(), ["sync", "rec", "-o", "voices", "--config", "audio.locale=en-us", "--quiet"]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stderr.matches("[LZ").count() <= 1, "{}", run.stderr);
    run.stderr
}

/// Returns the times in a diagnostic, in seconds.
fn seconds(found: &str) -> Vec<f64> {
    let line = found.lines().next().unwrap();
    let words: Vec<&str> = line.split(' ').collect();
    words.windows(2).filter(|pair| pair[1].starts_with('s')).filter_map(|pair| pair[0].parse().ok()).collect()
}

/// Checks that the times are as expected, within a syllable.
fn are_near(found: &str, expected: [f64; 2]) {
    let times = seconds(found);
    assert!(
        times.len() == 2 && times.iter().zip(expected).all(|(time, expected)| (time - expected).abs() < 0.2),
        "{found}"
    );
}

/// Returns the part of the text that is marked with carets.
fn marked(found: &str) -> String {
    let lines: Vec<&str> = found.lines().collect();
    let carets = lines.iter().position(|line| line.contains('^')).unwrap();
    let start = lines[carets].find('^').unwrap();
    let text = lines[carets - 1].chars().skip(start);
    text.take(lines[carets].matches('^').count()).collect()
}

#[test]
fn nothing_is_said_of_what_belongs_together() {
    assert_eq!(found(1, SENTENCE), "");
    assert_eq!(found(2, &format!("{SENTENCE} {SENTENCE}")), "");
}

#[test]
fn a_sentence_that_is_not_in_the_text_is_told_with_its_time() {
    let last = found(2, SENTENCE);
    assert!(last.contains("[LZ1707]: the speech from "), "{last}");
    are_near(&last, [1.66, 2.72]);
    let middle = found(3, &format!("{SENTENCE} {SENTENCE}"));
    let is_one_of_them = |second: f64| (0..3).any(|nth| (second - 0.07 - 1.595 * f64::from(nth)).abs() < 0.2);
    assert!(seconds(&middle).first().is_some_and(|&second| is_one_of_them(second)), "{middle}");
}

#[test]
fn a_sentence_that_is_not_said_is_told_with_its_place() {
    for (text, about) in [
        (format!("{SENTENCE} The mayor has never seen a castle."), 1.12),
        (format!("The mayor has never seen a castle. {SENTENCE}"), 0.07),
    ] {
        let found = found(1, &text);
        assert!(found.contains("[LZ1707]: `The mayor has never seen a castle` is not spoken; expected "), "{found}");
        assert_eq!(marked(&found), "The mayor has never seen a castle");
        assert!(seconds(&found).iter().all(|second: &f64| (second - about).abs() < 0.25), "{found}");
    }
}

#[test]
fn the_text_of_another_line_is_told() {
    let text = "Seven wizards are fishing, and none of them has caught a thing.";
    let other = found(2, text);
    assert!(other.contains("the recording differs from `Seven wizards are fishing"), "{other}");
    are_near(&other, [0.0, 2.72]);
    assert_eq!(marked(&other).trim_end_matches('.'), text.trim_end_matches('.'));
}

#[test]
fn findings_stay_until_they_are_mended() {
    let scene = Scene::new();
    scene.write(
        "lipz.toml",
        "sources = [\"voices\"]\nroot = \"voices\"\ndefault-locale = \"en-us\"\n[audio]\nfolder = \"rec\"\n",
    );
    let text = format!("{SENTENCE} The mayor has never seen a castle.");
    scene.write("rec/a.wav", said(1));
    scene.write("voices/a.lipz", format!("{{ \"text_en-us\": \"{text}\" }}"));
    let message = "warning[LZ1707]: `The mayor has never seen a castle` is not spoken";
    for command in [["sync", "--quiet"], ["sync", "--quiet"], ["check", "--quiet"]] {
        let run = lipz(scene.path(), command);
        assert!(run.stderr.contains(message), "{command:?}: {}", run.stderr);
        assert_eq!(marked(&run.stderr), "The mayor has never seen a castle");
    }
    assert!(lipz(scene.path(), ["check", "--output-format", "sarif"]).stdout.contains("LZ1707"));
    // The text has changed, and the next run compares again.
    scene.write(
        "voices/a.lipz",
        fs::read_to_string(scene.path().join("voices/a.lipz")).unwrap().replace(&text, SENTENCE),
    );
    let run = lipz(scene.path(), ["sync"]);
    assert!(run.stdout.contains("1 clip synced") && !run.stderr.contains("LZ1707"), "{run:?}");
    let run = lipz(scene.path(), ["check", "--quiet"]);
    assert!(!run.stderr.contains("LZ1707"), "{}", run.stderr);
}

#[test]
fn what_is_not_spoken_makes_no_text_another_one() {
    let scene = Scene::new();
    scene.write(
        "lipz.toml",
        "sources = [\"voices\"]\nroot = \"voices\"\ndefault-locale = \"en-us\"\n[audio]\nfolder = \"rec\"\n",
    );
    scene.write("rec/a.wav", said(1));
    scene.write("voices/a.lipz", r#"{ "text_en-us": "Bobby ripped the ledger." }"#);
    assert_eq!(lipz(scene.path(), ["sync"]).code, 0);
    let path = scene.path().join("voices/a.lipz");
    for text in ["Bobby ripped| the {angry} ledger.", "{aside} Bobby ripped the ledger."] {
        let before = fs::read_to_string(&path).unwrap();
        let element = before.lines().find(|line| line.contains("text_en-us")).unwrap();
        let changed = before.replace(element, &format!("  \"text_en-us\": \"{text}\","));
        // In each segment, the visemes match their part.
        let changed = changed.replace('|', "").replace("ripped the {", "ripped| the {");
        fs::write(&path, changed.replace(", }", " }")).unwrap();
        let checked = lipz(scene.path(), ["check"]);
        assert!(!checked.stderr.contains("LZ1915"), "{}", checked.stderr);
        let run = lipz(scene.path(), ["sync"]);
        assert!(!run.stdout.contains("older than their texts"), "{run:?}");
    }
}

#[test]
fn every_word_to_look_at_can_be_had_again() {
    let scene = Scene::new();
    scene.write("rec/a.wav", said(1));
    scene.write("rec/a.txt", "Bobby ripped the Wesnothian, \"ledger\".");
    let run = |list: &str| {
        lipz(scene.path(), ["sync", "rec", "-o", "voices", "--config", "audio.locale=en-us", "--list", list])
    };
    assert!(run("first.csv").stdout.contains("1 clip synced"));
    let again = run("lists/second.csv");
    assert!(again.stdout.contains("1 unchanged"), "{again:?}");
    let [first, second] =
        ["first.csv", "lists/second.csv"].map(|name| fs::read_to_string(scene.path().join(name)).unwrap());
    assert_eq!(first.lines().next(), Some("what,clip,seconds,word"));
    assert!(first.contains("by rules,,,Wesnothian  W"), "{first}");
    let words = |table: &str| table.lines().map(|line| line.split(',').next().unwrap().to_owned()).collect::<Vec<_>>();
    assert_eq!(words(&first), words(&second), "{first}{second}");
}

#[test]
fn programs_get_the_table_as_data() {
    let scene = Scene::new();
    scene.write("rec/=a.wav", said(1));
    scene.write("rec/=a.txt", "Bobby ripped the Wesnothian, ledger.");
    let arguments = ["sync", "rec", "-o", "voices", "--config", "audio.locale=en-us"];
    for state in ["synced", "unchanged"] {
        let run = lipz(scene.path(), arguments.into_iter().chain(["--output-format", "json"]));
        let document: serde_json::Value = serde_json::from_str(&run.stdout).unwrap();
        assert!(document["errors"] == 0 && document["diagnostics"].is_array());
        let sync = &document["sync"];
        match state {
            "synced" => assert_eq!(sync["synced"], serde_json::json!(["=a"])),
            _ => assert_eq!((&sync["synced"], &sync["unchanged"]), (&serde_json::json!([]), &1.into())),
        }
        assert_eq!(sync["by_rules"][0]["word"], "Wesnothian");
        assert!(sync["by_rules"][0]["pronunciation"].as_str().unwrap().starts_with('W'));
        let doubtful = sync["doubtful"].as_array().unwrap();
        assert!(doubtful.iter().any(|word| word["clip"] == "=a" && word["start_us"].as_u64().unwrap() > 0), "{sync}");
    }
    // The table for spreadsheets: standard output has only the table, and no formulas.
    let run = lipz(scene.path(), arguments.into_iter().chain(["--list", "-"]));
    assert!(run.stdout.starts_with("what,clip,seconds,word\n") && run.stderr.contains("1 unchanged"), "{run:?}");
    assert!(run.stdout.contains("doubtful,'=a,") && !run.stdout.contains(",=a"), "{}", run.stdout);
}

#[test]
fn a_dub_that_says_something_else_than_its_borrowed_text_is_told_by_check() {
    let scene = Scene::new();
    let settings = "sources = [\"voices\"]\nroot = \"voices\"\ndefault-locale = \"en-us\"\n[audio]\nfolder = \"rec\"\n\
                    [voices]\nen-us = \"en/{key}\"\nen-gb = \"gb/{key}\"\n";
    scene.write("lipz.toml", settings);
    let (text, other) = (SENTENCE, "The mayor has never seen a castle. Bobby ripped the ledger.");
    scene.write("voices/en/a.lipz", format!("{{ \"text_en-us\": \"{text}\", \"text_en-gb\": \"{other}\" }}"));
    ["en", "gb"].iter().for_each(|voice| scene.write(&format!("rec/{voice}/a.wav"), said(1)));
    let told = "warning[LZ1707]: `The mayor has never seen a castle` is not spoken";
    for arguments in [&["sync"][..], &["sync"], &["check"]] {
        let run = lipz(scene.path(), arguments);
        assert!(
            run.stderr.contains(told) && run.stderr.contains("= note: the dub is `gb/a`"),
            "{arguments:?}: {run:?}"
        );
        assert!(run.stderr.contains("--> voices/en/a.lipz:"), "{}", run.stderr);
    }
}

#[test]
fn languages_without_rules_are_told() {
    let scene = Scene::new();
    scene.write("rec/a.wav", said(1));
    scene.write("rec/a.txt", SENTENCE);
    let run = lipz(scene.path(), ["sync", "rec", "-o", "voices", "--config", "audio.locale=xx-yy"]);
    assert!(run.stdout.contains("(their texts are read letter by letter)\n  xx-yy\n"), "{run:?}");
}

#[test]
fn only_lines_without_a_recording_are_missed() {
    let scene = Scene::new();
    ["a", "b"].iter().for_each(|name| scene.write(&format!("rec/{name}.wav"), said(1)));
    scene.write("lines.csv", format!("file,text\na,{SENTENCE}\nb,{SENTENCE}\nc,{SENTENCE}\n"));
    let arguments = ["sync", "rec/a.wav", "-o", "voices", "--config", "audio.locale=en-us", "--script", "lines.csv"];
    let run = lipz(scene.path(), arguments);
    assert!(run.stderr.contains("the script has a text for `c`, which was not recorded\n"), "{}", run.stderr);
    for name in ["a", "b", "c"] {
        scene.write(&format!("rec/{name}.txt"), SENTENCE);
    }
    let run = lipz(scene.path(), ["sync", "rec/a.wav", "-o", "others", "--config", "audio.locale=en-us"]);
    assert!(run.stderr.contains("the text `rec/c.txt` has no recording\n"), "{}", run.stderr);
}
