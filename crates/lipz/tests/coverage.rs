//! `lipz coverage` of translations: tables, lists and pages of the remaining work.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use support::approved::{MAYOR, approved};
use support::{Scene, lipz};

#[test]
fn coverage_says_what_is_to_be_done() {
    let scene = approved();
    let folder = scene.path();
    scene.write("voices/mayor.lipz", MAYOR.replace("evening", "morning").replace("Wer da?", ""));
    scene.write("voices/=new.lipz", "{ \"text_en-us\": \"Halt!\", \"text_fr-fr\": \"Halte !\" }");
    let coverage = |arguments: &[&str]| lipz(folder, [&["coverage", "--quiet"], arguments].concat());
    let table = coverage(&["--cost-per-word", "0.5"]).stdout;
    let work = table.split_once("\n\nto translate from en-us: 3 segments with 6 words\n").unwrap().1;
    let rows: Vec<String> = work.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
    let head = "locale words missing stale translated reviewed final words to do cost";
    assert_eq!(rows[1..4], [head, "de-de 0.0 % 2 1 0 0 0 6 3.00", "fr-fr 16.6 % 2 0 1 0 0 5 2.50"]);
    let listed =
        |what: &str, locale: &str, more: &[&str]| coverage(&[&["--show", what, "--locale", locale], more].concat());
    assert_eq!(listed("missing", "de-de", &[]).stdout, "=new\nmayor\n");
    assert_eq!(listed("stale", "de-de", &[]).stdout, "mayor\n");
    assert_eq!(listed("missing,stale", "de-de", &[]).stdout, "=new\nmayor\n");
    assert_eq!(listed("missing", "sw-ke", &[]).stdout, "=new\nmayor\n", "no translation exists");
    let list = listed("missing,stale", "de-de", &["--as", "csv"]).stdout;
    let expected = "key,segment,locale,state,source,translated from,translation,words,match\r\n\
                    '=new,,de-de,missing,Halt!,,,1,new\r\n\
                    mayor,1,de-de,stale,\"Good morning, {name}.\",\"Good evening, {name}.\",\"Guten Abend, {name}.\",2,new\r\n\
                    mayor,2,de-de,missing,Who goes there?,,,3,new\r\n";
    assert_eq!(list, expected);
    let json = ["--output-format", "json", "--cost-per-word", "0.5"];
    let json = listed("missing,stale", "de-de", &json).stdout;
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    let stale = serde_json::json!({
        "key": "mayor", "segment": 1, "locale": "de-de", "state": "stale", "source": "Good morning, {name}.",
        "translated_from": "Good evening, {name}.", "translation": "Guten Abend, {name}.", "words": 2, "match": "new", "cost": 1.0,
    });
    assert_eq!((json.as_array().unwrap().len(), &json[1]), (3, &stale));
    for look in [&[][..], &["--as", "csv"]] {
        let source = listed("missing", "en-us", look);
        let said = "en-us is the source locale of the translations\n";
        assert!(source.code == 0 && source.stderr.ends_with(said), "{look:?}: {source:?}");
        let none = listed("stale", "fr-fr", look);
        assert!(none.code == 0 && none.stderr.ends_with("no text is stale\n"), "{none:?}");
    }
    for (what, locale) in [("missing", "en-us"), ("stale", "fr-fr")] {
        let none = listed(what, locale, &["--output-format", "json"]);
        assert_eq!((none.code, none.stdout.trim()), (0, "[]"), "{what}");
    }
    let csv = coverage(&["--as", "csv"]).stdout;
    let columns = |line: &str| line.split(',').count();
    assert!(csv.lines().all(|line| columns(line) == columns(csv.lines().next().unwrap())), "{csv}");
    assert!(csv.contains("\r\nde-de,2,50.0,1,0,1,0,3,6,2,4,1,2,0,0,0,0,0,0,0,0,6,0,0,0,0,0,6\r\n"), "{csv}");
    let json = coverage(&["--output-format", "json", "--cost-per-word", "0.5"]).stdout;
    assert!(
        json.contains("\"words_to_do\": 6,\n      \"matches\": {\n        \"new\": 6,")
            && json.contains("\"cost\": 3.0"),
        "{json}"
    );
    let page = coverage(&["--as", "html"]).stdout;
    assert!(page.contains("<del>evening</del><ins>morning</ins>") && page.ends_with("</html>\n"), "{page}");
    let wanted = coverage(&["--min-coverage", "sw-ke=100"]);
    assert!(wanted.code == 1 && wanted.stdout.contains("sw-ke"), "{wanted:?}");

    lipz(folder, ["pack", "voices", "-o", "b.lipzbank"]);
    for refused in [&["--show", "stale", "--locale", "de-de"][..], &["--as", "html"]] {
        let outcome = lipz(folder, [&["coverage", "b.lipzbank"], refused].concat());
        assert!(
            outcome.code == 2 && outcome.stderr.contains("the source texts of the translations are missing"),
            "{outcome:?}"
        );
    }
    refuses_contradictions(coverage);
}

