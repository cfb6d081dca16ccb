//! Variants of texts for numbers, genders and forms of address, in a project.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::delivery::replace;
use support::{Scene, lipz};

const GUARDS: &str = r#"{
  "visemes": "MA|EO",
  "text_en-us": "Look!|{n} guards are left.",
  "text_en-us-x-one": "|One guard is left.",
  "text_pl-pl": "Patrz!|Zostało {n} strażników."
}
"#;

fn scene() -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n[text]\nliteral-braces = true\n");
    scene.write("voices/guards.lipz", GUARDS);
    scene
}

#[test]
fn plural_forms_come_back_from_po_files() {
    let scene = scene();
    let folder = scene.path();
    assert!(lipz(folder, ["check"]).stderr.contains("the translation lacks `text_pl-pl-x-one`, `text_pl-pl-x-few`"));
    lipz(folder, ["export", "texts", "po", "--locale", "pl-pl", "-o", "pl.po"]);
    replace(folder, "pl.po", "msgstr[0] \"\"", "msgstr[0] \"Patrz! | Został jeden strażnik.\"");
    replace(folder, "pl.po", "msgstr[1] \"\"", "msgstr[1] \"Patrz! | Zostali {n} strażnicy.\"");
    let imported = lipz(folder, ["import", "texts", "pl.po"]);
    assert_eq!((imported.code, imported.stderr.as_str()), (0, ""));
    let added = "Zostało {n} strażników.\",\n  \"text_pl-pl-x-few\": \"|Zostali {n} strażnicy.\",\n  \"text_pl-pl-x-one\": \"|Został jeden strażnik.\"\n}\n";
    let clip = fs::read_to_string(folder.join("voices/guards.lipz")).unwrap();
    assert!(clip.ends_with(added), "the variants follow their text, and segments that do not vary are blank: {clip}");
    assert_eq!(lipz(folder, ["check"]).stderr, "");
    let again = lipz(folder, ["import", "texts", "pl.po"]);
    assert_eq!((again.stdout.as_str(), again.stderr.as_str()), ("texts imported: 0 new, 3 unchanged\n", ""));

    // A changed variant of the source concerns its translation alone.
    replace(folder, "voices/guards.lipz", "One guard is left.", "A single guard is left.");
    let stale = lipz(folder, ["check"]).stderr;
    assert!(
        stale.contains("LZ1911") && stale.contains("voices/guards.lipz:7:") && !stale.contains("guards.lipz:6:"),
        "{stale}"
    );
    lipz(folder, ["export", "texts", "po", "--locale", "pl-pl", "-o", "stale.po"]);
    let po = fs::read_to_string(folder.join("stale.po")).unwrap();
    let both = "#| msgid \" | One guard is left.\"\n#| msgid_plural \"Look! | {n} guards are left.\"\n";
    assert!(po.contains(both) && po.contains("#, fuzzy"), "gettext reads both lines or neither: {po}");
    let approved = lipz(folder, ["approve", "--all"]);
    assert!(approved.stdout.contains("guards pl-pl-x-one: "), "{approved:?}");
    assert_eq!(lipz(folder, ["check"]).stderr, "");
}

#[test]
fn missing_variants_are_reported_and_counted() {
    let mut scene = scene();
    scene.expect("LZ1924-variant-missing", &["check", "--quiet"]);
    let work = lipz(scene.path(), ["coverage", "--show", "missing", "--locale", "pl-pl", "--as", "csv"]).stdout;
    assert!(work.contains("guards|x-few,2,pl-pl,missing") && work.contains("guards|x-one,2,pl-pl,missing"), "{work}");
    let refused = lipz(scene.path(), ["export", "texts", "po", "--locale", "pl-pl-x-few", "-o", "x.po"]);
    assert!(refused.code == 2 && refused.stderr.contains("expected a language and a country"), "{refused:?}");
    scene.finish(1);
}

/// A text of another form of the same language is no translation.
#[test]
fn variants_of_the_source_are_no_translations() {
    let scene = scene();
    scene.write("voices/guards.lipz", r#"{ "text_en-us": "Hi {n}.", "text_en-us-x-one": "Hi {name} 7." }"#);
    assert_eq!(lipz(scene.path(), ["check"]).stderr, "");
    let exported = lipz(scene.path(), ["export", "texts", "csv", "-o", "-"]);
    assert!(exported.stderr.contains("no clip has a text in a locale other than en-us"), "{exported:?}");
}

/// A subtitle file has one text for each cue, and a clip has one recording.
#[test]
fn subtitles_and_recording_scripts_have_the_texts_alone() {
    let scene = scene();
    let folder = scene.path();
    let subtitles = lipz(folder, ["export", "subtitles", "srt", "-o", "srt", "--config", "default-fps=24"]);
    assert!(subtitles.stderr.contains("`text_en-us-x-one` is a variant, and is not exported"), "{subtitles:?}");
    assert!(folder.join("srt/guards.en-us.srt").exists() && !folder.join("srt/guards.en-us-x-one.srt").exists());
    let script = lipz(folder, ["export", "recording-script", "csv", "-o", "-"]);
    assert_eq!(script.stdout.matches("guards are left").count(), 1, "{script:?}");
    assert!(!script.stdout.contains("One guard"), "{script:?}");
}
