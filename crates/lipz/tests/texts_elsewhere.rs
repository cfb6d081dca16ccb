//! Files for translators, as parsers that are not ours read them: polib, openpyxl, and the XML of Python.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use serde_json::{Value, json};
use std::process::Command;
use support::{Scene, lipz, repository};

#[test]
fn parsers_that_are_not_ours_find_the_same() {
    let scene = Scene::new();
    scene.write(
        "voices/act1/mayor.lipz",
        r#"{ "visemes": "MA|EO|", "text_en-us": "{louder} \"Mayor\"?|A\\B\tC\n<&> é灯|", "text_de-de": "{louder} ‚Bürgermeister‘!|\nÄ|" }"#,
    );
    scene.write("voices/formula.lipz", r#"{ "text_en-us": "- No, '=1" }"#);
    let files = [("po", "a.po"), ("xliff", "b.xlf"), ("xliff-1.2", "c.xlf"), ("xlsx", "d.xlsx")];
    for (format, name) in files {
        let arguments = ["texts", "export", format, "voices", "--from", "en-us", "--locale", "de-de", "-o", name];
        scene.prepare(&arguments);
    }
    let script = repository().join("crates/lipz/tests/support/read_texts.py");
    let mut python = Command::new("python3");
    python.arg(script).args(files.map(|(_, name)| name)).current_dir(scene.path());
    let output = python.env("PYTHONPATH", repository().join("target/tools")).output();
    let found = output.ok().filter(|output| output.status.success());
    let Some(found) = found else {
        assert!(std::env::var_os("LIPZ_TOOLS").is_none(), "needs polib and openpyxl, which `.ci/install` brings");
        eprintln!("skipped: polib and openpyxl are not on this machine");
        return;
    };
    let found: Value = serde_json::from_slice(&found.stdout).unwrap();
    let mayor = ["act1/mayor", "{louder} \"Mayor\"? | A\\B\tC\n<&> é灯 | ", "{louder} ‚Bürgermeister‘! | Ä | "];
    let expected = json!([mayor, ["formula", "- No, '=1", ""]]);
    for (file, (format, _)) in found.as_array().unwrap().iter().zip(files) {
        let mut file = file.clone();
        if format == "xliff" {
            // A segment without a source has no translation, either.
            file[0][2] = expected[0][2].clone();
        }
        assert_eq!(file, expected, "{format}");
    }
    let import = lipz(scene.path(), ["texts", "import", "d.xlsx", "-o", "voices", "--from", "en-us"]);
    assert_eq!(import.stdout.lines().next(), Some("texts imported: 0 new, 2 unchanged"), "{}", import.stderr);
}
