//! Errors that are about no source file: of the command line, of what was asked for, of the system. Each has a code,
//! is in the document of every format, and counts as an error.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use lipz_diagnostics::Code;
use serde_json::Value;
use std::fs;
#[cfg(target_os = "linux")]
use std::process::Command;
use support::{Outcome, Scene, assert_sarif, lipz, repository};

const CLIP: &str = r#"{ "fps": 24, "viseme_type": "blair", "visemes": "AE-", "text_en-us": "Aye." }"#;

/// Command lines, each with the code of its one error.
const REFUSED: &[(&[&str], Code)] = &[
    // By clap.
    (&["check", "--fixx"], Code::Usage),
    (&["nosuch"], Code::Usage),
    (&["unpack"], Code::Usage),
    (&["check", "voices", "--default-fps", "0"], Code::Usage),
    (&["explain", "LZ0401", "--list"], Code::Usage),
    // By the command.
    (&["check"], Code::Usage),
    (&["check", "voices", "--default-locale", "es-419"], Code::Usage),
    (&["check", "-", "--fix"], Code::Usage),
    (&["pack", "voices"], Code::Usage),
    (&["pack", "voices", "-o", "voices/aye.lipz"], Code::Usage),
    (&["pack", "voices", "-o", "lipz.toml"], Code::Usage),
    (&["pack", "voices", "-o", "x.lipzbank", "--depfile", "voices/lipz.toml"], Code::Usage),
    (&["pack", "voices", "-o", "x.lipzbank", "--depfile", "./x.lipzbank"], Code::Usage),
    (&["pack", "voices", "-o", "x.lipzbank", "--cache", "voices/../x.lipzbank"], Code::Usage),
    (&["pack", "--config", "stdout.toml", "-o", "stdout.toml"], Code::Usage),
    (&["ids", "voices", "--lang", "c", "-o", "lipz.toml"], Code::Usage),
    (&["pack", "voices", "-o", "-", "--split-locales"], Code::Usage),
    (&["pack", "--config", "stdout.toml"], Code::Usage),
    (&["fmt", "voices", "-"], Code::Usage),
    (&["convert", "voices"], Code::Usage),
    (&["convert", "voices", "--viseme-type", "toonboom"], Code::Usage),
    (&["convert", "-", "--viseme-type", "toonboom", "--in-place"], Code::Usage),
    (&["verify", "b.lipzbank", "c.lipzbank", "--texts", "d.lipztexts"], Code::Usage),
    (&["inspect", "base.lipzbank", "--texts", "base.en-us.lipztexts", "base.en-us.lipztexts"], Code::Usage),
    (&["export", "rhubarb-tsv", "voices"], Code::Usage),
    (&["import", "rhubarb-tsv", "mayor.tsv"], Code::Usage),
    (&["import", "papagayo", "two.pgo", "-o", "-"], Code::Usage),
    (&["import", "rhubarb-tsv", "mayor.tsv", "mara.tsv", "-o", "out", "--text", "Aye."], Code::Usage),
    (&["subtitles", "import", "mayor.txt", "-o", "voices"], Code::Usage),
    (&["ids", "voices", "--lang", "c", "--prefix", "1"], Code::Usage),
    (&["ids", "voices", "--lang", "rust", "--prefix", "a"], Code::Usage),
    (&["watch", "-", "-o", "b.lipzbank"], Code::Usage),
    (&["inspect", "b.lipzbank", "nosuch"], Code::NoSuchClip),
    (&["inspect", "b.lipzbank", "--locale", "en-us"], Code::Usage),
    (&["inspect", "b.lipzbank", "aye", "--locale", "fr-fr"], Code::NoSuchLocale),
    (&["coverage", "b.lipzbank", "--missing", "fr-fr"], Code::NoSuchLocale),
    (&["explain", "nosuch"], Code::NoSuchRule),
    (&["maps", "nosuch"], Code::MapRefused),
];

