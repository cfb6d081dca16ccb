//! `lipz check --baseline`: old diagnostics are ignored, new ones are reported.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::{Outcome, Scene, lipz};

/// Two unknown elements, and a segment without a text.
const OLD: &str = r#"{ "x_take": 1, "x_mood": 2, "visemes": "MA|MA", "text_en-us": "Aye." }"#;
const BASELINE: [&str; 4] = ["check", "voices", "--baseline", "known.txt"];

fn check(scene: &Scene, more: &[&str]) -> Outcome {
    lipz(scene.path(), BASELINE.iter().chain(more))
}

#[test]
fn a_project_with_old_diagnostics_is_told_only_of_new_ones() {
    let mut scene = Scene::new();
    for name in ["aye", "no"] {
        scene.write(&format!("voices/{name}.lipz"), OLD);
    }
    let missing = check(&scene, &[]);
    assert!(missing.code == 2 && missing.stderr.contains("`known.txt` does not exist"), "{missing:?}");
    let written = check(&scene, &["--write-baseline"]);
    assert_eq!((written.code, written.stderr.as_str()), (0, ""));
    assert_eq!(written.stdout, "6 known diagnostics recorded in known.txt\n2 files checked\n");
    let baseline = fs::read_to_string(scene.path().join("known.txt")).unwrap();
    let lines: Vec<&str> = baseline.lines().skip(1).collect();
    assert_eq!(lines[..2], ["2 LZ0203 voices/aye.lipz", "1 LZ0601 voices/aye.lipz"], "{baseline}");

    let known = check(&scene, &[]);
    assert_eq!((known.code, known.stderr.as_str()), (0, ""));
    assert_eq!(known.stdout, "6 known diagnostics hidden by known.txt\n2 files checked\n");
    // Paths are relative to the baseline, in any working directory.
    let below = lipz(&scene.path().join("voices"), ["check", ".", "--baseline", "../known.txt", "--quiet"]);
    assert_eq!((below.code, below.stderr.as_str()), (0, ""));

    scene.write("voices/new.lipz", r#"{ "text_en-us": "Aye.", "fps": 0 }"#);
    let new = check(&scene, &[]);
    assert_eq!((new.code, new.stderr.matches("error[").count(), new.stderr.matches("warning[").count()), (1, 1, 0));

    fs::remove_file(scene.path().join("voices/new.lipz")).unwrap();
    scene.write("voices/aye.lipz", r#"{ "x_take": 1, "visemes": "MAM", "text_en-us": "Aye." }"#);
    scene.expect("LZ1606-baseline-entry", &["check", "voices", "--baseline", "known.txt", "--quiet"]);
    let part = lipz(scene.path(), ["check", "voices/aye.lipz", "--baseline", "known.txt", "--write-baseline", "-q"]);
    assert_eq!(part.code, 0, "{part:?}");
    let baseline = fs::read_to_string(scene.path().join("known.txt")).unwrap();
    let lines: Vec<&str> = baseline.lines().skip(1).collect();
    let expected = ["1 LZ0203 voices/aye.lipz", "2 LZ0203 voices/no.lipz", "1 LZ0601 voices/no.lipz"];
    assert_eq!(lines, expected, "lines about other files stay");
    scene.finish(1);
}

#[test]
fn other_files_are_not_replaced_and_a_check_of_nothing_stays_an_error() {
    let scene = Scene::new();
    scene.write("voices/aye.lipz", OLD);
    scene.write("known.txt", "Otto: Aye.\n");
    let refused = check(&scene, &["--write-baseline"]);
    assert!(refused.code == 1 && refused.stderr.contains("[LZ1606]"), "{refused:?}");
    assert_eq!(fs::read_to_string(scene.path().join("known.txt")).unwrap(), "Otto: Aye.\n");
    fs::remove_file(scene.path().join("known.txt")).unwrap();
    fs::remove_file(scene.path().join("voices/aye.lipz")).unwrap();
    let nothing = check(&scene, &["--write-baseline"]);
    assert!(nothing.code != 0 && nothing.stderr.contains("error[LZ0805]"), "{nothing:?}");
}
