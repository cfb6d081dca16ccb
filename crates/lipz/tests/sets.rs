//! Sets of banks from the command line: linked, verified, inspected, unpacked; whole whatever happens meanwhile.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::Duration;
use support::{Scene, lipz};

/// A project with dubs, two locales, and what it is packed into in one go.
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
    scene.prepare(&["shard", "plan", "--shards", "4", "-o", "build/plan.json", "--quiet"]);
    for shard in ["0", "1", "2", "3"] {
        let object = format!("build/{shard}-of-4.lipzobj");
        scene.prepare(&["pack", "--plan", "build/plan.json", "--shard", shard, "-o", &object, "--quiet"]);
    }
}

const LINK: [&str; 5] = ["link", "build/*-of-4.lipzobj", "-o", "out/dialogue.lipzset", "--quiet"];

/// The banks of the set.
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
    let linked = lipz(scene.path(), &LINK[..4]);
    assert!(
        linked.code == 0 && linked.stdout.starts_with("4 banks linked into the set out/dialogue.lipzset (25 clips")
    );
    assert_eq!(banks(&scene).len(), 4);
    let verified = lipz(scene.path(), ["verify", "out/dialogue.lipzset"]);
    assert!(verified.stdout.contains("no fault (4 banks, 25 clips, "), "{verified:?}");
    let summary = lipz(scene.path(), ["inspect", "out/dialogue.lipzset"]);
    assert!(summary.stdout.contains("set of 4 banks") && summary.stdout.contains("in the bank of their line"));
    let json = lipz(scene.path(), ["inspect", "out/dialogue.lipzset", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!((json["clips"].as_u64(), json["banks"].as_array().map(Vec::len)), (Some(25), Some(4)));
    scene.prepare(&["pack", "-o", "whole.lipzbank", "--quiet"]);
    for key in ["act/line-3", "de/act/line-8", "act/line-7"] {
        let [one, other] =
            ["out/dialogue.lipzset", "whole.lipzbank"].map(|bank| lipz(scene.path(), ["inspect", bank, key]));
        assert_eq!((one.code, &one.stdout), (0, &other.stdout), "{key}");
    }
    for (flag, value) in [("--locale", "de-de"), ("--texts", "de-de.lipztexts")] {
        let refused = lipz(scene.path(), ["inspect", "out/dialogue.lipzset", flag, value]);
        assert!(refused.code == 2 && refused.stderr.contains(flag), "not passed over in silence: {refused:?}");
    }
    let listed = lipz(scene.path(), ["inspect", "out/dialogue.lipzset", "--list", "de/"]);
    assert_eq!(listed.stdout.lines().count(), 5, "{listed:?}");
    let listed = lipz(scene.path(), ["inspect", "out/dialogue.lipzset", "--list", "--json"]);
    let listed: serde_json::Value = serde_json::from_str(&listed.stdout).unwrap();
    assert_eq!(listed.as_array().map(Vec::len), Some(25));
    scene.prepare(&["unpack", "out/dialogue.lipzset", "-o", "again", "--quiet"]);
    for path in ["act/line-3.lipz", "de/act/line-8.lipz"] {
        assert!(scene.path().join("again").join(path).is_file(), "{path}");
    }
    scene.prepare(&["pack", "again", "--root", "again", "-o", "again.lipzbank", "--quiet"]);
    let [one, other] = ["again.lipzbank", "whole.lipzbank"].map(|bank| fs::read(scene.path().join(bank)).unwrap());
    assert!(one == other, "what is unpacked is the project");
}

/// The set of the fixtures is what is linked now, byte for byte.
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
    scene.prepare(&["shard", "plan", "--shards", "2", "-o", "plan.json", "--quiet"]);
    for shard in ["0", "1"] {
        scene.prepare(&[
            "pack",
            "--plan",
            "plan.json",
            "--shard",
            shard,
            "-o",
            &format!("{shard}-of-2.lipzobj"),
            "--quiet",
        ]);
    }
    scene.prepare(&["link", "0-of-2.lipzobj", "1-of-2.lipzobj", "-o", "out/dubbed.lipzset", "--quiet"]);
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
    scene.expect("LZ0902-bank-refused-set", &["stats", "out/dialogue.lipzset"]);
    let files = banks(&scene);
    let whole = fs::read(&files[1]).unwrap();
    let verify = ["verify", "out/dialogue.lipzset"];
    fs::copy(&files[2], &files[1]).unwrap();
    scene.expect("LZ0903-bank-damaged-set", &verify);
    fs::write(&files[1], &whole[..100]).unwrap();
    assert_eq!(lipz(scene.path(), verify).code, 1);
    fs::remove_file(&files[1]).unwrap();
    assert_eq!(lipz(scene.path(), verify).code, 2);
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
    assert!(refused.code == 2 && refused.stderr.contains("not split by locale"), "{refused:?}");
}

/// Whenever it is killed, the old set or the new one is there, and the next run finishes and tidies up.
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
        // Another text each time, so that there is something to write.
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
    assert_eq!(banks(&scene).len(), 4, "nothing is left of the runs before");
}
