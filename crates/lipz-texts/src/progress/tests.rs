//! Tests of counting missing, stale and translated segments.

use super::*;

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
    let expected = "key,segment,locale,state,source,translated from,translation,words,cost\r\n\
                    '=a<b>,2,de-de,stale,New,Old,Alt,1,0.10\r\nshort,1,de-de,stale,A,,A,1,0.10\r\n";
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
