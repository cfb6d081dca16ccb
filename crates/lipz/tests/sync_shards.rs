//! Lip sync in shards makes the same Lipz files, record, TextGrids and diagnostics as a single run of `lipz sync`.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::collections::BTreeMap;
use std::fs;
use std::process::{Command, Stdio};
use std::time::Duration;
use support::sound::voice;
use support::{Scene, lipz, tree};

/// Speech and silence in a recording, in milliseconds.
const LINE: &[(bool, u32)] = &[(false, 200), (true, 500), (false, 100), (true, 300), (false, 200)];

const SETTINGS: &str = "sources = [\"voices\"]
default-locale = \"en-us\"

[voices]
en-us = \"en/{key}\"
de-de = \"de/{key}\"

[audio]
folder = \"recordings\"

[sync]
lexicon = \"words.txt\"
textgrids = \"grids\"
";

/// Returns a project of originals (with a text of two segments, with visemes made by hand, without a text, with an
/// error) and dubs (with and without a file).
fn scene() -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", SETTINGS);
    scene.write("words.txt", "ZWOGG  Z W AA G\nBAD LINE %%\n");
    for line in 0..9 {
        let text = format!(r#""text_en-us": "Good evening,| Zwogg {line}.", "text_de-de": "Guten Abend,| Zwogg.""#);
        scene.write(&format!("voices/en/line-{line}.lipz"), format!("{{ {text} }}\n"));
        scene.write(&format!("recordings/en/line-{line}.wav"), voice(LINE, line));
    }
    let by_hand = r#"{ "fps": 24, "viseme_type": "blair", "visemes": "MAAE", "text_en-us": "Mine." }"#;
    scene.write("voices/en/line-3.lipz", by_hand);
    scene.write("voices/en/line-4.lipz", "{ \"note\": \"nobody knows\" }");
    scene.write("voices/en/line-5.lipz", "{ \"text_en-us\": ");
    for line in [0, 1, 6, 7] {
        scene.write(&format!("recordings/de/line-{line}.wav"), voice(LINE, 100 + line));
    }
    scene.write("voices/de/line-1.lipz", r#"{ "viseme_type": "blair" }"#);
    scene.write("recordings/en/line-8.wav", "no sound");
    scene
}

/// Returns the files that lip sync writes, with their contents.
fn made(scene: &Scene) -> BTreeMap<String, Vec<u8>> {
    let is_made = |name: &String| name.starts_with("voices/") || name.starts_with("grids/");
    let files = tree(scene.path()).into_iter().filter(is_made).filter(|name| scene.path().join(name).is_file());
    files.map(|name| (name.clone(), fs::read(scene.path().join(name)).unwrap())).collect()
}

fn plan(scene: &Scene, shards: usize) {
    scene.prepare(&["shard", "plan", "sync", "--shards", &shards.to_string(), "-o", "build/sync.json", "--quiet"]);
}

fn arguments(shard: usize, shards: usize) -> Vec<String> {
    let (number, output) = (shard.to_string(), format!("build/{shard}-of-{shards}.lipzmouths"));
    let words = ["shard", "sync", "build/sync.json", &number, "-o", &output, "--store", "store"];
    words.map(str::to_owned).to_vec()
}

fn step(scene: &Scene, shard: usize, shards: usize) -> support::Outcome {
    let outcome = lipz(scene.path(), arguments(shard, shards));
    assert_eq!(outcome.code, 0, "{outcome:?}");
    outcome
}

fn merge(scene: &Scene, shards: usize) -> support::Outcome {
    lipz(scene.path(), ["shard", "merge", &format!("build/*-of-{shards}.lipzmouths")])
}

#[test]
fn shards_make_what_is_made_in_one_go() {
    let whole = scene();
    let expected = lipz(whole.path(), ["sync"]);
    assert!(expected.code != 0 && expected.stdout.contains("kept"), "{expected:?}");
    let expected_files = made(&whole);
    assert!(expected_files.contains_key("voices/de/line-0.lipz"), "a dub without a file gets one");
    for (shards, is_reversed) in [(2, false), (5, true)] {
        let scene = scene();
        plan(&scene, shards);
        let before = made(&scene);
        let order: Vec<usize> = if is_reversed { (0..shards).rev().collect() } else { (0..shards).collect() };
        order.iter().for_each(|shard| drop(step(&scene, *shard, shards)));
        assert!(made(&scene) == before, "steps write only their results");
        let merged = merge(&scene, shards);
        // `lipz shard merge` does not have the option.
        assert!(merged.stdout.contains("\nkept visemes (`lipz sync --discard-edits` replaces them)\n"), "{merged:?}");
        let files = made(&scene);
        for (name, bytes) in &expected_files {
            assert_eq!(
                files.get(name).map(|own| String::from_utf8_lossy(own)),
                Some(String::from_utf8_lossy(bytes)),
                "{name}"
            );
        }
        assert_eq!(files.len(), expected_files.len());
        assert_eq!((merged.code, &merged.stderr), (expected.code, &expected.stderr), "{shards} shards");
        // A second merge has the same result as a second single run.
        let again = merge(&scene, shards);
        assert!(made(&scene) == files && again.code == merged.code, "{again:?}");
        plan(&scene, shards);
        order.iter().for_each(|shard| drop(step(&scene, *shard, shards)));
        let second = lipz(whole.path(), ["sync"]);
        let merged = merge(&scene, shards);
        assert!(made(&scene) == made(&whole) && merged.stderr == second.stderr, "{merged:?} {second:?}");
    }
}

#[test]
fn mouths_are_pure_functions_of_their_inputs() {
    let (one, other) = (scene(), scene());
    let results = |scene: &Scene, threads: &str| -> Vec<Vec<u8>> {
        plan(scene, 2);
        (0..2)
            .map(|shard| {
                let more = ["--jobs", threads].map(str::to_owned);
                let outcome = lipz(scene.path(), arguments(shard, 2).into_iter().chain(more));
                assert_eq!(outcome.code, 0, "{outcome:?}");
                fs::read(scene.path().join(format!("build/{shard}-of-2.lipzmouths"))).unwrap()
            })
            .collect()
    };
    let first = results(&one, "1");
    assert!(first == results(&other, "7"));
    // A text changes one shard. The other one comes from the store.
    one.write("voices/en/line-2.lipz", r#"{ "text_en-us": "Good night." }"#);
    plan(&one, 2);
    let again: Vec<String> = (0..2).map(|shard| step(&one, shard, 2).stdout).collect();
    assert_eq!(again.iter().filter(|said| said.contains("unchanged in")).count(), 1, "{again:?}");
    // Files that are not in the plan are ignored, or prevent the step from running.
    one.write("recordings/de/line-2.wav", voice(LINE, 9));
    fs::remove_dir_all(one.path().join("store")).unwrap();
    let before: Vec<Vec<u8>> =
        (0..2).map(|shard| fs::read(one.path().join(format!("build/{shard}-of-2.lipzmouths"))).unwrap()).collect();
    for (shard, before) in before.iter().enumerate() {
        step(&one, shard, 2);
        assert!(fs::read(one.path().join(format!("build/{shard}-of-2.lipzmouths"))).unwrap() == *before);
    }
    for (name, bytes) in [
        ("recordings/en/line-0.wav", voice(LINE, 77)),
        ("words.txt", b"ZWOGG  Z W AO G\n".to_vec()),
        ("grids/en/line-0.TextGrid", b"new".to_vec()),
        ("voices/lipz-sync.txt", b"# lipz sync\n".to_vec()),
    ] {
        let changed = scene();
        plan(&changed, 1);
        changed.write(name, bytes);
        let outcome = lipz(changed.path(), arguments(0, 1));
        let is_harmless = name.ends_with("lipz-sync.txt");
        assert_eq!(outcome.code, i32::from(!is_harmless), "{name}: {outcome:?}");
        assert!(is_harmless || outcome.stderr.contains("LZ2202"), "{name}: {outcome:?}");
    }
}

#[test]
fn what_somebody_changed_meanwhile_is_kept() {
    let scene = scene();
    plan(&scene, 2);
    (0..2).for_each(|shard| drop(step(&scene, shard, 2)));
    let mine = r#"{ "fps": 24, "viseme_type": "blair", "visemes": "OOO", "text_en-us": "Good evening,| Zwogg 0." }"#;
    scene.write("voices/en/line-0.lipz", mine);
    let merged = merge(&scene, 2);
    assert!(merged.code == 1 && merged.stderr.contains("LZ2202"), "{merged:?}");
    assert_eq!(fs::read_to_string(scene.path().join("voices/en/line-0.lipz")).unwrap(), mine);
    let files = made(&scene);
    assert!(
        String::from_utf8_lossy(&files["voices/en/line-2.lipz"]).contains("visemes"),
        "the other clips have their visemes"
    );
    assert!(!String::from_utf8_lossy(&files["voices/lipz-sync.txt"]).contains(" en/line-0.lipz"));
}

/// Old results do not undo newer data about recordings and visemes, which was recorded after the plan.
#[test]
fn newer_records_recordings_and_settings_are_not_undone() {
    let scene = scene();
    for faulty in
        ["voices/en/line-5.lipz", "voices/en/line-8.lipz", "recordings/en/line-5.wav", "recordings/en/line-8.wav"]
    {
        fs::remove_file(scene.path().join(faulty)).unwrap();
    }
    scene.write("words.txt", "ZWOGG  Z W AA G\n");
    let steps = |shards: usize| {
        plan(&scene, shards);
        (0..shards).for_each(|shard| drop(step(&scene, shard, shards)));
    };
    let record = || fs::read_to_string(scene.path().join("voices/lipz-sync.txt")).unwrap();
    // Whether the recording of a clip is reported to differ from its text.
    let is_outdated = || lipz(scene.path(), ["check"]).stderr.contains("LZ1915");
    steps(2);
    assert_eq!((merge(&scene, 2).code, is_outdated()), (0, false));
    // A different text for the same recording: the visemes follow it, and the text of the recording is remembered.
    let file = "voices/en/line-2.lipz";
    let text = fs::read_to_string(scene.path().join(file)).unwrap();
    scene.write(file, text.replace("Zwogg", "Zwack"));
    steps(2);
    assert_eq!((merge(&scene, 2).code, is_outdated()), (0, true));
    // The text is approved, and merging again keeps this.
    scene.prepare(&["approve", "--all", "--quiet"]);
    let approved = record();
    assert_eq!((merge(&scene, 2).code, record(), is_outdated()), (0, approved, false));
    // Approved between step and merge: the visemes are refused.
    let text = fs::read_to_string(scene.path().join(file)).unwrap();
    scene.write(file, text.replace("Zwack", "Zweck"));
    steps(2);
    scene.prepare(&["approve", "--all", "--quiet"]);
    let approved = record();
    let merged = merge(&scene, 2);
    assert!(merged.code == 1 && merged.stderr.contains("has changed since the plan was made"), "{merged:?}");
    assert_eq!(record(), approved);
    // In a new plan, the store does not return results from before the acceptance.
    steps(2);
    assert_eq!((merge(&scene, 2).code, is_outdated()), (0, false));
    // Another take.
    scene.write("voices/en/line-3.lipz", r#"{ "text_en-us": "Zwogg 3." }"#);
    steps(2);
    let recording = scene.path().join("recordings/en/line-3.wav");
    let take = fs::read(&recording).unwrap();
    let mut longer = take.clone();
    longer.extend([0, 0]);
    fs::write(&recording, &longer).unwrap();
    let merged = merge(&scene, 2);
    assert!(
        merged.code == 1 && merged.stderr.contains("line-3.wav` has changed since the plan was made"),
        "{merged:?}"
    );
    fs::write(&recording, &take).unwrap();
    assert_eq!(merge(&scene, 2).code, 0);
    // Finished work stays, for any change of the recording.
    fs::write(&recording, &longer).unwrap();
    let done = merge(&scene, 2);
    assert!(done.code == 0 && !done.stderr.contains("has changed since"), "{done:?}");
    fs::write(&recording, &take).unwrap();
    // One shard has different settings from the other.
    scene.write("lipz.toml", SETTINGS.replace("[sync]", "[sync]\nlead-ms = 80"));
    plan(&scene, 2);
    step(&scene, 0, 2);
    let merged = merge(&scene, 2);
    assert!(merged.code != 0 && merged.stderr.contains("with different settings"), "{merged:?}");
}

/// Killed steps and merges are run again, and nothing is lost.
#[test]
fn killed_and_resumed() {
    let whole = scene();
    lipz(whole.path(), ["sync"]);
    let scene = scene();
    plan(&scene, 4);
    let kill_after = |arguments: Vec<String>, ms: u64| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lipz"));
        let child =
            command.args(arguments).current_dir(scene.path()).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
        let mut child = child.unwrap();
        std::thread::sleep(Duration::from_millis(ms));
        let _ = child.kill();
        child.wait().unwrap();
    };
    for round in 0..3 {
        (0..4).for_each(|shard| kill_after(arguments(shard, 4), 20 + 40 * round));
    }
    (0..4).for_each(|shard| drop(step(&scene, shard, 4)));
    for ms in (0..60).step_by(6) {
        kill_after(["shard", "merge", "build/*-of-4.lipzmouths"].map(str::to_owned).to_vec(), ms);
    }
    merge(&scene, 4);
    let (files, expected) = (made(&scene), made(&whole));
    let left = files.keys().filter(|name| name.ends_with(".lipztmp")).count();
    assert_eq!(files.len() - left, expected.len());
    assert!(expected.iter().all(|(name, bytes)| files.get(name) == Some(bytes)));
}

#[test]
fn what_is_refused() {
    let scene = scene();
    plan(&scene, 2);
    let refused = |arguments: &[&str], why: &str| {
        let outcome = lipz(scene.path(), arguments);
        assert!(outcome.code != 0 && outcome.stderr.contains(why), "{arguments:?}: {outcome:?}");
    };
    refused(&["shard", "pack", "build/sync.json", "0", "-o", "0.lipzobj"], "is a plan of lip sync");
    refused(&["shard", "sync", "build/sync.json", "0"], "--output <FILE>");
    refused(&["shard", "sync", "build/sync.json", "2", "-o", "2.lipzmouths"], "which has 2 shards");
    refused(&["shard", "sync", "build/sync.json", "0", "-o", "0.lipzmouths", "--discard-edits"], "LZ1601");
    step(&scene, 0, 2);
    refused(&["shard", "merge", "build/0-of-2.lipzmouths"], "LZ2205");
    step(&scene, 1, 2);
    let mouths = fs::read_to_string(scene.path().join("build/0-of-2.lipzmouths")).unwrap();
    scene.write("build/other.lipzmouths", &mouths);
    refused(&["shard", "merge", "build/0-of-2.lipzmouths", "build/other.lipzmouths"], "shard 0 is named twice");
    scene.write("build/other.lipzmouths", mouths.replacen("\"refused\": ", "\"refused\": 1", 1));
    refused(&["shard", "merge", "build/other.lipzmouths"], "it is damaged, or was edited");
    scene.write("build/other.lipzmouths", &mouths[..mouths.len() / 2]);
    refused(&["shard", "merge", "build/other.lipzmouths", "build/none.lipzmouths"], "LZ2203");
    assert!(!scene.path().join("grids").exists() && !scene.path().join("voices/lipz-sync.txt").exists());
    scene.write("lipz.toml", SETTINGS.replace("recordings", "none"));
    refused(&["shard", "plan", "sync", "--shards", "2", "-o", "build/sync.json"], "none");
}

/// Engines produce the same results as a single run. A missing engine is skipped with a message.
#[test]
#[cfg(unix)]
fn engines_run_the_steps() {
    let small = || {
        let scene = scene();
        for line in [3, 4, 5, 8] {
            fs::remove_file(scene.path().join(format!("voices/en/line-{line}.lipz"))).unwrap();
        }
        scene
    };
    let whole = small();
    lipz(whole.path(), ["sync"]);
    let emit = |scene: &Scene, engine: &str, file: &str| {
        plan(scene, 3);
        scene.prepare(&["shard", "emit", engine, "build/sync.json", "-o", file, "--quiet"]);
        fs::read_to_string(scene.path().join(file)).unwrap()
    };
    for (engine, file, arguments) in
        [("ninja", "build.ninja", &[][..]), ("make", "sync.mk", &["-f", "sync.mk", "-j2"][..])]
    {
        let is_there =
            Command::new(engine).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok();
        if !is_there {
            assert!(std::env::var_os("LIPZ_TOOLS").is_none(), "needs {engine}, which `.ci/install` brings");
            eprintln!("skipped: {engine} is not on this machine");
            continue;
        }
        let scene = small();
        let path = support::path_with_lipz(&scene);
        emit(&scene, engine, file);
        let run = || {
            let mut command = Command::new(engine);
            let output = command.args(arguments).env("PATH", &path).current_dir(scene.path()).output().unwrap();
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&[output.stdout, output.stderr].concat()));
        };
        run();
        assert!(made(&scene) == made(&whole), "{engine}");
        run();
        assert!(made(&scene) == made(&whole) && scene.path().join("build/sync.done").is_file(), "{engine}, again");
    }
    let scene = small();
    for engine in ["hyperqueue", "slurm"] {
        let text = emit(&scene, engine, "steps");
        assert!(text.contains("lipz shard sync build/sync.json "), "{text}");
        assert!(text.contains("shard merge") && text.contains("build/*-of-3.lipzmouths"), "{text}");
        assert!(text.contains("touch build/sync.done") && !text.contains("lipzobj"), "{text}");
    }
}

