//! Repeated runs of `lipz sync`: only changed clips are made again, and threads and order do not matter.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::collections::BTreeMap;
use std::fs;
use support::sound::voice;
use support::{Scene, lipz, tree};

const LINE: &[(bool, u32)] = &[(false, 200), (true, 700), (false, 300), (true, 400), (false, 100)];

/// Returns the contents of the files in a folder.
fn files(scene: &Scene, folder: &str) -> BTreeMap<String, String> {
    let read = |name: &String| fs::read_to_string(scene.path().join(folder).join(name)).unwrap();
    tree(&scene.path().join(folder)).into_iter().map(|name| (name.clone(), read(&name))).collect()
}

#[test]
fn threads_and_order_make_no_difference() {
    let scene = Scene::new();
    for number in 0..6 {
        scene.write(&format!("rec/{number}.wav"), voice(LINE, number));
        scene.write(&format!("rec/{number}.txt"), "Who goes|there, in the dark of the night?");
    }
    let names = |order: &[usize]| order.iter().map(|number| format!("rec/{number}.wav")).collect::<Vec<_>>();
    let runs = [
        ("one", "1", names(&[0, 1, 2, 3, 4, 5])),
        ("two", "2", names(&[5, 4, 3, 2, 1, 0])),
        ("eight", "8", names(&[3, 0, 5, 1, 4, 2])),
        ("folder", "8", vec!["rec".to_owned()]),
    ];
    let mut printed = Vec::new();
    for (folder, threads, sources) in &runs {
        let arguments = ["-o", folder, "--config", "audio.locale=en-us", "--jobs", threads];
        let run = lipz(scene.path(), ["sync"].into_iter().chain(sources.iter().map(String::as_str)).chain(arguments));
        assert_eq!(run.code, 0, "{}", run.stderr);
        printed.push((run.stdout + &run.stderr).replace(folder, "FOLDER"));
    }
    let first = files(&scene, "one");
    assert_eq!(first.len(), 7);
    for (number, (folder, ..)) in runs.iter().enumerate() {
        assert_eq!(files(&scene, folder), first, "{folder}");
        assert_eq!(printed[number], printed[0], "{folder}");
    }
}

