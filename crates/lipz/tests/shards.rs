//! Packing in shards on the command line: plan, objects, link; refused cases, and results in a store.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use std::process::{Command, Stdio};
use std::time::Duration;
use support::{Scene, lipz};

/// Returns a project with settings, two locales and a warning in a file, and its bank from a single run.
fn scene() -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\noutput = \"dialogue.lipzbank\"\ndefault-locale = \"en-us\"\n");
    for line in 0..30 {
        let german = if line % 3 == 0 { r#", "text_de-de": "Ja, {laut} und wie." "# } else { "" };
        let odd = if line == 7 { r#", "note": 1"# } else { "" };
        let file = format!(r#"{{ "fps": 24, "visemes": "AEE-", "text_en-us": "Aye, {line}."{german}{odd} }}"#);
        scene.write(&format!("voices/line-{line}.lipz"), &file);
    }
    scene
}

fn plan(scene: &Scene, shards: &str) {
    scene.prepare(&["shard", "plan", "pack", "--shards", shards, "-o", "build/plan.json", "--quiet"]);
}

fn pack(scene: &Scene, shard: u16, shards: u16) -> support::Outcome {
    let (number, object) = (shard.to_string(), format!("build/{shard}-of-{shards}.lipzobj"));
    lipz(scene.path(), ["shard", "pack", "build/plan.json", &number, "-o", &object, "--store", "store"])
}

#[test]
fn objects_are_linked_to_the_bank_that_is_packed_in_one_go() {
    let scene = scene();
    let packed = lipz(scene.path(), ["pack", "-o", "whole.lipzbank"]);
    for shards in [1, 4, 5] {
        plan(&scene, &shards.to_string());
        let of_shards: Vec<_> = (0..shards).map(|shard| pack(&scene, shard, shards)).collect();
        assert!(of_shards.iter().all(|outcome| outcome.code == 0), "{of_shards:?}");
        let objects = format!("build/*-of-{shards}.lipzobj");
        let linked = lipz(scene.path(), ["shard", "link", &objects, "-o", "dialogue.lipzbank"]);
        let said = if shards == 1 { "1 object linked" } else { &format!("{shards} objects linked") };
        assert!(linked.code == 0 && linked.stdout.starts_with(said), "{linked:?}");
        assert_eq!(linked.stderr, packed.stderr, "the same diagnostics, with their positions");
        let [one, other] =
            ["dialogue.lipzbank", "whole.lipzbank"].map(|bank| fs::read(scene.path().join(bank)).unwrap());
        assert!(one == other, "{shards} shards");
    }
    let verified = lipz(scene.path(), ["verify", "build/0-of-4.lipzobj"]);
    assert_eq!(verified.code, 0, "an object is a bank: {verified:?}");
}

#[test]
fn what_did_not_change_is_taken_from_the_store() {
    let scene = scene();
    plan(&scene, "4");
    let first: Vec<_> = (0..4).map(|shard| pack(&scene, shard, 4)).collect();
    assert!(first.iter().all(|outcome| outcome.stdout.contains("packed into")), "{first:?}");
    let objects = || -> Vec<Vec<u8>> {
        (0..4).map(|shard| fs::read(scene.path().join(format!("build/{shard}-of-4.lipzobj"))).unwrap()).collect()
    };
    let before = objects();
    scene.write("voices/line-3.lipz", r#"{ "text_en-us": "Nay." }"#);
    plan(&scene, "4");
    (0..4).for_each(|shard| fs::remove_file(scene.path().join(format!("build/{shard}-of-4.lipzobj"))).unwrap());
    let again: Vec<_> = (0..4).map(|shard| pack(&scene, shard, 4)).collect();
    let anew = again.iter().filter(|outcome| outcome.stdout.contains("packed into")).count();
    let stored = again.iter().filter(|outcome| outcome.stdout.contains("copied from the store to")).count();
    assert_eq!((anew, stored), (1, 3), "{again:?}");
    assert_eq!(std::iter::zip(before, objects()).filter(|(one, other)| one != other).count(), 1);
    // A damaged result is made again.
    for file in fs::read_dir(scene.path().join("store")).unwrap() {
        fs::write(file.unwrap().path(), "half a fi").unwrap();
    }
    assert!(pack(&scene, 0, 4).stdout.contains("unchanged in"));
}

#[test]
fn plans_that_cannot_be_read() {
    let mut scene = scene();
    plan(&scene, "2");
    let plan = fs::read_to_string(scene.path().join("build/plan.json")).unwrap();
    let of_shard = fs::read_to_string(scene.path().join("build/plan.shards/0-of-2.json")).unwrap();
    let pack = ["shard", "pack", "build/plan.json", "0", "-o", "0.lipzobj"];
    scene.write("build/plan.json", plan.replacen("\"version\": 1", "\"version\": 9", 1));
    scene.expect("LZ2201-plan-unreadable-version", &pack);
    scene.write("build/plan.json", plan.replacen("\"makes\":", "\"makes\"", 1));
    scene.expect("LZ2201-plan-unreadable-syntax", &pack);
    scene.write("build/plan.json", &plan);
    let key = of_shard.split("\"key\": \"").nth(1).unwrap().split('"').next().unwrap();
    scene.write(
        "build/plan.shards/0-of-2.json",
        of_shard.replacen(&format!("\"key\": \"{key}\""), "\"key\": \"zzz\"", 1),
    );
    scene.expect("LZ2201-plan-unreadable", &pack);
    assert!(!scene.path().join("0.lipzobj").exists());
    scene.finish(3);
}

#[test]
fn files_that_are_not_those_of_the_plan() {
    let mut scene = scene();
    plan(&scene, "1");
    scene.write("voices/line-3.lipz", r#"{ "text_en-us": "Nay." }"#);
    fs::remove_file(scene.path().join("voices/line-4.lipz")).unwrap();
    scene.expect("LZ2202-plan-outdated", &["shard", "pack", "build/plan.json", "0", "-o", "0.lipzobj"]);
    assert!(!scene.path().join("0.lipzobj").exists());
    scene.finish(1);
}

#[test]
fn objects_that_are_none_or_do_not_belong_together() {
    let mut scene = scene();
    plan(&scene, "4");
    (0..4).for_each(|shard| drop(pack(&scene, shard, 4)));
    scene.prepare(&["pack", "-o", "whole.lipzbank", "--quiet"]);
    let out = ["-o", "out.lipzbank"];
    let link = |objects: &[&'static str]| [&["shard", "link"], objects, &out].concat();
    let [o0, o1, o3] = ["build/0-of-4.lipzobj", "build/1-of-4.lipzobj", "build/3-of-4.lipzobj"];
    scene.expect("LZ2203-no-object", &link(&["whole.lipzbank"]));
    scene.expect("LZ2205-object-missing", &link(&[o0, o3]));
    scene.expect("LZ2204-object-misfit-twice", &link(&[o0, o1, "build/2-of-4.lipzobj", o3, o1]));
    plan(&scene, "2");
    pack(&scene, 1, 2);
    scene.expect("LZ2204-object-misfit-shards", &link(&[o0, "build/1-of-2.lipzobj"]));
    scene.write("lipz.toml", "sources = [\"voices\"]\ndefault-locale = \"de-de\"\n");
    plan(&scene, "4");
    pack(&scene, 1, 4);
    scene.expect("LZ2204-object-misfit", &link(&[o0, o1]));
    assert!(!scene.path().join("out.lipzbank").exists());
    scene.finish(5);
}

#[test]
fn flags_that_a_plan_decides_are_refused() {
    let scene = scene();
    plan(&scene, "2");
    let pack = ["shard", "pack", "build/plan.json", "0", "-o", "0.lipzobj"];
    let refused: [&[&str]; 6] = [
        &["voices"],
        &["--config", "default-locale=de-de"],
        &["--allow", "LZ0203"],
        &["--audio", "recordings"],
        &["--config", "strip=true"],
        &["--config", "root=voices"],
    ];
    for flags in refused {
        let outcome = lipz(scene.path(), pack.iter().chain(flags));
        assert!(outcome.code == 2 && outcome.stderr.contains("LZ1601"), "{flags:?}: {outcome:?}");
    }
    // Steps read their settings from the settings file. They would not have settings that only the plan gets.
    let plan = ["shard", "plan", "pack", "--shards", "2", "-o", "build/plan.json"];
    for setting in ["strip=true", "default-locale=de-de", "audio.folder=recordings"] {
        let outcome = lipz(scene.path(), plan.iter().chain(&["--config", setting]));
        assert!(outcome.code == 2 && outcome.stderr.contains("steps"), "{setting}: {outcome:?}");
    }
    scene.prepare(&[&plan[..], &["--config", "output=other.lipzbank", "--config", "root=voices"]].concat());
    assert!(fs::read_to_string(scene.path().join("build/plan.json")).unwrap().contains("other.lipzbank"));
    let none = lipz(scene.path(), ["shard", "pack", "build/plan.json", "2", "-o", "2.lipzobj"]);
    assert!(none.code == 2 && none.stderr.contains("shard 2 is not in the plan"), "{none:?}");
}

#[test]
fn steps_that_are_killed_are_done_again() {
    let scene = scene();
    scene.prepare(&["pack", "-o", "whole.lipzbank", "--quiet"]);
    plan(&scene, "2");
    let whole = fs::read(scene.path().join("whole.lipzbank")).unwrap();
    let killed_after = |arguments: &[&str], delay_us: u64| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lipz"));
        let mut child = command.args(arguments).current_dir(scene.path()).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(Duration::from_micros(delay_us));
        child.kill().unwrap();
        child.wait().unwrap().success()
    };
    let steps: [&[&str]; 3] = [
        &["shard", "pack", "build/plan.json", "0", "-o", "build/0-of-2.lipzobj", "--store", "store", "-q"],
        &["shard", "pack", "build/plan.json", "1", "-o", "build/1-of-2.lipzobj", "--store", "store", "-q"],
        &["shard", "link", "build/*-of-2.lipzobj", "-o", "dialogue.lipzbank", "-q"],
    ];
    let outputs =
        ["build/0-of-2.lipzobj", "build/1-of-2.lipzobj", "dialogue.lipzbank"].map(|name| scene.path().join(name));
    let mut killed = 0;
    for (step, output) in std::iter::zip(steps, &outputs) {
        for delay_us in (0..40).map(|turn| turn * 1000) {
            let _ = fs::remove_file(output);
            let _ = fs::remove_dir_all(scene.path().join("store"));
            killed += usize::from(!killed_after(step, delay_us));
            if output.exists() {
                assert_eq!(lipz(scene.path(), ["verify".as_ref(), output.as_os_str()]).code, 0, "complete, or missing");
            }
        }
        scene.prepare(step);
    }
    assert!(killed > 20, "only {killed} of 120 were killed before their end");
    assert!(fs::read(&outputs[2]).unwrap() == whole);
}
