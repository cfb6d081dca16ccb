//! Terms and placeholders of a project, and the punctuation at the ends of translations.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use support::delivery::{export, import, replace};
use support::{Scene, lipz};

const SETTINGS: &str =
    "sources = [\"voices\"]\nroot = \"voices\"\ndefault-locale = \"en-us\"\n\n[text]\nterms = \"terms.csv\"\n";

fn scene(german: &str) -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", SETTINGS);
    scene.write("terms.csv", "en-us,de-de,fr\nlighthouse,Leuchtturm|Leuchtfeuer,phare\n");
    let clip = format!("{{ \"text_en-us\": \"To the lighthouse!\", \"text_de-de\": \"{german}\" }}");
    scene.write("voices/mara.lipz", clip);
    scene
}

#[test]
fn translations_use_the_terms_of_the_project() {
    for right in ["Zum Leuchtturm!", "Zu den Leuchtfeuern!"] {
        assert_eq!(lipz(scene(right).path(), ["check", "--quiet"]).stderr, "", "{right}");
    }
    let mut wrong = scene("Zum Feuerturm!");
    wrong.expect("LZ1922-term-missing", &["check", "--quiet"]);
    // The next check reads a changed table, also with a cache.
    let cached = ["check", "--quiet", "--cache", "check.cache"];
    assert!(lipz(wrong.path(), cached).stderr.contains("LZ1922"));
    wrong.write("terms.csv", "en-us,de-de\nlighthouse,Feuerturm\n");
    assert_eq!(lipz(wrong.path(), cached).stderr, "");
    wrong.write("terms.csv", "en-us,de-de\nlighthouse,Leuchtturm\n");
    assert!(lipz(wrong.path(), cached).stderr.contains("LZ1922"));
    wrong.write("terms.csv", "note,de-de\nlighthouse,Leuchtturm\n");
    wrong.expect("LZ1901-exchange-syntax-terms", &["check", "--quiet"]);
    wrong.finish(2);
}

/// Without its terms, a project still needs all other checks.
#[test]
fn a_missing_table_is_reported_in_the_settings_and_the_check_goes_on() {
    let mut scene = scene("Nimm 50 Lampen!");
    scene.write("lipz.toml", format!("\u{feff}{}", SETTINGS.replace("terms.csv", "missing.csv")));
    scene.write("voices/mara.lipz", "{ \"text_en-us\": \"Take 15 lamps!\", \"text_de-de\": \"Nimm 50 Lampen!\" }");
    scene.expect("LZ1004-setting-value-terms", &["check", "--quiet"]);
    // A table on the command line is reported there, also if nothing can be compared.
    let assigned = lipz(scene.path(), ["check", "voices", "--no-config", "--config", "text.terms=terms"]);
    assert_eq!(assigned.code, 1);
    assert!(assigned.stderr.contains(" --> --config:1:12\n"), "{}", assigned.stderr);
    std::fs::create_dir(scene.path().join("terms")).unwrap();
    scene.expect(
        "LZ1004-setting-value-terms-folder",
        &["check", "voices", "--quiet", "--no-config", "--config", "text.terms=terms"],
    );
    scene.finish(2);
}

#[test]
fn ends_of_texts_are_compared_on_request() {
    let mut scene = scene("Zum Leuchtturm");
    assert_eq!(lipz(scene.path(), ["check", "--quiet"]).stderr, "");
    scene.expect("LZ1923-end-punctuation", &["check", "--quiet", "--warn", "end-punctuation"]);
    scene.finish(1);
}

/// Games have placeholders that lipz does not know.
#[test]
fn placeholders_of_a_project_are_checked_and_their_patterns_must_be_useful() {
    let scene = Scene::new();
    let folder = scene.path();
    let settings = "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n[text]\nplaceholders = [\"[item:*]\"]\n";
    scene.write("lipz.toml", settings);
    scene.write(
        "voices/otto.lipz",
        "{ \"text_en-us\": \"Take [item:rope].\", \"text_de-de\": \"Nimm [item:Seil].\" }\n",
    );
    let different = "the translation has `[item:Seil]` instead of `[item:rope]`";
    let checked = lipz(folder, ["check"]);
    assert!(checked.stderr.contains(different), "{checked:?}");
    // The cache knows the patterns.
    scene.write("lipz.toml", settings.replace("[item:*]", "[place:*]"));
    for cached in [settings.replace("[item:*]", "[place:*]"), settings.to_owned()] {
        scene.write("lipz.toml", &cached);
        let checked = lipz(folder, ["check", "--cache", "cache"]);
        assert_eq!(checked.stderr.contains(different), cached == settings, "{checked:?}");
    }
    export(folder, "po", "de.po");
    replace(folder, "de.po", "Nimm", "Nehmt");
    let imported = import(folder, &["de.po"]);
    assert!(imported.stderr.contains(different), "{imported:?}");
    scene.write("lipz.toml", settings.replace("[item:*]", "*]"));
    let refused = lipz(folder, ["check"]);
    assert!(refused.code != 0 && refused.stderr.contains("the pattern has no text before `*`"), "{refused:?}");
}
