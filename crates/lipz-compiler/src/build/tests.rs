//! Tests of the outputs of a build script, and of its messages to cargo.

use super::*;
use crate::files::path::display;
use crate::sources::discover;
use lipz_bank::Bank;
use std::fs;

const CLIP: &str = r#"{ "fps": 24, "visemes": "MAEO-", "viseme_type": "blair", "text_en-us": "Mayor!" }"#;

const OUTPUTS: [&str; 3] = ["dialogue.lipzbank", "dialogue.lipzcache", "dialogue.rs"];

/// Runs a build of `files` in `voices`. Returns its messages to cargo, and the names of its outputs.
fn run(scene: &Path, build: impl FnOnce(Build) -> Build, files: &[(&str, &str)]) -> (String, Vec<String>) {
    for (name, text) in files {
        let path = scene.join("voices").join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    let (mut cargo, outputs) = (Vec::new(), scene.join("out"));
    fs::create_dir_all(&outputs).unwrap();
    let result = build(Build::new(scene.join("voices"))).run_in(&outputs, &mut cargo);
    let lines = String::from_utf8(cargo).unwrap().replace(&*display(scene), "SCENE");
    assert_eq!(result.is_err(), lines.contains("cargo::error="), "{result:?}: {lines}");
    let mut names: Vec<String> =
        fs::read_dir(outputs).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    (lines, names)
}

#[test]
fn a_clean_build_writes_bank_and_ids() {
    let scene = tempfile::tempdir().unwrap();
    let (lines, names) = run(scene.path(), |build| build, &[("act1/mayor.lipz", CLIP)]);
    assert_eq!(lines, "cargo::rerun-if-changed=SCENE/voices\n");
    assert_eq!(names, OUTPUTS);
    let bytes = fs::read(scene.path().join("out/dialogue.lipzbank")).unwrap();
    assert!(Bank::open(&bytes).unwrap().verify().unwrap().clip_by_key("act1/mayor").is_some());
    let ids = fs::read_to_string(scene.path().join("out/dialogue.rs")).unwrap();
    assert!(ids.contains("pub const MAYOR: ::lipz_bank::ClipId"), "{ids}");
}

#[test]
fn the_next_run_gives_the_same_and_remembers() {
    let scene = tempfile::tempdir().unwrap();
    let outputs = || OUTPUTS.map(|name| fs::read(scene.path().join("out").join(name)).unwrap());
    run(scene.path(), |build| build, &[("aye.lipz", CLIP)]);
    let [bank, _, ids] = outputs();
    fs::remove_file(scene.path().join("out/dialogue.rs")).unwrap();
    run(scene.path(), |build| build, &[]);
    assert_eq!([outputs()[0].as_slice(), &outputs()[2]], [&bank, &ids], "also if a file was lost");
    let (path, cache) = (scene.path().join("out/dialogue.lipzbank"), scene.path().join("out/dialogue.lipzcache"));
    let inputs = discover(&[scene.path().join("voices")], None).unwrap();
    let next = Compiler::default().pack_cached(&inputs, &path, &cache);
    assert_eq!((next.recalled, next.is_unchanged), (1, true));
    run(scene.path(), |build| build, &[("no.lipz", CLIP)]);
    assert!(String::from_utf8(outputs()[2].clone()).unwrap().contains("pub const NO:"), "a new clip has an id");
}

#[test]
fn errors_are_all_told_and_leave_the_outputs() {
    let scene = tempfile::tempdir().unwrap();
    run(scene.path(), |build| build, &[("aye.lipz", CLIP)]);
    let before = fs::read(scene.path().join("out/dialogue.lipzbank")).unwrap();
    let foreign = "{\n  \"viseme_type\": \"blair\",\n  \"visemes\": \"MAZ-\" }";
    let (lines, _) = run(scene.path(), |build| build, &[("b.lipz", foreign), ("c.lipz", ""), ("d.lipz", "{}")]);
    let told: Vec<&str> = lines.lines().filter(|line| !line.contains("rerun")).collect();
    assert_eq!(told.len(), 3, "{lines}");
    assert!(
        told[0].starts_with("cargo::error=SCENE/voices/b.lipz:3:17: `Z` is not a blair code [LZ0401]; "),
        "{lines}"
    );
    assert!(told[1].starts_with("cargo::error=SCENE/voices/c.lipz: the file is empty [LZ0002]"), "{lines}");
    assert!(told[2].starts_with("cargo::warning=SCENE/voices/d.lipz"), "{lines}");
    assert_eq!(fs::read(scene.path().join("out/dialogue.lipzbank")).unwrap(), before);
}

#[test]
fn clashes_and_bad_names_write_nothing() {
    let scene = tempfile::tempdir().unwrap();
    let (lines, names) = run(scene.path(), |build| build, &[("a-b.lipz", CLIP), ("a_b.lipz", CLIP)]);
    assert!(lines.contains("cargo::error=SCENE/voices: the keys `a-b` and `a_b` have the same"), "{lines}");
    assert_eq!(names, [""; 0]);
    fs::remove_file(scene.path().join("voices/a-b.lipz")).unwrap();
    for name in ["../x", "", "..", "x/"] {
        let (lines, names) = run(scene.path(), |build| build.name(name), &[]);
        assert!(lines.contains("[LZ0904]"), "{lines}");
        assert_eq!(names, [""; 0], "{name}");
    }
}

#[test]
fn split_locales_are_files_of_their_own() {
    let scene = tempfile::tempdir().unwrap();
    let clip = r#"{ "text_en-us": "Mayor!", "text_de-de": "Meister!" }"#;
    let (_, names) = run(scene.path(), |build| build.split_locales(true), &[("mayor.lipz", clip)]);
    let expected = ["dialogue.de-de.lipztexts", "dialogue.en-us.lipztexts", "dialogue.lipzbank", "dialogue.rs"];
    assert_eq!(names, expected);
    let read = |name: &str| fs::read(scene.path().join("out").join(name)).unwrap();
    let (base, german) = (read("dialogue.lipzbank"), read("dialogue.de-de.lipztexts"));
    let mut bank = Bank::open(&base).unwrap().verify().unwrap();
    assert!(bank.locale("de-de").is_none());
    assert!(bank.open_texts(&german).is_ok());
    let (lines, names) = run(scene.path(), |build| build.split_locales(true), &[("no.lipz", "")]);
    assert!(lines.contains("cargo::error="), "{lines}");
    assert_eq!(names, expected, "what was there stays");
}

#[test]
fn dubs_are_banks_of_their_own() {
    let scene = tempfile::tempdir().unwrap();
    let clip = r#"{ "viseme_type": "blair", "visemes": "MAE", "text_en-us": "Mayor!" }"#;
    let voices = || {
        Options::new()
            .default_locale("en-us")
            .unwrap()
            .voices(crate::project::Voices::new("en-us").unwrap().dub("de-de", "de/{key}").unwrap())
    };
    let files = [("mayor.lipz", clip), ("de/mayor.lipz", r#"{ "viseme_type": "blair", "visemes": "EAE" }"#)];
    let build = |build: Build| build.options(voices()).split_locales(true).split_voices(true);
    let (lines, names) = run(scene.path(), build, &files);
    assert!(!lines.contains("error"), "{lines}");
    assert_eq!(names, ["dialogue.de-de.lipzbank", "dialogue.lipzbank", "dialogue.rs"]);
    let read = |name: &str| fs::read(scene.path().join("out").join(name)).unwrap();
    let banks = [read("dialogue.lipzbank"), read("dialogue.de-de.lipzbank")];
    assert!(Bank::open(&banks[0]).unwrap().clip_by_key("de/mayor").is_none());
    lipz_testkit::dialogues::with(&[&banks[0], &banks[1]], |dialogue| {
        let voice = dialogue.voice("de-de").unwrap();
        assert_eq!(dialogue.clip_by_key("mayor").unwrap().in_voice(voice).clip.key(), "de/mayor");
    });
}

#[test]
fn a_path_cannot_leave_its_line() {
    assert_eq!(rerun_lines(&["a\nb".into()]), "cargo::rerun-if-changed=a\\nb\n");
}

#[test]
fn settings_hold_and_are_watched() {
    let scene = tempfile::tempdir().unwrap();
    let file = scene.path().join("lipz.toml");
    let by_settings = |text: &str| {
        fs::write(&file, text).unwrap();
        run(scene.path(), |_| Build::from_settings(&file), &[("act1/mayor.lipz", r#"{ "text": "Mayor!" }"#)])
    };
    let (lines, names) = by_settings("sources = [\"voices\"]\ndefault-locale = \"en-us\"\n");
    assert!(lines.starts_with("cargo::rerun-if-changed=SCENE/voices\ncargo::rerun-if-changed=SCENE/lipz.toml\n"));
    assert!(lines.contains("[LZ0502]") && !lines.contains("error"), "{lines}");
    assert_eq!(names, OUTPUTS);
    let (lines, _) = by_settings("sources = [\"voices\"]\n[audio]\nin-bank = true\n");
    assert!(lines.contains("cargo::error=the settings put recordings into the bank"), "{lines}");
    let (lines, _) = by_settings("default-local = \"en-us\"\n");
    assert!(lines.contains("cargo::error=SCENE/lipz.toml:1:1: "), "{lines}");
}

#[test]
fn the_settings_beside_the_sources_hold() {
    let scene = tempfile::tempdir().unwrap();
    let files = [("mayor.lipz", r#"{ "text": "Mayor!" }"#), ("lipz.toml", "default-locale = \"en-us\"\n")];
    let (lines, names) = run(scene.path(), |build| build, &files);
    let watched = "cargo::rerun-if-changed=SCENE/voices\ncargo::rerun-if-changed=SCENE/voices/lipz.toml\n";
    assert!(lines.starts_with(watched), "{lines}");
    assert!(lines.contains("[LZ0502]") && !lines.contains("error"), "{lines}");
    assert_eq!(names, OUTPUTS);
    let command = Settings::read(scene.path().join("voices/lipz.toml")).unwrap();
    let inputs = discover(&[scene.path().join("voices")], None).unwrap();
    let expected = Compiler::new(command.options).compile(&inputs).bank;
    assert_eq!(Some(fs::read(scene.path().join("out/dialogue.lipzbank")).unwrap()), expected);

    let options = Options::new().default_locale("de-de").unwrap();
    let (lines, _) = run(scene.path(), |build| build.options(options.clone()), &[]);
    assert!(
        lines.contains("warning=SCENE/voices/lipz.toml: the settings file `SCENE/voices/lipz.toml` is not used"),
        "{lines}"
    );
    let (lines, _) = run(scene.path(), |build| build.options(options).without_settings(), &[]);
    assert!(!lines.contains("lipz.toml"), "{lines}");
    let (lines, _) = run(scene.path(), Build::without_settings, &[]);
    assert!(lines.contains("cargo::error=") && lines.contains("[LZ0502]"), "{lines}");
}

#[test]
fn sources_that_do_not_exist_are_watched() {
    let scene = tempfile::tempdir().unwrap();
    let (lines, names) = run(scene.path(), |build| build.source("no/where"), &[("aye.lipz", CLIP)]);
    assert!(lines.contains("cargo::rerun-if-changed=no/where\n"), "{lines}");
    assert!(lines.contains("cargo::error=no/where: `no/where` does not exist [LZ0001]; help: check"), "{lines}");
    assert_eq!(names, [""; 0]);
}
