//! Files of translators that live on: later deliveries of the same file, rejections, copies, and files of a whole game.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use std::path::Path;
use support::delivery::{export, import, project, replace};
use support::{Scene, lipz};

fn clip(folder: &Path) -> String {
    fs::read_to_string(folder.join("voices/otto.lipz")).unwrap()
}

#[test]
fn each_delivery_of_a_file_is_imported_without_a_new_export() {
    for (format, name) in
        [("po", "de.po"), ("csv", "de.csv"), ("xliff", "de.xlf"), ("xliff-1.2", "de.xlf"), ("json", "de.json")]
    {
        let scene = project();
        let folder = scene.path();
        export(folder, format, name);
        for (from, to) in [("Guten Abend", "Schönen Abend"), ("Schönen Abend", "Hallo"), ("Hallo", "Moin")] {
            replace(folder, name, from, to);
            let imported = import(folder, &[name]);
            assert_eq!((imported.code, imported.stderr.as_str()), (0, ""), "{format}: {to}");
            assert!(clip(folder).contains(to), "{format}: {}", clip(folder));
        }
        // A change by hand in the project is not lost.
        replace(folder, "voices/otto.lipz", "Moin", "Servus");
        replace(folder, name, "Moin", "Grüß Gott");
        let refused = import(folder, &[name]);
        assert!(refused.code == 1 && refused.stderr.contains("LZ1905"), "{format}: {refused:?}");
    }
}

/// A template that `msgmerge` merges into a translated file must not bring marks of an empty translation.
#[test]
fn a_template_has_no_marks() {
    let scene = project();
    let folder = scene.path();
    let written = lipz(folder, ["export", "texts", "pot", "-o", "texts.pot"]);
    assert_eq!(written.code, 0, "{written:?}");
    assert!(!fs::read_to_string(folder.join("texts.pot")).unwrap().contains("as exported"));
}

#[test]
fn a_rejected_text_stays_open_until_it_is_approved_or_translated() {
    for (format, name, (from, to)) in [
        ("po", "de.po", ("msgctxt \"otto\"", "#, fuzzy\nmsgctxt \"otto\"")),
        ("xliff", "de.xlf", ("state=\"translated\"", "state=\"initial\"")),
    ] {
        let scene = project();
        let folder = scene.path();
        assert_eq!(lipz(folder, ["approve", "--all"]).code, 0);
        export(folder, format, name);
        replace(folder, name, from, to);
        assert_eq!(import(folder, &[name]).code, 0);
        let checked = lipz(folder, ["check"]);
        assert!(checked.stderr.contains("LZ1911") && checked.stderr.contains("marked for review"), "{checked:?}");
        let again = format!("again-{name}");
        export(folder, format, &again);
        let text = fs::read_to_string(folder.join(&again)).unwrap();
        assert!(text.contains(if format == "po" { "#, fuzzy" } else { "state=\"initial\"" }), "{text}");
        // The export itself is no new rejection, nor an approval.
        let record = || fs::read_to_string(folder.join("lipz-texts.txt")).unwrap();
        let before = record();
        assert_eq!(import(folder, &[&again]).code, 0);
        assert_eq!(record(), before, "{format}");
        assert_eq!(lipz(folder, ["approve", "--all"]).code, 0);
        assert_eq!(lipz(folder, ["check"]).stderr, "", "{format}");
    }
}

/// A clip whose export was marked because of one segment: its other segments were not rejected.
#[test]
fn segments_beside_a_stale_one_are_not_rejected() {
    let scene = project();
    let folder = scene.path();
    assert_eq!(lipz(folder, ["approve", "--all"]).code, 0);
    replace(folder, "voices/otto.lipz", "You?", "And you?");
    export(folder, "po", "de.po");
    assert_eq!(import(folder, &["de.po"]).code, 0);
    let checked = lipz(folder, ["check"]);
    assert!(checked.stderr.contains("And you?") && !checked.stderr.contains("marked for review"), "{checked:?}");
}

#[test]
fn two_copies_of_a_file_are_merged_by_their_marks() {
    let scene = project();
    let folder = scene.path();
    let written = lipz(folder, ["export", "texts", "po", "--locale", "de-de", "--by", "segment", "-o", "one.po"]);
    assert_eq!(written.code, 0, "{written:?}");
    fs::copy(folder.join("one.po"), folder.join("two.po")).unwrap();
    replace(folder, "one.po", "Guten Abend", "Schönen Abend");
    replace(folder, "two.po", "Du?", "Und du?");
    let imported = import(folder, &["one.po", "two.po"]);
    assert_eq!((imported.code, imported.stderr.as_str()), (0, ""));
    assert!(clip(folder).contains("Schönen Abend.|Und du?"), "{}", clip(folder));
    // Two changes of one text are still a conflict.
    replace(folder, "one.po", "Schönen Abend", "Moin");
    replace(folder, "two.po", "Guten Abend", "Servus");
    let refused = import(folder, &["one.po", "two.po"]);
    assert!(refused.code == 1 && refused.stderr.contains("different text earlier"), "{refused:?}");
}

