//! Files for translators, read and edited by independent parsers: polib, openpyxl, translate-toolkit, and Python's XML.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use serde_json::{Value, json};
use std::process::Command;
use support::{Scene, lipz, repository};

/// Returns the output of a Python script that runs on these files; `None` if its libraries are not installed.
fn python(scene: &Scene, script: &str, files: &[&str]) -> Option<Value> {
    let mut python = Command::new("python3");
    python.arg(repository().join("crates/lipz/tests/support").join(script)).args(files).current_dir(scene.path());
    let output = python.env("PYTHONPATH", repository().join("target/tools")).output();
    let found = output.ok().filter(|output| output.status.success());
    if found.is_none() {
        let is_required = std::env::var_os("LIPZ_TOOLS").is_some();
        assert!(!is_required, "`{script}` needs libraries of Python, which `.ci/install` brings");
        eprintln!("skipped: what `{script}` needs is not on this machine");
    }
    Some(serde_json::from_slice(&found?.stdout).unwrap())
}

fn scene() -> Scene {
    let scene = Scene::new();
    scene.write(
        "voices/act1/mayor.lipz",
        r#"{ "visemes": "MA|EO|", "text_en-us": "{louder} \"Mayor\"?|A\\B\tC\n<&> é灯|", "text_de-de": "{louder} ‚Bürgermeister‘!|\nÄ|" }"#,
    );
    scene.write("voices/formula.lipz", r#"{ "text_en-us": "- No, '=1" }"#);
    scene
}

#[test]
fn parsers_that_are_not_ours_find_the_same() {
    let scene = scene();
    let files = [("po", "a.po"), ("xliff", "b.xlf"), ("xliff-1.2", "c.xlf"), ("xlsx", "d.xlsx")];
    for (format, name) in files {
        let arguments = ["export", "texts", format, "voices", "--from", "en-us", "--locale", "de-de", "-o", name];
        scene.prepare(&arguments);
    }
    let Some(found) = python(&scene, "read_texts.py", &files.map(|(_, name)| name)) else { return };
    let mayor = ["act1/mayor", "{louder} \"Mayor\"? | A\\B\tC\n<&> é灯 | ", "{louder} ‚Bürgermeister‘! | Ä | "];
    let expected = json!([mayor, ["formula", "- No, '=1", ""]]);
    for (file, (format, _)) in found.as_array().unwrap().iter().zip(files) {
        let mut file = file.clone();
        if format == "xliff" {
            // A segment without a source does not have a translation, either.
            file[0][2] = expected[0][2].clone();
        }
        assert_eq!(file, expected, "{format}");
    }
    let import = lipz(scene.path(), ["import", "texts", "d.xlsx", "-o", "voices", "--from", "en-us"]);
    assert_eq!(import.stdout.lines().next(), Some("texts imported: 0 new, 2 unchanged"), "{}", import.stderr);
}

#[test]
fn what_the_library_of_weblate_edits_is_what_comes_back() {
    let scene = scene();
    let files = [("po", "clip", "a.po"), ("xliff", "clip", "b.xlf"), ("xliff-1.2", "segment", "c.xlf")];
    for (format, by, name) in files {
        let by = if format == "xliff" { vec![] } else { vec!["--by", by] };
        let arguments = ["export", "texts", format, "voices", "--from", "en-us", "--locale", "de-de", "-o", name];
        scene.prepare(&[&arguments[..], &by].concat());
    }
    let Some(found) = python(&scene, "edit_texts.py", &files.map(|(.., name)| name)) else { return };
    let source = "{louder} \"Mayor\"? | A\\B\tC\n<&> é灯 | ";
    let formula = |key: &str| json!([key, "- No, '=1", "", false]);
    assert_eq!(found[0], json!([["act1/mayor", source, "{louder} ‚Bürgermeister‘! | Ä | ", true], formula("formula")]));
    // These programs treat placeholders as codes, not as words.
    let texts = |found: &Value| -> Vec<String> {
        let entries = found.as_array().unwrap().iter();
        entries.map(|entry| format!("{}={}", entry[1].as_str().unwrap(), entry[2].as_str().unwrap())).collect()
    };
    let expected = |placeholder: &str| {
        let mayor = format!("{placeholder} \"Mayor\"?={placeholder} ‚Bürgermeister‘!");
        vec![mayor, "A\\B\tC\n<&> é灯=Ä".to_owned(), "- No, '=1=".to_owned()]
    };
    assert_eq!(texts(&found[1]), expected(""));
    assert_eq!(texts(&found[2]), expected("{louder}"));
    let before = std::fs::read_to_string(scene.path().join("voices/act1/mayor.lipz")).unwrap();
    for (format, _, name) in files {
        let arguments = ["import", "texts", name, "-o", "voices", "--from", "en-us", "--locale", "de-de"];
        let import = lipz(scene.path(), arguments);
        assert_eq!(import.stdout.lines().next(), Some("texts imported: 1 new, 1 changed"), "{format}: {import:?}");
        let read = |name: &str| std::fs::read_to_string(scene.path().join(name)).unwrap();
        assert_eq!(read("voices/act1/mayor.lipz"), before.replace('Ä', "Öde"), "{format}");
        assert!(read("voices/formula.lipz").contains("\"text_de-de\": \"- Nein, '=1\""), "{format}");
        scene.write("voices/act1/mayor.lipz", &before);
        scene.write("voices/formula.lipz", r#"{ "text_en-us": "- No, '=1" }"#);
        std::fs::remove_file(scene.path().join("voices/lipz-texts.txt")).unwrap();
    }
}

#[test]
fn plural_forms_of_other_tools_become_variants() {
    for tool in ["polib", "translate"] {
        let scene = Scene::new();
        let file = r#"{ "visemes": "MA|EO", "text_en-us": "Look!|{n} left.", "text_en-us-x-one": "|One left." }"#;
        scene.write("voices/guards.lipz", file);
        let export = ["export", "texts", "po", "voices", "--from", "en-us", "--by", "segment", "--locale", "pl-pl"];
        scene.prepare(&[&export[..], &["-o", "pl.po"]].concat());
        let Some(found) = python(&scene, "plural_texts.py", &[tool, "pl.po"]) else { return };
        assert_eq!(found, json!(["guards|2"]), "{tool}");
        let import = lipz(scene.path(), ["import", "texts", "pl.po", "-o", "voices", "--from", "en-us"]);
        assert_eq!(import.stdout.lines().next(), Some("texts imported: 3 new"), "{tool}: {import:?}");
        let clip = std::fs::read_to_string(scene.path().join("voices/guards.lipz")).unwrap();
        let clip: Value = serde_json::from_str(&clip).unwrap();
        for (tag, text) in
            [("pl-pl-x-one", "|0: {n} left."), ("pl-pl-x-few", "|1: {n} left."), ("pl-pl", "|2: {n} left.")]
        {
            assert_eq!(clip[format!("text_{tag}")], text, "{tool}");
        }
    }
}
