//! `--config`: settings on the command line, with and without a settings file. They take precedence over the file.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use serde_json::Value;
use std::fs;
use support::{Outcome, Scene, lipz};

/// A text that two settings affect: its emotion is not registered, and its line is long.
const CLIP: &str =
    r#"{ "fps": 24, "visemes": "MAEO", "text_en-us": "Good evening, mayor.", "events": "feels nervous" }"#;

fn project() -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n[text]\nline-columns = 30\n");
    scene.write("release.toml", "sources = [\"voices\"]\n[text]\nline-columns = 10\n[lints]\nwarnings = \"deny\"\n");
    scene.write("voices/act1/mayor.lipz", CLIP);
    scene
}

/// Returns the exit code of `lipz check`, and the reported codes in order.
fn check(scene: &Scene, arguments: &[&str]) -> (i32, String) {
    let run = lipz(scene.path(), [&["check"], arguments].concat());
    let codes = run.stderr.lines().filter_map(|line| line.split_once("[LZ")?.1.split_once(']')).map(|(code, _)| code);
    (run.code, codes.collect::<Vec<_>>().join(" "))
}

/// Returns the outcome of a run that is refused because of its command line.
fn refused(scene: &Scene, arguments: &[&str]) -> Outcome {
    let run = lipz(scene.path(), arguments);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{arguments:?}: {}", run.stderr);
    run
}

#[test]
fn assignments_replace_what_the_file_says() {
    let scene = project();
    assert_eq!(check(&scene, &[]), (0, "0702".into()));
    assert_eq!(check(&scene, &["--config", "text.line-columns=10"]), (0, "0510 0702".into()));
    let emotion = "emotions.nervous=fear 3";
    assert_eq!(check(&scene, &["--config", emotion]), (0, String::new()));
    assert_eq!(check(&scene, &["--config", emotion, "--config", "text.line-columns = 10"]), (0, "0510".into()));
    let twice = ["--config", "text.line-columns=10", "--config", "text.line-columns=30"];
    assert_eq!(check(&scene, &twice), (0, "0702".into()), "the last one takes precedence");
    // Levels are settings, too, and command-line options take precedence over them.
    let deny = ["--config", "lints.unknown-emotion=deny"];
    assert_eq!(check(&scene, &deny), (1, "0702".into()));
    assert_eq!(check(&scene, &[&deny[..], &["--warn", "unknown-emotion"]].concat()), (0, "0702".into()));
    // A value is TOML, or a string without quotes.
    for locale in ["default-locale=de-de", "default-locale='de-de'", "default-locale = \"de-de\""] {
        let pack = ["pack", "-q", "-o", "b.lipzbank", "--config", locale];
        assert_eq!(lipz(scene.path(), pack).code, 0, "{locale}");
        let shown = lipz(scene.path(), ["coverage", "b.lipzbank"]).stdout;
        assert!(!shown.contains("(default locale)"), "no clip has a text in it: {shown}");
    }
}

#[test]
fn assignments_go_over_a_file_that_is_named_and_over_none() {
    let scene = project();
    let release = ["--config", "release.toml"];
    assert_eq!(check(&scene, &release), (1, "0510 0702".into()));
    for columns in [&["--config", "text.line-columns=30"][..], &["--config=text.line-columns=30"]] {
        assert_eq!(check(&scene, &[&release[..], columns].concat()), (1, "0702".into()), "after the file");
        assert_eq!(check(&scene, &[columns, &release].concat()), (1, "0702".into()), "before it");
    }
    let alone = ["voices", "--no-config", "--config", "text.line-columns=10"];
    assert_eq!(check(&scene, &alone), (0, "0510 0702".into()));
    let sources = ["--no-config", "--config", "sources=['voices']", "--config", "text.line-columns=30"];
    assert_eq!(check(&scene, &sources), (0, "0702".into()));
    for two in
        [["--config", "release.toml", "--config", "lipz.toml"], ["--no-config", "--config", "release.toml", "-q"]]
    {
        let run = refused(&scene, &[&["check"], &two[..]].concat());
        assert!(run.stderr.starts_with("error[LZ1601]: `--config` names a second settings file"), "{}", run.stderr);
    }
    // A file is read as a file, whatever its name.
    fs::rename(scene.path().join("release.toml"), scene.path().join("strip=true")).unwrap();
    assert_eq!(check(&scene, &["--config", "strip=true"]), (1, "0510 0702".into()));
}

#[test]
fn paths_in_assignments_count_from_the_current_folder() {
    let scene = project();
    let voices = scene.path().join("voices");
    let pack = ["pack", "act1", "--quiet", "--config", "root=.", "--config", "output=../act1.lipzbank"];
    assert_eq!(lipz(&voices, pack).code, 0);
    let listed = lipz(scene.path(), ["inspect", "act1.lipzbank", "--show", "clips"]);
    assert!(listed.stdout.starts_with("act1/mayor "), "{listed:?}");
    assert!(refused(&scene, &["pack", "--config", "output=-"]).stderr.contains("only `--output -`"));
}

#[test]
fn wrong_assignments_are_marked() {
    let mut scene = project();
    scene.expect("LZ1002-unknown-setting-assigned", &["check", "--config", "text.lins=2", "--config", "strip=true"]);
    scene.expect("LZ1003-setting-type-assigned", &["check", "--config", "text.lines=two"]);
    scene.expect("LZ1004-setting-value-assigned", &["check", "--config", "coverage.de-de=101"]);
    scene.expect("LZ1001-settings-syntax-assigned", &["check", "--config", "text..lines=2"]);
    scene.expect("LZ1007-settings-unreadable-assigned", &["check", "--config", "text.lines"]);
    for wrong in ["text.lins=2", "strip=maybe", "fallbacks.de-at=de-de", "=", "a b=1", "sources=[]"] {
        let run = refused(&scene, &["check", "--config", wrong]);
        assert!(run.stderr.contains(" --> --config:1:") && run.stderr.contains('^'), "{wrong}: {}", run.stderr);
    }
    let json = lipz(scene.path(), ["pack", "--config", "text.lins=2", "--output-format", "json"]);
    let json: Value = serde_json::from_str(&json.stdout).unwrap();
    let found = &json["diagnostics"][0];
    assert_eq!((&found["code"], &found["path"]), (&"LZ1002".into(), &"--config".into()), "{json}");
    assert_eq!(found["span"]["start"]["column"], 6, "{json}");
    scene.finish(5);
}
