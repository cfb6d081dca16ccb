//! Translations and their sources: the record, `lipz check`, `lipz approve`.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use std::path::Path;
use support::approved::{MAYOR, approved, project};
use support::sound::voice;
use support::{Scene, lipz, with_input};

fn record(folder: &Path) -> String {
    let text = fs::read_to_string(folder.join("lipz-texts.txt")).unwrap();
    text.lines().filter(|line| !line.starts_with('#')).map(|line| line.to_owned() + "\n").collect()
}

/// Returns the codes that `lipz check` reports.
fn codes(folder: &Path) -> Vec<String> {
    let outcome = lipz(folder, ["check", "--quiet"]);
    let lines = outcome.stderr.lines().filter_map(|line| line.strip_prefix("warning[")?.split(']').next());
    lines.map(str::to_owned).collect()
}

#[test]
fn a_file_that_would_be_fixed_has_its_record_all_the_same() {
    let scene = approved();
    let changed = MAYOR.replace("evening", "morning").replace("24", "\"24\"");
    scene.write("voices/mayor.lipz", &changed);
    let outcome = lipz(scene.path(), ["check", "--diff", "--quiet"]);
    assert!(outcome.stdout.contains("+  \"fps\" :        24"), "{outcome:?}");
    assert!(outcome.stderr.contains("LZ1911"), "{outcome:?}");
}

#[test]
fn a_changed_source_is_told_until_somebody_accepts_it() {
    let mut scene = project();
    assert_eq!(codes(scene.path()), [""; 0], "a project without a record works as before");
    let first = lipz(scene.path(), ["approve", "--all"]);
    let expected = "approved: 0 stale texts, 2 texts without a recorded source text\n\
                    lipz-texts.txt is new. ";
    assert!(first.code == 0 && first.stdout.starts_with(expected), "{first:?}");
    let line = "voices/mayor.lipz\ten-us\tde-de:3dd5d0bd,68686a10\tGood evening, {name}. | Who goes there?\n";
    assert_eq!(record(scene.path()), line);
    assert_eq!(codes(scene.path()), [""; 0]);

    scene.write("voices/mayor.lipz", MAYOR.replace("evening", "morning"));
    scene.expect("LZ1911-stale-translation", &["check", "--quiet"]);
    scene.write("voices/mayor.lipz", MAYOR.replace("evening", "morning").replace("Abend", "Tag"));
    scene.expect("LZ1911-stale-translation-both", &["check", "--quiet"]);
    scene.write("voices/mayor.lipz", MAYOR.replace("Abend", "Tag"));
    assert_eq!(codes(scene.path()), [""; 0], "a translation may change without its source");

    scene.write("voices/mayor.lipz", MAYOR.replace("evening", "morning"));
    let check = lipz(scene.path(), ["approve", "--all", "--check"]);
    let expected = "mayor de-de: `Guten Abend, {name}.` (source was `Good evening, {name}.`, is now `Good morning, {name}.`)\n\
                    to approve: 1 stale text, 0 texts without a recorded source text\n";
    assert_eq!((check.code, check.stdout.as_str()), (1, expected));
    assert_eq!(record(scene.path()), line, "nothing is written");
    for (slip, said) in [
        (&["approve", "voices", "--locale", "fr-fr"][..], "no clip has a text in `fr-fr`"),
        (&["approve", "voices/majo*"], "no Lipz files in `voices/majo*`"),
        (&["approve", "--all", "voices"], "'--all' cannot be used with '[SOURCES]...'"),
    ] {
        let refused = lipz(scene.path(), slip);
        assert!(refused.code == 2 && refused.stderr.contains(said), "{refused:?}");
    }
    let by_pattern = lipz(scene.path(), ["approve", "voices/may*", "--locale", "de-de"]);
    assert!(by_pattern.stdout.ends_with("approved: 1 stale text, 0 texts without a recorded source text\n"));
    assert_eq!(codes(scene.path()), [""; 0]);
    assert_eq!(lipz(scene.path(), ["approve", "--all", "--check"]).code, 0);
    let nothing = lipz(scene.path(), ["approve"]);
    assert!(nothing.code == 2 && nothing.stderr.contains("no clips are named"), "{nothing:?}");
}

