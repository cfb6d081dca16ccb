//! Banks that were split by locale, with their text banks: every command answers as about the whole.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use serde_json::Value;
use std::fs;
use support::{Outcome, Scene, lipz, tree};

const TEXTS: [&str; 3] = ["--texts", "split.de-de.lipztexts", "split.en-us.lipztexts"];

/// Two clips, one of them without German, as `whole.lipzbank` and split.
fn scene() -> Scene {
    let scene = Scene::new();
    scene.write("voices/act1/aye.lipz", r#"{ "visemes": "AE-", "text_en-us": "Aye.", "text_de-de": "Ja." }"#);
    scene.write("voices/no.lipz", r#"{ "visemes": "SO-", "text_en-us": "{loud} No." }"#);
    let pack = ["pack", "voices", "--default-locale", "en-us", "--quiet", "-o"];
    scene.prepare(&[&pack[..], &["whole.lipzbank", "--strip"]].concat());
    scene.prepare(&[&pack[..], &["split.lipzbank", "--split-locales"]].concat());
    scene
}

/// What a command prints about the whole bank, and about the split one.
fn both(scene: &Scene, command: &str, more: &[&str]) -> [Outcome; 2] {
    let whole = lipz(scene.path(), [&[command, "whole.lipzbank"], more].concat());
    let split = lipz(scene.path(), [&[command, "split.lipzbank"], more, &TEXTS].concat());
    assert_eq!((whole.code, split.code), (0, 0), "{}{}", whole.stderr, split.stderr);
    [whole, split]
}

#[test]
fn coverage_is_that_of_the_whole() {
    let scene = scene();
    for more in [&[][..], &["--missing", "de-de"], &["--json"]] {
        let [whole, split] = both(&scene, "coverage", more);
        assert_eq!(split.stdout, whole.stdout.replace("whole.", "split."));
    }
    let without = lipz(scene.path(), ["coverage", "split.lipzbank"]);
    assert!(without.stdout.contains("no clip has a text") && without.stdout.contains("(--texts)"), "{without:?}");
    let by_pattern = lipz(scene.path(), ["coverage", "split.lipzbank", "--texts", "split.*.lipztexts"]);
    assert!(by_pattern.code == 0 && by_pattern.stdout.contains("  de-de "), "{by_pattern:?}");
    let short = lipz(scene.path(), [&["coverage", "split.lipzbank", "--min-coverage", "90"][..], &TEXTS].concat());
    assert_eq!(short.code, 1, "German is at 50 %");
    for minimum in ["90", "de-de=90"] {
        let nothing = lipz(scene.path(), ["coverage", "split.lipzbank", "--min-coverage", minimum]);
        assert_eq!((nothing.code, nothing.stderr.contains("--texts")), (1, true), "{}", nothing.stderr);
    }
    let json = lipz(scene.path(), ["coverage", "split.lipzbank", "--json"]);
    assert!(json.stdout.trim() == "[]" && json.stderr.contains("no clip has a text"), "{}", json.stderr);
}

#[test]
fn a_bank_and_its_texts_are_merged() {
    let scene = scene();
    scene.prepare(&[&["merge", "split.lipzbank", "-o", "merged.lipzbank", "--quiet"][..], &TEXTS].concat());
    let read = |name: &str| fs::read(scene.path().join(name)).unwrap();
    let shown = |bank: &str, command: &[&str]| lipz(scene.path(), [command, &[bank]].concat()).stdout.replace(bank, "");
    for command in [&["coverage", "--json"][..], &["ids", "--lang", "json"], &["inspect", "--list"]] {
        assert_eq!(shown("merged.lipzbank", command), shown("whole.lipzbank", command));
    }
    for bank in ["merged", "whole"] {
        scene.prepare(&["unpack", &format!("{bank}.lipzbank"), "-o", bank, "--quiet"]);
    }
    assert_eq!(tree(&scene.path().join("merged")), tree(&scene.path().join("whole")));
    let [whole, split] = both(&scene, "ids", &["--lang", "json"]);
    assert_eq!(whole.stdout, split.stdout);
    let depfile = ["pack", "voices", "--split-locales", "-o", "d.lipzbank", "--depfile", "d.de-de.lipztexts"];
    let refused = lipz(scene.path(), depfile.into_iter().chain(["--default-locale", "en-us"]));
    assert_eq!((refused.code, refused.stderr.contains("are one file")), (2, true), "{}", refused.stderr);
    assert!(read("d.de-de.lipztexts") == read("split.de-de.lipztexts"), "it is the text bank");
}

#[test]
fn statistics_count_the_texts() {
    let scene = scene();
    let [whole, split] = both(&scene, "stats", &["--json"]).map(|outcome| {
        let stats: Value = serde_json::from_str(&outcome.stdout).unwrap();
        stats
    });
    assert_eq!(split["locales"], whole["locales"]);
    let length = |name: &str| scene.path().join(name).metadata().unwrap().len();
    let texts_bytes = TEXTS[1..].iter().map(|name| length(name)).sum::<u64>();
    assert_eq!((&whole["texts_bytes"], &split["texts_bytes"]), (&0.into(), &texts_bytes.into()));
    let [whole, split] = both(&scene, "stats", &[]);
    assert!(split.stdout.contains("  text banks ") && !whole.stdout.contains("  text banks "), "{}", split.stdout);
}

#[test]
fn differences_are_those_of_the_whole() {
    let scene = scene();
    let same = [&["diff", "whole.lipzbank", "split.lipzbank", "--new-texts"], &TEXTS[1..]].concat();
    let same = lipz(scene.path(), same);
    assert_eq!(same.code, 0, "{}{}", same.stdout, same.stderr);
    let without_german = ["diff", "split.lipzbank", "whole.lipzbank", "--old-texts", "split.en-us.lipztexts"];
    let shown = lipz(scene.path(), without_german);
    assert!(shown.code == 1 && shown.stdout.contains("\n+ locale de-de\n"), "{}", shown.stdout);
}

#[test]
fn unpacking_gives_all_texts() {
    let scene = scene();
    let [whole, _] = both(&scene, "unpack", &["-o", "out", "--force"]);
    assert!(whole.stdout.contains("2 files unpacked into out (display forms: "), "{}", whole.stdout);
    fs::rename(scene.path().join("out"), scene.path().join("split")).unwrap();
    scene.prepare(&["unpack", "whole.lipzbank", "-o", "whole"]);
    for file in ["act1/aye.lipz", "no.lipz"] {
        let read = |folder: &str| fs::read_to_string(scene.path().join(folder).join(file)).unwrap();
        assert_eq!(read("split"), read("whole"), "{file}");
    }
    assert!(fs::read_to_string(scene.path().join("split/act1/aye.lipz")).unwrap().contains("Ja."));
    let without = lipz(scene.path(), ["unpack", "split.lipzbank", "-o", "without"]);
    assert!(without.stdout.contains("2 files unpacked into without (no texts: "), "{}", without.stdout);
}

#[test]
fn files_that_are_not_texts_of_the_bank_are_refused() {
    let scene = scene();
    scene.write("other/a.lipz", r#"{ "visemes": "M-", "text_fr-fr": "Non." }"#);
    scene.prepare(&["pack", "other", "-o", "other.lipzbank", "--split-locales", "--quiet"]);
    let before = tree(scene.path());
    let refused = |file: &str, code: i32, message: &str| {
        for command in [&["coverage"][..], &["stats"], &["inspect"], &["unpack", "-o", "out"]] {
            let run = lipz(scene.path(), [command, &["split.lipzbank", "--texts", file]].concat());
            assert!(run.code == code && run.stderr.contains(message), "{command:?} {file}: {}", run.stderr);
        }
        let run = lipz(scene.path(), ["diff", "split.lipzbank", "split.lipzbank", "--old-texts", file]);
        assert!(run.code == 2 && run.stderr.contains(message), "{file}: {}", run.stderr);
    };
    refused("nowhere.lipztexts", 2, "`nowhere.lipztexts` does not exist");
    refused("other.fr-fr.lipztexts", 1, "error[LZ0902]");
    let twice = lipz(scene.path(), ["stats", "split.lipzbank", "--texts", TEXTS[1], TEXTS[2], TEXTS[1]]);
    assert!(twice.code == 2 && twice.stderr.contains("the texts in `de-de` are named twice"), "{}", twice.stderr);
    let on_top = lipz(scene.path(), ["stats", "whole.lipzbank", "--texts", TEXTS[1]]);
    assert_eq!(on_top.code, 2, "{}", on_top.stderr);
    assert_eq!(tree(scene.path()), before);
    // All that stands behind the flag is taken for text banks, so the usage has the bank before it.
    let behind = lipz(scene.path(), ["unpack", "-o", "out", "--texts", TEXTS[1], "split.lipzbank"]);
    assert!(behind.code == 2 && behind.stderr.contains("usage: lipz unpack <BANK> --output <FOLDER>"), "{behind:?}");
}
