//! Tests of merging the records of two branches.

use super::*;
use crate::exchange::ClipTexts;
use proptest::prelude::*;

const DONE: Option<State> = Some(State::Translated);

fn standing(record: &TextRecord, source: &str, text: &str) -> Standing {
    record.standings("a.lipz", "en-us", "de-de", &[source], &[text]).remove(0)
}

fn stale(made_from: &str, is_changed: bool) -> Standing {
    Standing::Stale { made_from: made_from.to_owned(), is_changed }
}

fn approved(pairs: &[(&str, &str)]) -> TextRecord {
    let mut record = TextRecord::default();
    for (source, text) in pairs {
        record.approve("a.lipz", "en-us", "de-de", &[source], &[text], &[DONE]);
    }
    record
}

#[test]
fn what_becomes_of_a_translation() {
    let record = approved(&[("Hi.", "Hallo.")]);
    assert_eq!(standing(&record, "Hi.", "Hallo."), Standing::Current(State::Translated));
    assert_eq!(standing(&record, "Hi.", "Moin."), Standing::Current(State::Translated), "only the translation changed");
    assert_eq!(standing(&record, "Hello.", "Hallo."), stale("Hi.", false));
    assert_eq!(standing(&record, "Hello.", "Moin."), stale("Hi.", true), "nobody knows which came first");
    assert_eq!(standing(&record, "Hi.", ""), Standing::Unknown);
    assert_eq!(record.standings("b.lipz", "en-us", "de-de", &["Hi."], &["Hallo."]), [Standing::Unknown]);
    assert_eq!(record.standings("a.lipz", "fr-fr", "de-de", &["Hi."], &["Hallo."]), [Standing::Unknown]);
    let record = approved(&[("Hi.", "Hallo."), ("Hello.", "Hallo.")]);
    assert_eq!(standing(&record, "Hello.", "Hallo."), Standing::Current(State::Translated));
    assert_eq!(standing(&record, "Hi.", "Hallo."), stale("Hello.", false), "the last approval counts");
}

#[test]
fn segments_move_and_one_of_them_is_stale() {
    let mut record = TextRecord::default();
    record.approve("a.lipz", "en-us", "de-de", &["One", "Two"], &["Eins", "Zwei"], &[DONE, Some(State::Final)]);
    let standings = |record: &TextRecord, sources: &[&str], texts: &[&str]| {
        record.standings("a.lipz", "en-us", "de-de", sources, texts)
    };
    let moved = standings(&record, &["Zero", "One", "Two"], &["Null", "Eins", "Zwei"]);
    assert_eq!(moved, [Standing::Unknown, Standing::Current(State::Translated), Standing::Current(State::Final)]);
    let (sources, texts) = (["One!", "Two"], ["Eins", "Zwei"]);
    assert_eq!(standings(&record, &sources, &texts), [stale("One", false), Standing::Current(State::Final)]);
    // Approving a different segment leaves that one unchanged.
    record.approve("a.lipz", "en-us", "de-de", &sources, &texts, &[None, DONE]);
    assert_eq!(standings(&record, &sources, &texts), [stale("One", false), Standing::Current(State::Translated)]);
    let text = record.to_string();
    assert_eq!(TextRecord::parse(&text), Some((record.clone(), Vec::new())));
    record.approve("a.lipz", "en-us", "de-de", &sources, &texts, &[DONE, DONE]);
    assert_eq!(record.to_string().lines().count(), 3, "{record}");
}

#[test]
fn an_empty_text_is_no_translation() {
    let mut record = TextRecord::default();
    record.approve("a.lipz", "en-us", "de-de", &["Hi."], &[""], &[DONE]);
    assert!(record.is_empty(), "{record}");
}

#[test]
fn every_text_comes_back() {
    let mut record = TextRecord::default();
    let odd = "tab\t, \\, \\t\r\nline";
    record.approve(odd, "en-us", "de-de", &[odd, "", "z"], &["x", "", "y"], &[Some(State::Reviewed), None, DONE]);
    assert_eq!(TextRecord::parse(&record.to_string()), Some((record, Vec::new())));
}

#[test]
fn damaged_files() {
    assert!(TextRecord::parse("my notes").is_none());
    let record = approved(&[("Hi.", "Hallo.")]);
    let text = record.to_string();
    let line = text.lines().last().unwrap();
    let conflict = format!("{HEAD}<<<<<<< ours\n{line}\n=======\n{line}\n>>>>>>> theirs\n");
    let (read, found) = TextRecord::parse(&conflict).unwrap();
    assert_eq!((read, found.len()), (record, 3));
    for at in (0..conflict.len()).filter(|at| conflict.is_char_boundary(*at)) {
        let _ = TextRecord::parse(&conflict[..at]); // no panic
    }
    for odd in
        ["a\ten-us\tde-de:0000000g\tx", "a\ten-us\tde-de:-,-\tx", "a\ten-us\tde-de\tx", "\ten-us\tde-de:-\tx", "a\tb"]
    {
        let (read, found) = TextRecord::parse(&format!("{HEAD}{odd}\n")).unwrap();
        assert_eq!((read.is_empty(), found.len()), (true, 1), "{odd}");
    }
}

