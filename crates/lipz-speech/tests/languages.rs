//! The page of languages lists all languages.

#![allow(clippy::expect_used)]

use lipz_speech::{Language, Pronouncer, Reliance};

const PAGE: &str = include_str!("../data/languages/README.md");

#[test]
fn the_page_has_a_row_for_each_language_with_data_of_its_own() {
    let rows: Vec<Vec<&str>> = PAGE
        .lines()
        .skip_while(|line| *line != "## Languages")
        .filter(|line| line.starts_with("| ") && !line.starts_with("| ---"))
        .map(|line| line.split('|').map(str::trim).skip(1).take(3).collect())
        .collect();
    let languages: Vec<Language> =
        Language::all().filter(|language| language.reliance() != Reliance::Letters).collect();
    assert_eq!(rows.len(), 1 + languages.len());
    for (row, language) in rows.iter().skip(1).zip(languages) {
        assert_eq!(*row, [language.name(), &format!("`{}`", language.code()), &language.reliance().to_string()]);
    }
}

#[test]
fn the_page_names_the_languages_that_are_read_by_letters() {
    let listed =
        PAGE.split("with numbers of their own: ").nth(1).and_then(|rest| rest.split('.').next()).expect("a list");
    let listed: Vec<String> =
        listed.split(',').map(|name| name.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
    let by_letters = Language::all().filter(|language| language.reliance() == Reliance::Letters);
    assert_eq!(listed, by_letters.map(Language::name).collect::<Vec<_>>());
}

#[test]
fn every_language_says_its_own_numbers() {
    for language in Language::all() {
        let script = Pronouncer::new(language).script("21");
        assert!(script.words.iter().all(|word| !word.pronunciations.is_empty()), "{language:?}");
        assert_eq!(script.words.len(), 1, "{language:?}");
        let english = Pronouncer::new(Language::ENGLISH).script("21");
        assert!(language == Language::ENGLISH || script != english, "{language:?}");
    }
}