#[test]
fn an_import_says_what_translations_were_made_from() {
    let scene = approved();
    let folder = scene.path();
    scene.write("voices/mayor.lipz", MAYOR.replace("evening", "morning"));
    lipz(folder, ["export", "texts", "po", "-o", "de.po"]);
    let po = fs::read_to_string(folder.join("de.po")).unwrap();
    assert!(
        po.contains("#, fuzzy, python-brace-format\n#| msgid \"Good evening, {name}. | Who goes there?\"\n"),
        "{po}"
    );
    lipz(folder, ["import", "texts", "de.po"]);
    assert_eq!(codes(folder), ["LZ1911"], "the translation has not been reviewed");
    // A translator who considers the text still valid removes the mark.
    scene.write("de.po", po.replace("fuzzy, ", ""));
    lipz(folder, ["import", "texts", "de.po"]);
    assert_eq!(codes(folder), [""; 0]);
    scene.write("voices/mayor.lipz", MAYOR.replace("evening", "night"));
    for format in ["csv", "xliff", "xliff-1.2", "json", "xlsx"] {
        let name = format!("texts.{}", format.split('-').next().unwrap().replace("xliff", "xlf"));
        lipz(folder, ["export", "texts", format, "-o", &name, "--overwrite"]);
        lipz(folder, ["import", "texts", &name]);
        assert_eq!(codes(folder), ["LZ1911"], "{format}: as it was");
    }
    let csv = fs::read_to_string(folder.join("texts.csv")).unwrap().replace("Guten Abend", "Gute Nacht");
    scene.write("texts.csv", csv);
    let import = lipz(folder, ["import", "texts", "texts.csv"]);
    assert_eq!((import.stdout.as_str(), codes(folder)), ("texts imported: 0 new, 1 changed\n", vec![]));
    let xliff = lipz(folder, ["export", "texts", "xliff", "-o", "-"]).stdout;
    scene.write("de.xlf", xliff.replacen("state=\"translated\"", "state=\"final\"", 1));
    lipz(folder, ["import", "texts", "de.xlf"]);
    assert!(record(folder).contains("fi,68686a10i\t"), "{}", record(folder));
    let again = lipz(folder, ["export", "texts", "xliff", "-o", "-"]).stdout;
    assert!(
        again.contains("state=\"translated\"") && !again.contains("state=\"final\""),
        "of the clip, the earliest state counts"
    );
}

