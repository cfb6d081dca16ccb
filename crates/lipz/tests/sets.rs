//! Sets of banks on the command line: linked, verified, inspected, unpacked. They stay complete at any time.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::Duration;
use support::{Scene, lipz};

/// Returns a project with dubs and two locales, and its bank from a single run.
fn scene() -> Scene {
    let scene = Scene::new();
    let settings = "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n[voices]\nde-de = \"de/{key}\"\n";
    scene.write("lipz.toml", settings);
    for line in 0..20 {
        let german = if line % 3 == 0 { r#", "text_de-de": "Ja, {laut} und wie." "# } else { "" };
        let file = format!(r#"{{ "fps": 24, "visemes": "AEE-", "text_en-us": "Aye, {line}."{german} }}"#);
        scene.write(&format!("voices/act/line-{line}.lipz"), &file);
        if line % 4 == 0 {
            scene.write(&format!("voices/de/act/line-{line}.lipz"), r#"{ "fps": 24, "visemes": "OO-" }"#);
        }
    }
    scene
}

/// Plans the project in four shards, and packs them.
fn pack(scene: &Scene) {
    scene.prepare(&["shard", "plan", "pack", "--shards", "4", "-o", "build/plan.json", "--quiet"]);
    for shard in ["0", "1", "2", "3"] {
        let object = format!("build/{shard}-of-4.lipzobj");
        scene.prepare(&["shard", "pack", "build/plan.json", shard, "-o", &object, "--quiet"]);
    }
}

const LINK: [&str; 6] = ["shard", "link", "build/*-of-4.lipzobj", "-o", "out/dialogue.lipzset", "--quiet"];

/// Returns the banks of the set.
fn banks(scene: &Scene) -> Vec<PathBuf> {
    let files = fs::read_dir(scene.path().join("out")).unwrap().map(|file| file.unwrap().path());
    let mut banks: Vec<_> = files.filter(|path| path.extension().is_some_and(|kind| kind == "lipzbank")).collect();
    banks.sort();
    banks
}

#[test]
fn a_set_is_linked_verified_inspected_and_unpacked() {
    let scene = scene();
    pack(&scene);
    let linked = lipz(scene.path(), &LINK[..5]);
    assert!(
        linked.code == 0 && linked.stdout.starts_with("4 banks linked into the set out/dialogue.lipzset (25 clips")
    );
    assert_eq!(banks(&scene).len(), 4);
    let verified = lipz(scene.path(), ["verify", "out/dialogue.lipzset"]);
    assert!(verified.stdout.contains("no fault (4 banks, 25 clips, "), "{verified:?}");
    let summary = lipz(scene.path(), ["inspect", "out/dialogue.lipzset"]);
    assert!(summary.stdout.contains("set of 4 banks") && summary.stdout.contains("in the bank of their line"));
    let json = lipz(scene.path(), ["inspect", "out/dialogue.lipzset", "--output-format", "json"]);
    let json: serde_json::Value = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!((json["clips"].as_u64(), json["banks"].as_array().map(Vec::len)), (Some(25), Some(4)));
    scene.prepare(&["pack", "-o", "whole.lipzbank", "--quiet"]);
    for key in ["act/line-3", "de/act/line-8", "act/line-7"] {
        let [one, other] =
            ["out/dialogue.lipzset", "whole.lipzbank"].map(|bank| lipz(scene.path(), ["inspect", bank, key]));
        assert_eq!((one.code, &one.stdout), (0, &other.stdout), "{key}");
    }
    let refused = lipz(scene.path(), ["inspect", "out/dialogue.lipzset", "--locale", "de-de"]);
    assert!(refused.code == 2 && refused.stderr.contains("--locale"), "not silently ignored: {refused:?}");
    for more in [&[][..], &["act/line-3"], &["--show", "clips"], &["--show", "stats"]] {
        let options = ["--config", "strip=true"];
        let refused = lipz(scene.path(), [&["inspect", "out/dialogue.lipzset"], more, &options].concat());
        assert!(refused.code == 2 && refused.stderr.contains("is a bank"), "{more:?}: {refused:?}");
    }
    let listed = lipz(scene.path(), ["inspect", "out/dialogue.lipzset", "de/", "--show", "clips"]);
    assert_eq!(listed.stdout.lines().count(), 5, "{listed:?}");
    let listed = lipz(scene.path(), ["inspect", "out/dialogue.lipzset", "--show", "clips", "--output-format", "json"]);
    let listed: serde_json::Value = serde_json::from_str(&listed.stdout).unwrap();
    assert_eq!(listed.as_array().map(Vec::len), Some(25));
    scene.prepare(&["unpack", "out/dialogue.lipzset", "-o", "again", "--quiet"]);
    for path in ["act/line-3.lipz", "de/act/line-8.lipz"] {
        assert!(scene.path().join("again").join(path).is_file(), "{path}");
    }
    scene.prepare(&["pack", "again", "--config", "root=again", "-o", "again.lipzbank", "--quiet"]);
    let [one, other] = ["again.lipzbank", "whole.lipzbank"].map(|bank| fs::read(scene.path().join(bank)).unwrap());
    assert!(one == other, "unpacking restores the project");
}

const SET: &str = "out/dialogue.lipzset";

/// Checks that a command prints the same about a set and the whole bank, except for the name.
fn prints_the_same(scene: &Scene, set: &str, command: &[&str]) {
    let of = |bank: &str| {
        let arguments: Vec<&str> = command.iter().map(|word| if *word == "BANK" { bank } else { word }).collect();
        let run = lipz(scene.path(), arguments);
        (run.code, run.stdout.replace(bank, "BANK"), run.stderr.replace(bank, "BANK"))
    };
    let (one, other) = (of(set), of("whole.lipzbank"));
    assert_eq!(one, other, "{command:?}");
    assert_eq!(one.0, 0, "{command:?}: {one:?}");
}

#[test]
fn tools_read_a_set_as_the_bank_of_all() {
    let scene = scene();
    pack(&scene);
    scene.prepare(&LINK);
    scene.prepare(&["pack", "-o", "whole.lipzbank", "--quiet"]);
    for command in [
        &["coverage", "BANK"][..],
        &["coverage", "BANK", "--output-format", "json"],
        &["coverage", "BANK", "--show", "voices"],
        &["coverage", "BANK", "--show", "missing", "--locale", "de-de"],
        &["inspect", "BANK", "--show", "clips"],
        &["inspect", "BANK", "de/", "--show", "clips", "--output-format", "json"],
        &["ids", "BANK", "--lang", "json"],
        &["ids", "BANK", "--lang", "rust"],
        &["diff", "BANK", "whole.lipzbank", "--quiet"],
        &["diff", "whole.lipzbank", "BANK", "--quiet"],
    ] {
        prints_the_same(&scene, SET, command);
    }
    let json = |bank: &str| -> serde_json::Value {
        serde_json::from_str(
            &lipz(scene.path(), ["inspect", "--show", "stats", bank, "--output-format", "json"]).stdout,
        )
        .unwrap()
    };
    let (mut one, mut other) = (json(SET), json("whole.lipzbank"));
    let of_files = |json: &mut serde_json::Value| {
        let members = json.as_object_mut().unwrap();
        members.remove("sections");
        members.remove("bytes").unwrap().as_u64()
    };
    let (bytes, _) = (of_files(&mut one), of_files(&mut other));
    assert_eq!(one, other);
    let on_disk =
        banks(&scene).iter().chain([&scene.path().join(SET)]).map(|path| path.metadata().unwrap().len()).sum::<u64>();
    assert_eq!(bytes, Some(on_disk));
    let read = |name: &str| fs::read(scene.path().join(name)).unwrap();
    let merged = lipz(scene.path(), ["merge", SET, "-o", "merged.lipzbank"]);
    assert!(merged.stdout.starts_with("4 banks merged into merged.lipzbank (25 clips, "), "{merged:?}");
    assert!(read("merged.lipzbank") == read("whole.lipzbank"));
    let unpacked = lipz(scene.path(), ["unpack", SET, "-o", "again"]);
    assert_eq!(unpacked.stdout, "25 files unpacked into again\n", "one summary: {unpacked:?}");
    let refused = lipz(scene.path(), ["unpack", SET, "-o", "again"]);
    assert!(refused.code == 1 && refused.stderr.contains("already exists"), "{refused:?}");
    scene.prepare(&["preview", SET, "--output", "site"]);
    assert!(scene.path().join("site/data/clips.js").is_file());
}

#[test]
fn a_set_is_patched() {
    let scene = scene();
    pack(&scene);
    scene.prepare(&LINK);
    scene.write("voices/act/line-3.lipz", r#"{ "fps": 24, "visemes": "OOO-", "text_en-us": "Nay, 3." }"#);
    scene.write("voices/act/line-20.lipz", r#"{ "text_en-us": "A new line.", "text_de-de": "Neu." }"#);
    fs::remove_file(scene.path().join("voices/act/line-7.lipz")).unwrap();
    let packed = lipz(scene.path(), ["pack", "--over", SET, "-o", "patch.lipzbank"]);
    assert!(
        packed.stdout.starts_with("2 new or changed clips and 1 removal packed into patch.lipzbank ("),
        "{packed:?}"
    );
    scene.prepare(&["pack", "-o", "whole.lipzbank", "--quiet"]);
    let read = |name: &str| fs::read(scene.path().join(name)).unwrap();
    scene.prepare(&["merge", SET, "patch.lipzbank", "-o", "merged.lipzbank", "--quiet"]);
    assert!(read("merged.lipzbank") == read("whole.lipzbank"));
    // The patch refers to the set by its index.
    let json = |arguments: &[&str]| -> serde_json::Value {
        serde_json::from_str(&lipz(scene.path(), arguments).stdout).unwrap()
    };
    let over = json(&["inspect", "patch.lipzbank", "--output-format", "json"])["layer"]["over"].clone();
    assert_eq!(over, serde_json::json!([json(&["inspect", SET, "--output-format", "json"])["checksum"]]));
    let stack = &format!("{SET}+patch.lipzbank");
    for command in [
        &["coverage", "BANK"][..],
        &["inspect", "BANK", "--show", "clips"],
        &["inspect", "BANK", "act/line-3"],
        &["inspect", "BANK", "de/act/line-8"],
        &["ids", "BANK", "--lang", "c"],
        &["diff", "BANK", "whole.lipzbank", "--quiet"],
    ] {
        prints_the_same(&scene, stack, command);
    }
    assert_eq!(lipz(scene.path(), ["verify", stack]).code, 0);
    assert_eq!(lipz(scene.path(), ["diff", SET, stack]).code, 1);
    scene.prepare(&["unpack", stack, "-o", "again", "--quiet"]);
    assert_eq!(support::tree(&scene.path().join("again")), support::tree(&scene.path().join("voices")));
    // The next patch is packed over both.
    scene.write("voices/act/line-4.lipz", r#"{ "fps": 24, "visemes": "AA-", "text_en-us": "Aye, 4." }"#);
    scene.write("voices/de/act/line-4.lipz", r#"{ "fps": 24, "visemes": "AA-" }"#);
    scene.prepare(&["pack", "--over", SET, "--over", "patch.lipzbank", "-o", "next.lipzbank", "--quiet"]);
    scene.prepare(&["pack", "-o", "whole.lipzbank", "--quiet"]);
    scene.prepare(&["merge", stack, "next.lipzbank", "-o", "merged.lipzbank", "--quiet"]);
    assert!(read("merged.lipzbank") == read("whole.lipzbank"));
    let alone = lipz(scene.path(), ["merge", SET, "next.lipzbank", "-o", "x.lipzbank"]);
    assert!(alone.code == 1 && alone.stderr.contains("LZ2102") && alone.stderr.contains("next.lipzbank"), "{alone:?}");
}

/// The banks of a set are inputs, too, although the command names only the index.
#[test]
fn no_bank_of_a_set_is_overwritten_by_what_is_made_of_it() {
    let scene = scene();
    pack(&scene);
    scene.prepare(&LINK);
    let bank = banks(&scene).remove(0);
    let before = fs::read(&bank).unwrap();
    let output = bank.to_str().unwrap();
    for made in [&["merge"][..], &["pack", "--over"], &["ids", "--lang", "c"]] {
        let merged = lipz(scene.path(), made.iter().copied().chain(["out/dialogue.lipzset", "-o", output]));
        assert_eq!((merged.code, merged.stderr.contains("are the same file")), (2, true), "{}", merged.stderr);
    }
    let arguments = ["pack", "--over", "out/dialogue.lipzset", "-o", "new.lipzbank", "--depfile", output];
    let packed = lipz(scene.path(), arguments);
    assert_eq!((packed.code, packed.stderr.contains("are the same file")), (2, true), "{}", packed.stderr);
    assert!(fs::read(&bank).unwrap() == before);
}

#[test]
fn a_summary_looks_at_every_bank() {
    let scene = scene();
    pack(&scene);
    scene.prepare(&LINK);
    let missing = lipz(scene.path(), ["inspect", "out/dialogue.lipzset", "no/such"]);
    assert!(missing.code != 0 && missing.stderr.contains("--> out/dialogue.lipzset"), "{}", missing.stderr);
    let bank = banks(&scene).remove(2);
    let mut bytes = fs::read(&bank).unwrap();
    *bytes.last_mut().unwrap() ^= 1;
    fs::write(&bank, bytes).unwrap();
    let damaged = lipz(scene.path(), ["inspect", "out/dialogue.lipzset"]);
    assert_eq!((damaged.code, damaged.stdout.as_str()), (1, ""), "{}", damaged.stderr);
    fs::remove_file(&bank).unwrap();
    let absent = lipz(scene.path(), ["inspect", "out/dialogue.lipzset"]);
    assert_eq!((absent.code, absent.stderr.contains("does not exist")), (2, true), "{}", absent.stderr);
}

/// The set of the fixtures equals a newly linked one, byte for byte.
#[test]
fn the_golden_set_is_linked_again() {
    let scene = Scene::new();
    let fixtures = support::repository().join("fixtures/banks");
    for key in ["aye", "no", "de/aye"] {
        let file = fs::read_to_string(fixtures.join("sources/dubbed").join(key).with_extension("lipz")).unwrap();
        scene.write(&format!("voices/{key}.lipz"), file);
    }
    let voices = "[voices]\nen-us = \"{key}\"\nde-de = \"de/{key}\"\nde-at = \"at/{key}\"\n";
    scene.write("lipz.toml", format!("sources = [\"voices\"]\ndefault-locale = \"en-us\"\n{voices}"));
    scene.prepare(&["shard", "plan", "pack", "--shards", "2", "-o", "plan.json", "--quiet"]);
    for shard in ["0", "1"] {
        let object = format!("{shard}-of-2.lipzobj");
        scene.prepare(&["shard", "pack", "plan.json", shard, "-o", &object, "--quiet"]);
    }
    scene.prepare(&["shard", "link", "0-of-2.lipzobj", "1-of-2.lipzobj", "-o", "out/dubbed.lipzset", "--quiet"]);
    let golden: Vec<_> = fs::read_dir(fixtures.join("sets")).unwrap().map(|file| file.unwrap().file_name()).collect();
    assert_eq!(golden.len(), 3);
    for name in golden {
        let [one, other] = [scene.path().join("out"), fixtures.join("sets")].map(|folder| fs::read(folder.join(&name)));
        assert!(one.unwrap() == other.unwrap(), "{name:?}");
    }
}

#[test]
fn what_is_wrong_with_a_set_is_reported() {
    let mut scene = scene();
    pack(&scene);
    scene.prepare(&LINK);
    scene.prepare(&["pack", "-o", "whole.lipzbank", "--quiet"]);
    scene.expect("LZ0902-bank-refused-set", &["inspect", "--show", "stats", "whole.lipzbank+out/dialogue.lipzset"]);
    let files = banks(&scene);
    let whole = fs::read(&files[1]).unwrap();
    let verify = ["verify", "out/dialogue.lipzset"];
    fs::copy(&files[2], &files[1]).unwrap();
    scene.expect("LZ0903-bank-damaged-set", &verify);
    fs::write(&files[1], &whole[..100]).unwrap();
    assert_eq!(lipz(scene.path(), verify).code, 1);
    fs::remove_file(&files[1]).unwrap();
    for asked in [&verify[..], &["inspect", "--show", "stats", "out/dialogue.lipzset"]] {
        let missing = lipz(scene.path(), asked);
        assert_eq!(missing.code, 2);
        assert!(missing.stderr.contains("copy all banks of `"), "{}", missing.stderr);
    }
    fs::write(&files[1], &whole).unwrap();
    let index = scene.path().join("out/dialogue.lipzset");
    let bytes = fs::read(&index).unwrap();
    for at in 8..bytes.len() {
        let mut damaged = bytes.clone();
        damaged[at] ^= 1;
        if at % 29 == 0 {
            fs::write(&index, damaged).unwrap();
            assert_eq!(lipz(scene.path(), verify).code, 1, "byte {at}");
        }
    }
    scene.finish(2);
}

#[test]
fn the_banks_of_a_set_are_not_split_by_locale() {
    let scene = scene();
    scene.write("lipz.toml", "sources = [\"voices\"]\nsplit-locales = true\n");
    pack(&scene);
    let refused = lipz(scene.path(), LINK);
    assert!(refused.code == 2 && refused.stderr.contains("cannot be split by locale"), "{refused:?}");
}

/// Whenever a link is killed, the old or the new set is complete. The next run finishes and removes leftovers.
#[test]
fn a_link_that_is_killed_leaves_a_whole_set() {
    let scene = scene();
    let link = |delay_us: u64| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lipz"));
        let mut child = command.args(LINK).current_dir(scene.path()).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(Duration::from_micros(delay_us));
        child.kill().unwrap();
        child.wait().unwrap().success()
    };
    let (mut killed, mut is_there) = (0, false);
    for turn in 0..40 {
        // A different text each time, so that there is something to write.
        scene.write("voices/act/line-3.lipz", format!(r#"{{ "text_en-us": "Turn {turn}." }}"#));
        if turn % 10 == 0 {
            pack(&scene);
        }
        killed += usize::from(!link(turn % 10 * 1500));
        is_there |= scene.path().join("out/dialogue.lipzset").exists();
        if is_there {
            assert_eq!(lipz(scene.path(), ["verify", "out/dialogue.lipzset"]).code, 0, "turn {turn}");
        }
    }
    assert!(killed > 5, "only {killed} of 40 were killed before their end");
    pack(&scene);
    scene.prepare(&LINK);
    assert_eq!(lipz(scene.path(), ["verify", "out/dialogue.lipzset"]).code, 0);
    assert_eq!(banks(&scene).len(), 4, "earlier runs leave no files");
}
