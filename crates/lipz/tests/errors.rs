//! Errors that do not concern a source file: of the command line, of the requested work, of the system. Each has a
//! code, is in the document of every format, and counts as an error.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use lipz_diagnostics::Code;
use serde_json::Value;
use std::fs;
#[cfg(target_os = "linux")]
use std::process::Command;
use support::{Outcome, Scene, assert_sarif, lipz, repository};

const CLIP: &str = r#"{ "fps": 24, "viseme_type": "blair", "visemes": "AE-", "text_en-us": "Aye." }"#;

/// Command lines with the code of their only error.
const REFUSED: &[(&[&str], Code)] = &[
    // By clap.
    (&["check", "--fixx"], Code::Usage),
    (&["nosuch"], Code::Usage),
    (&["unpack"], Code::Usage),
    (&["explain", "LZ0401", "--list"], Code::Usage),
    (&["inspect", "b.lipzbank", "--show", "clips", "--locale", "en-us"], Code::Usage),
    // By a setting.
    (&["check", "voices", "--config", "default-fps=0"], Code::SettingValue),
    (&["check", "voices", "--config", "default-locale=es-419"], Code::SettingValue),
    (&["check", "voices", "--config", "text.lins=2"], Code::UnknownSetting),
    (&["check", "voices", "--config", "strip=maybe"], Code::SettingType),
    (&["pack", "voices", "-o", "x.lipzbank", "--config", "strip"], Code::SettingsUnreadable),
    // By the command.
    (&["check"], Code::Usage),
    (&["check", "-", "--fix"], Code::Usage),
    (&["pack", "voices"], Code::Usage),
    (&["pack", "voices", "-o", "voices/aye.lipz"], Code::Usage),
    (&["pack", "voices", "-o", "lipz.toml"], Code::Usage),
    (&["pack", "voices", "-o", "x.lipzbank", "--depfile", "voices/lipz.toml"], Code::Usage),
    (&["pack", "voices", "-o", "x.lipzbank", "--depfile", "./x.lipzbank"], Code::Usage),
    (&["pack", "voices", "-o", "x.lipzbank", "--cache", "voices/../x.lipzbank"], Code::Usage),
    (&["pack", "--config", "stdout.toml", "-o", "stdout.toml"], Code::Usage),
    (&["ids", "voices", "--lang", "c", "-o", "lipz.toml"], Code::Usage),
    (&["pack", "voices", "-o", "-", "--config", "split-locales=true"], Code::Usage),
    (&["pack", "--config", "stdout.toml"], Code::Usage),
    (&["fmt", "voices", "-"], Code::Usage),
    (&["convert", "voices"], Code::Usage),
    (&["convert", "voices", "--viseme-type", "toonboom"], Code::Usage),
    (&["convert", "-", "--viseme-type", "toonboom", "--in-place"], Code::Usage),
    (&["inspect", "base.lipzbank+base.en-us.lipztexts+base.en-us.lipztexts"], Code::Usage),
    (&["merge", "base.lipzbank", "base.en-us.lipztexts", "base.*.lipztexts", "-o", "x.lipzbank"], Code::Usage),
    (&["inspect", "b.lipzbank", "--config", "strip=true"], Code::Usage),
    (&["coverage", "b.lipzbank", "--deny", "warnings"], Code::Usage),
    (&["export", "visemes", "rhubarb-tsv", "voices"], Code::Usage),
    (&["import", "visemes", "rhubarb-tsv", "mayor.tsv"], Code::Usage),
    (&["import", "visemes", "papagayo", "two.pgo", "-o", "-"], Code::Usage),
    (&["import", "visemes", "rhubarb-tsv", "mayor.tsv", "mara.tsv", "-o", "out", "--script", "mayor.txt"], Code::Usage),
    (&["import", "subtitles", "mayor.txt", "-o", "voices"], Code::Usage),
    (&["ids", "voices", "--lang", "c", "--prefix", "1"], Code::Usage),
    (&["ids", "voices", "--lang", "rust", "--prefix", "a"], Code::Usage),
    (&["watch", "-", "-o", "b.lipzbank"], Code::Usage),
    (&["inspect", "b.lipzbank", "nosuch"], Code::NoSuchClip),
    (&["inspect", "b.lipzbank", "--locale", "en-us"], Code::Usage),
    (&["inspect", "b.lipzbank", "aye", "--locale", "fr-fr"], Code::NoSuchLocale),
    (&["coverage", "b.lipzbank", "--show", "missing", "--locale", "fr-fr"], Code::NoSuchLocale),
    (&["explain", "nosuch"], Code::NoSuchRule),
    (&["print", "maps", "nosuch"], Code::MapRefused),
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
    scene.prepare(&["pack", "voices", "-o", "base.lipzbank", "--config", "split-locales=true", "--quiet"]);
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
            // At the start, so that no option takes it as its value.
            let outcome = lipz(scene.path(), [&["--output-format", format], arguments].concat());
            assert_reported(&outcome, format, code);
        }
    }
}

