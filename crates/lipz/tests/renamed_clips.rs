//! Files of translators with the old keys of clips.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use support::delivery::{export, import, project, replace};

#[test]
fn a_file_with_the_old_key_of_a_renamed_clip_is_imported() {
    for (format, name) in [("po", "de.po"), ("xlsx", "de.xlsx"), ("csv", "de.csv"), ("xliff", "de.xlf")] {
        let scene = project();
        let folder = scene.path();
        scene.write("voices/yes.lipz", "{ \"text_en-us\": \"Good evening.|Me!\" }");
        export(folder, format, name);
        fs::rename(folder.join("voices/otto.lipz"), folder.join("voices/mara.lipz")).unwrap();
        if format != "xlsx" {
            replace(folder, name, "Guten Abend.", "Schönen Abend.");
        }
        let imported = import(folder, &[name]);
        assert!(imported.code == 0 && imported.stderr.contains("`otto` is now `mara`"), "{format}: {imported:?}");
        let clip = fs::read_to_string(folder.join("voices/mara.lipz")).unwrap();
        assert!(format == "xlsx" || clip.contains("Schönen Abend.|Du?"), "{format}: {clip}");
    }
    // Two clips with this text may be meant, and a file that lipz has not exported may be of a different game.
    let scene = project();
    let folder = scene.path();
    export(folder, "po", "de.po");
    fs::copy(folder.join("voices/otto.lipz"), folder.join("voices/mara.lipz")).unwrap();
    fs::rename(folder.join("voices/otto.lipz"), folder.join("voices/nell.lipz")).unwrap();
    assert!(import(folder, &["de.po"]).stderr.contains("the project has no clip `otto`"));
    fs::remove_file(folder.join("voices/mara.lipz")).unwrap();
    let text = fs::read_to_string(folder.join("de.po")).unwrap();
    let unmarked: String =
        text.lines().filter(|line| !line.contains("as exported")).map(|line| format!("{line}\n")).collect();
    fs::write(folder.join("de.po"), unmarked).unwrap();
    assert!(import(folder, &["de.po"]).stderr.contains("the project has no clip `otto`"));
}

/// A deleted clip is not an existing one with the same source text, whose translation would be replaced.
#[test]
fn a_deleted_clip_is_not_taken_for_a_renamed_one() {
    for german in [", \"text_de-de\": \"Tag.|Sie?\"", ""] {
        let scene = project();
        let folder = scene.path();
        let alike = format!("{{ \"text_en-us\": \"Good evening.|You?\"{german} }}");
        scene.write("voices/mara.lipz", &alike);
        export(folder, "po", "de.po");
        fs::remove_file(folder.join("voices/otto.lipz")).unwrap();
        replace(folder, "de.po", "Guten Abend.", "Schönen Abend.");
        let imported = import(folder, &["de.po"]);
        assert!(imported.stderr.contains("the project has no clip `otto`"), "{imported:?}");
        assert_eq!(fs::read_to_string(folder.join("voices/mara.lipz")).unwrap(), alike);
    }
}

/// Of two clips with the same texts, one was deleted and the other renamed. lipz does not guess which.
#[test]
fn a_clip_that_two_old_keys_fit_is_none_of_them() {
    let scene = project();
    let folder = scene.path();
    let otto = folder.join("voices/otto.lipz");
    fs::copy(&otto, folder.join("voices/amy.lipz")).unwrap();
    export(folder, "csv", "de.csv");
    fs::remove_file(folder.join("voices/amy.lipz")).unwrap();
    fs::rename(&otto, folder.join("voices/mara.lipz")).unwrap();
    replace(folder, "de.csv", "Guten Abend.", "Schönen Abend.");
    let imported = import(folder, &["de.csv"]);
    for key in ["amy", "otto"] {
        assert!(imported.stderr.contains(&format!("the project has no clip `{key}`")), "{imported:?}");
    }
    assert!(fs::read_to_string(folder.join("voices/mara.lipz")).unwrap().contains("Guten Abend."));
}