/// Without a record, no translation can be reported as stale, so a hint must warn about this.
#[test]
fn translations_of_which_nothing_is_known() {
    let scene = project();
    let folder = scene.path();
    let unknown = "unknown: 2 of 2 translated segments without a recorded source text";
    let hint = |arguments: &[&str]| {
        lipz(folder, [&["check"], arguments].concat()).stdout.contains("cannot detect stale translations")
    };
    assert!(
        hint(&[]) && !hint(&["--allow", "stale-translation"]) && !hint(&["--quiet"]) && !hint(&["--show", "stats"])
    );
    let settings = fs::read_to_string(folder.join("lipz.toml")).unwrap();
    // As stated in the hint.
    scene.write("lipz.toml", format!("{settings}\n[lints]\nstale-translation = \"allow\"\n"));
    assert!(!hint(&[]));
    scene.write("lipz.toml", settings);
    scene.write("voices/broken.lipz", "{");
    assert!(!hint(&[]), "there is other work to do");
    fs::remove_file(folder.join("voices/broken.lipz")).unwrap();
    assert!(lipz(folder, ["coverage"]).stdout.contains(unknown));
    assert!(lipz(folder, ["coverage", "--as", "csv"]).stdout.contains(",0,0,2,5,0,0,0,0,0,0,0\r\n"));
    let json: serde_json::Value =
        serde_json::from_str(&lipz(folder, ["coverage", "--output-format", "json"]).stdout).unwrap();
    let german = json.as_array().unwrap().iter().find(|locale| locale["locale"] == "de-de").unwrap();
    assert_eq!(german["work"]["unknown"], serde_json::json!({ "segments": 2, "words": 5 }));
    assert!(
        lipz(folder, ["coverage", "--as", "html"])
            .stdout
            .contains("the source text of 2 translated segments is not recorded")
    );
    lipz(folder, ["approve", "--all"]);
    assert!(!hint(&[]));
    assert!(!lipz(folder, ["coverage"]).stdout.contains("unknown:"));
    // Added by hand, after the record was created.
    scene.write("voices/new.lipz", r#"{ "visemes": "M", "text_en-us": "Halt!", "text_de-de": "Halt!" }"#);
    assert!(lipz(folder, ["coverage"]).stdout.contains("unknown: 1 of 3 translated segments without"));
}

/// The file names the source of its translation, which also applies to a forced import.
#[test]
fn a_forced_import_of_an_older_text_is_out_of_date() {
    for recorded in [false, true] {
        let scene = if recorded { approved() } else { project() };
        let folder = scene.path();
        lipz(folder, ["export", "texts", "po", "-o", "de.po"]);
        let changed = MAYOR.replace("evening", "morning");
        scene.write("voices/mayor.lipz", &changed);
        let po = fs::read_to_string(folder.join("de.po")).unwrap();
        scene.write("de.po", po.replace("Guten Abend", "Schönen Abend"));
        let import = lipz(folder, ["import", "texts", "de.po", "--discard-edits"]);
        assert!(import.code == 0 && import.stderr.contains("warning[LZ1904]"), "{import:?}");
        let check = lipz(folder, ["check", "--quiet"]);
        assert_eq!(check.stderr.matches("LZ1911").count(), 1, "{recorded}: {check:?}");
        assert!(check.stderr.contains("this was `evening`"), "{check:?}");
    }
}

#[test]
fn a_renamed_clip_keeps_what_is_known() {
    let scene = approved();
    let folder = scene.path();
    fs::remove_file(folder.join("voices/mayor.lipz")).unwrap();
    scene.write("voices/act1/mayor.lipz", MAYOR.replace("evening", "morning"));
    assert_eq!(codes(folder), ["LZ1911"]);
    let inner = lipz(&folder.join("voices"), ["check", "act1", "--quiet"]);
    assert!(inner.stderr.contains("[LZ1911]"), "{}", inner.stderr);
    let approve = lipz(folder, ["approve", "--all"]);
    assert!(approve.stdout.starts_with("renamed: voices/mayor.lipz -> voices/act1/mayor.lipz\n"), "{}", approve.stdout);
    fs::remove_file(folder.join("voices/act1/mayor.lipz")).unwrap();
    scene.write("voices/other.lipz", "{ \"visemes\": \"MA\" }");
    lipz(folder, ["approve", "voices"]);
    assert_ne!(record(folder), "", "only a run on the whole project removes entries");
    let approve = lipz(folder, ["approve", "--all"]);
    assert!(approve.stdout.starts_with("deleted: voices/act1/mayor.lipz\n"), "{}", approve.stdout);
    assert_eq!(record(folder), "");
}

#[test]
fn records_that_cannot_be_read() {
    let mut scene = approved();
    let line = record(scene.path());
    let conflict = format!("# lipz texts\n<<<<<<< HEAD\n{line}=======\n{line}>>>>>>> theirs\n");
    scene.write("lipz-texts.txt", &conflict);
    scene.expect("LZ1910-text-record-line", &["check", "--quiet"]);
    scene.write("lipz-texts.txt", "my notes");
    for arguments in [&["check"][..], &["approve", "--all"], &["export", "texts", "po", "-o", "x.po"]] {
        let outcome = lipz(scene.path(), arguments);
        assert!(outcome.code == 2 && outcome.stderr.contains("is not a record of translations"), "{outcome:?}");
    }
    assert_eq!(fs::read_to_string(scene.path().join("lipz-texts.txt")).unwrap(), "my notes");
    assert!(!scene.path().join("x.po").exists());
}

#[test]
fn exports_of_what_is_to_be_done() {
    let scene = approved();
    let folder = scene.path();
    scene.write("voices/done.lipz", "{ \"text_en-us\": \"Go.\", \"text_de-de\": \"Geh.\", \"text_fr-fr\": \"Va.\" }");
    let export = |format: &str, states: &str| {
        lipz(
            folder,
            [
                "export",
                "texts",
                format,
                "--locale",
                "de-de",
                "--locale",
                "fr-fr",
                "--state",
                states,
                "-o",
                "out",
                "--overwrite",
            ],
        )
    };
    fs::create_dir(folder.join("out")).unwrap();
    let nothing = export("po", "stale");
    assert!(nothing.code == 2 && nothing.stderr.contains("no text is stale"), "{nothing:?}");
    scene.write("voices/mayor.lipz", MAYOR.replace("evening", "morning"));
    let read = |name: &str| fs::read_to_string(folder.join("out").join(name)).unwrap_or_default();
    assert_eq!(export("po", "stale").code, 0);
    assert!(read("de-de.po").contains("\"mayor\"") && !read("de-de.po").contains("\"done\""));
    assert_eq!(read("fr-fr.po"), "", "nothing of it is stale");
    assert_eq!(export("xliff", "missing,stale").code, 0);
    assert!(["de-de.xlf", "fr-fr.xlf"].iter().all(|name| read(name).contains("mayor") && !read(name).contains("done")));
    let segments: Vec<String> =
        read("de-de.xlf").lines().filter(|line| line.contains("<segment")).map(|line| line.trim().to_owned()).collect();
    let expected = ["<segment id=\"s1\" state=\"initial\">", "<segment id=\"s2\" state=\"translated\">"];
    assert_eq!(segments, expected);
    assert_eq!(export("csv", "translated").code, 0);
    assert!(read("texts.csv").contains("\r\ndone,"), "{}", read("texts.csv"));

    let template = lipz(folder, ["export", "texts", "pot", "-o", "texts.pot"]);
    assert_eq!(template.stdout, "texts of 2 clips for any locale written into texts.pot\n", "{template:?}");
    let template = fs::read_to_string(folder.join("texts.pot")).unwrap();
    assert!(template.contains("\"Language: \\n\"") && !template.contains("Guten"), "{template}");
    // Any tool may have made a translation from the template.
    let po = template
        .replace("Language: ", "Language: sw_KE")
        .replace("msgid \"Go.\"\nmsgstr \"\"", "msgid \"Go.\"\nmsgstr \"Nenda.\"");
    let import = with_input(folder, &["import", "texts", "-", "--stdin-filename", "sw-ke.po"], po.as_bytes());
    assert!(import.stdout.starts_with(b"texts imported: 1 new"), "{import:?}");
    assert!(fs::read_to_string(folder.join("voices/done.lipz")).unwrap().contains("\"text_sw-ke\": \"Nenda.\""));
    let unknown = with_input(folder, &["import", "texts", "-"], b"");
    assert_eq!(unknown.status.code(), Some(2), "{unknown:?}");
}

#[test]
fn recordings_of_mouths_by_hand_are_known_once_they_are_accepted() {
    let scene = Scene::new();
    let settings = "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n[audio]\nfolder = \"rec\"\n";
    scene.write("lipz.toml", format!("{settings}[voices]\nen-us = \"{{key}}\"\nde-de = \"de/{{key}}\"\n"));
    scene.write("voices/mayor.lipz", MAYOR);
    scene.write("voices/silent.lipz", r#"{ "fps": 24, "visemes": "MAEO" }"#);
    let dub = r#"{ "fps": 24, "visemes": "MAAAEO----|MAAAAEEO--" }"#;
    scene.write("voices/de/mayor.lipz", dub);
    for (take, name) in (0..).zip(["mayor", "silent", "de/mayor"]) {
        scene.write(&format!("rec/{name}.wav"), voice(&[(true, 833)], take));
    }
    let told = || -> Vec<String> {
        codes(scene.path()).into_iter().filter(|code| ["LZ1915", "LZ2006"].contains(&code.as_str())).collect()
    };
    let approve = |arguments: &[&str]| lipz(scene.path(), [&["approve"], arguments].concat());
    let check = approve(&["--all", "--check"]);
    let unknown = "\nto approve: 0 recordings with a changed text, 2 new recordings\n";
    assert!(check.code == 1 && check.stdout.ends_with(unknown), "{check:?}");
    assert!(!scene.path().join("lipz-sync.txt").exists() && !scene.path().join("voices/lipz-sync.txt").exists());
    assert_eq!(approve(&["--all", "--quiet"]).code, 0);
    let again = approve(&["--all", "--check"]);
    assert!(again.code == 0 && !again.stdout.contains("recording"), "{again:?}");
    assert_eq!(told(), [""; 0]);
    // Both texts change: the recordings of the original and the dub have the old words, and the original of the dub has
    // changed.
    let changed = MAYOR.replace("evening", "morning").replace("Abend", "Morgen");
    scene.write("voices/mayor.lipz", &changed);
    assert_eq!(told(), ["LZ1915", "LZ2006", "LZ1915"]);
    scene.write("rec/mayor.wav", voice(&[(true, 833)], 10));
    assert_eq!(told(), ["LZ1915", "LZ2006"], "the original is recorded again");
    scene.write("rec/de/mayor.wav", voice(&[(true, 833)], 11));
    assert_eq!(told(), [""; 0], "and the dub");
    assert_eq!(approve(&["--all", "--quiet"]).code, 0);
    scene.write("voices/mayor.lipz", changed.replace("Morgen", "morgen"));
    assert_eq!(told(), ["LZ1915"]);
    let below = lipz(&scene.path().join("voices/de"), ["approve", "mayor.lipz", "--check"]);
    assert!(
        below.code == 1 && below.stdout.starts_with("de/mayor: "),
        "by the key that it has in the project: {below:?}"
    );
    let one = approve(&["voices/de/*"]);
    assert!(one.stdout.starts_with("de/mayor: rec/de/mayor.wav (its text has changed)\n"), "{one:?}");
    assert_eq!(told(), [""; 0]);
}
