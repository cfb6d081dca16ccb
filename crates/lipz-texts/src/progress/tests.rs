//! Tests of counting missing, stale and translated segments.

use super::*;
use crate::exchange::texts_of;

fn texts(texts: &[(&str, &[&str])]) -> ClipTexts {
    let text = |(locale, texts): &(&str, &[&str])| {
        ((*locale).to_owned(), texts.iter().map(|text| (*text).to_owned()).collect())
    };
    texts.iter().map(text).collect()
}

/// Returns a clip with every progress, of one word each except the first.
fn work() -> Work {
    let mut record = TextRecord::default();
    let sources = ["x", "Old", "Two", "Three", "Four"];
    let german = ["", "Alt", "Zwei", "Drei", "Vier"];
    let states = [None, Some(State::Translated), None, Some(State::Reviewed), Some(State::Final)];
    record.approve("a.lipz", "en-us", "de-de", &sources, &german, &states);
    let clip = texts(&[
        ("en-us", &["One and one", "New", "Two", "Three", "Four", ""]),
        ("de-de", &["", "Alt", "Zwei", "Drei", "Vier", ""]),
    ]);
    let mut work = Work::new("en-us", ["de-de", "xx-xx"]);
    work.add("=a<b>", "a.lipz", &clip, Some(&record));
    work.add("none", "b.lipz", &texts(&[("de-de", &["Ja."])]), Some(&record));
    work.add("short", "c.lipz", &texts(&[("en-us", &["A", "B"]), ("de-de", &["A"])]), None);
    work
}

#[test]
fn every_progress_is_counted() {
    let work = work();
    let counts =
        |locale: &LocaleWork| Progress::ALL.map(|progress| locale.amount(progress)).map(|a| (a.segments, a.words));
    assert_eq!(counts(&work.locales[0]), [(2, 4), (2, 2), (1, 1), (1, 1), (1, 1)]);
    assert_eq!(counts(&work.locales[1]), [(7, 9), (0, 0), (0, 0), (0, 0), (0, 0)], "nobody has begun");
    assert_eq!((work.locales[0].percent_in_tenths(), work.locales[1].percent_in_tenths()), (33.3, 0.0));
    let unknown = Amount { segments: 1, words: 1 };
    assert_eq!((work.locales[0].unknown, work.locales[1].unknown), (unknown, Amount::default()));
    assert_eq!(work.unknown(), (3, 1));
    let mut twice = work.clone();
    twice.join(work);
    assert_eq!((twice.locales[0].all().words, twice.locales[0].open.len()), (18, 8));
    assert_eq!(LocaleWork::default().percent_in_tenths(), 100.0);
}

#[test]
fn lists_are_no_formulas() {
    let list = String::from_utf8(work().locales[0].csv(|progress| progress == Progress::Stale, Some(0.1))).unwrap();
    let expected = "key,segment,locale,state,source,translated from,translation,words,match,cost\r\n\
                    '=a<b>,2,de-de,stale,New,Old,Alt,1,new,0.10\r\nshort,1,de-de,stale,A,,A,1,new,0.10\r\n";
    assert_eq!(list, expected);
}

#[test]
fn a_page_is_xml_and_says_what_changed() {
    let page = page(&work(), "<voices>", Some(0.1));
    assert!(page.contains("<td dir=\"auto\"><del>Old</del><ins>New</ins></td><td dir=\"auto\">Alt</td>"), "{page}");
    assert!(page.contains("=a&lt;b&gt; <small>2</small>") && !page.contains("<voices>"), "{page}");
    // All elements are closed, except for those that HTML closes itself.
    let body = page.split_once("</style>\n").unwrap().1;
    roxmltree::Document::parse(&format!("<html>{body}")).unwrap();
}

#[test]
fn matches_are_repetitions_and_similar_texts() {
    let clip = |english: &str, german: &str| {
        let file = format!(r#"{{ "text_en-us": "{english}", "text_de-de": "{german}" }}"#);
        texts_of(&lipz_file::parse(file.as_bytes()).document.unwrap(), None)
    };
    let mut work = Work::new("en-us", ["de-de"]);
    let done = "The old lighthouse keeper never lights the lamp on a Sunday.";
    let changed = [
        ("The old lighthouse keeper never lights the lamp on a Monday.", "90 %"),
        ("An old lighthouse keeper never lights the lamp on Mondays, he says.", "new"),
        (done, "100 %"),
        ("The old lighthouse keeper never lights the lamp on a Sunday!", "99 %"),
        ("Nothing like it.", "new"),
        ("Nothing like it.", "repeated"),
        ("", ""),
    ];
    work.add("a", "a", &clip(done, "Der alte Leuchtturmwärter macht sonntags nie Licht."), None);
    for (number, (source, _)) in changed.iter().enumerate() {
        work.add(&format!("b{number}"), "b", &clip(source, ""), None);
    }
    let found: Vec<String> = work.locales[0].matches().into_iter().map(SourceMatch::name).collect();
    let expected: Vec<&str> = changed.iter().map(|(_, name)| *name).filter(|name| !name.is_empty()).collect();
    assert_eq!(found, expected);
    let bands = work.locales[0].bands();
    assert_eq!(bands.map(|amount| amount.segments), [2, 0, 1, 1, 1, 1]);
    assert_eq!(bands.iter().map(|amount| amount.words).sum::<usize>(), work.locales[0].to_do().words);
}
