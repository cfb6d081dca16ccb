//! Locales on the command line: coverage, chosen locales, text banks.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use serde_json::Value;
use support::{Scene, lipz};

/// Returns a scene with the Lipz files of two clips, one of them without German.
fn scene() -> Scene {
    let scene = Scene::new();
    scene.write("voices/aye.lipz", r#"{ "visemes": "AE-", "text_en-us": "Aye.", "text_de-de": "Ja." }"#);
    scene.write("voices/no.lipz", r#"{ "visemes": "SO-", "text_en-us": "No." }"#);
    scene
}

const TABLE: &str = "\
voices: 2 clips with texts

  locale         covered   texts     same  fallback  no text  falls back to
  de-de           50.0 %       1        0         1        0  en-us 1
  en-us          100.0 %       2        0         0        0  (default locale)

same: the text is identical to that of the default locale
";

/// The output that is available only for Lipz files.
const WORK: &str = "
to translate from en-us: 2 segments with 2 words

  locale           words    missing      stale translated   reviewed      final  words to do
  de-de           50.0 %          1          0          1          0          0            1

words: the translated share; the next columns count segments
unknown: 1 of 1 translated segment without a recorded source text, which may be stale;
`lipz approve --all` records the current source texts
";

#[test]
fn coverage_of_a_folder_and_of_its_bank() {
    let scene = scene();
    let folder = lipz(scene.path(), ["coverage", "voices", "--config", "default-locale=en-us"]);
    let both = TABLE.to_owned() + WORK;
    assert_eq!((folder.code, folder.stdout.as_str(), folder.stderr.as_str()), (0, both.as_str(), ""));
    scene.prepare(&["pack", "voices", "-o", "b.lipzbank", "--config", "default-locale=en-us", "--quiet"]);
    let bank = lipz(scene.path(), ["coverage", "b.lipzbank"]);
    assert_eq!((bank.code, bank.stdout), (0, TABLE.replace("voices", "b.lipzbank")));
    let keys = lipz(scene.path(), ["coverage", "b.lipzbank", "--show", "missing", "--locale", "de-de"]);
    assert_eq!((keys.code, keys.stdout.as_str()), (0, "no\n"));
    let misspelt = lipz(scene.path(), ["coverage", "b.lipzbank", "--show", "missing", "--locale", "de_DE"]);
    assert_eq!((misspelt.code, misspelt.stdout), (0, keys.stdout));
    assert_eq!(lipz(scene.path(), ["coverage", "b.lipzbank", "--show", "missing", "--locale", "fr-fr"]).code, 2);
    let json = lipz(scene.path(), ["coverage", "b.lipzbank", "--output-format", "json"]);
    let json: Value = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!(json.pointer("/0/fallbacks/en-us/0").and_then(Value::as_str), Some("no"));
}

#[test]
fn in_a_project_coverage_and_stats_need_no_bank() {
    let scene = scene();
    scene.write("lipz.toml", "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n");
    let coverage = lipz(scene.path(), ["coverage"]);
    assert_eq!((coverage.code, coverage.stdout.as_str()), (0, (TABLE.to_owned() + WORK).as_str()), "{coverage:?}");
    let stats = lipz(scene.path(), ["inspect", "--show", "stats"]);
    assert!(stats.code == 0 && stats.stdout.starts_with("voices\n  2 clips, "), "{stats:?}");
    assert_eq!(lipz(scene.path(), ["coverage", "--no-config"]).code, 2);
}

#[test]
fn the_table_and_the_diagnostic_show_the_same_percent() {
    let scene = scene();
    scene.write("voices/yes.lipz", r#"{ "text_en-us": "Yes.", "text_de-de": "Doch." }"#);
    let shown = lipz(scene.path(), ["coverage", "voices", "--min-coverage", "66.7"]);
    assert!(shown.stdout.contains(" 66.6 % ") && shown.stderr.contains(": 66.6 % of"), "{shown:?}");
}

#[test]
fn too_little_is_translated() {
    let mut scene = scene();
    let wanted = ["--min-coverage", "60"];
    let pack = ["pack", "voices", "-o", "b.lipzbank", "--config", "coverage.all=60"];
    scene.expect("LZ0513-low-coverage", &pack);
    assert!(!scene.path().join("b.lipzbank").exists());
    let shown = lipz(scene.path(), ["coverage", "voices"].iter().chain(&wanted));
    assert_eq!(shown.code, 1);
    assert!(shown.stdout.contains("50.0 %") && shown.stderr.contains("[LZ0513]"), "{shown:?}");
    scene.write("lipz.toml", "[coverage]\nall = 100\nde-de = 50\n");
    assert_eq!(lipz(scene.path(), ["pack", "voices", "-o", "b.lipzbank"]).code, 0);
    scene.finish(1);
}

#[test]
fn another_script_is_shown_only_where_the_project_says_so() {
    let mut scene = Scene::new();
    scene.write("voices/aye.lipz", r#"{ "text_zh-cn": "是", "text_en-us": "Aye." }"#);
    scene.write(
        "voices/no.lipz",
        r#"{ "text_zh-cn": "不", "text_zh-tw": "不", "text_zh-hk": "不", "text_en-us": "No." }"#,
    );
    let pack = ["pack", "voices", "-o", "b.lipzbank", "-q", "--cache", "b.cache", "--config", "default-locale=en-us"];
    scene.expect("LZ0516-other-script", &pack);
    let again = lipz(scene.path(), pack);
    assert_eq!(again.stderr.matches("[LZ0516]").count(), 2, "nothing has changed, and it is reported again: {again:?}");
    let shown = lipz(scene.path(), ["inspect", "b.lipzbank", "aye", "--locale", "zh-tw"]);
    assert!(shown.stdout.contains("Aye.") && !shown.stdout.contains('是'), "{shown:?}");
    scene.write("lipz.toml", "[fallbacks]\nzh-tw = [\"zh-cn\"]\nzh-hk = [\"zh-tw\", \"zh-cn\"]\n");
    assert_eq!(lipz(scene.path(), pack).stderr, "", "the setting decides");
    let shown = lipz(scene.path(), ["inspect", "b.lipzbank", "aye", "--locale", "zh-tw"]);
    assert!(shown.stdout.contains('是'), "{shown:?}");
    scene.finish(1);
}

#[test]
fn a_locale_that_no_clip_has_is_not_left_out_in_silence() {
    let mut scene = scene();
    let pack = [
        "pack",
        "voices",
        "-o",
        "b.lipzbank",
        "-q",
        "--cache",
        "b.cache",
        "--config",
        "locales=['de-de','es-mx','fr-rf']",
    ];
    scene.expect("LZ0514-locale-without-texts", &pack);
    let again = lipz(scene.path(), pack);
    assert_eq!(again.stderr.matches("[LZ0514]").count(), 2, "nothing has changed, and it is reported again: {again:?}");
    let deny =
        ["pack", "voices", "-o", "c.lipzbank", "--config", "locales=['fr-rf']", "--deny", "locale-without-texts"];
    let denied = lipz(scene.path(), deny);
    assert!(denied.code == 1 && !scene.path().join("c.lipzbank").exists(), "{denied:?}");
    let fallback = ["pack", "voices", "-o", "b.lipzbank", "-q", "--config", "locales=['de-at']"];
    assert_eq!(lipz(scene.path(), fallback).stderr, "", "German will do in Austria");
    scene.finish(1);
}

#[test]
fn text_banks_are_checked_and_shown_with_their_bank() {
    let mut scene = scene();
    scene.write("lipz.toml", "default-locale = \"en-us\"\nsplit-locales = true\n");
    let packed = lipz(scene.path(), ["pack", "voices", "-o", "b.lipzbank"]);
    let lines: Vec<&str> = packed.stdout.lines().filter_map(|line| line.split(" (").next()).collect();
    assert_eq!(lines[..2], ["2 clips packed into b.lipzbank", "texts packed into b.de-de.lipztexts"], "{packed:?}");
    let verify = ["verify", "b.lipzbank", "b.de-de.lipztexts", "b.en-us.lipztexts"];
    let verified = lipz(scene.path(), verify);
    assert_eq!((verified.code, verified.stdout.lines().count()), (0, 3), "{verified:?}");
    assert!(verified.stdout.contains("b.de-de.lipztexts: no fault (texts in de-de, "), "{verified:?}");
    let shown = lipz(scene.path(), ["inspect", "b.lipzbank+b.de-de.lipztexts", "aye"]);
    assert!(shown.stdout.contains("Ja.") && !shown.stdout.contains("Aye."), "{shown:?}");
    let coverage = lipz(scene.path(), ["coverage", "b.lipzbank"]);
    assert!(coverage.stdout.contains("no clip has a text; add the text banks"), "{coverage:?}");
    scene.expect("LZ0902-bank-refused-texts-only", &["verify", "b.de-de.lipztexts"]);
    scene.write("more/yes.lipz", r#"{ "text_de-de": "Doch." }"#);
    scene.prepare(&["pack", "more", "-o", "m.lipzbank", "--quiet"]);
    scene.expect("LZ0902-bank-refused-other-clips", &["verify", "-q", "b.lipzbank", "m.de-de.lipztexts"]);
    assert_eq!(lipz(scene.path(), ["pack", "voices", "-o", "-"]).code, 2, "several banks for standard output");
    let whole = lipz(scene.path(), ["pack", "voices", "-o", "w.lipzbank", "--config", "split-locales=false"]);
    assert_eq!((whole.code, whole.stdout.lines().count()), (0, 1), "{whole:?}");
    scene.finish(2);
}

#[test]
fn text_banks_of_locales_that_are_gone_are_named() {
    let scene = scene();
    let pack = |locales: &[&str]| {
        let arguments = ["pack", "voices", "-o", "b.lipzbank", "--config", "split-locales=true"];
        lipz(scene.path(), arguments.iter().chain(locales))
    };
    assert!(!pack(&[]).stdout.contains("left unchanged"));
    let text = pack(&["--config", "locales=['en-us']"]).stdout;
    assert!(text.ends_with("left unchanged: b.de-de.lipztexts, because the bank no longer has its locale\n"), "{text}");
    assert!(scene.path().join("b.de-de.lipztexts").exists(), "files of a removed locale stay until you delete them");
}

#[test]
fn fallback_to_a_locale_that_is_not_packed() {
    let scene = scene();
    let arguments = ["coverage", "voices", "--config", "default-locale=en-us", "--config", "locales=['de-de']"];
    let shown = lipz(scene.path(), arguments).stdout;
    assert!(shown.contains("(not packed) 1"), "{shown}");
}

#[test]
fn only_chosen_locales_are_packed() {
    let scene = scene();
    scene.prepare(&[
        "pack",
        "voices",
        "-o",
        "b.lipzbank",
        "--config",
        "locales=['de-de']",
        "--config",
        "default-locale=en-us",
        "-q",
    ]);
    let shown = lipz(scene.path(), ["inspect", "b.lipzbank", "no"]);
    assert!(shown.stdout.contains("No.") && !shown.stdout.contains("en-us"), "{shown:?}");
}
