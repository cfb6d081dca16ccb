//! Dubs on the command line: mismatches, and the output of each command about voices.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use std::time::{Duration, SystemTime};
use support::sound::voice;
use support::{Scene, lipz};

const SETTINGS: &str = "sources = [\"voices\"]
output = \"dialogue.lipzbank\"
default-locale = \"en-us\"

[voices]
en-us = \"en/{key}\"
de-de = \"de/{key}\"
";

/// Speech and silence in a recording, in milliseconds.
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
    let packed = lipz(scene.path(), ["pack", "--config", "split-voices=true", "-o", "base.lipzbank"]);
    assert!(packed.stdout.starts_with("1 clip packed into base.lipzbank ("), "{packed:?}");
    assert!(packed.stdout.contains("\n1 dub packed into base.de-de.lipzbank ("), "{packed:?}");
    let stack = "base.lipzbank+base.de-de.lipzbank";
    scene.prepare(&["merge", stack, "-o", "merged.lipzbank", "--quiet"]);
    let read = |name: &str| fs::read(scene.path().join(name)).unwrap();
    assert!(read("merged.lipzbank") == read("whole.lipzbank"));
    assert_eq!(lipz(scene.path(), ["diff", stack, "whole.lipzbank"]).code, 0);
    let of =
        |bank: &str| lipz(scene.path(), ["coverage", "--show", "voices", bank]).stdout.replace(stack, "whole.lipzbank");
    assert_eq!(of(stack), of("whole.lipzbank"));
    for shown in [&[][..], &["--show", "stats"]] {
        let voices = |bank: &str| -> serde_json::Value {
            let inspect = [&["inspect", bank, "--output-format", "json"], shown].concat();
            let json: serde_json::Value = serde_json::from_str(&lipz(scene.path(), inspect).stdout).unwrap();
            json["voices"].clone()
        };
        assert_eq!(voices(stack), voices("whole.lipzbank"), "{shown:?}");
    }
    // The same through settings. Each voice has its own patch over the banks that its players have.
    scene.write("lipz.toml", format!("split-voices = true\n{SETTINGS}"));
    scene.prepare(&["pack", "-o", "set.lipzbank", "--quiet"]);
    assert!(read("set.lipzbank") == read("base.lipzbank") && read("set.de-de.lipzbank") == read("base.de-de.lipzbank"));
    let patch = lipz(scene.path(), ["pack", "--over", "base.lipzbank", "-o", "x.lipzbank"]);
    assert!(patch.code == 2 && patch.stderr.contains("split-voices=false"), "{patch:?}");
    let (original, dub) = ("voices/en/act1/mayor.lipz", "voices/de/act1/mayor.lipz");
    for (path, old, new) in [(original, "Who|goes?", "Who|went?"), (dub, "AA|E", "AE|E")] {
        let text = fs::read_to_string(scene.path().join(path)).unwrap();
        scene.write(path, text.replace(old, new));
    }
    let over = ["--config", "split-voices=false", "--config", "root=voices", "--quiet", "--over", "base.lipzbank"];
    scene.prepare(&[&["pack", "voices/en", "-o", "patch.lipzbank"], &over[..]].concat());
    let german = ["pack", "voices/de", "-o", "patch.de-de.lipzbank", "--over", "base.de-de.lipzbank", "--keep-others"];
    scene.prepare(&[&german[..1], &over, &german[1..]].concat());
    scene.prepare(&["pack", "--config", "split-voices=false", "-o", "new.lipzbank", "--quiet"]);
    let patched = "base.lipzbank+base.de-de.lipzbank+patch.lipzbank+patch.de-de.lipzbank";
    let differ = lipz(scene.path(), ["diff", patched, "new.lipzbank"]);
    assert!(differ.code == 0 && differ.stdout.contains("\nno differences in 2 clips\n"), "{differ:?}");
    let english = lipz(scene.path(), ["inspect", "base.lipzbank+patch.lipzbank", "en/act1/mayor"]);
    assert!(english.code == 0 && english.stdout.contains("went?"), "without the voice: {english:?}");
    scene.write("lipz.toml", SETTINGS);
    // Stale files are reported, and stay.
    fs::remove_file(scene.path().join("voices/de/act1/mayor.lipz")).unwrap();
    let packed = lipz(scene.path(), ["pack", "--config", "split-voices=true", "-o", "base.lipzbank"]);
    assert!(
        packed.stdout.contains("left unchanged: base.de-de.lipzbank, because the bank no longer has its locale"),
        "{packed:?}"
    );
    for other in [["--config", "split-locales=true"], ["--over", "base.lipzbank"]] {
        let split = ["pack", "-o", "x.lipzbank", "--config", "split-voices=true", other[0], other[1]];
        let refused = lipz(scene.path(), split);
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
    assert_eq!(visemes.matches('|').count(), 1, "divided like the text of the original: {visemes}");
    assert!(document.elements.iter().all(|element| !element.name.text.starts_with("text")), "{dub}");
    assert_eq!(first(&run(&["sync"]).stdout), "0 clips synced, 2 unchanged, in voices");
    let check = |scene: &Scene| {
        let checked = lipz(scene.path(), ["check", "--quiet", "--allow", "LZ1707,LZ1715"]);
        let codes = checked.stderr.match_indices("[LZ").map(|(at, _)| checked.stderr[at + 1..at + 7].to_owned());
        codes.collect::<Vec<_>>()
    };
    assert_eq!(check(&scene), [""; 0]);
    // The text of the dub is the German text of the original.
    scene.write("voices/en/mayor.lipz", format!("{{ {english}, \"text_de-de\": \"Wer ist|da?\" }}"));
    assert_eq!(check(&scene), ["LZ1915"], "the dub has the old words");
    assert_eq!(first(&run(&["sync"]).stdout), "2 clips synced, in voices");
    assert_eq!(check(&scene), ["LZ1915"], "new visemes are not a new recording");
    let approve = || lipz(scene.path(), ["approve", "voices/de/mayor.lipz"]).stdout;
    let approved = approve();
    assert!(approved.starts_with("de/mayor: rec/de/mayor.wav (its text has changed)\n"), "{approved}");
    assert!(approved.contains("\napproved: 1 recording with a changed text, 0 new recordings\n"), "{approved}");
    assert_eq!(check(&scene), [""; 0]);
    // The text of the original has changed since.
    let again = fs::read_to_string(scene.path().join("voices/en/mayor.lipz")).unwrap().replace("goes", "went");
    scene.write("voices/en/mayor.lipz", again);
    scene.expect("LZ2006-dub-out-of-date-text", &["check", "--quiet", "--allow", "LZ1707,LZ1715,LZ1705,LZ1915"]);
    scene.write("rec/en/mayor.wav", voice(LINE, 3));
    scene.expect("LZ2006-dub-out-of-date", &["check", "--quiet", "--allow", "LZ1707,LZ1715,LZ1705,LZ1915"]);
    let forced = lipz(scene.path(), ["sync", "--discard-edits", "--allow", "LZ1707,LZ1715"]);
    assert_eq!((forced.code, check(&scene)), (0, vec!["LZ2006".to_owned()]), "new visemes are not a new dub");
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
    for arguments in [&["sync"][..], &["sync", "--discard-edits"]] {
        let alone = run(&[arguments, &["voices/de/mayor.lipz"]].concat());
        assert_eq!((alone.code, alone.stderr.as_str()), (0, ""), "{arguments:?}");
        assert!(files() == whole, "{arguments:?}: as a run over the whole project");
    }
    let checked = run(&["check", "voices/de/mayor.lipz", "--quiet", "--allow", "LZ1702,LZ2001"]);
    assert_eq!((checked.code, checked.stderr.as_str()), (0, ""));
    // The same from recordings. An original without a recording does not count as recorded again.
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
    shows(&["inspect", "--show", "stats", bank], &["en-us 2 0.5 s original", "de-de 1 0.3 s"]);
    let covered = ["en-us 100.0 % 2 0.6 s 0 0.0 s (original)", "de-de 50.0 % 1 0.4 s 1 0.3 s"];
    shows(&["coverage", bank], &covered);
    shows(&["coverage", "--show", "voices"], &covered);
    shows(&["coverage", bank], &["de-de 100.0 % 2 0 0 0", "dialogue.lipzbank: 2 clips with texts"]);
    assert_eq!(run(&["coverage", bank, "--show", "voices,missing", "--locale", "de_DE"]), "en/act1/yes\n");
    let json = |arguments: &[&str]| lipz(scene.path(), [arguments, &["--output-format", "json"]].concat()).stdout;
    assert!(json(&["coverage", bank, "--show", "voices"]).contains("\"to_record_us\":"));
    assert!(json(&["inspect", bank]).contains("\"voices\":"));
    let ids = run(&["ids", bank, "--lang", "json"]);
    assert!(ids.contains("en/act1/mayor") && !ids.contains("de/act1/mayor"), "{ids}");
    run(&["unpack", bank, "--output", "again", "--quiet"]);
    for file in ["en/act1/mayor", "de/act1/mayor"] {
        let read = |folder: &str| fs::read_to_string(scene.path().join(format!("{folder}/{file}.lipz"))).unwrap();
        let document = |text: &str| lipz_file::write(&lipz_file::parse(text.as_bytes()).document.unwrap());
        assert_eq!(document(&read("again")), document(&read("voices")), "a dub does not get the text of its original");
    }
    fs::remove_file(scene.path().join("voices/de/act1/mayor.lipz")).unwrap();
    let gone = lipz(scene.path(), ["diff", bank, "voices"]);
    assert_eq!(gone.code, 1);
    assert!(gone.stdout.contains("~ voices  en-us, de-de -> none\n"), "{}", gone.stdout);
    scene.write("voices/de/act1/yes.lipz", DUB);
    let other = lipz(scene.path(), ["diff", bank, "voices"]).stdout;
    assert!(other.contains("~ en/act1/mayor in de-de  de/act1/mayor -> the original\n"), "{other}");
    assert!(other.contains("~ en/act1/yes in de-de  the original -> de/act1/yes\n"), "{other}");
    let none = lipz(scene.path(), ["coverage", "voices/en", "--no-config", "--show", "voices"]);
    assert!(none.code == 2 && none.stderr.contains("the bank does not contain dubs"), "{}", none.stderr);
}

