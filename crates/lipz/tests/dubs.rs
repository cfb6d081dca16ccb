//! Dubs on the command line: what does not belong together, and what each command says about voices.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::sound::voice;
use support::{Scene, lipz};

const SETTINGS: &str = "sources = [\"voices\"]
output = \"dialogue.lipzbank\"
default-locale = \"en-us\"

[voices]
en-us = \"en/{key}\"
de-de = \"de/{key}\"
";

/// When somebody speaks in a recording, and when not, in milliseconds.
const LINE: &[(bool, u32)] = &[(false, 200), (true, 500), (false, 200)];

const ORIGINAL: &str = r#"{
  "fps": 24,
  "viseme_type": "blair",
  "visemes": "MAAE|O--",
  "text_de-de": "Herr| Mayor!",
  "text_en-us": "Mayor| Mayor!"
}
"#;

const DUB: &str = r#"{ "fps": 30, "viseme_type": "blair", "visemes": "EAEEE|MAAEO-" }"#;

fn scene() -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", SETTINGS);
    scene.write("voices/en/act1/mayor.lipz", ORIGINAL);
    scene.write("voices/en/act1/yes.lipz", ORIGINAL);
    scene.write("voices/de/act1/mayor.lipz", DUB);
    scene
}

#[test]
fn what_does_not_belong_together() {
    let mut scene = scene();
    let check = ["check", "--quiet"];
    assert_eq!(lipz(scene.path(), check).stderr, "");
    scene.write("voices/de/act1/no.lipz", DUB);
    scene.expect("LZ2001-dub-without-original", &check);
    fs::remove_file(scene.path().join("voices/de/act1/no.lipz")).unwrap();
    scene.write("voices/de/act1/mayor.lipz", DUB.replace('|', ""));
    scene.expect("LZ2002-dub-segments", &check);
    scene.expect("LZ2002-dub-segments-pack", &["pack", "--quiet"]);
    scene.write("voices/de/act1/mayor.lipz", r#"{ "text_de-de": "Herr" }"#);
    scene.expect("LZ2002-dub-segments-text", &check);
    scene.write("voices/de/act1/mayor.lipz", DUB.replace(" }", r#", "text_de-de": "Herr|Meier!" }"#));
    scene.expect("LZ2003-dub-text", &check);
    scene.write("voices/de/act1/mayor.lipz", DUB);
    scene.write("lipz.toml", SETTINGS.replace("de-de", "de-at"));
    scene.expect("LZ2004-voice-without-locale", &["pack", "--quiet"]);
    scene.write("lipz.toml", SETTINGS);
    assert_eq!(lipz(scene.path(), ["pack", "--quiet", "-o", "base.lipzbank"]).code, 0);
    scene.write("voices/de/act1/mayor.lipz", DUB.replace("EAE", "AAA"));
    let over = ["pack", "--over", "base.lipzbank", "-o", "patch.lipzbank", "--quiet"];
    assert_eq!(lipz(scene.path(), over).code, 0);
    let played = lipz(scene.path(), ["merge", "base.lipzbank", "patch.lipzbank", "-o", "merged.lipzbank", "--quiet"]);
    let packed = lipz(scene.path(), ["pack", "--quiet", "-o", "whole.lipzbank"]);
    assert_eq!((played.code, packed.code), (0, 0), "{played:?} {packed:?}");
    let read = |name: &str| fs::read(scene.path().join(name)).unwrap();
    assert!(read("merged.lipzbank") == read("whole.lipzbank"));
    scene.write("lipz.toml", SETTINGS.replace("en-us", "fr-fr"));
    let addition = ["pack", "--over", "base.lipzbank", "--keep-others", "-o", "mod.lipzbank", "--quiet"];
    scene.expect("LZ2005-other-original", &addition);
    assert!(!scene.path().join("mod.lipzbank").exists());
    scene.finish(7);
}

#[test]
fn each_voice_has_a_bank_of_its_own() {
    let scene = Scene::new();
    scene.write("lipz.toml", SETTINGS);
    scene.write(
        "voices/en/act1/mayor.lipz",
        r#"{ "viseme_type": "blair", "visemes": "EAE|MA", "text_en-us": "Who|goes?" }"#,
    );
    scene.write("voices/de/act1/mayor.lipz", r#"{ "viseme_type": "blair", "visemes": "AA|E" }"#);
    scene.prepare(&["pack", "--quiet", "-o", "whole.lipzbank"]);
    let packed = lipz(scene.path(), ["pack", "--split-voices", "-o", "base.lipzbank"]);
    assert!(packed.stdout.starts_with("1 clip packed into base.lipzbank ("), "{packed:?}");
    assert!(packed.stdout.contains("\n1 dub packed into base.de-de.lipzbank ("), "{packed:?}");
    let stack = "base.lipzbank+base.de-de.lipzbank";
    scene.prepare(&["merge", stack, "-o", "merged.lipzbank", "--quiet"]);
    let read = |name: &str| fs::read(scene.path().join(name)).unwrap();
    assert!(read("merged.lipzbank") == read("whole.lipzbank"));
    assert_eq!(lipz(scene.path(), ["diff", stack, "whole.lipzbank"]).code, 0);
    let of = |bank: &str| lipz(scene.path(), ["coverage", "--voices", bank]).stdout.replace(stack, "whole.lipzbank");
    assert_eq!(of(stack), of("whole.lipzbank"));
    for command in ["stats", "inspect"] {
        let voices = |bank: &str| -> serde_json::Value {
            let json: serde_json::Value =
                serde_json::from_str(&lipz(scene.path(), [command, bank, "--json"]).stdout).unwrap();
            json["voices"].clone()
        };
        assert_eq!(voices(stack), voices("whole.lipzbank"), "{command}");
    }
    // By the settings, too; and each voice is patched by itself, over the banks that its players have.
    scene.write("lipz.toml", format!("split-voices = true\n{SETTINGS}"));
    scene.prepare(&["pack", "-o", "set.lipzbank", "--quiet"]);
    assert!(read("set.lipzbank") == read("base.lipzbank") && read("set.de-de.lipzbank") == read("base.de-de.lipzbank"));
    let patch = lipz(scene.path(), ["pack", "--over", "base.lipzbank", "-o", "x.lipzbank"]);
    assert!(patch.code == 2 && patch.stderr.contains("--split-voices=false"), "{patch:?}");
    let (original, dub) = ("voices/en/act1/mayor.lipz", "voices/de/act1/mayor.lipz");
    for (path, old, new) in [(original, "Who|goes?", "Who|went?"), (dub, "AA|E", "AE|E")] {
        let text = fs::read_to_string(scene.path().join(path)).unwrap();
        scene.write(path, text.replace(old, new));
    }
    let over = ["--split-voices=false", "--root", "voices", "--quiet", "--over", "base.lipzbank"];
    scene.prepare(&[&["pack", "voices/en", "-o", "patch.lipzbank"], &over[..]].concat());
    let german = ["pack", "voices/de", "-o", "patch.de-de.lipzbank", "--over", "base.de-de.lipzbank", "--keep-others"];
    scene.prepare(&[&german[..1], &over, &german[1..]].concat());
    scene.prepare(&["pack", "--split-voices=false", "-o", "new.lipzbank", "--quiet"]);
    let patched = "base.lipzbank+base.de-de.lipzbank+patch.lipzbank+patch.de-de.lipzbank";
    let differ = lipz(scene.path(), ["diff", patched, "new.lipzbank"]);
    assert!(differ.code == 0 && differ.stdout.contains("\nno difference in 2 clips\n"), "{differ:?}");
    let english = lipz(scene.path(), ["inspect", "base.lipzbank+patch.lipzbank", "en/act1/mayor"]);
    assert!(english.code == 0 && english.stdout.contains("went?"), "without the voice: {english:?}");
    scene.write("lipz.toml", SETTINGS);
    // What is out of date is told, and stays.
    fs::remove_file(scene.path().join("voices/de/act1/mayor.lipz")).unwrap();
    let packed = lipz(scene.path(), ["pack", "--split-voices", "-o", "base.lipzbank"]);
    assert!(
        packed.stdout.contains("not written: base.de-de.lipzbank, whose locale the bank no longer has"),
        "{packed:?}"
    );
    for other in [["--split-voices", "--split-locales"], ["--split-voices", "--over=base.lipzbank"]] {
        let refused = lipz(scene.path(), ["pack", "-o", "x.lipzbank", other[0], other[1]]);
        assert!(refused.code == 2 && !scene.path().join("x.lipzbank").exists(), "{refused:?}");
    }
}

#[test]
fn recordings_of_dubs_become_dubs() {
    let mut scene = Scene::new();
    let (english, german) = ("\"text_en-us\": \"Who goes|there?\"", "\"text_de-de\": \"Wer|da?\"");
    scene.write("lipz.toml", format!("{SETTINGS}[audio]\nfolder = \"rec\"\n"));
    scene.write("voices/en/mayor.lipz", format!("{{ {english}, {german} }}"));
    scene.write("rec/en/mayor.wav", voice(LINE, 1));
    scene.write("rec/de/mayor.wav", voice(LINE, 2));
    let run = |arguments: &[&str]| lipz(scene.path(), arguments.iter().chain(&["--allow", "LZ1707,LZ1715"]).copied());
    let first = |text: &str| text.lines().next().unwrap_or_default().to_owned();
    assert_eq!(first(&run(&["sync"]).stdout), "2 clips synced, in voices");
    let dub = fs::read_to_string(scene.path().join("voices/de/mayor.lipz")).unwrap();
    let document = lipz_file::parse(dub.as_bytes()).document.unwrap();
    let visemes = document.string("visemes").unwrap();
    assert_eq!(visemes.matches('|').count(), 1, "divided as the text of the original: {visemes}");
    assert!(document.elements.iter().all(|element| !element.name.text.starts_with("text")), "{dub}");
    assert_eq!(first(&run(&["sync"]).stdout), "0 clips synced, 2 unchanged, in voices");
    let check = |scene: &Scene| {
        let checked = lipz(scene.path(), ["check", "--quiet", "--allow", "LZ1707,LZ1715"]);
        let codes = checked.stderr.match_indices("[LZ").map(|(at, _)| checked.stderr[at + 1..at + 7].to_owned());
        codes.collect::<Vec<_>>()
    };
    assert_eq!(check(&scene), [""; 0]);
    // The dub is spoken as the German text of the original says.
    scene.write("voices/en/mayor.lipz", format!("{{ {english}, \"text_de-de\": \"Wer ist|da?\" }}"));
    assert_eq!(check(&scene), ["LZ1915"], "the dub says the old words");
    assert_eq!(first(&run(&["sync"]).stdout), "2 clips synced, in voices");
    assert_eq!(check(&scene), ["LZ1915"], "a new mouth is no new recording");
    let accept = || lipz(scene.path(), ["accept", "--key", "de/mayor"]).stdout;
    let accepted = accept();
    assert!(
        accepted.starts_with("de/mayor: rec/de/mayor.wav says the text of today, before another one\n"),
        "{accepted}"
    );
    assert!(
        accepted.contains("\n1 recording with another text before, 0 recordings of which nothing was known\n"),
        "{accepted}"
    );
    assert_eq!(check(&scene), [""; 0]);
    // What the original says has changed since.
    let again = fs::read_to_string(scene.path().join("voices/en/mayor.lipz")).unwrap().replace("goes", "went");
    scene.write("voices/en/mayor.lipz", again);
    scene.expect("LZ2006-dub-out-of-date-text", &["check", "--quiet", "--allow", "LZ1707,LZ1715,LZ1705,LZ1915"]);
    scene.write("rec/en/mayor.wav", voice(LINE, 3));
    scene.expect("LZ2006-dub-out-of-date", &["check", "--quiet", "--allow", "LZ1707,LZ1715,LZ1705,LZ1915"]);
    let forced = lipz(scene.path(), ["sync", "--force", "--allow", "LZ1707,LZ1715"]);
    assert_eq!((forced.code, check(&scene)), (0, vec!["LZ2006".to_owned()]), "a new mouth is no new dub");
    scene.write("rec/de/mayor.wav", voice(LINE, 4));
    let again = lipz(scene.path(), ["sync", "--allow", "LZ1707,LZ1715"]);
    assert_eq!((again.code, check(&scene)), (0, vec![]));
    scene.finish(2);
}

#[test]
fn a_dub_alone_knows_its_original() {
    let scene = Scene::new();
    scene.write("lipz.toml", format!("root = \"voices\"\n{SETTINGS}[audio]\nfolder = \"rec\"\n"));
    scene.write("voices/en/mayor.lipz", r#"{ "text_en-us": "Who goes|there?", "text_de-de": "Wer|da?" }"#);
    scene.write("rec/en/mayor.wav", voice(LINE, 1));
    scene.write("rec/de/mayor.wav", voice(LINE, 2));
    let run = |arguments: &[&str]| lipz(scene.path(), arguments.iter().chain(&["--allow", "LZ1707,LZ1715"]).copied());
    let files =
        || ["voices/de/mayor.lipz", "voices/lipz-sync.txt"].map(|name| fs::read(scene.path().join(name)).unwrap());
    assert_eq!(run(&["sync"]).code, 0);
    let whole = files();
    for arguments in [&["sync"][..], &["sync", "--force"]] {
        let alone = run(&[arguments, &["voices/de/mayor.lipz"]].concat());
        assert_eq!((alone.code, alone.stderr.as_str()), (0, ""), "{arguments:?}");
        assert!(files() == whole, "{arguments:?}: as a run over the whole project");
    }
    let checked = run(&["check", "voices/de/mayor.lipz", "--quiet", "--allow", "LZ1702,LZ2001"]);
    assert_eq!((checked.code, checked.stderr.as_str()), (0, ""));
    // From the recordings, too; and an original whose recording is missing was not recorded again.
    let recordings = run(&["sync", "rec", "-o", "voices"]);
    assert_eq!((recordings.code, recordings.stderr.as_str()), (0, ""));
    assert!(files() == whole, "{}", recordings.stdout);
    fs::remove_file(scene.path().join("rec/en/mayor.wav")).unwrap();
    let missing = run(&["check", "--quiet"]);
    assert!(missing.stderr.contains("LZ1701") && !missing.stderr.contains("LZ2006"), "{}", missing.stderr);
}

#[test]
fn every_command_knows_voices() {
    let scene = scene();
    let run = |arguments: &[&str]| {
        let done = lipz(scene.path(), arguments.iter().copied());
        assert_eq!((done.code, done.stderr.as_str()), (0, ""), "{arguments:?}");
        done.stdout
    };
    run(&["pack", "--quiet"]);
    let bank = "dialogue.lipzbank";
    let shows = |arguments: &[&str], lines: &[&str]| {
        let shown = run(arguments);
        let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
        let has = |line: &str| shown.lines().any(|shown| words(shown) == line);
        assert!(lines.iter().all(|line| has(line)), "{arguments:?} shows\n{shown}");
    };
    shows(&["inspect", bank], &["en-us original", "de-de 1"]);
    shows(&["inspect", bank, "de/act1/mayor"], &["dub of en/act1/mayor in de-de"]);
    shows(&["stats", bank], &["en-us 2 0.5 s original", "de-de 1 0.3 s"]);
    let covered = ["en-us 100.0 % 2 0.6 s 0 0.0 s (original)", "de-de 50.0 % 1 0.4 s 1 0.3 s"];
    shows(&["coverage", bank], &covered);
    shows(&["coverage", "--voices"], &covered);
    shows(&["coverage", bank], &["de-de 100.0 % 2 0 0 0", "dialogue.lipzbank: 2 clips with texts"]);
    assert_eq!(run(&["coverage", bank, "--voices", "--missing", "de_DE"]), "en/act1/yes\n");
    assert!(run(&["coverage", bank, "--voices", "--json"]).contains("\"to_record_us\":"));
    assert!(run(&["inspect", bank, "--json"]).contains("\"voices\":"));
    let ids = run(&["ids", bank, "--lang", "json"]);
    assert!(ids.contains("en/act1/mayor") && !ids.contains("de/act1/mayor"), "{ids}");
    run(&["unpack", bank, "--output", "again", "--quiet"]);
    for file in ["en/act1/mayor", "de/act1/mayor"] {
        let read = |folder: &str| fs::read_to_string(scene.path().join(format!("{folder}/{file}.lipz"))).unwrap();
        let document = |text: &str| lipz_file::write(&lipz_file::parse(text.as_bytes()).document.unwrap());
        assert_eq!(document(&read("again")), document(&read("voices")), "a dub gets no text of its original");
    }
    fs::remove_file(scene.path().join("voices/de/act1/mayor.lipz")).unwrap();
    let gone = lipz(scene.path(), ["diff", bank, "voices"]);
    assert_eq!(gone.code, 1);
    assert!(gone.stdout.contains("~ voices  en-us, de-de -> none\n"), "{}", gone.stdout);
    scene.write("voices/de/act1/yes.lipz", DUB);
    let other = lipz(scene.path(), ["diff", bank, "voices"]).stdout;
    assert!(other.contains("~ en/act1/mayor in de-de  de/act1/mayor -> the original\n"), "{other}");
    assert!(other.contains("~ en/act1/yes in de-de  the original -> de/act1/yes\n"), "{other}");
    let none = lipz(scene.path(), ["coverage", "voices/en", "--no-config", "--voices"]);
    assert!(none.code == 2 && none.stderr.contains("no clip of the bank is a dub"), "{}", none.stderr);
}

/// The project plans a language, and nobody has recorded a line of it.
#[test]
fn the_first_dub_has_its_work_before_it_begins() {
    let scene = scene();
    fs::remove_dir_all(scene.path().join("voices/de")).unwrap();
    let run = |arguments: &[&str]| lipz(scene.path(), [&["coverage", "--voices"], arguments].concat());
    let table = run(&[]);
    let row = table.stdout.lines().find(|line| line.contains("de-de")).unwrap_or_default();
    assert_eq!(row.split_whitespace().collect::<Vec<_>>().join(" "), "de-de 0.0 % 0 0.0 s 2 0.6 s", "{table:?}");
    assert_eq!(run(&["--missing", "de-de"]).stdout, "en/act1/mayor\nen/act1/yes\n");
    let line = |key: &str| serde_json::json!({ "key": key, "voice": "de-de", "played": "en-us" });
    let json: serde_json::Value = serde_json::from_str(&run(&["--missing", "de-de", "--json"]).stdout).unwrap();
    assert_eq!(json, serde_json::json!([line("en/act1/mayor"), line("en/act1/yes")]));
    let csv = run(&["--missing", "de-de", "--csv"]).stdout;
    assert_eq!(csv, "key,voice,played\r\nen/act1/mayor,de-de,en-us\r\nen/act1/yes,de-de,en-us\r\n");
    let csv = run(&["--csv"]).stdout;
    assert!(csv.starts_with("voice,lines,dubbed,") && csv.contains("\r\nde-de,2,0,0.0,0.0,0.0,0,2,0.6\r\n"), "{csv}");
    let page = run(&["--html"]).stdout;
    assert!(page.contains("<summary>2 lines to be recorded</summary>") && page.ends_with("</html>\n"), "{page}");
    let none = run(&["--missing", "en-us", "--json"]);
    assert_eq!((none.code, none.stdout.trim(), none.stderr.as_str()), (0, "[]", "no line is missing\n"));
    let unknown = run(&["--missing", "fr-fr"]);
    assert!(unknown.code == 2 && unknown.stderr.contains("no voice is `fr-fr`"), "{unknown:?}");
    assert!(unknown.stderr.contains("there are en-us, de-de; [voices] in lipz.toml names others"), "{unknown:?}");
    let exported = lipz(scene.path(), ["texts", "export", "po", "-o", "de.po"]);
    assert_eq!(exported.stdout, "texts of 2 clips for de-de written into de.po\n");
    scene.write("voices/de/act1/mayor.lipz", DUB);
    let exported = lipz(scene.path(), ["texts", "export", "po", "-o", "de.po", "--force"]);
    let expected = "texts of 2 clips for de-de written into de.po; 1 dub left out, whose texts are their originals'\n";
    assert_eq!(exported.stdout, expected);
}
