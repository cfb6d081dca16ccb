//! `lipz check --cache` reports the same as without a cache, for any changes to the files.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use std::time::Duration;
use support::{Scene, lipz};

/// The time that a file must stay unchanged before its metadata proves that it is unchanged.
const SETTLING: Duration = Duration::from_millis(2100);

fn clip(source: &str, translation: &str) -> String {
    format!(
        r#"{{ "fps": 24, "viseme_type": "blair", "visemes": "MA-", "text_en-us": "{source}", "text_de-de": "{translation}" }}"#
    )
}

#[test]
fn the_findings_are_the_same() {
    let scene = Scene::new();
    let settings = |levels: &str| format!("default-locale = \"en-us\"\nsources = [\"voices\"]\n[lints]\n{levels}");
    scene.write("lipz.toml", settings(""));
    for number in 0..12 {
        scene.write(&format!("voices/{number}.lipz"), clip(&format!("Line {number}."), &format!("Zeile {number}.")));
    }
    std::thread::sleep(SETTLING);
    let voices = |name: &str| scene.path().join("voices").join(name);
    let check = |what: &str| {
        let without = lipz(scene.path(), ["check"]);
        for _ in 0..2 {
            let with = lipz(scene.path(), ["check", "--cache", "check.cache"]);
            assert_eq!(
                (&with.stdout, &with.stderr, with.code),
                (&without.stdout, &without.stderr, without.code),
                "{what}"
            );
        }
        without
    };
    let first = check("at first");
    assert!(first.code == 0 && first.stdout.contains("lipz cannot detect stale translations yet"), "{first:?}");
    scene.write("voices/1.lipz", clip("Line 1.", "Zeile 2."));
    assert!(check("another number").stderr.contains("voices/1.lipz"));
    scene.write("lipz.toml", settings("numbers-differ = \"deny\"\n"));
    assert_eq!(check("another level").code, 1);
    scene.write("voices/2.lipz", "{ \"text_en-us\": ");
    check("an error");
    scene.write("voices/3.lipz", r#"{ "fps": 24, "viseme_type": "blair", "visemes": "MA-", "text_en-us": "Alone." }"#);
    check("a translation that is gone");
    scene.write("voices/2.lipz", clip("Line 2.", "Zeile 2."));
    scene.write("voices/1.lipz", clip("Line 1.", "Zeile 1."));
    assert_eq!(check("mended").code, 0);
    scene.prepare(&["approve", "--all"]);
    let recorded = check("a record");
    assert!(recorded.code == 0 && !recorded.stdout.contains("cannot detect"), "{recorded:?}");
    scene.write("voices/4.lipz", clip("Another line 4.", "Zeile 4."));
    assert!(check("a stale translation").stderr.contains("voices/4.lipz"));
    fs::rename(voices("4.lipz"), voices("5-new.lipz")).unwrap();
    assert!(check("it is also stale under a different name").stderr.contains("voices/5-new.lipz"));
    fs::rename(voices("6.lipz"), voices("7-new.lipz")).unwrap();
    check("a renamed file");
    fs::remove_file(voices("7.lipz")).unwrap();
    check("a removed file");
    fs::remove_file(scene.path().join("lipz-texts.txt")).unwrap();
    assert!(check("without the record").stdout.contains("cannot detect stale"));
    scene.write("lipz.toml", settings("") + "[voices]\nen-us = \"{key}\"\nde-de = \"de/{key}\"\n");
    check("voices");
}

/// The lines of a record name files relative to its folder, so the same bytes in a different folder mean different
/// files.
#[test]
fn a_record_that_moves_is_another_one() {
    let scene = Scene::new();
    let settings = "default-locale = \"en-us\"\nsources = [\"voices\"]\n";
    scene.write("voices/a.lipz", clip("Line 1.", "Zeile 1."));
    scene.write("voices/lipz.toml", settings.replace("\"voices\"", "\".\""));
    scene.prepare(&["approve", "--all", "--config", "voices/lipz.toml"]);
    scene.write("voices/a.lipz", clip("Another line 1.", "Andere Zeile 1."));
    scene.write("lipz.toml", settings);
    fs::rename(scene.path().join("voices/lipz-texts.txt"), scene.path().join("lipz-texts.txt")).unwrap();
    std::thread::sleep(SETTLING);
    let check = |settings: &str| lipz(scene.path(), ["check", "--config", settings, "--cache", "check.cache"]);
    for _ in 0..2 {
        let beside = check("lipz.toml");
        assert!(
            beside.code == 0 && !beside.stderr.contains("LZ1911"),
            "the record does not contain the file: {beside:?}"
        );
    }
    fs::rename(scene.path().join("lipz-texts.txt"), scene.path().join("voices/lipz-texts.txt")).unwrap();
    for _ in 0..2 {
        let stale = check("voices/lipz.toml");
        assert!(stale.stderr.contains("LZ1911"), "{stale:?}");
    }
}

#[test]
fn a_cache_replaces_nothing_but_a_cache() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", clip("Aye.", "Ja."));
    scene.prepare(&["pack", "voices", "-o", "a.lipzbank", "--cache", "pack.cache"]);
    for (cache, why) in [
        ("voices/a.lipz", "is the name of a Lipz file"),
        ("a.lipzbank", "is not a lipz cache and is not overwritten"),
        ("pack.cache", "is the cache of a bank and is not overwritten"),
        ("voices", "is not a lipz cache and is not overwritten"),
    ] {
        let before = fs::read(scene.path().join(cache)).ok();
        let refused = lipz(scene.path(), ["check", "voices", "--cache", cache]);
        assert!(refused.code == 2 && refused.stderr.contains(why), "{refused:?}");
        assert_eq!(fs::read(scene.path().join(cache)).ok(), before);
    }
    scene.prepare(&["check", "voices", "--cache", "check.cache"]);
    let refused = lipz(scene.path(), ["pack", "voices", "-o", "a.lipzbank", "--cache", "check.cache"]);
    assert!(refused.code == 2 && refused.stderr.contains("is a cache of `lipz check`"), "{refused:?}");
}
