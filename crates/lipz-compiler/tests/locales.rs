//! The locales of a bank, and the origins of their texts.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use lipz_bank::Bank;
use lipz_compiler::{Compiler, Documents, Input, LocaleError, MinCoverage, Options, Voices, discover};
use lipz_diagnostics::Code;
use lipz_testkit::dialogue;

const FILES: [(&str, &str); 3] = [
    ("aye", r#"{ "text_en-us": "{x} Aye.", "text_de-de": "Ja.", "text_en-gb": "Aye, sir." }"#),
    ("both", r#"{ "text_de-at": "Servus.", "text_de-de": "Hallo.", "text_en-us": "Hello." }"#),
    ("no", r#"{ "text_en-us": "No.", "events": "feels sad" }"#),
];

fn inputs(files: &[(&str, &str)]) -> Vec<Input> {
    files.iter().map(|(key, file)| Input::from_bytes(*key, *file)).collect()
}

fn packed(options: &Options) -> Vec<u8> {
    let compiled = Compiler::new(options.clone()).compile(&inputs(&FILES));
    assert!(compiled.reports.is_empty(), "{:?}", compiled.reports);
    compiled.bank.unwrap()
}

fn only(tags: &[&str]) -> Options {
    Options::new().default_locale("en-us").unwrap().locales(tags.iter().copied()).unwrap()
}

/// Returns each locale with the texts that it shows, clip by clip; `*` marks fallbacks.
fn shown(bytes: &[u8]) -> Vec<(String, Vec<String>)> {
    let bank = Bank::open(bytes).unwrap().verify().unwrap();
    let text = |clip: lipz_bank::Clip<'_>, locale| match clip.segment(0).unwrap().text(locale) {
        Some(text) => format!("{}{text}", if text.is_fallback() { "*" } else { "" }),
        None => "-".to_owned(),
    };
    let texts = |locale| bank.clips().map(|clip| text(clip, locale)).collect();
    bank.locales().map(|locale| (bank.locale_tag(locale).to_owned(), texts(locale))).collect()
}

#[test]
fn chosen_locales_have_what_they_fall_back_to() {
    let expect = |tags: &[&str], expected: &[(&str, [&str; 3])]| {
        let expected = expected.iter().map(|(tag, texts)| ((*tag).to_owned(), texts.map(str::to_owned).to_vec()));
        let expected: Vec<(String, Vec<String>)> = expected.collect();
        assert_eq!(shown(&packed(&only(tags))), expected, "{tags:?}");
    };
    expect(&["de-de"], &[("de-de", ["Ja.", "Hallo.", "*No."])]);
    expect(&["de-at"], &[("de-at", ["*Ja.", "Servus.", "*No."])]);
    let english = ("en-us", ["Aye.", "Hello.", "No."]);
    expect(&["de-at", "en-us"], &[("de-at", ["*Ja.", "Servus.", "*No."]), english]);
    // A locale without any file shows only its fallbacks.
    expect(&["de-ch"], &[("de-ch", ["*Ja.", "*Servus.", "*No."])]);
}

#[test]
fn texts_that_are_not_packed_are_nowhere_in_the_bank() {
    let bytes = packed(&only(&["de-de"]));
    let has = |text: &str| bytes.windows(text.len()).any(|window| window == text.as_bytes());
    assert!(has("Hallo.") && !has("Servus.") && !has("Hello.") && !has("en-gb") && !has("{x}"));
    dialogue!(bank = &bytes);
    let documents = Documents::from_dialogue(&bank).unwrap();
    let names: Vec<Vec<String>> = documents
        .iter()
        .map(|document| document.unwrap().1.elements.iter().map(|element| element.name.text.to_string()).collect())
        .collect();
    assert_eq!(names, [vec!["text_de-de"], vec!["text_de-de"], vec!["events"]]);
}

#[test]
fn choosing_all_locales_changes_nothing() {
    let inputs = discover(&[support::folder("drama")], None).unwrap();
    let options = Options::new().default_locale("en-us").unwrap();
    let all = Compiler::new(options.clone()).compile(&inputs).bank.unwrap();
    let bank = Bank::open(&all).unwrap();
    let chosen = options.locales(bank.locales().map(|locale| bank.locale_tag(locale))).unwrap();
    assert_eq!(Compiler::new(chosen).compile(&inputs).bank.unwrap(), all);
}

#[test]
fn named_fallbacks_come_first() {
    let options = Options::new().fallback("en-gb", ["de-de"]).unwrap().default_locale("en-us").unwrap();
    let british = shown(&packed(&options)).into_iter().find(|(tag, _)| tag == "en-gb").unwrap();
    assert_eq!(british.1, ["Aye, sir.", "*Hallo.", "-"]);
}

#[test]
fn a_pseudo_locale_is_made_of_the_default_locale() {
    let options = Options::new().pseudo(true).default_locale("en-us").unwrap();
    let all = shown(&packed(&options));
    let of = |wanted: &str| all.iter().find(|(tag, _)| tag == wanted).unwrap().1.clone();
    assert_eq!(of("en-xa"), ["[Åýé. one]", "[Ĥéļļö. one]", "[Ñö. one]"]);
    assert_eq!(of("en-gb"), ["Aye, sir.", "*Hello.", "*No."], "no locale falls back to it");
    let without = Compiler::new(Options::new().pseudo(true)).compile(&inputs(&FILES));
    assert!(without.bank.is_none() && without.reports[0].diagnostics[0].code == Code::SettingValue);
}

#[test]
fn a_pseudo_locale_is_packed_beside_chosen_ones() {
    let options = only(&["de-de"]).pseudo(true);
    let tags: Vec<String> = shown(&packed(&options)).into_iter().map(|(tag, _)| tag).collect();
    assert_eq!(tags, ["de-de", "en-xa"]);
}

#[test]
fn a_file_keeps_its_own_text_of_the_pseudo_locale() {
    let file = r#"{ "text_en-us": "Aye.", "text_en-xa": "Mine.", "text_fr-fr": " Oui." }"#;
    let options = Options::new().pseudo(true).default_locale("en-us").unwrap();
    let bytes = Compiler::new(options.clone()).compile(&inputs(&[("aye", file)])).bank.unwrap();
    let texts: Vec<Vec<String>> = shown(&bytes).into_iter().map(|(_, texts)| texts).collect();
    assert_eq!(texts, [["Aye."], ["Mine."], ["Oui."]]);
    dialogue!(bank = &bytes);
    let documents = Documents::from_dialogue(&bank).unwrap();
    let (_, document) = documents.iter().next().unwrap().unwrap();
    assert_eq!(document, lipz_file::parse(file.as_bytes()).document.unwrap());
}

#[test]
fn too_little_coverage_makes_no_bank() {
    let wanted = |all: Option<f64>, locale: Option<(&str, f64)>| {
        let share = all.map_or(MinCoverage::new(), |percent| MinCoverage::new().all(percent));
        let share = locale.into_iter().fold(share, |share, (tag, percent)| share.locale(tag, percent).unwrap());
        let compiled = Compiler::new(Options::new().min_coverage(share)).compile(&inputs(&FILES));
        let codes: Vec<Code> =
            compiled.reports.iter().flat_map(|report| &report.diagnostics).map(|found| found.code).collect();
        assert_eq!(compiled.bank.is_none(), !codes.is_empty());
        codes.len()
    };
    assert_eq!(wanted(Some(33.3), None), 0);
    assert_eq!(wanted(Some(50.0), None), 2);
    assert_eq!(wanted(Some(50.0), Some(("de-at", 30.0))), 1);
    assert_eq!(wanted(None, Some(("fr-fr", 1.0))), 1);
    assert_eq!(wanted(None, Some(("DE_at", 30.0))), 0, "a different spelling of the locale");
}

#[test]
fn locales_of_another_shape_are_refused() {
    let tag = |options: Result<Options, LocaleError>| options.unwrap_err().tag().to_owned();
    assert_eq!(tag(Options::new().default_locale("english")), "english");
    assert_eq!(tag(Options::new().locales(["en-us", "es-419"])), "es-419");
    assert_eq!(tag(Options::new().fallback::<&str>("de", [])), "de");
    assert_eq!(MinCoverage::new().locale("englisch-deutsch", 1.0).unwrap_err().tag(), "englisch-deutsch");
    let extended = Options::new().extended_locales(true).default_locale("es-419").unwrap();
    assert!(Compiler::new(extended.clone()).compile(&inputs(&FILES)).bank.is_some());
    let broken = [
        extended.extended_locales(false),
        Options::new().min_coverage(MinCoverage::new().locale("es-419", 1.0).unwrap()),
        Options::new().voices(Voices::new("es-419").unwrap()),
    ];
    for options in broken {
        let compiled = Compiler::new(options).compile(&inputs(&FILES));
        assert_eq!(compiled.reports[0].diagnostics[0].code, Code::LocaleShape);
    }
}