#[test]
fn a_rejection_counts_even_if_a_copy_of_the_file_has_none() {
    for names in [["one.po", "two.po"], ["two.po", "one.po"]] {
        let scene = project();
        let folder = scene.path();
        lipz(folder, ["approve", "--all"]);
        export(folder, "po", "one.po");
        fs::copy(folder.join("one.po"), folder.join("two.po")).unwrap();
        replace(folder, "one.po", "msgctxt", "#, fuzzy\nmsgctxt");
        assert_eq!(import(folder, &names).code, 0);
        let checked = lipz(folder, ["check", "--output-format", "concise"]);
        assert_eq!(checked.stdout.matches("LZ1911").count(), 2, "{checked:?}");
        // The same holds in the other direction: one of two copies approves what was rejected.
        fs::remove_file(folder.join("one.po")).unwrap();
        fs::remove_file(folder.join("two.po")).unwrap();
        export(folder, "po", "one.po");
        fs::copy(folder.join("one.po"), folder.join("two.po")).unwrap();
        replace(folder, "two.po", "fuzzy", "no-wrap");
        assert_eq!(import(folder, &names).code, 0);
        let checked = lipz(folder, ["check", "--output-format", "concise"]);
        assert_eq!(checked.stdout.matches("LZ1911").count(), 0, "{checked:?}");
    }
}

/// A changed text with the old problem is a decision about this delivery.
#[test]
fn a_check_reports_problems_of_changed_texts_that_the_old_texts_had() {
    let scene = Scene::new();
    let folder = scene.path();
    scene.write("lipz.toml", "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n");
    let clip = "{ \"text_en-us\": \"Wait 15 minutes.|Take 2.\", \"text_de-de\": \"Warte 50 Minuten.|Nimm 3.\" }\n";
    scene.write("voices/otto.lipz", clip);
    export(folder, "po", "de.po");
    replace(folder, "de.po", "Warte 50", "Warten Sie 50");
    let checked = lipz(folder, ["import", "texts", "de.po", "--check"]);
    assert!(checked.stderr.contains("the number 50 instead of 15"), "{checked:?}");
    assert!(!checked.stderr.contains("the number 3 instead of 2"), "the text has not changed: {checked:?}");
}

#[test]
fn entries_of_other_parts_of_a_game_do_not_refuse_those_of_clips() {
    let scene = project();
    let folder = scene.path();
    let head = "msgid \"\"\nmsgstr \"Language: de_DE\\n\"\n";
    let menu = "\nmsgid \"Options\"\nmsgstr \"Optionen\"\n\nmsgid \"%d coin\"\nmsgid_plural \"%d coins\"\n\
        msgstr[0] \"%d Münze\"\nmsgstr[1] \"%d Münzen\"\n";
    let otto = "\nmsgctxt \"otto\"\nmsgid \"Good evening. | You?\"\nmsgstr \"Sch\\303\\266nen Abend. | Du?\"\n";
    scene.write("de.po", format!("{head}{menu}{otto}"));
    let imported = import(folder, &["de.po"]);
    assert!(imported.code == 0 && clip(folder).contains("Schönen Abend."), "{imported:?}");
    assert_eq!(imported.stderr.matches("[LZ1902]").count(), 2, "{}", imported.stderr);
    for content in ["", head] {
        scene.write("empty.po", content);
        let empty = import(folder, &["empty.po"]);
        assert!(empty.code == 1 && empty.stderr.contains("LZ1901"), "{content:?}: {empty:?}");
    }
}

