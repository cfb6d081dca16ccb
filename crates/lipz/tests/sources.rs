//! Diagnostics about sources and keys, with inputs that cannot be in the repository: names that some systems refuse,
//! links, files that cannot be read.
//!
//! Systems have different error messages and refuse different names, so most of this runs only on Unix, and some of it
//! only on Linux.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use std::os::unix::fs::symlink;
use support::Scene;

const CLIP: &str = r#"{ "text_en-us": "Aye." }"#;

#[test]
fn sources_without_lipz_files() {
    let mut scene = Scene::new();
    scene.write("voices/notes.txt", "Otto: Aye.");
    scene.expect("LZ0805-no-sources-folder", &["check", "voices"]);
    scene.expect("LZ0805-no-sources-pattern", &["check", "voices/**/*.lipz"]);
    scene.expect("LZ0805-no-sources-bad-pattern", &["check", "voices/***/*.lipz"]);
    scene.write("more/aye.lipz", CLIP);
    scene.expect("LZ0805-no-sources-one-of-two", &["check", "voices", "more", "--quiet"]);
    scene.finish(4);
}

#[test]
fn sources_that_cannot_be_read() {
    let mut scene = Scene::new();
    scene.expect("LZ0001-unreadable-file-missing", &["check", "nowhere"]);
    scene.write("voices/aye.lipz", CLIP);
    scene.write("voices/empty.lipz", "");
    symlink("../recordings/no.lipz", scene.path().join("voices/no.lipz")).unwrap();
    // The other files of the folder are still checked.
    scene.expect("LZ0001-unreadable-file-dangling-link", &["check", "voices"]);
    fs::remove_file(scene.path().join("voices/no.lipz")).unwrap();
    fs::remove_file(scene.path().join("voices/empty.lipz")).unwrap();
    fs::create_dir(scene.path().join("voices/act1")).unwrap();
    symlink("../../voices", scene.path().join("voices/act1/all")).unwrap();
    scene.expect("LZ0001-unreadable-file-link-loop", &["check", "voices"]);
    scene.finish(3);
}

/// A file whose first page cannot be read, not even by root.
#[cfg(target_os = "linux")]
#[test]
fn a_file_that_opens_and_cannot_be_read() {
    let mut scene = Scene::new();
    scene.write("voices/aye.lipz", CLIP);
    symlink("/proc/self/mem", scene.path().join("voices/no.lipz")).unwrap();
    scene.expect("LZ0001-unreadable-file-input-output", &["check", "voices"]);
    scene.finish(1);
}

#[test]
fn a_file_larger_than_a_clip_can_be() {
    let mut scene = Scene::new();
    fs::create_dir(scene.path().join("voices")).unwrap();
    let file = fs::File::create(scene.path().join("voices/film.lipz")).unwrap();
    file.set_len(u64::try_from(lipz_file::MAX_FILE_BYTES).unwrap() + 1).unwrap(); // sparse: no blocks are written
    scene.expect("LZ0006-file-too-large", &["check", "voices"]);
    scene.finish(1);
}

#[test]
fn clips_for_which_a_bank_has_no_room() {
    let mut scene = Scene::new();
    let speech = "Bell ".repeat(14_000);
    scene.write("voices/speech.lipz", format!("{{\n  \"text_en-us\" : \"Hear me: |{speech}|Aye.\"\n}}\n"));
    scene.expect("LZ0901-bank-too-large-text", &["check", "voices"]);
    scene.write("voices/speech.lipz", format!("{{\n  \"visemes\" : \"{}\"\n}}\n", "A-|".repeat(70_000)));
    scene.expect("LZ0901-bank-too-large-segments", &["check", "voices"]);
    scene.finish(2);
}

#[test]
fn keys_that_cannot_be_file_names_everywhere() {
    let mut scene = Scene::new();
    for name in
        ["con", "act1/AUX.take2", "act1./hello", "what?", "say \"aye\"", "a:b", "tab\there", " blank", "old.lipz/aye"]
    {
        scene.write(&format!("voices/{name}.lipz"), CLIP);
    }
    scene.write("voices/日本/はい .lipz", CLIP);
    scene.expect("LZ0803-refused-key", &["check", "voices"]);
    scene.write("more/aye.lipz", CLIP);
    scene.expect("LZ0803-refused-key-not-below-root", &["check", "more", "--config", "root=voices"]);
    scene.expect("LZ0803-refused-key-parent-folder", &["check", "more/../more/aye.lipz", "--config", "root=more"]);
    scene.finish(3);
}

