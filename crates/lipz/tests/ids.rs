//! `lipz ids`: from sources and from banks, to a file and to standard output.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use lipz_bank::ClipId;
use std::fs;
use support::{Scene, lipz, tree};

const CLIP: &str = r#"{ "text_en-us": "Aye." }"#;

#[test]
fn sources_and_their_bank_have_the_same_ids() {
    let scene = Scene::new();
    scene.write("voices/act1/otto-aye.lipz", CLIP);
    scene.prepare(&["pack", "voices", "-o", "b.lipzbank"]);
    for language in ["rust", "c", "csharp", "typescript", "json"] {
        let of_bank = lipz(scene.path(), ["ids", "b.lipzbank", "--lang", language]);
        let of_sources = lipz(scene.path(), ["ids", "voices", "--lang", language]);
        assert_eq!((of_bank.code, of_bank.stderr.as_str()), (0, ""), "{language}");
        assert_eq!(of_bank.stdout, of_sources.stdout, "{language}");
        assert!(of_bank.stdout.contains(&ClipId::from_key("act1/otto-aye").to_string()), "{}", of_bank.stdout);
    }
}

#[test]
fn a_file_is_replaced_and_a_prefix_used() {
    let scene = Scene::new();
    scene.write("voices/aye.lipz", CLIP);
    scene.write("include/ids.h", "old");
    let arguments = ["ids", "voices", "--lang", "c", "--prefix", "GAME_", "-o", "include/ids.h"];
    let outcome = lipz(scene.path(), arguments);
    assert_eq!((outcome.code, outcome.stdout.as_str()), (0, "1 id written to include/ids.h\n"), "{}", outcome.stderr);
    assert!(fs::read_to_string(scene.path().join("include/ids.h")).unwrap().contains("#define GAME_AYE UINT64_C("));

    let stamp = || fs::metadata(scene.path().join("include/ids.h")).unwrap().modified().unwrap();
    let written = stamp();
    scene.write("voices/aye.lipz", r#"{ "text_en-us": "Aye.", "events": "ring" }"#);
    assert_eq!(lipz(scene.path(), arguments).stdout, "1 id unchanged in include/ids.h\n");
    assert_eq!(stamp(), written, "what includes it is not compiled again");
}

#[test]
fn two_keys_with_one_identifier() {
    let mut scene = Scene::new();
    for name in ["mara-hello", "mara_hello", "mara", "MaraHello"] {
        scene.write(&format!("voices/act1/{name}.lipz"), CLIP);
    }
    scene.prepare(&["pack", "voices", "-o", "b.lipzbank"]);
    let before = tree(scene.path());
    scene.expect("LZ1201-identifier-clash", &["ids", "voices", "--lang", "rust", "-o", "ids.rs"]);
    scene.expect("LZ1201-identifier-clash-bank", &["ids", "b.lipzbank", "--lang", "csharp"]);
    assert_eq!(tree(scene.path()), before, "nothing was written");
    assert_eq!(lipz(scene.path(), ["ids", "voices", "--lang", "json"]).code, 0, "JSON has keys, not identifiers");
    scene.finish(2);
}

#[test]
fn sources_with_errors_have_no_ids() {
    let scene = Scene::new();
    scene.write("voices/aye.lipz", CLIP);
    scene.write("voices/no.lipz", "");
    let outcome = lipz(scene.path(), ["ids", "voices", "--lang", "c"]);
    assert_eq!((outcome.code, outcome.stdout.as_str()), (1, ""));
    assert!(outcome.stderr.contains("error[LZ0002]"), "{}", outcome.stderr);
    scene.write("no.lipzbank", "no bank");
    assert!(lipz(scene.path(), ["ids", "no.lipzbank", "--lang", "c"]).stderr.contains("error[LZ0902]"));
}

#[test]
fn prefixes_that_no_language_takes_are_usage_errors() {
    let scene = Scene::new();
    for (language, prefix) in
        [("c", "my game"), ("c", "LIPZ_"), ("c", "_GAME_"), ("csharp", "Game."), ("rust", "game"), ("json", "x")]
    {
        let outcome = lipz(scene.path(), ["ids", "voices", "--lang", language, "--prefix", prefix]);
        assert_eq!(outcome.code, 2, "{language}: {}", outcome.stderr);
        assert!(outcome.stderr.contains("prefix"), "{}", outcome.stderr);
    }
}
