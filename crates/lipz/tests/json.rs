//! The JSON of results, byte for byte, as `fixtures/json` has it. `LIPZ_BLESS=1` writes it anew; fields may be
//! added, never changed (docs/reference/versions.md).
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use support::{Comparison, Scene, lipz};

/// Two versions of a dialogue that differ in every way there is.
fn scene() -> Scene {
    let scene = Scene::new();
    scene.write("old/lipz.toml", "default-locale = \"en-us\"\n[babble.ghost]\n[babble.robot]\nrate = 12\n");
    scene.write(
        "old/a.lipz",
        r#"{ "fps": 24, "viseme_type": "blair", "visemes": "AAAA|MM", "text_en-us": "Good evening, Otto.|Aye.",
            "text_de-de": "Guten Abend, Otto.|Aye.", "text_de-at": "Servus.|Aye.", "events": "otto points door|" }"#,
    );
    scene.write("old/gone.lipz", r#"{ "text_en-us": "No.", "text_de-de": "No." }"#);
    scene.write("old/old-name.lipz", r#"{ "text_en-us": "Me." }"#);
    scene.write("old/old-shape.lipz", r#"{ "visemes": "-M-" }"#);
    scene.write("old/same.lipz", r#"{ "fps": 10, "visemes": "-A-", "text_en-us": "Same." }"#);
    scene.write(
        "new/lipz.toml",
        "default-locale = \"de-de\"\n[babble.robot]\nrate = 29.97\n[fallbacks]\nde-at = [\"en-us\"]\n",
    );
    scene.write(
        "new/a.lipz",
        r#"{ "fps": 29.97, "viseme_type": "rms", "visemes": "0123|45|", "text_en-us": "Good morning, Otto.|Aye.|",
            "text_de-de": "Guten Morgen, Otto.|Aye.|", "text_ja-jp": "灯台||", "events": "ring(3, x)||otto feels sad, stops staring" }"#,
    );
    scene.write("new/b.lipz", r#"{ "events": "otto points" , "text_de-at": "Servus." }"#);
    scene.write("new/here.lipz", r#"{ "text_en-us": "A \"quote\", a \\ and\u0085more.", "text_de-at": "So." }"#);
    scene.write("new/new-name.lipz", r#"{ "text_en-us": "Me." }"#);
    scene.write("new/new-shape.lipz", r#"{ "visemes": "-M-" }"#);
    scene.write("new/same.lipz", r#"{ "fps": 10, "visemes": "-A-", "text_en-us": "Same." }"#);
    for side in ["old", "new"] {
        let settings = format!("{side}/lipz.toml");
        let bank = format!("{side}.lipzbank");
        scene.prepare(&["pack", side, "-o", &bank, "--config", &settings, "--quiet"]);
    }
    scene.prepare(&["pack", "old", "-o", "split.lipzbank", "--split-locales", "--config", "old/lipz.toml", "--quiet"]);
    scene
}

#[test]
fn results_are_the_same_to_the_byte() {
    let scene = scene();
    let mut comparison = Comparison::default();
    let commands: [(&str, &[&str]); 9] = [
        ("coverage", &["coverage", "new.lipzbank"]),
        ("coverage-split", &["coverage", "split.lipzbank", "--texts", "split.*.lipztexts"]),
        ("diff", &["diff", "old.lipzbank", "new.lipzbank"]),
        ("diff-same", &["diff", "old.lipzbank", "old.lipzbank"]),
        ("inspect", &["inspect", "new.lipzbank"]),
        ("inspect-clip", &["inspect", "new.lipzbank", "a"]),
        ("inspect-clip-without-frames", &["inspect", "new.lipzbank", "here", "--locale", "de-at"]),
        ("inspect-list", &["inspect", "new.lipzbank", "--list"]),
        ("stats", &["stats", "new.lipzbank"]),
    ];
    for (name, arguments) in commands {
        let outcome = lipz(scene.path(), [arguments, &["--json"]].concat());
        assert!(outcome.stderr.is_empty(), "{name}: {}", outcome.stderr);
        comparison.compare(&format!("fixtures/json/{name}.json"), &outcome.stdout);
        let of_format = lipz(scene.path(), [arguments, &["--format", "json"]].concat());
        assert_eq!(of_format.stdout, outcome.stdout, "{name}: results have the format of the diagnostics");
    }
    comparison.finish(commands.len());
}