#[cfg(target_os = "linux")]
#[test]
fn a_name_that_is_not_unicode() {
    use std::os::unix::ffi::OsStrExt;
    let mut scene = Scene::new();
    scene.write("voices/aye.lipz", CLIP);
    let name = std::ffi::OsStr::from_bytes(b"gel\xF6scht.lipz");
    fs::write(scene.path().join("voices").join(name), CLIP).unwrap();
    scene.expect("LZ0803-refused-key-not-unicode", &["check", "voices"]);
    scene.finish(1);
}

/// Names that macOS and Windows treat as one file, so that only Linux can have both.
#[cfg(target_os = "linux")]
#[test]
fn keys_that_are_one_file_on_some_systems() {
    let mut scene = Scene::new();
    for name in ["otto-aye", "Otto-Aye", "OTTO-aye"] {
        scene.write(&format!("case/{name}.lipz"), CLIP);
    }
    scene.expect("LZ0801-key-clash-case", &["check", "case"]);
    for name in ["\u{C4}rger", "A\u{308}rger"] {
        scene.write(&format!("normalisation/{name}.lipz"), CLIP);
    }
    scene.expect("LZ0801-key-clash-normalisation", &["check", "normalisation"]);
    for name in ["Straße", "STRASSE"] {
        scene.write(&format!("folding/{name}.lipz"), CLIP);
    }
    scene.expect("LZ0801-key-clash-folding", &["check", "folding"]);
    scene.finish(3);
}

#[test]
fn the_same_key_from_two_sources() {
    let mut scene = Scene::new();
    scene.write("act1/otto/aye.lipz", CLIP);
    scene.write("act2/otto/aye.lipz", CLIP);
    scene.expect("LZ0802-duplicate-key", &["check", "act1", "act2"]);
    // A common root distinguishes them, as stated in the help.
    assert_eq!(support::lipz(scene.path(), ["check", "act1", "act2", "--config", "root=."]).code, 0);
    scene.finish(1);
}

/// `lipz_compiler::discover`: "a file named by several sources counts once".
#[test]
fn a_file_named_by_several_sources_counts_once() {
    let scene = Scene::new();
    scene.write("voices/act1/aye.lipz", CLIP);
    for sources in [
        &["voices", "voices"][..],
        &["voices", "./voices"],
        &["voices/", "voices"],
        &["voices", "voices/**/*.lipz"],
        &["voices", "voices/act1", "--config", "root=voices"],
        &["voices", "voices/act1"],
        &["voices/act1", "voices"],
    ] {
        let outcome = support::lipz(scene.path(), ["check"].iter().chain(sources));
        assert_eq!((outcome.code, outcome.stdout.as_str()), (0, "1 file checked\n"), "{sources:?}: {}", outcome.stderr);
    }
}

/// `lipz_compiler::discover`: "under the key that the first of them gives it".
#[test]
fn the_first_source_gives_a_file_its_key() {
    let scene = Scene::new();
    scene.write("voices/act1/aye.lipz", CLIP);
    scene.write("voices/no.lipz", CLIP);
    for (sources, keys) in [(["voices", "voices/act1"], ["act1/aye", "no"]), (["voices/act1", "voices"], ["aye", "no"])]
    {
        scene.prepare(&["pack", sources[0], sources[1], "-o", "b.lipzbank"]);
        let list = support::lipz(scene.path(), ["inspect", "b.lipzbank", "--show", "clips"]);
        let listed: Vec<&str> = list.stdout.lines().filter_map(|line| line.split(' ').next()).collect();
        assert_eq!(listed, keys, "{sources:?}");
    }
}

/// Two keys with the same id by design: both have two words of eight bytes, and the second word cancels the difference
/// from the first one (`ClipId::from_key`).
#[test]
fn keys_with_the_same_id() {
    let keys = ["act1-ott-goodbye", "acjbelgad764-2ne"];
    assert_eq!(lipz_bank::ClipId::from_key(keys[0]), lipz_bank::ClipId::from_key(keys[1]), "find a different pair");
    let mut scene = Scene::new();
    for key in keys {
        scene.write(&format!("voices/{key}.lipz"), CLIP);
    }
    scene.expect("LZ0804-id-collision", &["pack", "voices", "-o", "voices.lipzbank"]);
    assert!(!scene.path().join("voices.lipzbank").exists());
    scene.finish(1);
}