/// Hand-edited visemes stay, and the record gets the times of words that were added since.
#[test]
fn kept_mouths_get_the_times_of_new_words() {
    let project = || {
        let scene = Scene::new();
        scene.write(
            "lipz.toml",
            SETTINGS.replace("textgrids = \"grids\"\n", "").replace("lexicon = \"words.txt\"\n", ""),
        );
        scene.write("recordings/en/line.wav", voice(LINE, 1));
        scene.write("voices/en/line.lipz", r#"{ "text_en-us": "Good evening, all." }"#);
        scene.prepare(&["sync", "--quiet"]);
        let file = fs::read_to_string(scene.path().join("voices/en/line.lipz")).unwrap();
        let edited = file.replacen("\"-", "\"M", 1).replacen("evening", "old evening", 1);
        assert_ne!(edited, file);
        scene.write("voices/en/line.lipz", edited);
        scene
    };
    let record = |scene: &Scene| fs::read_to_string(scene.path().join("voices/lipz-sync.txt")).unwrap();
    let (at_once, sharded) = (project(), project());
    let before = record(&at_once);
    at_once.prepare(&["sync", "--quiet"]);
    plan(&sharded, 1);
    step(&sharded, 0, 1);
    assert_eq!(merge(&sharded, 1).code, 0);
    assert_eq!((made(&sharded), record(&sharded)), (made(&at_once), record(&at_once)));
    let words = |record: &str| record.split_once("said:").unwrap().1.split(',').count();
    assert_eq!((words(&before), words(&record(&at_once))), (3, 4));
}
