//! `lipz.toml` with any contents: diagnostics with positions in the file, and no panic.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::{Fps, VisemeType};
use lipz_compiler::MinCoverage;
use lipz_compiler::settings::{Settings, template};
use lipz_diagnostics::{Code, Report, Severity};
use proptest::prelude::*;
use std::path::PathBuf;

fn parse(bytes: &[u8]) -> (Settings, Report) {
    Settings::parse_with_report(bytes, "game/lipz.toml", "game")
}

#[test]
fn every_setting_is_read() {
    let text = r#"
        sources = ["voices", "../shared/*.lipz"]
        root = "."
        output = "/tmp/b.lipzbank"
        default-fps = 23.976
        default-viseme-type = "rms"
        viseme-type = "blair"
        extended-locales = true
        default-locale = "EN_us"
        locales = ["en-us", "zh-Hant"]
        split-locales = true
        split-voices = true
        pseudo = true
        strip = true
        coverage = { all = 90, DE_de = 99.5 }
        fallbacks = { es-419 = ["es-es", "en-us"] }
        text = { literal-braces = true, line-columns = 42, lines = 2, characters-per-second = 17.5 }
        lints = { warnings = "deny", LZ0702 = "allow", segment-count = "warn" }
        registry = { characters = ["mara"], props = ["door"], emotions = ["nervous"], actions = [] }
    "#;
    let (settings, report) = parse(text.as_bytes());
    assert_eq!(report.diagnostics, []);
    assert_eq!(settings.sources, ["game/voices", "game/../shared/*.lipz"].map(PathBuf::from));
    assert_eq!(settings.root, Some("game".into()));
    assert_eq!(settings.output, Some("/tmp/b.lipzbank".into()));
    assert!(settings.split_locales && settings.split_voices);
    let options = settings.options;
    assert!(options.get_pseudo());
    assert_eq!(options.get_min_coverage(), &MinCoverage::new().all(90.0).locale("de-de", 99.5).unwrap());
    assert_eq!(options.get_default_fps(), Fps::new(2997, 125));
    assert_eq!(
        (options.get_default_viseme_type(), options.get_viseme_type()),
        (Some(VisemeType::Rms), Some(VisemeType::Blair))
    );
    assert!(options.get_extended_locales() && options.get_strip() && options.get_literal_braces());
    assert_eq!(options.get_default_locale(), Some("en-us"));
    assert_eq!(options.get_locales(), Some(&["en-us", "zh-hant"].map(str::to_owned).into()));
    assert_eq!(options.get_fallbacks()["es-419"], ["es-es", "en-us"]);
    let limits = options.get_text_limits();
    assert_eq!((limits.get_line_columns(), limits.get_lines()), (Some(42), Some(2)));
    assert_eq!(limits.get_characters_per_second(), Some(17.5));
    let settings = "[text]\nline-pixels = 640\nfont = \"a.ttf\"\nfont-pixels = 32\n\
                    [text.locales.ja]\nfont = \"b.otf\"\n[text.locales.ja-jp]\nfont-pixels = 40.5\n";
    let (fonts, report) = parse(settings.as_bytes());
    assert_eq!(report.diagnostics, []);
    let of = |tag: &str| {
        let limit = fonts.pixel_limits.of(tag);
        (limit.font.unwrap().path().to_owned(), limit.font_pixels.unwrap(), limit.line_pixels.unwrap())
    };
    assert_eq!(of("de-de"), (PathBuf::from("game/a.ttf"), 32.0, 640));
    assert_eq!(of("ja-jp"), (PathBuf::from("game/b.otf"), 40.5, 640));
    let settings = "[text]\nlines = 2\n[text.locales.ja]\nlines = 3\nshortest-seconds = 0.5\n[text.locales.de-de]\nline-columns = 40";
    let (japanese, report) = parse(settings.as_bytes());
    let of = |tag: &str| japanese.options.get_text_limits_of(tag);
    assert_eq!(
        (of("ja-jp").get_lines(), of("ja-jp").get_shortest_seconds(), report.diagnostics.len()),
        (Some(3), Some(0.5), 0)
    );
    assert_eq!(
        (of("de-de").get_line_columns(), of("de-at").get_line_columns(), of("de-de").get_lines()),
        (Some(40), None, Some(2))
    );
    assert_eq!(options.get_levels().severity(Code::UnknownEmotion), None, "a lint takes precedence over its group");
    assert_eq!(options.get_levels().severity(Code::UnknownLocale), Some(Severity::Error));
    assert_eq!(options.get_levels().severity(Code::SegmentCount), Some(Severity::Warning));
    let names = options.get_known_names();
    assert_eq!(names.get_characters(), Some(&["mara".to_owned()].into()));
    assert_eq!(names.get_actions(), Some(&[].into()), "no actions at all");
    assert_eq!(names.get_emotions(), &["nervous".to_owned()].into());
}