fn scene() -> Scene {
    let scene = Scene::new();
    scene.write("voices/aye.lipz", CLIP);
    scene.write("stdout.toml", "sources = [\"voices\"]\noutput = \"-\"\n");
    scene.write("mayor.tsv", "0.00\tX\n0.50\tD\n0.75\tX\n");
    scene.write("mara.tsv", "0.00\tX\n0.50\tD\n0.75\tX\n");
    scene.write("mayor.txt", "Aye.\n");
    let one = fs::read_to_string(repository().join("fixtures/interop/papagayo/hello.pgo")).unwrap();
    let (head, voice) = one.split_once("\n1\n").unwrap();
    scene.write("two.pgo", format!("{head}\n2\n{voice}{}", voice.replace("Mara", "Otto")));
    scene.prepare(&["pack", "voices", "-o", "b.lipzbank", "--quiet"]);
    scene.prepare(&["pack", "voices", "-o", "base.lipzbank", "--split-locales", "--quiet"]);
    scene
}

/// Fails unless the outcome of a run with this format reports exactly this error.
fn assert_reported(outcome: &Outcome, format: &str, code: Code) {
    assert_eq!(outcome.code, 2, "{outcome:?}");
    if format == "human" {
        assert_eq!(outcome.stdout, "", "{outcome:?}");
        assert!(outcome.stderr.starts_with(&format!("error[{code}]: ")), "{outcome:?}");
        return;
    }
    let (("", document) | (document, "")) = (outcome.stdout.as_str(), outcome.stderr.as_str()) else {
        unreachable!("there is one document: {outcome:?}");
    };
    if format == "github" {
        let title = format!("title={code} {}::", code.name());
        assert!(document.starts_with("::error ") && document.contains(&title), "{document}");
        assert_eq!(document.lines().count(), 1, "{document}");
        return;
    }
    let document: Value = serde_json::from_str(document).unwrap();
    if format == "json" {
        assert_eq!((&document["errors"], &document["warnings"]), (&1.into(), &0.into()), "{document}");
        assert_eq!(document["diagnostics"][0]["code"], code.number(), "{document}");
    } else {
        assert_sarif(&document);
        assert_eq!(document["runs"][0]["results"][0]["ruleId"], code.number(), "{document}");
        assert_eq!(document["runs"][0]["invocations"][0]["executionSuccessful"], false, "{document}");
    }
}

#[test]
fn every_error_is_in_every_format() {
    let scene = scene();
    for &(arguments, code) in REFUSED {
        for format in ["human", "json", "sarif", "github"] {
            // In front, where no argument before it can take it for its value.
            let outcome = lipz(scene.path(), [&["--format", format], arguments].concat());
            assert_reported(&outcome, format, code);
        }
    }
}

#[test]
fn scripts_find_usage_errors_on_standard_output() {
    for arguments in [
        &["unpack", "--format", "json"][..],
        &["nosuch", "--format=json"],
        &["--format", "json"],
        &["--format", "json", "fallout"],
    ] {
        let outcome = lipz(&repository(), arguments);
        assert_eq!((outcome.code, outcome.stderr.as_str()), (2, ""), "{outcome:?}");
        assert_reported(&outcome, "json", Code::Usage);
    }
}

#[test]
fn help_is_no_error_in_any_format() {
    for arguments in [&["--help"][..], &["--format", "json", "check", "--help"], &["--version", "--format", "json"]] {
        let outcome = lipz(&repository(), arguments);
        assert_eq!((outcome.code, outcome.stderr.as_str()), (0, ""), "{outcome:?}");
        assert!(outcome.stdout.contains("lipz"), "{outcome:?}");
    }
}

#[test]
fn what_people_see() {
    let mut scene = scene();
    scene.expect("LZ1601-usage", &["pack", "voices"]);
    scene.expect("LZ1601-usage-unknown", &["check", "voices", "--fixx"]);
    scene.expect("LZ1601-usage-missing", &["unpack"]);
    scene.expect("LZ1601-usage-value", &["check", "voices", "--format", "xml"]);
    scene.expect("LZ1602-no-such-clip", &["inspect", "b.lipzbank", "ayes"]);
    scene.expect("LZ1602-no-such-clip-far", &["inspect", "b.lipzbank", "quite-another"]);
    scene.expect("LZ1603-no-such-locale", &["coverage", "b.lipzbank", "--missing", "fr-fr"]);
    scene.expect("LZ1604-no-such-rule", &["explain", "forein-code"]);
    scene.expect("LZ1604-no-such-rule-far", &["explain", "LZ9999"]);
    scene.expect("LZ1111-map-refused-not-listed", &["maps", "papagaya"]);
    scene.finish(10);
}

