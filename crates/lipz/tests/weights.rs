//! Weights of rigs: `lipz export weights`, its round trips, and readers of other projects; `lipz pack --bake`.
//!
//! A missing reader is skipped with a message; with `LIPZ_TOOLS`, it is required.
#![allow(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "tests")]

mod support;

use lipz_bank::{Bank, Micros};
use serde_json::{Value, json};
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};
use support::{Scene, lipz, repository};

const MAMA: &str = r#"{ "fps": 24, "visemes": "-----MMAAAMMAAAA--------", "text_en-us": "{joy 5} Mama!",
    "viseme_type": "blair", "phones": "sil@0 M@200 AA@280 M@420 AA@500 sil@700",
    "curves": { "jawForward": "0:0.2 20:0.4" } }"#;

fn scene() -> Scene {
    let scene = Scene::new();
    scene.write("voices/mama.lipz", MAMA);
    scene
}

fn export(scene: &Scene, format: &str, rig: &str, folder: &str, more: &[&str]) {
    let arguments = ["export", "weights", format, "voices", "--rig", rig, "-o", folder, "--quiet"];
    let run = lipz(scene.path(), arguments.iter().chain(more));
    assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{format}");
}

fn json_of(scene: &Scene, path: &str) -> Value {
    serde_json::from_slice(&fs::read(scene.path().join(path)).unwrap()).unwrap()
}