/// The project plans a language without any recorded line.
#[test]
fn the_first_dub_has_its_work_before_it_begins() {
    let scene = scene();
    fs::remove_dir_all(scene.path().join("voices/de")).unwrap();
    let run = |arguments: &[&str]| lipz(scene.path(), [&["coverage"], arguments].concat());
    let missing = |locale: &[&str]| run(&[&["--show", "voices,missing", "--locale"], locale].concat());
    let table = run(&["--show", "voices"]);
    let row = table.stdout.lines().find(|line| line.contains("de-de")).unwrap_or_default();
    assert_eq!(row.split_whitespace().collect::<Vec<_>>().join(" "), "de-de 0.0 % 0 0.0 s 2 0.6 s", "{table:?}");
    assert_eq!(missing(&["de-de"]).stdout, "en/act1/mayor\nen/act1/yes\n");
    let line = |key: &str| serde_json::json!({ "key": key, "voice": "de-de", "played": "en-us" });
    let json: serde_json::Value = serde_json::from_str(&missing(&["de-de", "--output-format", "json"]).stdout).unwrap();
    assert_eq!(json, serde_json::json!([line("en/act1/mayor"), line("en/act1/yes")]));
    let csv = missing(&["de-de", "--as", "csv"]).stdout;
    assert_eq!(csv, "key,voice,played\r\nen/act1/mayor,de-de,en-us\r\nen/act1/yes,de-de,en-us\r\n");
    let csv = run(&["--show", "voices", "--as", "csv"]).stdout;
    assert!(csv.starts_with("voice,lines,dubbed,") && csv.contains("\r\nde-de,2,0,0.0,0.0,0.0,0,2,0.6\r\n"), "{csv}");
    let page = run(&["--show", "voices", "--as", "html"]).stdout;
    assert!(page.contains("<summary>2 lines to record</summary>") && page.ends_with("</html>\n"), "{page}");
    assert_eq!(missing(&["en-us", "--output-format", "json"]).stdout.trim(), "[]");
    let none = missing(&["en-us"]);
    assert_eq!((none.code, none.stdout.as_str(), none.stderr.as_str()), (0, "", "no line is missing\n"));
    let unknown = missing(&["fr-fr"]);
    assert!(unknown.code == 2 && unknown.stderr.contains("the bank has no voice `fr-fr`"), "{unknown:?}");
    assert!(unknown.stderr.contains("choose one of en-us, de-de, or add fr-fr = "), "{unknown:?}");
    let exported = lipz(scene.path(), ["export", "texts", "po", "-o", "de.po"]);
    assert_eq!(exported.stdout, "texts of 2 clips for de-de written into de.po\n");
    scene.write("voices/de/act1/mayor.lipz", DUB);
    let exported = lipz(scene.path(), ["export", "texts", "po", "-o", "de.po", "--overwrite"]);
    let expected = "texts of 2 clips for de-de written into de.po; left out 1 dub with the texts of their originals\n";
    assert_eq!(exported.stdout, expected);
}

