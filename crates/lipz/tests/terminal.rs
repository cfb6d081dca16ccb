//! Contents of files, file names and banks never reach the terminal as control characters, which could move the cursor,
//! hide diagnostics or start commands of the terminal.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::process::Command;
use support::Scene;
use support::forge::bank_with_key;

/// Sets the title of the window, clears the screen with 7-bit and 8-bit controls, and reverses the writing direction.
const HOSTILE: &str = "\u{1b}]0;x\u{7}\u{1b}[2J\u{9b}2J\u{8}\u{202e}\u{7f}";

/// Every output format of diagnostics.
const FORMATS: [&str; 4] = ["human", "json", "sarif", "github"];

/// Returns the output for a terminal, without lipz's own colours.
fn printed(scene: &Scene, arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_lipz"))
        .args(arguments)
        .current_dir(scene.path())
        .env_remove("NO_COLOR")
        .env("CLICOLOR_FORCE", "1") // otherwise all escapes are filtered out
        .output()
        .unwrap();
    let text = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
    let mut parts = text.split("\u{1b}[");
    let mut plain = parts.next().unwrap().to_owned();
    for part in parts {
        let rest = part.trim_start_matches(|c: char| c.is_ascii_digit() || c == ';');
        match rest.strip_prefix('m') {
            Some(rest) => plain.push_str(rest),
            None => plain.extend(["\u{1b}[", part]),
        }
    }
    plain
}

fn assert_harmless(scene: &Scene, arguments: &[&str], seen: &str) {
    let text = printed(scene, arguments);
    assert!(text.contains(seen), "{arguments:?}: {text:?}");
    let bad = text.chars().find(|&c| c.is_control() && c != '\n' || c == '\u{202e}');
    assert_eq!(bad, None, "{arguments:?}: {text:?}");
}

#[test]
fn diagnostics_about_hostile_files() {
    let scene = Scene::new();
    let escaped: String = HOSTILE.chars().map(|c| format!("\\u{:04x}", u32::from(c))).collect();
    // Unescaped JSON strings can contain only the controls above U+007E.
    let raw = "\u{9b}2J\u{7f}\u{202e}";
    let files = [
        ("names", format!("{{ \"{escaped}\": 1, \"{raw}\": 2, \"{raw}\": 3 }}")),
        (
            "texts",
            format!("{{ \"text_{escaped}\": \"\", \"text_en-us\": \"{raw}{escaped}|\", \"text_ja-jp\": \"{raw}\" }}"),
        ),
        ("codes", format!("{{ \"viseme_type\": \"blair\", \"visemes\": \"{raw}{escaped}\" }}")),
        ("type", format!("{{ \"viseme_type\": \"{escaped}\", \"fps\": \"{raw}\" }}")),
        ("control", format!("{{ \"events\": \"{HOSTILE}\" }}")),
        ("escape", format!("{{ \"events\": \"\\{raw}\" }}")),
        ("plain", HOSTILE.to_owned()),
        ("word", format!("{{ \"fps\": x{raw} }}")),
        ("rest", format!("{{}} {HOSTILE}")),
    ];
    for (name, text) in &files {
        scene.write(&format!("{name}/aye.lipz"), text);
        for format in FORMATS {
            assert_harmless(&scene, &["check", name, "--output-format", format], "LZ0");
        }
    }
    for clip in ["Aye", "aye"] {
        scene.write(&format!("keys/{HOSTILE}/{clip}.lipz"), "{}");
    }
    scene.write(&format!("keys/{HOSTILE}.lipz"), "{}");
    for format in FORMATS {
        assert_harmless(&scene, &["check", "keys", "--output-format", format], "LZ0803");
    }
    let missing = format!("nowhere{HOSTILE}");
    for arguments in [["check", &missing], ["verify", &missing], ["inspect", &missing]] {
        assert_harmless(&scene, &arguments, "nowhere");
    }
    scene.write("clip/aye.lipz", "{}");
    let output = format!("bank{HOSTILE}");
    assert_harmless(&scene, &["pack", "clip", "-o", &output], "bank");
    assert_harmless(&scene, &["verify", &output], "no fault");
    assert_harmless(&scene, &["inspect", &output], "no fault");
    assert_harmless(&scene, &["inspect", &output, HOSTILE], "no clip");
    assert_harmless(&scene, &["unpack", &output, "-o", HOSTILE], "1 file unpacked");
    assert_harmless(&scene, &["unpack", &output, "-o", HOSTILE], "LZ0906");
    assert_harmless(&scene, &["explain", HOSTILE], "no rule");
}

#[test]
fn banks_with_hostile_keys_and_texts() {
    let scene = Scene::new();
    let key = "a\u{1b}[2J\u{9b}2\u{7}b";
    scene.write("hostile.lipzbank", bank_with_key(&scene, key));
    for arguments in [
        &["inspect", "hostile.lipzbank", "--show", "clips"][..],
        &["inspect", "hostile.lipzbank", "--show", "clips", "--output-format", "json"],
        &["inspect", "hostile.lipzbank", key],
        &["inspect", "hostile.lipzbank", key, "--output-format", "json"],
        &["inspect", "hostile.lipzbank", "b"],
        &["unpack", "hostile.lipzbank", "-o", "out"],
    ] {
        assert_harmless(&scene, arguments, "2J");
    }
    scene.write("texts/aye.lipz", "{ \"text_en-us\": \"\\u001b[2JAye \u{9b}2J\", \"events\": \"\\u001b]0;x\\u0007\" }");
    scene.prepare(&["pack", "texts", "-o", "texts.lipzbank", "--quiet"]);
    assert_harmless(&scene, &["inspect", "texts.lipzbank", "aye"], "Aye");
    for sides in [["hostile.lipzbank", "texts"], ["texts", "hostile.lipzbank"]] {
        assert_harmless(&scene, &["diff", sides[0], sides[1]], "2J");
        assert_harmless(&scene, &["diff", sides[0], sides[1], "--output-format", "json"], "2J");
    }
    scene.write("other/aye.lipz", "{ \"text_en-us\": \"\\u001b[2JNo\", \"events\": \"\\u009bx\" }");
    assert_harmless(&scene, &["diff", "texts", "other"], "2J");
    assert_harmless(&scene, &["inspect", "--show", "stats", "hostile.lipzbank"], "section");
    assert_harmless(&scene, &["inspect", "texts.lipzbank", "aye", "--output-format", "json"], "Aye");
}