#[test]
fn scripts_find_usage_errors_on_standard_output() {
    for arguments in [
        &["unpack", "--output-format", "json"][..],
        &["nosuch", "--output-format=json"],
        &["--output-format", "json"],
        &["--output-format", "json", "fallout"],
    ] {
        let outcome = lipz(&repository(), arguments);
        assert_eq!((outcome.code, outcome.stderr.as_str()), (2, ""), "{outcome:?}");
        assert_reported(&outcome, "json", Code::Usage);
    }
}

#[test]
fn help_is_no_error_in_any_format() {
    for arguments in
        [&["--help"][..], &["--output-format", "json", "check", "--help"], &["--version", "--output-format", "json"]]
    {
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
    scene.expect("LZ1601-usage-value", &["check", "voices", "--output-format", "xml"]);
    scene.expect("LZ1602-no-such-clip", &["inspect", "b.lipzbank", "ayes"]);
    scene.expect("LZ1602-no-such-clip-far", &["inspect", "b.lipzbank", "quite-another"]);
    scene.expect("LZ1603-no-such-locale", &["coverage", "b.lipzbank", "--show", "missing", "--locale", "fr-fr"]);
    scene.expect("LZ1604-no-such-rule", &["explain", "forein-code"]);
    scene.expect("LZ1604-no-such-rule-far", &["explain", "LZ9999"]);
    scene.expect("LZ1111-map-refused-not-listed", &["print", "maps", "papagaya"]);
    scene.finish(10);
}

/// Runs `lipz` in a shell, with `before` and `after` around the command.
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
        &["print", "schema"],
        &["print", "completions", "bash"],
        &["print", "maps"],
        &["explain"],
        &["inspect", "b.lipzbank"],
        &["pack", "voices", "-o", "-", "--quiet"],
    ];
    for arguments in printing {
        for format in ["human", "json", "sarif", "github"] {
            let outcome = in_shell(&scene, "", " > /dev/full", &[arguments, &["--output-format", format]].concat());
            assert_reported(&outcome, format, Code::OutputFailed);
        }
    }
    // The summary for people, and a document without another destination.
    for arguments in [&["check", "voices"][..], &["check", "voices", "--output-format", "json"], &["--help"]] {
        let outcome = in_shell(&scene, "", " > /dev/full", arguments);
        assert_reported(&outcome, "human", Code::OutputFailed);
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_system_that_watches_nothing_is_an_error_in_every_format() {
    let mut scene = scene();
    // Enough files to start the program, but too few for a watcher.
    let watch = |format: &str| {
        in_shell(&scene, "ulimit -n 8; ", "", &["watch", "voices", "-o", "b.lipzbank", "--output-format", format])
    };
    for format in ["human", "json", "sarif", "github"] {
        assert_reported(&watch(format), format, Code::WatchFailed);
    }
    let human = watch("human");
    scene.expect_outcome("LZ1605-watch-failed", &human);
    scene.finish(1);
}

/// Joined files, or files changed with PowerShell's `>>`, have two byte order marks. Parsers below lipz skip the second
/// one, and would report different positions.
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
        &["print", "babble", "b.xml"],
        &["import", "visemes", "rhubarb-xml", "b.xml", "-o", "o", "--no-config"],
        &["import", "subtitles", "d.en-us.srt", "-o", "o"],
        &["check", "voices", "--config", "d.toml"],
        &["import", "visemes", "rhubarb-tsv", "mayor.tsv", "-o", "o", "--map", "d.toml"],
        &["check", "aye.lipz"],
    ];
    for command in commands {
        for format in ["human", "json", "sarif", "github"] {
            let outcome = lipz(scene.path(), command.iter().copied().chain(["--output-format", format]));
            assert!((1..=2).contains(&outcome.code), "{command:?}: {outcome:?}");
        }
        let outcome = lipz(scene.path(), command.iter().copied());
        assert!(outcome.stderr.contains("\n1 error "), "{command:?}: {}", outcome.stderr);
    }
    let settings = lipz(scene.path(), ["check", "voices", "--config", "d.toml"]);
    assert!(settings.stderr.contains("d.toml:1:1"), "{}", settings.stderr);
}
