//! Clips and their recordings: the comparisons of `lipz check`, and the data that `lipz pack` stores in the bank.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::sound::{RATE_HZ, voice_samples, wav};
use support::{Scene, assert_sarif, lipz};

/// A clip of 10 frames at 24 fps: 0.417 s.
const CLIP: &str = r#"{ "visemes": "MAAAEO----", "viseme_type": "blair", "fps": 24, "text_en-us": "Mayor!" }"#;

/// Returns a WAV file of this many samples at 8000 Hz, with speech while the mouth of [`CLIP`] moves. Files of other
/// lengths differ in more than the length.
fn sound(samples: u32) -> Vec<u8> {
    let voice = voice_samples(&[(true, 250), (false, 1750)], samples);
    let samples: Vec<_> = voice.into_iter().step_by(2).take(samples as usize).collect();
    wav(RATE_HZ / 2, &samples)
}

#[test]
fn what_does_not_belong_together() {
    let mut scene = Scene::new();
    scene.write("voices/act1/mayor.lipz", CLIP);
    scene.write("voices/act1/otto.lipz", CLIP);
    scene.write("voices/title.lipz", r#"{ "text_en-us": "Act one" }"#);
    scene.write("recordings/act1/mayor.wav", sound(3333));
    scene.write("recordings/act1/otto.wav", sound(3333));
    let check = ["check", "voices", "--audio", "recordings", "--quiet"];
    let fine = lipz(scene.path(), check);
    assert_eq!((fine.code, fine.stderr.as_str()), (0, ""));
    scene.write("recordings/act1/otto.wav", sound(10_000));
    scene.expect("LZ1703-recording-length", &check);
    fs::remove_file(scene.path().join("recordings/act1/otto.wav")).unwrap();
    scene.expect("LZ1701-clip-without-recording", &check);
    scene.write("recordings/act1/otto.wav", "");
    scene.expect("LZ1704-unreadable-sound-empty", &check);
    scene.write("recordings/act1/otto.wav", &sound(3333)[..40]);
    scene.expect("LZ1704-unreadable-sound", &check);
    scene.write("recordings/act1/otto.wav", sound(3333));
    scene.write("recordings/act1/Mayor 2.wav", sound(3333));
    scene.expect("LZ1702-recording-without-clip", &check);
    let one = ["check", "voices/act1/mayor.lipz", "--config", "root=voices", "--audio", "recordings", "--quiet"];
    assert_eq!(lipz(scene.path(), one).stderr, "", "for a single clip, the recordings of other clips are ignored");
    scene.expect("LZ1702-recording-without-clip-denied", &[&check[..], &["--deny", "LZ1702"]].concat());
    scene.expect("LZ0001-unreadable-file-recordings", &["check", "voices", "--audio", "nowhere", "--quiet"]);
    let sarif = lipz(scene.path(), check.into_iter().chain(["--output-format", "sarif"]));
    let document = serde_json::from_str(&sarif.stdout).unwrap();
    assert_sarif(&document);
    assert!(sarif.stdout.contains("LZ1702"), "{}", sarif.stdout);
    scene.finish(7);
}

/// As for missing sources, the command cannot do what was asked for.
#[test]
fn folders_of_recordings_that_are_missing_end_with_2() {
    let scene = Scene::new();
    scene.write("voices/mayor.lipz", CLIP);
    scene.prepare(&["pack", "voices", "-o", "old.lipzbank", "--quiet"]);
    for arguments in [
        &["check", "voices"][..],
        &["sync", "voices"],
        &["pack", "voices", "-o", "new.lipzbank"],
        &["preview", "voices", "-o", "site"],
        &["preview", "old.lipzbank", "-o", "site"],
        &["watch", "voices", "-o", "new.lipzbank"],
    ] {
        for (folder, what) in [("nowhere", "does not exist"), ("voices/mayor.lipz", "is not a folder")] {
            let outcome = lipz(scene.path(), arguments.iter().copied().chain(["--audio", folder]));
            assert_eq!(outcome.code, 2, "{arguments:?}: {outcome:?}");
            assert!(outcome.stderr.contains(&format!("error[LZ0001]: `{folder}` {what}")), "{outcome:?}");
        }
    }
    assert!(!scene.path().join("new.lipzbank").exists() && !scene.path().join("site").exists());
}

#[test]
fn settings_say_where_recordings_are() {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\n[audio]\nfolder = \"vo\"\npattern = \"en/{key}\"\n");
    scene.write("voices/mayor.lipz", CLIP);
    scene.write("vo/en/mayor.wav", sound(3333));
    assert_eq!(lipz(scene.path(), ["check"]).stderr, "");
    let other = lipz(scene.path(), ["check", "--config", "audio.pattern=de/{key}"]);
    assert!(other.stderr.contains("[LZ1701]") && other.stderr.contains("[LZ1702]"), "{}", other.stderr);
    let refused = lipz(scene.path(), ["check", "--config", "audio.pattern=de/key"]);
    assert!(refused.code == 2 && refused.stderr.contains("does not contain {key} exactly once"), "{}", refused.stderr);
}