/// Runs `lipz` with a shell that does something to it before.
#[cfg(target_os = "linux")]
fn in_shell(scene: &Scene, before: &str, after: &str, arguments: &[&str]) -> Outcome {
    let line = format!("{before}exec \"$0\" \"$@\"{after}");
    let output = Command::new("sh")
        .args(["-c", &line, env!("CARGO_BIN_EXE_lipz")])
        .args(arguments)
        .current_dir(scene.path())
        .env("NO_COLOR", "1")
        .output()
        .unwrap();
    Outcome::from(output)
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_is_an_error_in_every_format() {
    let scene = scene();
    let printing: [&[&str]; 6] = [
        &["schema"],
        &["completions", "bash"],
        &["maps"],
        &["explain"],
        &["inspect", "b.lipzbank"],
        &["pack", "voices", "-o", "-", "--quiet"],
    ];
    for arguments in printing {
        for format in ["human", "json", "sarif", "github"] {
            let outcome = in_shell(&scene, "", " > /dev/full", &[arguments, &["--format", format]].concat());
            assert_reported(&outcome, format, Code::OutputFailed);
        }
    }
    // The summary for people, and a document that has no other place.
    for arguments in [&["check", "voices"][..], &["check", "voices", "--format", "json"], &["--help"]] {
        let outcome = in_shell(&scene, "", " > /dev/full", arguments);
        assert_reported(&outcome, "human", Code::OutputFailed);
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_system_that_watches_nothing_is_an_error_in_every_format() {
    let mut scene = scene();
    // Enough files for the start of the program, too few for a watcher.
    let watch = |format: &str| {
        in_shell(&scene, "ulimit -n 8; ", "", &["watch", "voices", "-o", "b.lipzbank", "--format", format])
    };
    for format in ["human", "json", "sarif", "github"] {
        assert_reported(&watch(format), format, Code::WatchFailed);
    }
    let human = watch("human");
    scene.expect_outcome("LZ1605-watch-failed", &human);
    scene.finish(1);
}

/// Files that were joined, or changed with PowerShell's `>>`, have two byte order marks: parsers below ours skip the
/// second one, and then count from another place.
#[test]
fn two_byte_order_marks_are_told() {
    let scene = scene();
    let marked = |name: &str, text: &str| scene.write(name, format!("\u{feff}\u{feff}{text}"));
    marked("b.xml", "l");
    marked("d.en-us.srt", "1\n@@@kotor,500 ]--> 00:0\u{7f}\n");
    marked("d.toml", "x = 1");
    marked("m.txt", "Aye.");
    marked("aye.lipz", CLIP);
    let commands: [&[&str]; 6] = [
        &["babble", "b.xml"],
        &["import", "rhubarb-xml", "b.xml", "-o", "o", "--no-config"],
        &["subtitles", "import", "d.en-us.srt", "-o", "o"],
        &["check", "voices", "--config", "d.toml"],
        &["import", "rhubarb-tsv", "mayor.tsv", "-o", "o", "--map", "d.toml"],
        &["check", "aye.lipz"],
    ];
    for command in commands {
        for format in ["human", "json", "sarif", "github"] {
            let outcome = lipz(scene.path(), command.iter().copied().chain(["--format", format]));
            assert!((1..=2).contains(&outcome.code), "{command:?}: {outcome:?}");
        }
        let outcome = lipz(scene.path(), command.iter().copied());
        assert!(outcome.stderr.contains("\n1 error "), "{command:?}: {}", outcome.stderr);
    }
    let settings = lipz(scene.path(), ["check", "voices", "--config", "d.toml"]);
    assert!(settings.stderr.contains("d.toml:1:1"), "{}", settings.stderr);
}
