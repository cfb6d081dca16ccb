//! Banks that were split by locale, with their text banks: every command prints the same as for the whole bank.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use serde_json::Value;
use std::fs;
use support::{Outcome, Scene, lipz, tree};

const TEXTS: [&str; 2] = ["split.de-de.lipztexts", "split.en-us.lipztexts"];
const SPLIT: &str = "split.lipzbank+split.de-de.lipztexts+split.en-us.lipztexts";

/// Returns two clips, one of them without German, as `whole.lipzbank` and split.
fn scene() -> Scene {
    let scene = Scene::new();
    scene.write("voices/act1/aye.lipz", r#"{ "visemes": "AE-", "text_en-us": "Aye.", "text_de-de": "Ja." }"#);
    scene.write("voices/no.lipz", r#"{ "visemes": "SO-", "text_en-us": "{loud} No." }"#);
    let pack = ["pack", "voices", "--config", "default-locale=en-us", "--quiet", "-o"];
    scene.prepare(&[&pack[..], &["whole.lipzbank", "--config", "strip=true"]].concat());
    scene.prepare(&[&pack[..], &["split.lipzbank", "--config", "split-locales=true"]].concat());
    scene
}

/// Returns the outcomes of a command for the whole bank and for the split one.
fn both(scene: &Scene, command: &str, more: &[&str]) -> [Outcome; 2] {
    let [whole, split] = ["whole.lipzbank", SPLIT].map(|bank| lipz(scene.path(), [&[command, bank], more].concat()));
    assert_eq!((whole.code, split.code), (0, 0), "{}{}", whole.stderr, split.stderr);
    [whole, split]
}

#[test]
fn coverage_is_that_of_the_whole() {
    let scene = scene();
    for more in [&[][..], &["--show", "missing", "--locale", "de-de"], &["--output-format", "json"]] {
        let [whole, split] = both(&scene, "coverage", more);
        assert_eq!(split.stdout, whole.stdout.replace("whole.lipzbank", SPLIT));
    }
    let without = lipz(scene.path(), ["coverage", "split.lipzbank"]);
    assert!(without.stdout.contains("no clip has a text") && without.stdout.contains("BANK+TEXTS"), "{without:?}");
    let by_pattern = lipz(scene.path(), ["coverage", "split.lipzbank+split.*.lipztexts"]);
    assert!(by_pattern.code == 0 && by_pattern.stdout.contains("  de-de "), "{by_pattern:?}");
    let short = lipz(scene.path(), ["coverage", SPLIT, "--min-coverage", "90"]);
    assert_eq!(short.code, 1, "German is at 50 %");
    for minimum in ["90", "de-de=90"] {
        let nothing = lipz(scene.path(), ["coverage", "split.lipzbank", "--min-coverage", minimum]);
        assert_eq!((nothing.code, nothing.stderr.contains("BANK+TEXTS")), (1, true), "{}", nothing.stderr);
    }
    let json = lipz(scene.path(), ["coverage", "split.lipzbank", "--output-format", "json"]);
    assert_eq!((json.code, json.stdout.trim()), (0, "[]"));
    let csv = lipz(scene.path(), ["coverage", "split.lipzbank", "--as", "csv"]);
    assert!(csv.stdout.lines().count() == 1 && csv.stderr.contains("no clip has a text"), "{csv:?}");
}

#[test]
fn a_bank_and_its_texts_are_merged() {
    let scene = scene();
    let merge = |banks: &[&str]| scene.prepare(&[&["merge"], banks, &["-o", "merged.lipzbank", "--quiet"]].concat());
    merge(&["split.lipzbank", TEXTS[0], TEXTS[1]]);
    let read = |name: &str| fs::read(scene.path().join(name)).unwrap();
    let shown = |bank: &str, command: &[&str]| lipz(scene.path(), [command, &[bank]].concat()).stdout.replace(bank, "");
    let commands =
        [&["coverage", "--output-format", "json"][..], &["ids", "--lang", "json"], &["inspect", "--show", "clips"]];
    for command in commands {
        assert_eq!(shown("merged.lipzbank", command), shown("whole.lipzbank", command));
    }
    let merged = read("merged.lipzbank");
    for banks in [&["split.lipzbank", "split.*.lipztexts"][..], &[SPLIT]] {
        merge(banks);
        assert!(read("merged.lipzbank") == merged, "{banks:?}");
    }
    for bank in ["merged", "whole"] {
        scene.prepare(&["unpack", &format!("{bank}.lipzbank"), "-o", bank, "--quiet"]);
    }
    assert_eq!(tree(&scene.path().join("merged")), tree(&scene.path().join("whole")));
    let [whole, split] = both(&scene, "ids", &["--lang", "json"]);
    assert_eq!(whole.stdout, split.stdout);
    let depfile =
        ["pack", "voices", "--config", "split-locales=true", "-o", "d.lipzbank", "--depfile", "d.de-de.lipztexts"];
    let refused = lipz(scene.path(), depfile.into_iter().chain(["--config", "default-locale=en-us"]));
    assert_eq!((refused.code, refused.stderr.contains("are the same file")), (2, true), "{}", refused.stderr);
    assert!(read("d.de-de.lipztexts") == read("split.de-de.lipztexts"), "it is the text bank");
}

#[test]
fn statistics_count_the_texts() {
    let scene = scene();
    let [whole, split] = both(&scene, "inspect", &["--show", "stats", "--output-format", "json"]).map(|outcome| {
        let stats: Value = serde_json::from_str(&outcome.stdout).unwrap();
        stats
    });
    assert_eq!(split["locales"], whole["locales"]);
    let length = |name: &str| scene.path().join(name).metadata().unwrap().len();
    let texts_bytes = TEXTS.iter().map(|name| length(name)).sum::<u64>();
    assert_eq!((&whole["texts_bytes"], &split["texts_bytes"]), (&0.into(), &texts_bytes.into()));
    let [whole, split] = both(&scene, "inspect", &["--show", "stats"]);
    assert!(split.stdout.contains("  text banks ") && !whole.stdout.contains("  text banks "), "{}", split.stdout);
}

#[test]
fn differences_are_those_of_the_whole() {
    let scene = scene();
    let same = lipz(scene.path(), ["diff", "whole.lipzbank", SPLIT]);
    assert_eq!(same.code, 0, "{}{}", same.stdout, same.stderr);
    let shown = lipz(scene.path(), ["diff", "split.lipzbank+split.en-us.lipztexts", "whole.lipzbank"]);
    assert!(shown.code == 1 && shown.stdout.contains("\n+ locale de-de\n"), "{}", shown.stdout);
}

#[test]
fn unpacking_gives_all_texts() {
    let scene = scene();
    let [whole, _] = both(&scene, "unpack", &["-o", "out", "--overwrite"]);
    assert!(whole.stdout.contains("2 files unpacked into out (display texts, "), "{}", whole.stdout);
    fs::rename(scene.path().join("out"), scene.path().join("split")).unwrap();
    scene.prepare(&["unpack", "whole.lipzbank", "-o", "whole"]);
    for file in ["act1/aye.lipz", "no.lipz"] {
        let read = |folder: &str| fs::read_to_string(scene.path().join(folder).join(file)).unwrap();
        assert_eq!(read("split"), read("whole"), "{file}");
    }
    assert!(fs::read_to_string(scene.path().join("split/act1/aye.lipz")).unwrap().contains("Ja."));
    let without = lipz(scene.path(), ["unpack", "split.lipzbank", "-o", "without"]);
    assert!(without.stdout.contains("2 files unpacked into without (without texts; "), "{}", without.stdout);
}

#[test]
fn files_that_are_not_texts_of_the_bank_are_refused() {
    let scene = scene();
    scene.write("other/a.lipz", r#"{ "visemes": "M-", "text_fr-fr": "Non." }"#);
    scene.prepare(&["pack", "other", "-o", "other.lipzbank", "--config", "split-locales=true", "--quiet"]);
    let before = tree(scene.path());
    let refused = |file: &str, code: i32, message: &str| {
        for command in [&["coverage"][..], &["inspect", "--show", "stats"], &["inspect"], &["unpack", "-o", "out"]] {
            let run = lipz(scene.path(), [command, &[&format!("split.lipzbank+{file}")]].concat());
            assert!(run.code == code && run.stderr.contains(message), "{command:?} {file}: {}", run.stderr);
        }
        let run = lipz(scene.path(), ["diff", &format!("split.lipzbank+{file}"), "split.lipzbank"]);
        assert!(run.code == 2 && run.stderr.contains(message), "{file}: {}", run.stderr);
    };
    refused("nowhere.lipztexts", 2, "`nowhere.lipztexts` does not exist");
    refused("other.fr-fr.lipztexts", 1, "error[LZ0902]");
    let twice = lipz(scene.path(), ["inspect", "--show", "stats", &format!("{SPLIT}+{}", TEXTS[0])]);
    assert!(twice.code == 2 && twice.stderr.contains("the texts in `de-de` are named twice"), "{}", twice.stderr);
    let on_top = lipz(scene.path(), ["inspect", "--show", "stats", &format!("whole.lipzbank+{}", TEXTS[0])]);
    assert_eq!(on_top.code, 2, "{}", on_top.stderr);
    let first = lipz(scene.path(), ["inspect", &format!("{}+split.lipzbank", TEXTS[0])]);
    assert!(first.code == 1 && first.stderr.contains("name the bank that it belongs to before it"), "{first:?}");
    assert_eq!(tree(scene.path()), before);
}

#[test]
fn text_banks_are_verified_with_the_bank_before_them() {
    let scene = scene();
    let verify = |files: &[&str]| lipz(scene.path(), [&["verify"], files].concat());
    let all = verify(&["whole.lipzbank", "split.lipzbank", "split.*.lipztexts", "whole.lipzbank"]);
    let names: Vec<&str> =
        all.stdout.lines().filter_map(|line| line.split_once(": no fault (")).map(|(name, _)| name).collect();
    assert_eq!((all.code, names), (0, vec!["whole.lipzbank", "split.lipzbank", TEXTS[0], TEXTS[1], "whole.lipzbank"]));
    let mut bytes = fs::read(scene.path().join(TEXTS[1])).unwrap();
    *bytes.last_mut().unwrap() ^= 1;
    scene.write(TEXTS[1], bytes);
    let damaged = verify(&["split.lipzbank", TEXTS[1], TEXTS[0]]);
    assert!(damaged.code == 1 && damaged.stderr.contains("[LZ0903]"), "{damaged:?}");
    assert_eq!(damaged.stdout.lines().count(), 2, "the other banks are still checked: {damaged:?}");
    assert_eq!(verify(&[TEXTS[0]]).code, 1, "no bank comes before it");
}

/// Settings and levels apply to Lipz files. With a bank, they are refused because they would not have an effect.
#[test]
fn a_bank_takes_no_settings_and_no_levels() {
    let scene = scene();
    scene.write("lipz.toml", "strip = true\n");
    let options: [&[&str]; 5] = [
        &["--config", "strip=true"],
        &["--config", "lipz.toml"],
        &["--allow", "unknown-emotion"],
        &["--warn", "unknown-emotion"],
        &["--deny", "warnings"],
    ];
    let commands: [&[&str]; 8] = [
        &["inspect", "whole.lipzbank"],
        &["inspect", SPLIT, "no"],
        &["inspect", "whole.lipzbank", "--show", "clips"],
        &["inspect", "whole.lipzbank", "--show", "stats"],
        &["coverage", "whole.lipzbank"],
        &["diff", "whole.lipzbank", SPLIT],
        &["ids", "whole.lipzbank", "--lang", "json"],
        &["preview", "whole.lipzbank", "--output", "site"],
    ];
    for command in commands {
        for option in options {
            let refused = lipz(scene.path(), [command, option].concat());
            assert_eq!((refused.code, refused.stdout.as_str()), (2, ""), "{command:?} {option:?}");
            let is_told = refused.stderr.contains("[LZ1601]")
                && refused.stderr.contains("is a bank")
                && refused.stderr.contains(option[0]);
            assert!(is_told, "{command:?} {option:?}: {}", refused.stderr);
        }
        assert!(!scene.path().join("site").exists(), "{command:?}");
    }
    for command in commands {
        assert_eq!(lipz(scene.path(), command).code, 0, "{command:?}: without options there is nothing to refuse");
    }
    // They apply to the other side.
    let diff = ["diff", "whole.lipzbank", "voices", "--config", "default-locale=en-us"];
    assert_eq!(lipz(scene.path(), diff).code, 0);
}