#[test]
fn a_bank_says_which_recordings_its_clips_were_made_for() {
    let scene = Scene::new();
    scene.write("voices/mayor.lipz", CLIP);
    scene.write("voices/otto.lipz", CLIP);
    scene.write("recordings/mayor.wav", sound(3333));
    let pack = |arguments: &[&str]| {
        let run =
            lipz(scene.path(), ["pack", "voices", "-o", "b.lipzbank", "--audio", "recordings"].iter().chain(arguments));
        assert_eq!(run.code, 0, "{}", run.stderr);
        fs::read(scene.path().join("b.lipzbank")).unwrap()
    };
    let (without, with) = (pack(&[]), pack(&["--config", "audio.in-bank=true"]));
    assert!(!without.windows(4).any(|tag| tag == b"RCRD"));
    let bank = lipz_bank::Bank::open(&with).unwrap().verify().unwrap();
    let recording = bank.clip_by_key("mayor").unwrap().recording().unwrap();
    assert_eq!(recording.length_us(), 416_625);
    assert_eq!(bank.clip_by_key("otto").unwrap().recording(), None);
    let shown = lipz(scene.path(), ["inspect", "b.lipzbank", "mayor"]).stdout;
    assert!(shown.contains(&format!("recording 0.417 s, content {:016x}\n", recording.content_hash())), "{shown}");
    assert!(lipz(scene.path(), ["inspect", "--show", "stats", "b.lipzbank"]).stdout.contains("1 recording, 0.4 s\n"));
    // A retake of the same length is a different recording.
    let mut retake = sound(3333);
    *retake.last_mut().unwrap() ^= 1;
    scene.write("recordings/mayor.wav", retake);
    fs::write(scene.path().join("old.lipzbank"), &with).unwrap();
    let cached = pack(&["--config", "audio.in-bank=true", "--cache", "c.cache"]);
    assert_eq!(cached, pack(&["--config", "audio.in-bank=true"]));
    assert_eq!(cached, pack(&["--config", "audio.in-bank=true", "--cache", "c.cache"]));
    let differences = lipz(scene.path(), ["diff", "old.lipzbank", "b.lipzbank"]);
    assert!(
        differences.code == 1 && differences.stdout.contains("    recording    0.417 s, content "),
        "{}",
        differences.stdout
    );
    // Unpacking restores the Lipz files. With the recordings, packing makes the same bank.
    scene.prepare(&["unpack", "b.lipzbank", "-o", "out", "--quiet"]);
    scene.prepare(&[
        "pack",
        "out",
        "-o",
        "again.lipzbank",
        "--audio",
        "recordings",
        "--config",
        "audio.in-bank=true",
        "--quiet",
    ]);
    assert_eq!(fs::read(scene.path().join("again.lipzbank")).unwrap(), cached);
    scene.write("recordings/otto.wav", "RIFF");
    let refused = lipz(
        scene.path(),
        ["pack", "voices", "-o", "b.lipzbank", "--audio", "recordings", "--config", "audio.in-bank=true"],
    );
    assert!(refused.code == 1 && refused.stderr.contains("[LZ1704]"), "{}", refused.stderr);
    assert_eq!(fs::read(scene.path().join("b.lipzbank")).unwrap(), cached, "the bank is unchanged");
}