#[test]
fn a_table_ends_before_the_unknown_texts() {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n");
    scene.write(
        "voices/a.lipz",
        r#"{ "text_en-us": "Good evening, traveller.", "text_de-de": "Guten Abend, Fremder." }"#,
    );
    scene.write("voices/b.lipz", r#"{ "text_en-us": "Good evening, traveller." }"#);
    let table = lipz(scene.path(), ["coverage"]).stdout;
    let (_, matches) = table.split_once("words to do by similarity:\n\n").unwrap();
    assert!(matches.contains("\n\nunknown: 1 of 1 translated segment"), "{table}");
}

#[test]
fn a_price_is_a_usable_number() {
    let scene = approved();
    let coverage = |price: &str| lipz(scene.path(), ["coverage", &format!("--cost-per-word={price}")]);
    for refused in ["1e308", "1000000001", "inf", "nan", "-0.1", "much", ""] {
        let outcome = coverage(refused);
        assert!(outcome.code == 2 && outcome.stderr.contains("LZ1601"), "{refused}: {outcome:?}");
        assert!(outcome.stderr.contains("expected a price from 0 to 1,000,000,000"), "{refused}: {outcome:?}");
    }
    for price in ["0", "-0", "0.12", "1e9"] {
        let outcome = coverage(price);
        assert!(outcome.code == 0 && !outcome.stdout.contains("-0.00"), "{price}: {outcome:?}");
    }
}

/// Options that exclude each other are refused, so that none of them is silently ignored.
fn refuses_contradictions(coverage: impl Fn(&[&str]) -> support::Outcome) {
    let contradictions: [&[&str]; 6] = [
        &["--show", "missing"],
        &["--locale", "de-de"],
        &["--show", "stale,voices", "--locale", "de-de"],
        &["--show", "voices", "--locale", "de-de"],
        &["--as", "html", "--show", "missing", "--locale", "de-de"],
        &["--as", "csv", "--output-format", "json"],
    ];
    for refused in contradictions {
        let outcome = coverage(refused);
        let said = outcome.stderr + &outcome.stdout;
        assert!(outcome.code == 2 && said.contains("LZ1601"), "{refused:?}: {said}");
    }
}

#[test]
fn what_is_missing_is_not_called_translated() {
    let scene = approved();
    for (what, locale, said) in [("stale", "fr-fr", "no text is stale\n"), ("missing", "de-de", "no text is missing\n")]
    {
        let listed = lipz(scene.path(), ["coverage", "--show", what, "--locale", locale]);
        assert_eq!((listed.code, listed.stdout.as_str(), listed.stderr.as_str()), (0, "", said), "{what}");
    }
    assert_eq!(lipz(scene.path(), ["coverage", "--show", "missing", "--locale", "fr-fr"]).stdout, "mayor\n");
    assert_eq!(lipz(scene.path(), ["pack", "-o", "a.lipzbank", "--quiet"]).code, 0);
    for useless in [&["--cost-per-word", "0.1"][..], &["--show", "missing", "--locale", "de-de", "--as", "csv"]] {
        assert_eq!(lipz(scene.path(), [&["coverage", "a.lipzbank"], useless].concat()).code, 2, "{useless:?}");
    }
}