#[test]
fn limits_are_for_languages_and_locales() {
    let found = |key: &str, more: &str| {
        let (settings, report) = parse(format!("{more}\n[text.locales.{key}]\nlines = 3").as_bytes());
        let found: Vec<_> = report.diagnostics.iter().map(|one| (one.code, one.message.clone())).collect();
        let help = report.diagnostics.first().and_then(|one| one.help.clone()).unwrap_or_default();
        (settings.options.get_text_limits_of("ja-jp").get_lines(), found, help)
    };
    for key in ["ja", "JA", "ja-jp", "ja_JP"] {
        assert_eq!(found(key, ""), (Some(3), vec![], String::new()), "{key}");
    }
    for key in ["japanese", "\"\"", "xx"] {
        for more in ["", "extended-locales = true"] {
            let (lines, found, help) = found(key, more);
            let message = format!("`{}` is not a language or locale", key.trim_matches('"'));
            assert_eq!((lines, found), (None, vec![(Code::SettingValue, message)]), "{key}");
            assert_eq!(help, "name a language, as in ja, or a language and a country, as in ja-jp");
        }
    }
    assert_eq!(found("es-419", "").1.len(), 1);
    assert_eq!(found("es-419", "extended-locales = true").1.len(), 0);
    assert!(found("ja-japan-x", "").2.contains("as in en-us"));
}

#[test]
fn a_locale_has_one_entry() {
    for text in ["[coverage]\nde-de = 90\nDE_de = 10", "[fallbacks]\nde-at = [\"de-de\"]\nde_AT = []"] {
        let (_, report) = parse(text.as_bytes());
        let [diagnostic] = &report.diagnostics[..] else { unreachable!("{text}: {:?}", report.diagnostics) };
        assert_eq!(diagnostic.code, Code::SettingValue);
        assert!(diagnostic.message.starts_with("the locale `de-"), "{}", diagnostic.message);
    }
}

#[test]
fn a_byte_order_mark_is_skipped() {
    let (settings, report) = parse(b"\xEF\xBB\xBFstrip = true\nstirp = true");
    assert!(settings.options.get_strip());
    assert_eq!(report.diagnostics.len(), 1);
    assert_eq!(&report.source.text[report.diagnostics[0].primary.as_ref().unwrap().span.range()], "stirp");
}

/// Returns the template with every setting uncommented.
fn uncommented() -> String {
    template(&[])
        .replace("\n#", "\n")
        .lines()
        .filter(|line| !line.starts_with(' '))
        .map(|line| format!("{line}\n"))
        .collect()
}

fn assert_places_are_in_the_file(bytes: &[u8]) {
    let (_, report) = parse(bytes);
    for diagnostic in &report.diagnostics {
        for label in diagnostic.primary.iter().chain(&diagnostic.labels) {
            assert!(report.source.text.get(label.span.range()).is_some(), "{diagnostic:?}");
        }
    }
}

proptest! {
    #[test]
    fn any_bytes(bytes in any::<Vec<u8>>()) {
        assert_places_are_in_the_file(&bytes);
    }

    #[test]
    fn any_change_of_a_good_file(
        (at, removed) in (any::<prop::sample::Index>(), 0..9_usize),
        inserted in "[\\[\\]{}=\"',.#a-z0-9\\\\\u{e9}灯\r\n \\-]{0,6}",
    ) {
        let mut bytes = uncommented().into_bytes();
        let start = at.index(bytes.len());
        let end = (start + removed).min(bytes.len());
        bytes.splice(start..end, inserted.bytes());
        assert_places_are_in_the_file(&bytes);
    }
}

#[test]
fn many_faults_take_little_time() {
    let faults = "default-fps = \n[a\n".repeat(50_000) + &"x = y\n".repeat(50_000);
    assert_places_are_in_the_file(faults.as_bytes());
    assert_places_are_in_the_file("x = [".repeat(100_000).as_bytes());
}

#[test]
fn a_project_without_lipz_files_is_an_error_unless_it_says_otherwise() {
    let folder = tempfile::tempdir().unwrap();
    let error = Settings::parse("", "lipz.toml", folder.path()).unwrap().discover().unwrap_err();
    assert_eq!(error.reports()[0].diagnostics[0].code, Code::NoSources);
    let lowered = Settings::parse("[lints]\nno-sources = \"warn\"\n", "lipz.toml", folder.path()).unwrap();
    let inputs = lowered.discover().unwrap();
    assert!(inputs.is_empty());
    assert_eq!(inputs.warnings()[0].diagnostics[0].severity, Severity::Warning);
    std::fs::write(folder.path().join("aye.lipz"), "{}").unwrap();
    let inputs = lowered.discover().unwrap();
    assert_eq!(inputs.warnings(), []);
    assert_eq!(inputs.into_vec()[0].key, "aye");
}
