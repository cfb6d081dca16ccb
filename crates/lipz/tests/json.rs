//! The JSON of results, compared byte for byte with `fixtures/json`. `LIPZ_BLESS=1` writes it again; fields may be
//! added, but never changed (docs/reference/versions.md).
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use support::{Comparison, Scene, lipz};

/// Returns two versions of a dialogue with every kind of difference.
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
    scene.prepare(&[
        "pack",
        "old",
        "-o",
        "split.lipzbank",
        "--config",
        "split-locales=true",
        "--config",
        "old/lipz.toml",
        "--quiet",
    ]);
    scene
}

/// The document on standard error, because standard output is reserved for the result.
const NO_DIAGNOSTICS: &str = "{\n  \"errors\": 0,\n  \"warnings\": 0,\n  \"diagnostics\": []\n}\n";

#[test]
fn results_are_the_same_to_the_byte() {
    let scene = scene();
    let mut comparison = Comparison::default();
    let commands: [(&str, &[&str]); 9] = [
        ("coverage", &["coverage", "new.lipzbank"]),
        ("coverage-split", &["coverage", "split.lipzbank+split.*.lipztexts"]),
        ("diff", &["diff", "old.lipzbank", "new.lipzbank"]),
        ("diff-same", &["diff", "old.lipzbank", "old.lipzbank"]),
        ("inspect", &["inspect", "new.lipzbank"]),
        ("inspect-clip", &["inspect", "new.lipzbank", "a"]),
        ("inspect-clip-without-frames", &["inspect", "new.lipzbank", "here", "--locale", "de-at"]),
        ("inspect-list", &["inspect", "new.lipzbank", "--show", "clips"]),
        ("stats", &["inspect", "--show", "stats", "new.lipzbank"]),
    ];
    for (name, arguments) in commands {
        let outcome = lipz(scene.path(), [arguments, &["--output-format", "json"]].concat());
        assert_eq!(outcome.stderr, NO_DIAGNOSTICS, "{name}");
        comparison.compare(&format!("fixtures/json/{name}.json"), &outcome.stdout);
    }
    comparison.finish(commands.len());
}
