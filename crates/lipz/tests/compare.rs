//! `lipz diff` and `lipz stats`, on banks and on folders.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use serde_json::{Value, json};
use support::{Scene, lipz, repository, tree};

const DRAMA: &str = "fixtures/drama";
const DRAMA_BANK: &str = "fixtures/banks/v1/drama.lipzbank";

/// Returns a scene with the settings of the drama's golden bank, which is older than curves for emotions without
/// values.
fn settings_of_the_bank() -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", "default-locale = \"en-us\"\n\n[emotions]\ncurves = \"values\"\n");
    scene
}

fn aye(text: &str, more: &str) -> String {
    format!(r#"{{ "fps": 24, "viseme_type": "blair", "visemes": "AAAA|MM", "text_en-us": "{text}"{more} }}"#)
}

/// Returns two folders with every kind of difference.
fn scene() -> Scene {
    let scene = Scene::new();
    scene.write("old/a.lipz", aye("Good evening, Otto.|Aye.", r#", "events": "points door|""#));
    scene.write("old/gone.lipz", r#"{ "text_en-us": "No." }"#);
    scene.write("old/old-name.lipz", aye("Me.|Me.", ""));
    scene.write("old/same.lipz", aye("Same.|Same.", ""));
    scene.write(
        "new/a.lipz",
        r#"{ "fps": 29.97, "viseme_type": "blair", "visemes": "AAAL|MMM|", "text_en-us": "Good morning, Otto.|Aye.|",
            "text_ja-jp": "灯台||", "events": "points window||" }"#,
    );
    scene.write("new/here.lipz", "{ \"fps\": 24 }");
    scene.write("new/new-name.lipz", aye("Me.|Me.", ""));
    scene.write("new/same.lipz", aye("  Same.|{softly} Same.", ""));
    scene
}

#[test]
fn differences_are_shown_and_counted() {
    let scene = scene();
    let expected = "\
old -> new

+ locale ja-jp
- gone
+ here
= old-name -> new-name (renamed)
~ a
    fps          24 -> 29.97
    frames       2 differ (6 -> 7), first at frame 3
    segments     2 -> 3
    en-us 0      - Good evening, Otto.
                 + Good morning, Otto.
    en-us 2      + (empty)
    ja-jp 0      + 灯台
    ja-jp 1      + (empty)
    ja-jp 2      + (empty)
    event 0      - points door
                 + points window
    event 2      + (empty)

clips: 1 removed, 1 added, 1 renamed, 1 changed, 1 unchanged
";
    let shown = lipz(scene.path(), ["diff", "old", "new"]);
    assert_eq!((shown.code, shown.stderr.as_str()), (1, ""));
    assert_eq!(shown.stdout, expected);
    for side in ["old", "new"] {
        scene.prepare(&["pack", side, "-o", &format!("{side}.lipzbank"), "--config", "strip=true"]);
    }
    let banks = lipz(scene.path(), ["diff", "old.lipzbank", "new.lipzbank"]);
    assert_eq!((banks.code, banks.stdout), (1, expected.replace("old -> new\n", "old.lipzbank -> new.lipzbank\n")));
    assert!(tree(scene.path()).iter().all(|path| !path.ends_with(".tmp")));

    let printed = lipz(scene.path(), ["diff", "old.lipzbank", "new", "--output-format", "json"]);
    let found: Value = serde_json::from_str(&printed.stdout).unwrap();
    assert_eq!((printed.code, &found["is_same"], &found["same"]), (1, &json!(false), &json!(1)));
    assert_eq!(found["renamed"], json!([{ "old": "old-name", "new": "new-name" }]));
    let clip = &found["changed"][0];
    assert_eq!(clip["fps"], json!({ "old": [24, 1], "new": [2997, 100] }));
    assert_eq!(clip["viseme_type"], Value::Null);
    assert_eq!(clip["frames"], json!({ "counts": { "old": 6, "new": 7 }, "differing": 2, "first": 3 }));
    assert_eq!(clip["segment_starts"], json!({ "old": [0, 4], "new": [0, 4, 7] }));
    assert_eq!(clip["texts"].as_array().map(Vec::len), Some(5));
    assert_eq!(clip["events"][0], json!({ "segment": 0, "old": "points door", "new": "points window" }));
}

#[test]
fn a_bank_is_the_same_as_its_folder() {
    let settings = settings_of_the_bank();
    let flags = ["--config", settings.path().join("lipz.toml").to_str().unwrap()].map(str::to_owned);
    let no_flags: &[String] = &[];
    for (sides, flags) in
        [([DRAMA_BANK, DRAMA], &flags[..]), ([DRAMA, DRAMA_BANK], &flags), ([DRAMA_BANK, DRAMA_BANK], no_flags)]
    {
        let diff = |quiet: &[&str]| {
            let arguments = ["diff"].iter().chain(quiet).chain(&sides).map(|part| (*part).to_owned());
            lipz(&repository(), arguments.chain(flags.iter().cloned()))
        };
        let same = diff(&[]);
        assert_eq!(same.code, 0, "{}", same.stdout);
        assert!(same.stdout.ends_with("\nno differences in 48 clips\n"), "{}", same.stdout);
        let quiet = diff(&["--quiet"]);
        assert_eq!((quiet.code, quiet.stdout.as_str()), (0, ""));
    }
    let other = lipz(&repository(), ["diff", "--no-config", DRAMA_BANK, DRAMA]);
    assert!(other.stdout.contains("~ default locale  en-us -> none"), "{}", other.stdout);
}

#[test]
fn differences_of_banks_as_a_whole() {
    let scene = Scene::new();
    scene.write("voices/a.lipz", r#"{ "text_en-us": "Aye.", "text_de-de": "Ja.", "text_de-at": "Ja." }"#);
    scene.write("voices/b.lipz", r#"{ "text_en-us": "OK", "text_de-de": "OK" }"#);
    scene.write("old.toml", "[fallbacks]\nde-at = [\"de-de\"]\n[babble.ghost]\n[babble.robot]\naah = \"15\"\n");
    scene.write("new.toml", "[fallbacks]\nde-at = [\"en-us\"]\n[babble.robot]\naah = \"19\"\nrate = 30\n");
    for side in ["old", "new"] {
        let (bank, settings) = (format!("{side}.lipzbank"), format!("{side}.toml"));
        scene.prepare(&["pack", "voices", "-o", &bank, "--config", &settings, "--quiet"]);
    }
    let shown = lipz(scene.path(), ["diff", "old.lipzbank", "new.lipzbank"]);
    let expected = "\
old.lipzbank -> new.lipzbank

~ locale de-at falls back to  de-de -> en-us
- babble profile ghost
~ babble profile robot
    rate         24 -> 30
    aah          - 15
                 + 19

clips: 2 unchanged
";
    assert_eq!((shown.code, shown.stdout.as_str()), (1, expected));
    let back = lipz(scene.path(), ["diff", "new.lipzbank", "old.lipzbank"]);
    assert!(back.stdout.contains("\n+ babble profile ghost\n"), "{}", back.stdout);

    let printed = lipz(scene.path(), ["diff", "old.lipzbank", "new.lipzbank", "--output-format", "json"]);
    let found: Value = serde_json::from_str(&printed.stdout).unwrap();
    assert_eq!((printed.code, &found["is_same"]), (1, &json!(false)));
    assert_eq!(found["fallbacks"], json!([{ "locale": "de-at", "old": ["de-de"], "new": ["en-us"] }]));
    let babble = &found["babble"];
    assert_eq!((&babble[0]["name"], &babble[0]["new"]), (&json!("ghost"), &Value::Null));
    assert_eq!((&babble[1]["old"]["rate"], &babble[1]["new"]["aah"]), (&json!([24, 1]), &json!("19")));
}

#[test]
fn many_differences_are_cut_unless_all_are_asked_for() {
    let scene = Scene::new();
    scene.write("old/first.lipz", "{ \"fps\": 24 }");
    for clip in 0..60 {
        scene.write(&format!("new/clip-{clip:02}.lipz"), "{ \"fps\": 25 }");
    }
    let cut = lipz(scene.path(), ["diff", "old", "new"]).stdout;
    assert!(cut.contains("+ clip-49\n… and 10 more added clips (--all shows them)\n"), "{cut}");
    let all = lipz(scene.path(), ["diff", "old", "new", "--all"]).stdout;
    assert!(all.contains("+ clip-59\n") && !all.contains('…'), "{all}");
}

#[test]
fn without_two_sides_there_is_no_comparison() {
    let scene = scene();
    scene.write("bad/a.lipz", "{ \"fps\": 0 }");
    scene.write("no.lipzbank", "no bank");
    for (side, code) in [("nowhere", "LZ0902"), ("bad", "LZ0301"), ("no.lipzbank", "LZ0902"), ("nowhere/*", "LZ0805")] {
        for sides in [["old", side], [side, "old"]] {
            let refused = lipz(scene.path(), ["diff"].iter().chain(&sides));
            assert_eq!((refused.code, refused.stdout.as_str()), (2, ""), "{side}");
            assert!(refused.stderr.contains(code), "{side}: {}", refused.stderr);
        }
    }
}

#[test]
fn statistics_of_a_bank_and_of_its_folder() {
    let settings = settings_of_the_bank();
    let config = settings.path().join("lipz.toml");
    let of = |arguments: &[&str]| lipz(&repository(), [&["inspect", "--show", "stats"], arguments].concat());
    let (bank, folder) = (of(&[DRAMA_BANK]), of(&[DRAMA, "--config", config.to_str().unwrap()]));
    assert_eq!((bank.code, folder.code), (0, 0));
    let table = |text: &str| text.split_once('\n').unwrap().1.to_owned();
    assert_eq!(table(&bank.stdout), table(&folder.stdout), "except for the names");
    for line in ["  48 clips, 124 segments, 4,107 frames, 2:31.5 min", "  FRAM                 4,107   6."] {
        assert!(bank.stdout.contains(line), "{}", bank.stdout);
    }
    assert!(bank.stdout.lines().all(|line| line.chars().count() <= 80), "{}", bank.stdout);

    let printed = lipz(&repository(), ["inspect", "--show", "stats", DRAMA_BANK, "--output-format", "json"]);
    let stats: Value = serde_json::from_str(&printed.stdout).unwrap();
    assert_eq!((&stats["clips"], &stats["frames"], &stats["events"]), (&json!(48), &json!(4107), &json!(85)));
    let of_types =
        |visemes: &Value| visemes["frames"].as_object().unwrap().values().map(|n| n.as_u64().unwrap()).sum::<u64>();
    assert_eq!(stats["visemes"].as_array().unwrap().iter().map(of_types).sum::<u64>(), 4107, "every frame has a code");
    let without = lipz(&repository(), ["inspect", "--show", "stats", "nowhere"]);
    assert_eq!((without.code, without.stdout.as_str()), (2, ""));
}