#[test]
fn a_game_with_translations_comes_by_its_texts() {
    let scene = project();
    let folder = scene.path();
    scene.write("voices/new.lipz", "{ \"visemes\": \"MA|EO|MA\", \"text_en-us\": \"Hi.|You?|Go!\" }\n");
    scene.write("voices/whole.lipz", "{ \"visemes\": \"MA|EO\", \"text_en-us\": \"Who?|Me.\" }\n");
    let entry = |source: &str, text: &str| format!("\nmsgid \"{source}\"\nmsgstr \"{text}\"\n");
    let head = "msgid \"\"\nmsgstr \"Language: de_DE\\n\"\n".to_owned();
    let entries = [("Hi.", "Hallo."), ("You?", "Du da?"), ("Who? | Me.", "Wer? | Ich."), ("Menu", "Menü")];
    let po: String = entries.map(|(source, text)| entry(source, text)).concat();
    scene.write("de.po", head + &po + "\nmsgctxt \"bow\"\nmsgid \"Go!\"\nmsgstr \"Los!\"\n");
    let imported = import(folder, &["de.po", "--by-text"]);
    assert_eq!(imported.code, 0, "{imported:?}");
    assert!(imported.stderr.contains("a translation matches no text that lacks one"), "{}", imported.stderr);
    let read = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
    assert!(read("voices/new.lipz").contains("Hallo.|Du da?|Los!"), "{}", read("voices/new.lipz"));
    assert!(read("voices/whole.lipz").contains("Wer?|Ich."), "{}", read("voices/whole.lipz"));
    assert!(clip(folder).contains("Guten Abend.|Du?"), "translations that exist are not replaced");
    // Different translations of one text.
    scene.write("voices/last.lipz", "{ \"visemes\": \"MA\", \"text_en-us\": \"Bow\" }\n");
    let two = "msgid \"\"\nmsgstr \"Language: de_DE\\n\"\n\nmsgctxt \"ship\"\nmsgid \"Bow\"\nmsgstr \"Bug\"\n\n\
        msgctxt \"arms\"\nmsgid \"Bow\"\nmsgstr \"Bogen\"\n";
    scene.write("two.po", two);
    let refused = import(folder, &["two.po", "--by-text"]);
    assert!(refused.code == 1 && refused.stderr.contains("has different translations"), "{refused:?}");
}

/// A translation that was improved by hand while its source stayed the same: without the pair of texts in the record, a
/// merge with a branch that changed both would call it current.
#[test]
fn approval_records_pairs_of_texts() {
    let scene = project();
    let folder = scene.path();
    assert_eq!(lipz(folder, ["approve", "--all"]).code, 0);
    let record = || fs::read_to_string(folder.join("lipz-texts.txt")).unwrap();
    let base = record();
    replace(folder, "voices/otto.lipz", "Guten Abend", "Schönen Abend");
    assert_eq!(lipz(folder, ["approve", "--all", "--check"]).code, 0, "there is nothing to approve");
    let approved = lipz(folder, ["approve", "--all"]);
    assert!(approved.stdout.contains("1 text without a recorded source text"), "{approved:?}");
    let ours = record();
    assert_ne!(ours, base);
    // The other branch changed source and translation, and git merged the records by lines.
    scene.write("lipz-texts.txt", &base);
    replace(folder, "voices/otto.lipz", "Good evening", "Good night");
    replace(folder, "voices/otto.lipz", "Schönen Abend", "Gute Nacht");
    assert_eq!(lipz(folder, ["approve", "--all"]).code, 0);
    let last = |text: &str| text.lines().last().unwrap().to_owned();
    scene.write("lipz-texts.txt", format!("{}{}\n", record(), last(&ours)));
    replace(folder, "voices/otto.lipz", "Gute Nacht", "Schönen Abend");
    let checked = lipz(folder, ["check"]);
    assert!(checked.stderr.contains("LZ1911"), "{checked:?}");
}

/// Spreadsheets change case and spaces; Unreal writes a namespace before the key.
#[test]
fn keys_mean_the_only_clip_that_they_can() {
    for key in [" otto ", "OTTO", "Dialogue,otto"] {
        let scene = project();
        let folder = scene.path();
        let head = "msgid \"\"\nmsgstr \"Language: de_DE\\n\"\n\n";
        let entry = "msgid \"Good evening. | You?\"\nmsgstr \"Hallo. | Du?\"\n";
        scene.write("de.po", format!("{head}msgctxt \"{key}\"\n{entry}"));
        let imported = import(folder, &["de.po"]);
        assert!(clip(folder).contains("Hallo.|Du?"), "{key:?}: {imported:?}");
    }
}

/// A vendor's file can be judged before it is in the project.
#[test]
fn a_check_reports_every_problem_that_a_delivery_would_bring() {
    let scene = Scene::new();
    scene.write(
        "lipz.toml",
        "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n[text]\nlines = 1\nline-columns = 20\n",
    );
    scene.write(
        "voices/otto.lipz",
        "{ \"text_en-us\": \"Wait 15 minutes.|Good evening my friend.|Go {name} now!\", \"text_fr-fr\": \"Attendez.|Bonsoir.|Va, {name} !\" }\n",
    );
    let folder = scene.path();
    for (format, name) in [("po", "de.po"), ("csv", "de.csv")] {
        let exported = ["export", "texts", format, "--locale", "de-de", "--by", "segment", "-o", name];
        assert_eq!(lipz(folder, exported).code, 0);
        let translated = |text: &str, translation: &str| match format {
            "po" => format!("msgid \"{text}\"\nmsgstr \"{translation}\""),
            _ => format!("{text},{translation},"),
        };
        for (text, translation) in [
            ("Wait 15 minutes.", "Warten Sie 50 Minuten."),
            ("Good evening my friend.", "Good evening my friend."),
            ("Go {name} now!", "Geh!"),
        ] {
            replace(folder, name, &translated(text, ""), &translated(text, translation));
        }
        let before = fs::read_to_string(folder.join("voices/otto.lipz")).unwrap();
        let checked = lipz(folder, ["import", "texts", name, "--check"]);
        assert_eq!(checked.code, 0, "warnings only: {checked:?}");
        for code in ["LZ1913", "LZ1912", "LZ1906", "LZ0510"] {
            assert!(checked.stderr.contains(code), "{format}: {code}: {}", checked.stderr);
        }
        assert!(checked.stderr.contains(&format!("--> {name}:")), "{}", checked.stderr);
        let denied = lipz(folder, ["import", "texts", name, "--check", "--deny", "numbers-differ"]);
        assert_eq!(denied.code, 1, "{denied:?}");
        assert_eq!(fs::read_to_string(folder.join("voices/otto.lipz")).unwrap(), before);
    }
}

