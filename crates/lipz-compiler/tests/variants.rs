//! Variants of texts: packing, fallback, unpacking and queries.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::files::DialogueFile;
use lipz_bank::{Bank, Clip, Dialogue, Locale};
use lipz_compiler::{Compiled, Compiler, Documents, Input, Options, SplitBank, coverage};
use lipz_diagnostics::Code;
use lipz_testkit::dialogues::with;
use std::time::{Duration, Instant};

const GUARDS: &str = r#"{ "visemes": "M|A", "text_en-us": "Look!|{n} guards.", "text_en-us-x-one": " | One guard.",
    "text_pl-pl": "Patrz!|{n} strażników.", "text_pl-pl-x-one": "|Jeden strażnik.", "text_pl-pl-x-few": "|{n} strażnicy.",
    "text_pl-pl-x-few-fem": "Popatrz!|{n} strażniczki." }"#;
const PLAIN: &str = r#"{ "visemes": "A", "text_en-us": "Aye.", "text_pl-pl": "Tak." }"#;
const ENGLISH: &str = r#"{ "visemes": "A", "text_en-us": "{n} left.", "text_en-us-x-one": "One left." }"#;

fn options() -> Options {
    Options::new().default_locale("en-us").unwrap().literal_braces(true)
}

fn compiled(options: &Options, files: &[(&str, &str)]) -> Compiled {
    let inputs: Vec<Input> = files.iter().map(|(key, file)| Input::from_bytes(*key, *file)).collect();
    Compiler::new(options.clone()).compile(&inputs)
}

fn packed(options: &Options) -> Vec<u8> {
    let compiled = compiled(options, &[("english", ENGLISH), ("guards", GUARDS), ("plain", PLAIN)]);
    assert!(compiled.reports.is_empty(), "{:?}", compiled.reports);
    compiled.bank.unwrap()
}

fn texts(clip: &Clip<'_>, locale: Locale) -> String {
    clip.segments().map(|segment| segment.text(locale).unwrap().as_str().to_owned()).collect::<Vec<_>>().join("|")
}

fn shown(dialogue: &Dialogue<'_>, clip: &str, tag: &str, key: &str) -> String {
    let locale = dialogue.variant(dialogue.locale(tag).unwrap(), key);
    texts(&dialogue.clip_by_key(clip).unwrap(), locale)
}

#[test]
fn a_key_selects_a_text() {
    let bank = packed(&options());
    with(&[&bank], |dialogue| {
        let shown = |clip, tag, key| shown(dialogue, clip, tag, key);
        assert_eq!(shown("guards", "en-us", "one"), "Look!|One guard.", "blank segments are those of the text");
        assert_eq!(shown("guards", "pl-pl", "few"), "Patrz!|{n} strażnicy.");
        assert_eq!(shown("guards", "pl-pl", "few-fem"), "Popatrz!|{n} strażniczki.");
        assert_eq!(shown("guards", "pl-pl", "one-fem"), "Patrz!|Jeden strażnik.", "without the second name");
        assert_eq!(shown("guards", "pl-pl", "many"), "Patrz!|{n} strażników.", "no such variant");
        assert_eq!(shown("plain", "pl-pl", "few"), "Tak.", "no variant of this clip");
        assert_eq!(shown("english", "pl-pl", "one"), "{n} left.", "the English category has other numbers");
        assert_eq!(shown("english", "pl-pl", "few"), "{n} left.");
    });
    let bank = Bank::open(&bank).unwrap().verify().unwrap();
    let polish = bank.locale("pl-pl").unwrap();
    assert_eq!(bank.locale_tag(bank.variant(polish, "few-masc")), "pl-pl-x-few");
    assert_eq!(bank.variant(polish, ""), polish);
    assert_eq!(bank.variant(polish, "--"), polish);
    let foreign = Locale::from_words([7, 7]);
    assert_eq!(bank.variant(foreign, "few"), foreign);
}

#[test]
fn a_gender_is_found_for_all_numbers() {
    let queen = r#"{ "visemes": "A", "text_en-us": "My liege.", "text_en-us-x-fem": "My queen.",
        "text_pl-pl": "{n} panów.", "text_pl-pl-x-few": "{n} panowie.", "text_pl-pl-x-fem": "{n} pań." }"#;
    let english =
        r#"{ "visemes": "A", "text_en-us": "My liege.", "text_en-us-x-fem": "My queen.", "text_en-us-x-one": "1" }"#;
    let bank = compiled(&options(), &[("english", english), ("queen", queen)]).bank.unwrap();
    with(&[&bank], |dialogue| {
        let shown = |clip, tag, key| shown(dialogue, clip, tag, key);
        assert_eq!(shown("queen", "pl-pl", "many-fem"), "{n} pań.", "no variant is for `many`");
        assert_eq!(shown("queen", "pl-pl", "other-fem-formal"), "{n} pań.");
        assert_eq!(shown("queen", "pl-pl", "few-fem"), "{n} panowie.", "the number first");
        assert_eq!(shown("queen", "pl-pl", "all-fem"), "{n} panów.", "only a plural category is left out");
        assert_eq!(shown("queen", "pl-pl", "few-"), "{n} panowie.");
        assert_eq!(shown("queen", "pl-pl", "many-"), "{n} panów.");
        assert_eq!(shown("english", "pl-pl", "many-fem"), "My queen.", "a gender of the fallback locale");
    });
    let bank = Bank::open(&bank).unwrap().verify().unwrap();
    assert_eq!(bank.locale_tag(bank.variant(bank.locale("pl-pl").unwrap(), "two-fem")), "pl-pl-x-fem");
}