/// Returns a project of four clips: one with a word of the lexicon, one without, one with loudness only, and one
/// without a text.
fn project() -> Scene {
    let scene = Scene::new();
    let settings = "sources = [\"voices\"]\nroot = \"voices\"\ndefault-locale = \"en-us\"\n[audio]\nfolder = \"rec\"\n\
                    [sync]\nlexicon = \"lexicon.txt\"\n[lints]\nwarnings = \"allow\"\n";
    scene.write("lipz.toml", settings);
    scene.write("lexicon.txt", "WESNOTH  W EH S N AO TH\n");
    scene.write("voices/lexicon.lipz", r#"{ "text_en-us": "Go to|Wesnoth!" }"#);
    scene.write("voices/plain.lipz", r#"{ "text_en-us": "Who goes there?", "text_de-de": "Wer da?" }"#);
    scene.write("voices/loud.lipz", r#"{ "text_en-us": "Who?", "viseme_type": "rms" }"#);
    scene.write("voices/mute.lipz", r#"{ "mood": "calm" }"#);
    for (take, name) in ["lexicon", "plain", "loud", "mute"].into_iter().enumerate() {
        scene.write(&format!("rec/{name}.wav"), voice(LINE, u32::try_from(take).unwrap()));
    }
    scene
}

/// Runs `lipz sync`. Returns the keys of the clips that were made again, based on the changed lines of the record.
fn made(scene: &Scene, arguments: &[&str]) -> Vec<String> {
    let lines = |text: String| text.lines().map(str::to_owned).collect::<Vec<_>>();
    let record = || lines(fs::read_to_string(scene.path().join("voices/lipz-sync.txt")).unwrap_or_default());
    let before = record();
    let run = lipz(scene.path(), ["sync"].iter().chain(arguments));
    assert_eq!(run.code, 0, "{}", run.stderr);
    let changed = record().into_iter().filter(|line| !line.starts_with('#') && !before.contains(line));
    let mut names: Vec<String> = changed.filter_map(|line| Some(line.rsplit_once(' ')?.1.to_owned())).collect();
    names.iter_mut().for_each(|name| *name = name.trim_end_matches(".lipz").to_owned());
    // A clip may have two lines: one for its visemes, and one for the text of its recording.
    names.sort();
    names.dedup();
    let told = format!("{} clip{} synced", names.len(), if names.len() == 1 { "" } else { "s" });
    assert!(run.stdout.starts_with(&told), "{names:?}: {}", run.stdout);
    names
}

#[test]
fn what_changed_and_nothing_else_is_made_again() {
    let scene = project();
    let change = |file: &str, from: &str, to: &str| {
        let text = fs::read_to_string(scene.path().join(file)).unwrap();
        assert!(text.contains(from), "{text}");
        scene.write(file, text.replace(from, to));
    };
    let all = ["lexicon", "loud", "mute", "plain"];
    assert_eq!(made(&scene, &[]), all);
    assert_eq!(made(&scene, &[]), [""; 0]);
    // The recording.
    scene.write("rec/plain.wav", voice(LINE, 7));
    assert_eq!(made(&scene, &[]), ["plain"]);
    // The spoken text, and a text that is not spoken.
    change("voices/plain.lipz", "Wer da?", "Wer ist da?");
    assert_eq!(made(&scene, &[]), [""; 0]);
    change("voices/plain.lipz", "goes there?", "is there?");
    assert_eq!(made(&scene, &[]), ["plain"]);
    // A pronunciation that one clip needs, an unused one, and one for a single occurrence.
    change("lexicon.txt", "N AO TH", "N OW TH");
    assert_eq!(made(&scene, &[]), ["lexicon"]);
    change("lexicon.txt", "WESNOTH", "CASTLE  K AE S AH L\nWESNOTH");
    assert_eq!(made(&scene, &[]), [""; 0]);
    change("voices/plain.lipz", "Who is", "Who{say: W UW} is");
    assert_eq!(made(&scene, &[]), ["plain"]);
    // Settings for all visemes, for visemes from phones, and for visemes from loudness.
    assert_eq!(made(&scene, &["--config", "sync.lead-ms=0"]), all);
    assert_eq!(made(&scene, &["--config", "sync.lead-ms=0"]), [""; 0]);
    assert_eq!(made(&scene, &[]), all);
    assert_eq!(made(&scene, &["--config", "sync.hold-ms=0"]), ["lexicon", "mute", "plain"]);
    assert_eq!(made(&scene, &[]), ["lexicon", "mute", "plain"]);
    assert_eq!(made(&scene, &["--config", "sync.rms-exponent=1"]), ["loud"]);
    assert_eq!(made(&scene, &[]), ["loud"]);
    // Settings that do not affect visemes, and defaults that no file needs.
    assert_eq!(
        made(
            &scene,
            &["--config", "default-fps=12", "--config", "default-viseme-type=toonboom", "--config", "text.lines=2"]
        ),
        [""; 0]
    );
    // The language, which determines the pronunciation.
    change("voices/plain.lipz", "text_en-us", "text_xx-xx");
    change("voices/plain.lipz", "text_de-de", "text_en-us");
    change("voices/plain.lipz", "text_xx-xx", "text_de-de");
    assert_eq!(made(&scene, &[]), ["plain"]);
}

#[test]
fn what_makes_no_other_mouth_makes_none_again() {
    let scene = project();
    made(&scene, &[]);
    // Formatting, and other elements.
    scene.prepare(&["fmt", "--quiet"]);
    scene.write("voices/mute.lipz", {
        let text = fs::read_to_string(scene.path().join("voices/mute.lipz")).unwrap();
        text.replace("calm", "angry")
    });
    assert_eq!(made(&scene, &[]), [""; 0]);
    // A copy of a recording, and one that was rewritten with the same bytes.
    scene.write("rec/plain.wav", fs::read(scene.path().join("rec/plain.wav")).unwrap());
    assert_eq!(made(&scene, &[]), [""; 0]);
}

/// The record has the times of words. A record of an older version does not, so its visemes are made again, with the
/// same result.
#[test]
fn faces_change_at_the_words_of_the_record() {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\nroot = \"voices\"\ndefault-locale = \"en-us\"\n[audio]\nfolder = \"rec\"\n[emotions]\nover = 0\n[lints]\nwarnings = \"allow\"\n");
    scene.write("voices/a.lipz", r#"{ "text_en-us": "Go {anger 2} to the house", "fps": 100 }"#);
    scene.write("rec/a.wav", voice(LINE, 1));
    assert_eq!(made(&scene, &[]), ["a"]);
    let record = || fs::read_to_string(scene.path().join("voices/lipz-sync.txt")).unwrap();
    let with_times = record();
    let (_, said) = with_times.split_once("said:").unwrap();
    let entries: Vec<&str> = said.split_once(':').unwrap().1.split([',', ' ']).collect();
    let places: Vec<&str> = entries[..4].iter().map(|entry| entry.split_once('#').unwrap().0).collect();
    assert_eq!(places, ["0-2", "2-4", "4-7", "7-12"], "{said}");
    let start_ms: u32 = entries[1].split(['@', '-']).nth(2).unwrap().parse().unwrap();
    let curves = || {
        let run = lipz(scene.path(), ["pack", "-o", "a.lipzbank"]);
        assert_eq!(run.code, 0, "{}", run.stderr);
        lipz(scene.path(), ["inspect", "a.lipzbank", "a"]).stdout
    };
    // Before the lead of the visemes: the word is spoken at this frame.
    let at = start_ms / 10;
    assert!(curves().contains(&format!("{}:0 {at}:2", at - 1)), "{at}: {}", curves());
    let mouth = fs::read(scene.path().join("voices/a.lipz")).unwrap();
    let old: String = with_times
        .split_inclusive('\n')
        .map(|line| match line.split_once("said:") {
            Some((hashes, said)) => format!("{hashes}{}", said.split_once(' ').unwrap().1),
            None => line.to_owned(),
        })
        .collect();
    fs::write(scene.path().join("voices/lipz-sync.txt"), old).unwrap();
    assert!(!curves().contains(&format!("{}:0 {at}:2", at - 1)), "by its letters");
    assert_eq!(made(&scene, &[]), ["a"]);
    assert_eq!((record(), fs::read(scene.path().join("voices/a.lipz")).unwrap()), (with_times, mouth));
    assert_eq!(made(&scene, &[]), [""; 0]);
}

/// A writer edits the text after `lipz sync`, and an animator edits the visemes: words keep their times, new words get
/// theirs with the next run, and the visemes stay.
#[test]
fn words_keep_their_times_when_texts_and_mouths_are_edited() {
    let mut scene = Scene::new();
    let folder = scene.path().to_owned();
    scene.write("lipz.toml", "sources = [\"voices\"]\nroot = \"voices\"\ndefault-locale = \"en-us\"\n[audio]\nfolder = \"rec\"\n[emotions]\nover = 0\n[lints]\nmouth-kept = \"allow\"\n");
    let recording = fs::read(support::repository().join("fixtures/speech/bobby.wav")).unwrap();
    scene.write("rec/bobby.wav", recording);
    scene.write("voices/bobby.lipz", r#"{ "text_en-us": "Bobby ripped the ledger.", "fps": 100 }"#);
    assert_eq!(made(&scene, &[]), ["bobby"]);
    let path = folder.join("voices/bobby.lipz");
    let edit = |from: &str, to: &str| {
        let file = fs::read_to_string(&path).unwrap();
        assert!(file.contains(from), "{file}");
        fs::write(&path, file.replacen(from, to, 1)).unwrap();
    };
    let anger = || {
        let run = lipz(&folder, ["pack", "-o", "a.lipzbank"]);
        assert_eq!(run.code, 0, "{}", run.stderr);
        let shown = lipz(&folder, ["inspect", "a.lipzbank", "bobby"]).stdout;
        shown.lines().find_map(|line| line.trim().strip_prefix("anger  ")).unwrap().to_owned()
    };
    let start_ms = |word: usize| -> u32 {
        let record = fs::read_to_string(folder.join("voices/lipz-sync.txt")).unwrap();
        let words = record.split_once("said:").unwrap().1.split_once(':').unwrap().1;
        words.split([',', ' ']).nth(word).unwrap().split(['@', '-']).nth(2).unwrap().parse().unwrap()
    };
    let at = |frame: u32| format!("{}:0 {frame}:6", frame - 1);
    // The writer adds an emotion after the animator has edited the visemes.
    edit("ripped", "{anger 6} ripped");
    edit("-\"", "M\"");
    assert_eq!(anger(), at(start_ms(1) / 10));
    assert_eq!(made(&scene, &[]), [""; 0]);
    assert_eq!(anger(), at(start_ms(1) / 10), "also after a run that keeps the mouth");
    // The writer changes a word: those around it keep their times, and it is reported.
    let the = start_ms(2);
    edit("{anger 6} ripped the", "ripped {anger 6} a");
    scene.expect("LZ1815-untimed-emotion", &["check", "--quiet"]);
    let run = lipz(scene.path(), ["sync"]);
    assert!(run.code == 0 && run.stdout.contains("0 clips synced"), "{run:?}");
    let file = fs::read_to_string(&path).unwrap();
    assert!(file.contains("M\"") && !lipz(scene.path(), ["check"]).stderr.contains("LZ1815"), "{file}");
    assert!(start_ms(2).abs_diff(the) < 200, "{} and {the}", start_ms(2));
    assert_eq!(anger(), at(start_ms(2) / 10));
    scene.finish(1);
}