/// Returns the rows of weights in an Audio2Face file, in thousandths, by the names of the shapes.
fn rows(file: &Value) -> Vec<Vec<(String, i64)>> {
    let names: Vec<&str> = file["facsNames"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    let row = |row: &Value| {
        let weights = row.as_array().unwrap().iter().map(|weight| (weight.as_f64().unwrap() * 1000.0).round() as i64);
        names.iter().map(|name| (*name).to_owned()).zip(weights).collect()
    };
    file["weightMat"].as_array().unwrap().iter().map(row).collect()
}

#[test]
fn exported_weights_are_those_of_the_reader() {
    let scene = scene();
    export(&scene, "audio2face", "arkit", "out", &["--fps", "60"]);
    let file = json_of(&scene, "out/mama.json");
    assert_eq!((&file["exportFps"], &file["numFrames"]), (&json!(60.0), &json!(60)));
    lipz(scene.path(), ["pack", "voices", "-o", "a.lipzbank", "--config", "rig.arkit=true"]);
    let bytes = fs::read(scene.path().join("a.lipzbank")).unwrap();
    let bank = Bank::open(&bytes).unwrap();
    let clip = bank.clip_by_key("mama").unwrap();
    let weights = lipz_compiler::ClipWeights::new(&bank, clip, bank.rig("arkit").unwrap());
    for (frame, row) in rows(&file).into_iter().enumerate() {
        let at = weights.at(Micros((frame as i64 * 1_000_000 + 30) / 60));
        let expected: Vec<(&str, i64)> =
            weights.names().zip(at.iter().map(|weight| i64::from(weight.thousandths()))).collect();
        for (name, weight) in row {
            let of_rig = expected.iter().find(|(other, _)| *other == name).map(|(_, weight)| *weight);
            // A curve of the file, which the rig does not have.
            let expected = if name == "jawForward" { Some(weight) } else { of_rig };
            assert_eq!(weight, expected.unwrap_or(0), "{name} in frame {frame}");
        }
    }
    let [first, late] =
        [0, 59].map(|frame| rows(&file)[frame].iter().find(|(name, _)| name == "jawForward").unwrap().1);
    assert_eq!((first, late), (200, 400));
}

#[test]
fn recorded_faces_come_back_exactly() {
    for (format, fixture) in [("live-link", "live-link/take.csv"), ("audio2face", "audio2face/mayor.json")] {
        let scene = Scene::new();
        let original = repository().join("fixtures/interop").join(fixture);
        let run = lipz(scene.path(), ["import", "visemes", format, original.to_str().unwrap(), "-o", "voices"]);
        assert_eq!(run.code, 0, "{run:?}");
        assert!(run.stdout.contains("weights become curves, rounded to thousandths"), "{run:?}");
        export(&scene, format, "arkit", "out", &[]);
        let name = original.file_name().unwrap().to_str().unwrap();
        let [before, after] = [original.clone(), scene.path().join("out").join(name)].map(|path| table(format, &path));
        assert_eq!(before.len(), after.len(), "{format}: frames");
        for (frame, (before, after)) in before.iter().zip(&after).enumerate() {
            for (name, weight) in before {
                let found = after.iter().find(|(other, _)| other.eq_ignore_ascii_case(name)).unwrap().1;
                assert!((found - weight).abs() <= 1.0, "{format}: {name} in frame {frame}: {found} {weight}");
            }
        }
    }
}

/// Returns the frames of a file, each with names and weights in thousandths.
fn table(format: &str, path: &PathBuf) -> Vec<Vec<(String, f64)>> {
    let text = fs::read_to_string(path).unwrap();
    if format == "audio2face" {
        let exact = |row: Vec<(String, i64)>| row.into_iter().map(|(name, weight)| (name, weight as f64)).collect();
        return rows(&serde_json::from_str(&text).unwrap()).into_iter().map(exact).collect();
    }
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let row = |line: &str| {
        let pairs = names.iter().zip(line.split(',')).skip(2);
        pairs.map(|(name, weight)| ((*name).to_owned(), weight.parse::<f64>().unwrap() * 1000.0)).collect()
    };
    lines.map(row).collect()
}

/// Returns the output of a program that runs a reader; `None` if it is missing.
fn reader(command: &mut Command, what: &str) -> Option<Output> {
    let folder = repository().join("target/tools/readers/node_modules");
    let output = command.output().ok().filter(|_| what == "python3" || folder.is_dir());
    if output.is_none() {
        assert!(std::env::var_os("LIPZ_TOOLS").is_none(), "needs {what}, which `.ci/install` brings");
        eprintln!("skipped: {what} is not on this machine");
    }
    output
}

#[test]
fn readers_of_other_projects_find_the_same_weights() {
    let scene = scene();
    let scripts = repository().join("crates/lipz/tests/weight_readers");
    let readers = repository().join("target/tools/readers");
    let formats = [
        ("gltf", "glb", "arkit", "24"),
        ("vrma", "vrma", "vrm", "24"),
        ("vmd", "vmd", "mmd", "30"),
        ("spine", "json", "arkit", "24"),
        ("live2d", "motion3.json", "live2d", "24"),
        ("godot", "tres", "arkit", "24"),
        ("unity", "anim", "arkit", "24"),
    ];
    if readers.is_dir() {
        fs::copy(scripts.join("check.mjs"), readers.join("check.mjs")).unwrap();
    }
    for (format, extension, rig, fps) in formats {
        let (folder, expected) = (format!("out-{format}"), format!("expected-{format}"));
        export(&scene, format, rig, &folder, &["--fps", fps]);
        export(&scene, "audio2face", rig, &expected, &["--fps", fps]);
        let mut node = Command::new("node");
        node.arg(readers.join("check.mjs")).arg(format).current_dir(scene.path());
        node.args([format!("{folder}/mama.{extension}"), format!("{expected}/mama.json")]);
        let Some(output) = reader(&mut node, "a reader of npm") else { return };
        assert!(output.status.success(), "{format}: {}", String::from_utf8_lossy(&output.stderr));
    }
}

#[test]
fn the_script_for_blender_keys_the_weights() {
    let scene = scene();
    export(&scene, "blender", "arkit", "out", &[]);
    export(&scene, "audio2face", "arkit", "expected", &[]);
    let expected = json_of(&scene, "expected/mama.json");
    scene.write("names.json", expected["facsNames"].to_string());
    let mut python = Command::new("python3");
    python.arg(repository().join("crates/lipz/tests/weight_readers/bpy.py")).current_dir(scene.path());
    let Some(output) = reader(python.args(["out/mama.py", "names.json", "24"]), "python3") else { return };
    let found: Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{output:?}"));
    for (frame, row) in rows(&expected).into_iter().enumerate() {
        for (index, (name, weight)) in row.into_iter().enumerate() {
            let found = found[frame][index].as_f64().unwrap_or_default() * 1000.0;
            assert!((found - weight as f64).abs() <= 2.1, "{name} in frame {frame}: {found} {weight}");
        }
    }
}

#[test]
fn what_cannot_be_exported_is_told() {
    let mut scene = scene();
    scene.write("bad/still.lipz", r#"{ "text_en-us": "Hi." }"#);
    scene.expect("LZ1112-not-exportable-weights", &["export", "weights", "gltf", "bad", "-o", "out"]);
    scene.write("lipz.toml", "[rig.otto]\nJawDown = \"jaw\"\nextraordinarilyLongName = \"jaw\"\n");
    scene.expect(
        "LZ1113-export-loss-columns",
        &["export", "weights", "live-link", "voices", "-o", "out", "--rig", "otto", "-q"],
    );
    scene.expect(
        "LZ1113-export-loss-morphs",
        &["export", "weights", "vmd", "voices", "-o", "out", "--rig", "otto", "-q"],
    );
    scene.expect("LZ0906-would-overwrite-weights", &["export", "weights", "vmd", "voices", "-o", "out"]);
    for (arguments, told) in [
        (&["vmd", "voices", "--fps", "24"][..], "`vmd` always has 30 frames per second"),
        (&["gltf", "voices", "--rig", "arkti"], "did you mean `arkit`?"),
        (&["gltf", "voices", "--config", "bake=arkti"], "did you mean `arkit`?"),
    ] {
        let run = lipz(scene.path(), [&["export", "weights", "-o", "new"], arguments].concat());
        assert!(run.code > 0 && run.stderr.contains(told), "{run:?}");
        assert!(!scene.path().join("new").exists());
    }
    scene.finish(4);
}

#[test]
fn baked_weights_are_the_same_by_option_setting_and_conversion() {
    let scene = scene();
    for (name, option) in [("option", &["--bake", "arkit"][..]), ("setting", &["--config", "bake=arkit"])] {
        let run = lipz(scene.path(), [&["pack", "voices", "-o", name], option].concat());
        assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    }
    let run = lipz(scene.path(), ["convert", "voices", "--write-curves", "--in-place", "--config", "bake=arkit"]);
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
    assert!(run.stdout.contains("jawOpen in 1 file"), "{}", run.stdout);
    lipz(scene.path(), ["pack", "voices", "-o", "written"]);
    let bytes = ["option", "setting", "written"].map(|name| fs::read(scene.path().join(name)).unwrap());
    assert_eq!(bytes[0], bytes[1]);
    let curves = |bytes: &[u8]| {
        let bank = Bank::open(bytes).unwrap();
        let clip = bank.clip_by_key("mama").unwrap();
        clip.curves()
            .map(|curve| (curve.name().as_str().to_owned(), curve.keys().collect::<Vec<_>>()))
            .collect::<Vec<_>>()
    };
    assert_eq!(curves(&bytes[0]), curves(&bytes[2]));
    assert!(curves(&bytes[0]).len() > 10);
}