#[test]
fn files_come_back_with_their_blanks() {
    with(&[&packed(&options())], |dialogue| {
        let documents = Documents::from_dialogue(dialogue).unwrap();
        assert!(documents.is_exact());
        for (document, file) in documents.iter().zip([ENGLISH, GUARDS, PLAIN]) {
            assert_eq!(document.unwrap().1, lipz_file::parse(file.as_bytes()).document.unwrap());
        }
    });
}

#[test]
fn a_locale_is_packed_with_its_variants() {
    let bank = packed(&options().locales(["pl-pl"]).unwrap());
    with(&[&bank], |dialogue| {
        let mut tags: Vec<_> = dialogue.locales().map(|locale| dialogue.locale_tag(locale)).collect();
        tags.sort_unstable();
        assert_eq!(tags, ["pl-pl", "pl-pl-x-few", "pl-pl-x-few-fem", "pl-pl-x-one"]);
        assert_eq!(shown(dialogue, "english", "pl-pl", "one"), "{n} left.", "with the text that it borrows");
        assert_eq!(shown(dialogue, "guards", "pl-pl", "few"), "Patrz!|{n} strażnicy.");
    });
}

#[test]
fn text_banks_have_variants() {
    let split = SplitBank::from_bytes(&packed(&options())).unwrap();
    let tags: Vec<_> = split.texts.iter().map(|(tag, _)| tag.as_str()).collect();
    assert_eq!(tags, ["en-us", "pl-pl"], "one file for a language and its variants");
    let mut files: Vec<&[u8]> = vec![&split.base];
    files.extend(split.texts.iter().map(|(_, texts)| texts.as_slice()));
    let mut opened = [DialogueFile::ABSENT; 8];
    let dialogue = Dialogue::open(&mut opened, files).unwrap();
    assert_eq!(shown(&dialogue, "guards", "pl-pl", "few-fem"), "Popatrz!|{n} strażniczki.");
    assert_eq!(shown(&dialogue, "guards", "en-us", "one"), "Look!|One guard.");
    assert_eq!(shown(&dialogue, "plain", "pl-pl", "few"), "Tak.");
    assert_eq!(shown(&dialogue, "english", "pl-pl", "one"), "{n} left.");
    let mut base = Bank::open(&split.base).unwrap().verify().unwrap();
    base.open_texts(&split.texts[1].1).unwrap();
}

#[test]
fn variants_are_no_locales_of_their_own() {
    let bank = packed(&options());
    let covered = with(&[&bank], coverage);
    let percents: Vec<_> = covered.iter().map(|locale| (locale.tag.as_str(), locale.own_count)).collect();
    assert_eq!(percents, [("en-us", 3), ("pl-pl", 2)]);
    assert!(Options::new().default_locale("en-us-x-one").is_err());
    assert!(Options::new().locales(["en-us-x-one"]).is_err());
}

#[test]
fn names_of_variants_are_checked() {
    let codes = |file: &str| -> Vec<Code> {
        let compiled = compiled(&options(), &[("a", file)]);
        compiled.reports.iter().flat_map(|report| &report.diagnostics).map(|diagnostic| diagnostic.code).collect()
    };
    let with_key = |key: &str| format!(r#"{{ "text_en-us": "a", "text_en-us-x-{key}": "b" }}"#);
    assert_eq!(codes(r#"{ "text_en-us-x-one": "One." }"#), [Code::VariantWithoutText]);
    assert_eq!(codes(r#"{ "text_en-us": "a", "text_en-us-x-masculine": "b" }"#), [Code::LocaleShape]);
    assert_eq!(codes(&with_key(&["fem"; 9].join("-"))), []);
    assert_eq!(codes(&with_key(&["fem"; 10].join("-"))), [Code::LocaleShape]);
    assert_eq!(codes(r#"{ "text_en-us": "a", "text_en-us-x-One": "b" }"#), [Code::LocaleSpelling]);
    assert_eq!(codes(r#"{ "text_en-uk": "a", "text_en-uk-x-one": "b" }"#), [Code::UnknownLocale; 2]);
    assert_eq!(codes(r#"{ "text_en-us": "a|b", "text_en-us-x-one": "c" }"#), [Code::SegmentCount]);
}

#[test]
fn a_bad_key_is_explained() {
    let message = |key: &str| {
        let file = format!(r#"{{ "text_en-us": "a", "text_en-us-x{key}": "b" }}"#);
        let compiled = compiled(&options(), &[("a", &file)]);
        compiled.reports[0].diagnostics[0].message.clone()
    };
    assert_eq!(message("-"), "the key of the variant is missing after `-x-`");
    assert_eq!(message(""), "the key of the variant is missing after `-x-`");
    assert_eq!(message("-żeńska"), "`żeńska` is not the key of a variant");
    assert_eq!(message("-masculine"), "`masculine` is not the key of a variant");
    let started = Instant::now();
    let long = ["a"; 30_000].join("-");
    assert_eq!(message(&format!("-{long}")), "the key of the variant has 59999 bytes; the limit is 35");
    assert!(started.elapsed() < Duration::from_secs(5), "not quadratic");
}

/// The reader has its own list of plural categories, because it depends on no tool.
#[test]
fn the_reader_and_the_tools_have_the_same_plural_categories() {
    let file = r#"{ "text_en-us": "{n} guards.", "text_en-us-x-fem": "{n} of them." }"#;
    let bank = compiled(&options(), &[("a", file)]).bank.unwrap();
    let bank = Bank::open(&bank).unwrap().verify().unwrap();
    let english = bank.locale("en-us").unwrap();
    for name in ["zero", "one", "two", "few", "many", "other", "all", "formal"] {
        let is_category = lipz_file::locale::split_category(name).0.is_some();
        let found = bank.locale_tag(bank.variant(english, &format!("{name}-fem")));
        assert_eq!(found == "en-us-x-fem", is_category, "{name}");
    }
}