/// Returns a project of three clips, one of which has a recording.
fn project() -> Scene {
    let scene = Scene::new();
    let settings = "sources = [\"voices\"]\nroot = \"voices\"\ndefault-locale = \"en-us\"\n[audio]\nfolder = \"rec\"\n";
    scene.write("lipz.toml", settings);
    scene.write("voices/mayor.lipz", r#"{ "text_en-us": "Good evening, mayor." }"#);
    scene.write("voices/otto.lipz", CLIP);
    scene.write("voices/title.lipz", r#"{ "text_en-us": "Act one" }"#);
    scene.write("rec/mayor.wav", sound(16_000));
    scene
}

#[test]
fn statistics_of_a_project_count_its_recordings() {
    let scene = project();
    scene.write("rec/mayor.ogg", "");
    scene.write("rec/take 2.wav", sound(3333));
    let shown = lipz(scene.path(), ["inspect", "--show", "stats"]).stdout;
    assert!(shown.contains("  1 recording of 1 clip, 2.0 s; 1 clip without a recording, 2 unused\n"), "{shown}");
    // The statistics have the same number of words as the output of the run.
    let synced = lipz(scene.path(), ["sync", "--allow", "warnings"]);
    assert_eq!(synced.code, 0, "{}", synced.stderr);
    let record = fs::read_to_string(scene.path().join("voices/lipz-sync.txt")).unwrap();
    let doubtful =
        record.lines().filter(|line| !line.starts_with('#')).map(|line| line.matches('?').count()).sum::<usize>();
    assert!(doubtful > 0, "a buzz does not match the text: {record}");
    let json = lipz(scene.path(), ["inspect", "--show", "stats", "--output-format", "json"]);
    let stats: serde_json::Value = serde_json::from_str(&json.stdout).unwrap();
    let expected = serde_json::json!({
        "clips": 1, "recordings": 1, "length_us": 2_000_000, "missing": 1, "unused": 2, "synced": 1,
        "doubtful_words": doubtful,
    });
    assert_eq!((&stats["recorded"], &stats["clips"]), (&expected, &serde_json::json!(3)));
    scene.write("rec/otto.wav", "RIFF");
    let refused = lipz(scene.path(), ["inspect", "--show", "stats"]);
    assert!(refused.code == 1 && refused.stderr.contains("[LZ1704]"), "{}", refused.stderr);
}

#[test]
fn a_clip_is_shown_with_its_recording() {
    let scene = project();
    scene.write("rec/otto.wav", sound(3333));
    let shown = |key: &str| lipz(scene.path(), ["inspect", "voices", key]).stdout;
    let states = |key: &str| {
        let json = lipz(scene.path(), ["inspect", "voices", key, "--output-format", "json"]);
        let clip: serde_json::Value = serde_json::from_str(&json.stdout).unwrap();
        assert_eq!(clip["key"], key);
        (clip["recorded"]["state"].clone(), clip["recorded"]["doubtful"].as_array().map(Vec::len))
    };
    assert!(
        shown("mayor").contains("\nrecording rec/mayor.wav, 2.000 s\n  the clip has no visemes yet\n"),
        "{}",
        shown("mayor")
    );
    assert!(shown("otto").contains("  the visemes were made by hand or by another tool\n"), "{}", shown("otto"));
    assert!(!shown("title").contains("recording"));
    assert_eq!(states("title").0, serde_json::Value::Null);
    assert_eq!(lipz(scene.path(), ["sync", "--allow", "warnings"]).code, 0);
    let text = shown("mayor");
    assert!(
        text.contains("  the visemes were made from it\n  uncertain words (listen and check)\n"),
        "a buzz is no good evening: {text}"
    );
    let (state, doubtful) = states("mayor");
    assert!(state == "synced" && doubtful.unwrap() > 0);
    let file = fs::read_to_string(scene.path().join("voices/mayor.lipz")).unwrap();
    let first = file.find("visemes\": \"").unwrap() + "visemes\": \"".len();
    let other = if &file[first..=first] == "M" { "O" } else { "M" };
    for (changed, expected) in [
        (file.replace("evening", "morning"), "other-text"),
        ([&file[..first], other, &file[first + 1..]].concat(), "changed"),
        (file.clone(), "synced"),
    ] {
        scene.write("voices/mayor.lipz", changed);
        assert_eq!(states("mayor").0, expected);
    }
    scene.write("rec/mayor.wav", sound(16_001));
    assert_eq!(states("mayor").0, "other-recording");
    scene.write("rec/mayor.wav", "RIFF");
    let refused = lipz(scene.path(), ["inspect", "voices", "mayor"]);
    assert!(refused.code == 2 && refused.stderr.contains("[LZ1704]"), "{}", refused.stderr);
}