/// The clips of unchanged files are not read while other files have errors, so a dub was not compared with them.
#[test]
fn packs_with_a_cache_report_dubs_beside_errors() {
    let scene = scene();
    scene.write("voices/en/act1/no.lipz", ORIGINAL);
    let past = SystemTime::now() - Duration::from_secs(60);
    let age = || {
        for name in ["en/act1/mayor", "en/act1/yes", "en/act1/no", "de/act1/mayor"] {
            let file = scene.path().join(format!("voices/{name}.lipz"));
            fs::File::options().append(true).open(file).unwrap().set_modified(past).unwrap();
        }
    };
    age();
    scene.prepare(&["pack", "--quiet", "--cache", "c.cache"]);
    scene.write("voices/de/act1/mayor.lipz", DUB.replace('|', ""));
    scene.write("voices/en/act1/no.lipz", ORIGINAL.replace("blair", "rms"));
    age();
    let cold = lipz(scene.path(), ["pack", "-o", "cold.lipzbank"]);
    let cached = lipz(scene.path(), ["pack", "--cache", "c.cache"]);
    assert!(cold.stderr.contains("error[LZ2002]") && cold.stderr.contains("error[LZ0401]"), "{}", cold.stderr);
    assert_eq!((cached.code, cached.stderr), (cold.code, cold.stderr));
}