/// Questions come before translations, and clips are renamed in between.
#[test]
fn comments_on_a_clip_without_translations_follow_it() {
    let scene = project();
    let folder = scene.path();
    scene.write("voices/otto.lipz", "{ \"visemes\": \"MA|EO\", \"text_en-us\": \"Good evening.|You?\" }\n");
    scene.write("voices/mara.lipz", "{ \"text_en-us\": \"Yes.\" }\n");
    export(folder, "po", "de.po");
    replace(folder, "de.po", "#. as exported", "# Formal or not?\n#. as exported");
    let text = fs::read_to_string(folder.join("de.po")).unwrap();
    assert_eq!(import(folder, &["de.po"]).code, 0, "{text}");
    let record = || fs::read_to_string(folder.join("lipz-texts.txt")).unwrap();
    assert!(record().contains("voices/otto.lipz\ten-us\tde-de:-,-\tGood evening. | You?\n"), "{}", record());
    assert_eq!(lipz(folder, ["check", "--quiet"]).stderr, "");
    fs::rename(folder.join("voices/otto.lipz"), folder.join("voices/mayor.lipz")).unwrap();
    fs::remove_file(folder.join("de.po")).unwrap();
    export(folder, "po", "de.po");
    let exported = fs::read_to_string(folder.join("de.po")).unwrap();
    let of_mayor = exported.split("\n\n").find(|entry| entry.contains("\"mayor")).unwrap();
    assert!(of_mayor.contains("# Formal or not?"), "{exported}");
}

/// Questions of a translator reach the others, and answers reach the translator.
#[test]
fn comments_of_translators_are_kept_and_come_back() {
    for (format, name) in
        [("po", "de.po"), ("csv", "de.csv"), ("xliff", "de.xlf"), ("xliff-1.2", "de.xlf"), ("json", "de.json")]
    {
        let scene = project();
        let folder = scene.path();
        export(folder, format, name);
        let with_comment = |text: &str| match format {
            "po" => replace(folder, name, "#. as exported", &format!("# {text}\n#. as exported")),
            "csv" => replace(folder, name, "Guten Abend. | Du?,,", &format!("Guten Abend. | Du?,{text},")),
            "xliff" => replace(folder, name, "<notes>", &format!("<notes><note>{text}</note>")),
            "xliff-1.2" => {
                replace(folder, name, "</trans-unit>", &format!("<note from=\"Anna\">{text}</note></trans-unit>"));
            }
            _ => replace(
                folder,
                name,
                "\"segments\"",
                &format!("\"comments\": {{ \"de-de\": {{ \"lines\": [\"{text}\"] }} }}, \"segments\""),
            ),
        };
        with_comment("Formal or not?");
        let imported = import(folder, &[name]);
        assert!(imported.stdout.contains("comments of translators on 1 clip updated"), "{format}: {imported:?}");
        let exported = |count: usize| {
            fs::remove_file(folder.join(name)).unwrap();
            export(folder, format, name);
            let text = fs::read_to_string(folder.join(name)).unwrap();
            assert_eq!(text.matches("Formal or not?").count(), count, "{format}: {text}");
        };
        exported(1);
        // The same file again changes nothing.
        let record = || fs::read_to_string(folder.join("lipz-texts.txt")).unwrap();
        let before = record();
        assert_eq!(import(folder, &[name]).code, 0);
        assert_eq!(record(), before, "{format}");
        // A second translator answers.
        replace(folder, name, "Formal or not?", "Formal or not? Not.");
        assert_eq!(import(folder, &[name]).code, 0);
        assert_eq!(record().matches("\tcomment\t").count(), 1, "{format}: {}", record());
        exported(1);
        assert!(record().contains("Formal or not? Not."), "{format}");
        // A renamed clip keeps its comments.
        fs::rename(folder.join("voices/otto.lipz"), folder.join("voices/mayor.lipz")).unwrap();
        exported(1);
    }
}
