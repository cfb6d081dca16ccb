//! The widths of texts in the fonts of a project, and characters that the fonts lack.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use lipz_testkit::font::font;
use support::delivery::{export, import, replace};
use support::{Scene, lipz};

const SETTINGS: &str = "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n\
                        [text]\nline-pixels = 64\nfont-pixels = 16\nfont = \"fonts/latin.ttf\"\n\
                        [text.locales.ja]\nfont = \"fonts/japanese.ttf\"\nline-pixels = 40\n";

/// Returns a scene with two fonts: Latin letters are half an em wide, and others a whole one.
fn scene() -> Scene {
    let scene = Scene::new();
    let latin: Vec<(char, u16)> = ('a'..='z').chain("ABGKLMS .!".chars()).map(|letter| (letter, 500)).collect();
    let japanese: Vec<(char, u16)> = latin.iter().copied().chain("灯台守".chars().map(|sign| (sign, 1000))).collect();
    scene.write("fonts/latin.ttf", font(600, &latin));
    scene.write("fonts/japanese.ttf", font(600, &japanese));
    scene.write("lipz.toml", SETTINGS);
    scene.write("voices/mara.lipz", "{ \"text\": \"Good day!\", \"text_ja-jp\": \"灯台\" }\n");
    scene
}

const CHECK: [&str; 4] = ["check", "--quiet", "--allow", "text-without-locale"];

#[test]
fn lines_are_measured_in_the_font_of_their_locale() {
    let mut scene = scene();
    // A space, `!` and seven letters of half an em.
    scene.write("lipz.toml", SETTINGS.replace("64", "72"));
    assert_eq!(lipz(scene.path(), CHECK).stderr, "");
    scene.write("lipz.toml", SETTINGS);
    scene.write(
        "voices/mara.lipz",
        "{ \"text\": \"Good\\nday! |{speaker: Mara}A light\\n in the lamp.\", \"text_ja-jp\": \"灯台|灯台守\" }\n",
    );
    scene.expect("LZ0510-text-too-wide-pixels", &CHECK);
    scene.write("voices/mara.lipz", "{ \"text_pl-pl\": \"Łódź.\" }\n");
    scene.write("lipz.toml", SETTINGS.replace("line-pixels = 64\nfont-pixels = 16\n", ""));
    let without = lipz(scene.path(), CHECK);
    assert!(
        without.stderr.contains("`text.locales.ja.line-pixels` is set, but `font-pixels` is missing"),
        "{}",
        without.stderr
    );
    scene.write("lipz.toml", "sources = [\"voices\"]\n[text]\nfont = \"fonts/latin.ttf\"\n");
    scene.expect("LZ0518-missing-glyph", &CHECK);
    scene.finish(2);
}

#[test]
fn fonts_that_cannot_be_used_are_reported_in_the_settings() {
    let mut scene = scene();
    scene.write("lipz.toml", SETTINGS.replace("fonts/latin", "fonts/missing"));
    scene.write("fonts/japanese.ttf", "wOF2 of a web page");
    scene.write("voices/mara.lipz", "{ \"text_en-us\": \"Take 15 lamps!\", \"text_ja-jp\": \"50 灯台\" }\n");
    scene.expect("LZ1004-setting-value-fonts", &CHECK);
    scene.write("lipz.toml", "sources = [\"voices\"]\n[text]\nline-pixels = 64\nfont-pixels = 16\n");
    scene.expect("LZ1004-setting-value-line-pixels", &CHECK);
    scene.finish(2);
}

/// A changed font changes the result for unchanged files.
#[test]
fn caches_of_checks_contain_the_fonts() {
    let scene = scene();
    scene.write("lipz.toml", SETTINGS.replace("64", "72"));
    let check = || lipz(scene.path(), [&CHECK[..], &["--cache", "check.cache"]].concat()).stderr;
    assert_eq!(check(), "");
    assert_eq!(check(), "");
    scene.write("fonts/latin.ttf", font(600, &[('G', 500)]));
    assert!(check().contains("LZ0518"));
    std::fs::remove_file(scene.path().join("fonts/latin.ttf")).unwrap();
    assert!(check().contains("LZ1004"));
    scene.write("lipz.toml", SETTINGS.replace("64", "72").replace("fonts/latin", "fonts/japanese"));
    assert_eq!(check(), "");
    scene.write("lipz.toml", SETTINGS.replace("fonts/latin", "fonts/japanese"));
    assert!(check().contains("LZ0510"));
}

#[test]
fn a_delivery_is_measured_before_it_is_in_the_project() {
    let scene = scene();
    scene.write("voices/mara.lipz", "{ \"text_en-us\": \"Good day!\", \"text_de-de\": \"Tag!\" }\n");
    export(scene.path(), "po", "de.po");
    replace(scene.path(), "de.po", "Tag!", "Guten Abend!");
    let imported = import(scene.path(), &["de.po", "--check"]);
    assert!(imported.stderr.contains("a line of this text is 96 pixels wide"), "{imported:?}");
    assert!(imported.stderr.contains("de.po:"), "{imported:?}");
}
