//! Layers from the command line: patches and mods are packed over a bank, and every command reads a stack as one bank.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::{Scene, lipz, tree};

/// Returns `base.lipzbank` of the folder `old`, and a folder `new` with a changed text, an added clip and a removed
/// clip.
fn scene() -> Scene {
    let scene = Scene::new();
    scene
        .write("old/aye.lipz", r#"{ "fps": 24, "visemes": "AEE-", "text_en-us": "{nods} Aye.", "text_de-de": "Ja." }"#);
    scene.write("old/no.lipz", r#"{ "text_en-us": "No.", "events": "sighs" }"#);
    scene
        .write("new/aye.lipz", r#"{ "fps": 24, "visemes": "AEE-", "text_en-us": "{nods} Aye!", "text_de-de": "Ja." }"#);
    scene.write("new/yes.lipz", r#"{ "visemes": "EE", "text_en-us": "Yes." }"#);
    scene.prepare(&["pack", "old", "-o", "base.lipzbank", "--config", "default-locale=en-us", "--quiet"]);
    scene
}

const PACK_PATCH: [&str; 8] =
    ["pack", "new", "--over", "base.lipzbank", "-o", "patch.lipzbank", "--config", "default-locale=en-us"];

#[test]
fn a_patch_and_its_base_are_the_bank_of_the_new_sources() {
    let scene = scene();
    let packed = lipz(scene.path(), PACK_PATCH);
    assert!(
        packed.stdout.starts_with("2 new or changed clips and 1 removal packed into patch.lipzbank ("),
        "{packed:?}"
    );
    scene.prepare(&["pack", "new", "-o", "whole.lipzbank", "--config", "default-locale=en-us", "--quiet"]);
    let merged = lipz(scene.path(), ["merge", "base.lipzbank", "patch.lipzbank", "-o", "merged.lipzbank"]);
    assert!(merged.stdout.starts_with("2 banks merged into merged.lipzbank (2 clips, "), "{merged:?}");
    let read = |name: &str| fs::read(scene.path().join(name)).unwrap();
    assert!(read("merged.lipzbank") == read("whole.lipzbank"));
    scene.prepare(&["merge", "base.lipzbank+patch.lipzbank", "-o", "again.lipzbank", "--quiet"]);
    assert!(read("again.lipzbank") == read("whole.lipzbank"));
    // Every command accepts a stack as a bank.
    let stack = "base.lipzbank+patch.lipzbank";
    let differ = lipz(scene.path(), ["diff", stack, "whole.lipzbank"]);
    assert_eq!(differ.code, 0, "{differ:?}");
    let differ = lipz(scene.path(), ["diff", "base.lipzbank", stack]);
    assert!(differ.code == 1 && differ.stdout.contains("yes"), "{differ:?}");
    let coverage = [stack, "whole.lipzbank"].map(|bank| lipz(scene.path(), ["coverage", bank]));
    let [of_stack, of_whole] = coverage.map(|run| (run.code, run.stdout.replace(stack, "whole.lipzbank")));
    assert_eq!((of_stack.0, &of_stack), (0, &of_whole));
    // These list the individual files.
    let bytes = read("base.lipzbank").len() + read("patch.lipzbank").len();
    for shown in [&[][..], &["--show", "stats"]] {
        let json = |bank: &str| -> serde_json::Value {
            let inspect = [&["inspect", bank, "--output-format", "json"], shown].concat();
            serde_json::from_str(&lipz(scene.path(), inspect).stdout).unwrap()
        };
        let (mut of_stack, mut of_whole) = (json(stack), json("whole.lipzbank"));
        assert_eq!(of_stack["bytes"], bytes, "{shown:?}");
        if shown.is_empty() {
            assert_eq!(of_stack["checksum"], json("patch.lipzbank")["checksum"]);
            assert_eq!(of_stack["layer"], json("patch.lipzbank")["layer"]);
        }
        for json in [&mut of_stack, &mut of_whole] {
            let members = json.as_object_mut().unwrap();
            members
                .retain(|name, _| !["bytes", "sections", "fingerprint", "checksum", "layer"].contains(&name.as_str()));
        }
        assert_eq!(of_stack, of_whole, "{shown:?}");
    }
    let verified = lipz(scene.path(), ["verify", stack]);
    assert!(verified.code == 0 && verified.stdout.contains("no fault (2 clips, "), "{verified:?}");
    scene.prepare(&["unpack", stack, "-o", "out", "--quiet"]);
    assert_eq!(tree(&scene.path().join("out")), tree(&scene.path().join("new")));
}

#[test]
fn a_patch_alone_says_what_it_is() {
    let scene = scene();
    scene.prepare(&PACK_PATCH);
    let inspected = lipz(scene.path(), ["inspect", "patch.lipzbank"]).stdout;
    let base = lipz(scene.path(), ["inspect", "base.lipzbank"]).stdout;
    let (_, checksum) = base.split_once("checksum ").unwrap();
    let checksum = checksum.lines().next().unwrap();
    assert!(inspected.contains(&format!("  patch over {checksum}\n  removes 1 clip: id ")), "{inspected}");
    assert!(inspected.contains("2 clips") && !base.contains("patch over"), "{base}");
    let json = lipz(scene.path(), ["inspect", "patch.lipzbank", "--output-format", "json"]).stdout;
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(
        (&json["layer"]["over"][0], json["layer"]["removed_clips"].as_array().unwrap().len()),
        (&checksum.into(), 1)
    );
    assert_eq!(lipz(scene.path(), ["verify", "patch.lipzbank"]).code, 0);
}

#[test]
fn a_mod_keeps_the_clips_that_it_does_not_have() {
    let scene = scene();
    scene.write("mod/no.lipz", r#"{ "text_en-us": "Never." }"#);
    let pack = ["pack", "mod", "--over", "base.lipzbank", "--keep-others", "-o", "mod.lipzbank"];
    let packed = lipz(scene.path(), pack);
    assert!(packed.stdout.starts_with("1 new or changed clip packed into mod.lipzbank ("), "{packed:?}");
    // The patch of the base does not depend on the mod, but can still be placed below it.
    scene.prepare(&PACK_PATCH);
    let listed = lipz(scene.path(), ["inspect", "base.lipzbank+patch.lipzbank+mod.lipzbank", "--show", "clips"]).stdout;
    assert!(listed.starts_with("aye") && listed.contains("\nno ") && listed.contains("\nyes"), "{listed}");
}

#[test]
fn what_does_not_fit_is_told() {
    let mut scene = scene();
    scene.prepare(&PACK_PATCH);
    let pack_old =
        ["pack", "old", "--over", "base.lipzbank", "-o", "none.lipzbank", "--config", "default-locale=en-us"];
    scene.expect("LZ2101-layer-without-change", &pack_old);
    assert!(!scene.path().join("none.lipzbank").exists());
    scene.prepare(&["pack", "new", "-o", "other.lipzbank", "--quiet"]);
    scene.expect("LZ2102-layer-misfit", &["merge", "other.lipzbank", "patch.lipzbank", "-o", "whole.lipzbank"]);
    scene.expect("LZ2102-layer-misfit-no-base", &["inspect", "patch.lipzbank+base.lipzbank"]);
    scene.expect("LZ2102-layer-misfit-no-layer", &["diff", "base.lipzbank+other.lipzbank", "base.lipzbank"]);
    scene.prepare(&["pack", "old", "-o", "stripped.lipzbank", "--config", "strip=true", "--quiet"]);
    scene.expect(
        "LZ2103-layer-stripped",
        &["pack", "new", "--over", "stripped.lipzbank", "-o", "p.lipzbank", "--quiet"],
    );
    scene.expect("LZ2104-layer-alone", &["unpack", "patch.lipzbank", "-o", "out"]);
    assert!(!scene.path().join("out").exists() && !scene.path().join("whole.lipzbank").exists());
    scene.finish(6);
}

#[test]
fn a_stack_that_no_program_opens_is_not_packed() {
    let scene = scene();
    scene.prepare(&PACK_PATCH);
    let twice = lipz(scene.path(), ["verify", "base.lipzbank+patch.lipzbank+patch.lipzbank"]);
    assert_eq!((twice.code, twice.stderr.contains("this patch twice")), (1, true), "{}", twice.stderr);
    let alone = lipz(scene.path(), ["pack", "new", "--over", "patch.lipzbank", "-o", "p.lipzbank", "--quiet"]);
    assert!(alone.code == 1 && alone.stderr.contains("--> patch.lipzbank"), "{}", alone.stderr);
    let mut below = vec!["base.lipzbank".to_owned()];
    for number in 1..=16 {
        scene.write("new/yes.lipz", format!(r#"{{ "visemes": "EE", "text_en-us": "Yes, {number}." }}"#));
        let name = format!("{number}.lipzbank");
        let over = below.iter().flat_map(|bank| ["--over", bank.as_str()]);
        let pack = ["pack", "new", "-o", name.as_str(), "--quiet", "--config", "default-locale=en-us"];
        let packed = lipz(scene.path(), pack.into_iter().chain(over));
        assert_eq!(packed.code, i32::from(number > 15), "{number}: {}", packed.stderr);
        below.push(name);
    }
    assert!(!scene.path().join("16.lipzbank").exists());
    scene.prepare(&["verify", &below[..16].join("+")]);
}

#[test]
fn files_are_not_mixed_up() {
    let scene = scene();
    let before = tree(scene.path());
    let refused: [(&[&str], &str); 8] = [
        (&["ids", "base.lipzbank", "--lang", "c", "-o", "base.lipzbank"], "LZ1601"),
        (&["pack", "new", "--over", "base.lipzbank", "-o", "p.lipzbank", "--depfile", "base.lipzbank"], "LZ1601"),
        (&["pack", "new", "--over", "base.lipzbank", "--over", "base.lipzbank", "-o", "p.lipzbank"], "LZ2102"),
        (&["merge", "base.lipzbank", "-o", "whole.lipzbank"], "LZ1601"),
        (&["pack", "new", "--over", "base.lipzbank", "-o", "base.lipzbank"], "LZ1601"),
        (&["pack", "new", "--over", "base.lipzbank", "-o", "p.lipzbank", "--config", "split-locales=true"], "LZ1601"),
        (&["pack", "new", "--keep-others", "-o", "p.lipzbank"], "LZ1601"),
        (&["pack", "new", "--over", "nowhere.lipzbank", "-o", "p.lipzbank"], "LZ0902"),
    ];
    for (arguments, code) in refused {
        let outcome = lipz(scene.path(), arguments);
        assert!(
            outcome.code != 0 && outcome.stderr.contains(&format!("error[{code}]: ")),
            "{arguments:?}: {outcome:?}"
        );
    }
    assert_eq!(tree(scene.path()), before);
}