#[test]
fn renamed_files_keep_what_is_known() {
    let texts = |source: &str, text: &str| {
        ClipTexts::from([("en-us".to_owned(), vec![source.to_owned()]), ("de-de".to_owned(), vec![text.to_owned()])])
    };
    let mut record = approved(&[("Hi.", "Hallo.")]);
    record.approve("b.lipz", "en-us", "de-de", &["Yes."], &["Ja."], &[DONE]);
    record.approve("c.lipz", "en-us", "de-de", &["Aye."], &["Ja."], &[DONE]);
    let lost = ["a.lipz", "b.lipz", "c.lipz"].map(str::to_owned);
    let new =
        [("x.lipz", texts("Hello.", "Hallo.")), ("y.lipz", texts("Aye.", "Ja.")), ("z.lipz", texts("No.", "Nein."))];
    let found = record.follow(&lost, &new.map(|(name, texts)| (name.to_owned(), texts)));
    let pairs: Vec<(&str, &str)> = found.iter().map(|(old, new)| (old.as_str(), new.as_str())).collect();
    assert_eq!(pairs, [("a.lipz", "x.lipz"), ("c.lipz", "y.lipz")]);
    let known = record.standings("x.lipz", "en-us", "de-de", &["Hello."], &["Hallo."]);
    assert_eq!(known, [stale("Hi.", false)], "its source changed with its name");
    // Two lost files with the same translation are ambiguous.
    let mut record = approved(&[("Hi.", "Ja.")]);
    record.approve("b.lipz", "en-us", "de-de", &["Yes."], &["Ja."], &[DONE]);
    assert_eq!(record.follow(&lost, &[("x.lipz".to_owned(), texts("Sure.", "Ja."))]), []);
}

/// Returns records with few files, texts and states, so that they often concern the same ones.
fn records() -> impl Strategy<Value = TextRecord> {
    let texts = || prop::collection::vec(0..3u8, 2);
    let states = prop::collection::vec(prop::option::of(1..4usize), 2);
    let step = (0..2u8, 0..2u8, texts(), texts(), states);
    prop::collection::vec(step, 0..6).prop_map(|steps| {
        let mut record = TextRecord::default();
        for (file, locale, sources, texts, states) in steps {
            let name =
                |prefix: &str, numbers: &[u8]| numbers.iter().map(|n| format!("{prefix}{n}")).collect::<Vec<_>>();
            let states: Vec<Option<State>> = states.into_iter().map(|state| Some(State::ALL[state?])).collect();
            let locale = ["de-de", "fr-fr"][usize::from(locale)];
            record.approve(&format!("{file}"), "en-us", locale, &name("s", &sources), &name("t", &texts), &states);
        }
        record
    })
}

/// Returns the record's states of all texts that occur in the test.
fn current(record: &TextRecord) -> BTreeMap<String, State> {
    let mut current = BTreeMap::new();
    for (file, locale) in ["0", "1"].into_iter().flat_map(|file| ["de-de", "fr-fr"].map(|locale| (file, locale))) {
        for (source, text) in (0..3).flat_map(|source| (0..3).map(move |text| (source, text))) {
            let (sources, texts) = ([format!("s{source}")], [format!("t{text}")]);
            // Only explicitly approved pairs count, not those inferred from them.
            let fact = record.files.get(file).into_iter().flatten().any(|version| {
                let made = version.made.get(locale).into_iter().flatten().zip(&version.sources);
                made.filter_map(|(made, source)| Some((made.as_ref()?.mark, source)))
                    .any(|(mark, source)| mark == Mark::of(&texts[0]) && *source == sources[0])
            });
            if let (true, Standing::Current(state)) =
                (fact, record.standings(file, "en-us", locale, &sources, &texts).remove(0))
            {
                current.insert(format!("{file} {locale} {source} {text}"), state);
            }
        }
    }
    current
}

proptest! {
    #[test]
    fn lines_of_two_branches_say_what_both_accepted(ours in records(), theirs in records(), is_mixed: bool) {
        let (ours_text, theirs_text) = (ours.to_string(), theirs.to_string());
        let mut lines: Vec<&str> = ours_text.lines().chain(theirs_text.lines()).collect();
        if is_mixed {
            lines[1..].sort_by_key(|line| line.len());
        }
        let (both, odd_lines) = TextRecord::parse(&(lines.join("\n") + "\n")).unwrap();
        prop_assert_eq!(odd_lines, []);
        let mut expected = current(&ours);
        for (pair, state) in current(&theirs) {
            let known = expected.entry(pair).or_insert(state);
            *known = state.max(*known);
        }
        prop_assert_eq!(&current(&both), &expected);
        prop_assert_eq!(TextRecord::parse(&both.to_string()), Some((both.clone(), Vec::new())));
        // The same lines in any order and number produce the same file.
        let other_way = theirs_text.lines().chain(ours_text.lines().rev()).chain(theirs_text.lines());
        let (again, _) = TextRecord::parse(&(other_way.collect::<Vec<_>>().join("\n") + "\n")).unwrap();
        prop_assert_eq!(again.to_string(), both.to_string());
    }
}

#[test]
fn texts_without_a_source_are_not_recorded() {
    let mut record = TextRecord::default();
    record.approve("a.lipz", "en-us", "de-de", &["Hi."], &["Hallo.", "Du?"], &[Some(State::Translated); 2]);
    let standings = record.standings("a.lipz", "en-us", "de-de", &["Hi."], &["Hallo."]);
    assert_eq!(standings, [Standing::Current(State::Translated)]);
}
