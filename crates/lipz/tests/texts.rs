//! `lipz texts`: export to translators, import, and conflicts.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use std::path::Path;
use support::{Scene, lipz, repository};

const MAYOR: &str = r#"{
  "visemes" :    "MAAAEO----|MAAAAEEO--",
  "text_en-us" : "{louder} Mayor?|Mayor!",
  "fps" :        24
}
"#;
const SHOE: &str = r#"{ "visemes": "MA", "text_en-us": "Shoes, {name}!", "text_de-de": "Schuhe, {name}!",
    "mood": [1,2] }
"#;

/// Returns a project of two clips, one of which is translated.
fn project() -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n");
    scene.write("voices/act1/mayor.lipz", MAYOR);
    scene.write("voices/shoe.lipz", SHOE);
    scene
}

/// Returns a PO file of German translations: the texts of `mayor` and `shoe` with their sources.
fn po(entries: &[(&str, &str, &str)]) -> String {
    let entry = |(key, source, text): &(&str, &str, &str)| {
        format!("\nmsgctxt \"{key}\"\nmsgid \"{source}\"\nmsgstr \"{text}\"\n")
    };
    let entries: String = entries.iter().map(entry).collect();
    format!("msgid \"\"\nmsgstr \"Language: de_DE\\n\"\n{entries}")
}

fn read(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap()
}

/// Returns the contents of the files below `voices`.
fn voices(folder: &Path) -> [String; 2] {
    ["voices/act1/mayor.lipz", "voices/shoe.lipz"].map(|name| read(folder, name))
}

#[test]
fn a_week_of_a_localiser() {
    let scene = project();
    let folder = scene.path();
    let export = lipz(folder, ["export", "texts", "po", "--locale", "de-de", "-o", "de-de.po"]);
    assert_eq!((export.code, export.stderr.as_str()), (0, ""));
    assert_eq!(export.stdout, "texts of 2 clips for de-de written into de-de.po\n");
    let again = lipz(folder, ["export", "texts", "po", "--locale", "de-de", "-o", "de-de.po"]);
    assert!(again.code == 1 && again.stderr.contains("[LZ0906]"), "{}", again.stderr);

    let same = lipz(folder, ["import", "texts", "de-de.po"]);
    let summary = "texts imported: 0 new, 2 unchanged\nlipz-texts.txt is new. ";
    assert!(same.code == 0 && same.stdout.starts_with(summary), "{same:?}");
    assert_eq!(voices(folder), [MAYOR, SHOE]);

    // While the translator works, the Lipz file of another clip is edited.
    let translated = read(folder, "de-de.po").replace(
        "msgid \"{louder} Mayor? | Mayor!\"\nmsgstr \"\"",
        "msgid \"{louder} Mayor? | Mayor!\"\nmsgstr \"{louder} Herr Bürgermeister? | Bürgermeister!\"",
    );
    scene.write("de-de.po", &translated);
    scene.write("voices/shoe.lipz", SHOE.replace("Schuhe", "Treter"));
    let check = lipz(folder, ["import", "texts", "de-de.po", "--check"]);
    let expected = "texts that would be imported: 1 new, 1 kept (newer in the project)\n";
    assert_eq!((check.code, check.stdout.as_str()), (0, expected), "{}", check.stderr);
    assert_eq!(read(folder, "voices/act1/mayor.lipz"), MAYOR);
    let import = lipz(folder, ["import", "texts", "de-de.po"]);
    assert_eq!(import.stdout, "texts imported: 1 new, 1 kept (newer in the project)\n");
    let [mayor, shoe] = voices(folder);
    assert!(mayor.contains("  \"text_de-de\" : \"{louder} Herr Bürgermeister?|Bürgermeister!\",\n"), "{mayor}");
    assert_eq!(shoe, SHOE.replace("Schuhe", "Treter"));
    assert_eq!(lipz(folder, ["fmt", "--check", "voices/act1"]).code, 0, "the layout was canonical");
    let all = lipz(folder, ["check"]);
    assert!(!all.stderr.contains("LZ06"), "{}", all.stderr);
}

#[test]
fn every_shape_of_a_csv_comes_back() {
    for shape in ["csv", "unity", "godot", "unreal", "yarn"] {
        let scene = project();
        let folder = scene.path();
        let arguments = ["export", "texts", shape, "--locale", "de-de", "--by", "segment", "-o", "."];
        let export = lipz(folder, arguments);
        assert_eq!(export.code, 0, "{shape}: {}", export.stderr);
        let name = if shape == "yarn" { "de-de.csv" } else { "texts.csv" };
        let table = read(folder, name).replace("Schuhe", "Treter");
        // A table as Excel saves it on a German system.
        scene.write(name, format!("\u{feff}{table}"));
        let import = lipz(folder, ["import", "texts", name]);
        assert_eq!((import.code, import.stderr.as_str()), (0, ""), "{shape}");
        assert_eq!(voices(folder), [MAYOR.to_owned(), SHOE.replace("Schuhe", "Treter")], "{shape}");
    }
}

#[test]
fn what_does_not_fit() {
    let mut scene = project();
    let import = ["import", "texts", "de-de.po", "--quiet"];
    let mayor = "{louder} Mayor? | Mayor!";
    scene.write("de-de.po", po(&[("shoe", "Shoes, {name}!", "Schuhe")]).replace("\"Schuhe\"", "\"Schuhe"));
    scene.expect("LZ1901-exchange-syntax", &import);
    scene.write("de-de.po", po(&[("act1/mayer", mayor, "a | b"), ("shoe", "Shoes, {name}!", "Schuhe, {name}!")]));
    scene.expect("LZ1902-unknown-text-key", &import);
    scene.write("de-de.po", po(&[("act1/mayor", mayor, "Herr Bürgermeister!"), ("shoe|2", "", "Schuhe")]));
    scene.expect("LZ1903-text-segments", &import);
    scene.write("de-de.po", po(&[("shoe|1", "Shoes, {name}!", "Schuhe | {name}")]));
    scene.expect("LZ1903-text-segments-in-segment", &import);
    scene.write(
        "de-de.po",
        po(&[("shoe", "Boots, {name}!", "Stiefel, {name}!"), ("act1/mayor", mayor, "{louder} A | B")]),
    );
    scene.expect("LZ1904-outdated-source", &import);
    assert_eq!(read(scene.path(), "voices/shoe.lipz"), SHOE, "the clip stays");
    assert!(read(scene.path(), "voices/act1/mayor.lipz").contains("\"{louder} A "), "the other text is imported");
    scene.write("voices/act1/mayor.lipz", MAYOR);
    scene.write("de-de.po", po(&[("shoe", "Shoes, {name}!", "A, {name}"), ("shoe", "Shoes, {name}!", "B, {name}")]));
    scene.expect("LZ1905-text-conflict-twice", &import);
    // Rows of two tables, one of which does not have texts in the locale, do not conflict in any order.
    for rows in ["shoe,\nshoe,\"Schuhe, {name}!\"", "shoe,\"Schuhe, {name}!\"\nshoe,"] {
        scene.write("a.csv", format!("key,de-de\n{rows}\n"));
        let imported = lipz(scene.path(), ["import", "texts", "a.csv"]);
        assert!(imported.code == 0 && !imported.stderr.contains("LZ1905"), "{imported:?}");
    }
    scene.write("de-de.po", po(&[("shoe", "Shoes, {name}!", "Schuhe, {nmae}!")]));
    scene.expect("LZ1906-placeholder", &[&import[..], &["--deny", "placeholder"]].concat());
    assert_eq!(read(scene.path(), "voices/shoe.lipz"), SHOE, "a denied text is not imported");
    scene.write(
        "de-de.po",
        po(&[("shoe", "Shoes, {name}!", "Treter, {name}!")]).replace("\nmsgctxt", "\n#, fuzzy\nmsgctxt"),
    );
    scene.expect("LZ1907-unfinished-translation", &import);
    scene.write("a.csv", "key,en-us,de-de,Deutsch\nshoe,\"Shoes, {name}!\",\"Schuhe, {name}!\",x\n,,y,\n");
    scene.expect("LZ1908-exchange-loss", &["import", "texts", "a.csv", "--quiet"]);
    scene.write("a.csv", "key;en-us;de-de\nshoe;Shoes, {name}!;Treter, {name}!\n");
    scene.expect("LZ1909-text-replaced", &["import", "texts", "a.csv", "--quiet"]);
    scene.write("voices/shoe.lipz", SHOE);

    // Both change the same text.
    lipz(scene.path(), ["export", "texts", "po", "--locale", "de-de", "-o", "de-de.po", "--overwrite"]);
    scene.write("de-de.po", read(scene.path(), "de-de.po").replace("Schuhe", "Treter"));
    scene.write("voices/shoe.lipz", SHOE.replace("Schuhe", "Latschen"));
    scene.expect("LZ1905-text-conflict", &import);
    assert!(read(scene.path(), "voices/shoe.lipz").contains("Latschen"));
    let forced = lipz(scene.path(), ["import", "texts", "de-de.po", "--discard-edits"]);
    assert_eq!((forced.code, forced.stdout.as_str()), (0, "texts imported: 0 new, 1 changed, 1 unchanged\n"));
    assert!(read(scene.path(), "voices/shoe.lipz").contains("Treter"));
    scene.finish(11);
}

#[test]
fn slips_on_the_command_line() {
    let scene = project();
    fs::create_dir(scene.path().join("empty")).unwrap();
    let told = |arguments: &[&str]| {
        let outcome = lipz(scene.path(), arguments);
        (outcome.code, outcome.stderr)
    };
    for (arguments, expected) in [
        (&["export", "texts", "po", "-o", "x.lipz"][..], "is the name of a Lipz file"),
        (
            &["export", "texts", "po", "--locale", "de-de", "--locale", "fr-fr", "-o", "x.po"],
            "each locale needs its own",
        ),
        (&["export", "texts", "po", "--locale", "de-de", "--locale", "fr-fr", "-o", "-"], "several files cannot go"),
        (&["export", "texts", "po", "--no-config", "voices", "-o", "x.po"], "the source locale is not set"),
        (&["import", "texts", "x.docx"], "does not have the extension of a supported format"),
        (&["import", "texts", "x.po"], "`x.po` does not exist"),
        (&["import", "texts", "x.po", "-o", "nowhere"], "`nowhere` does not exist"),
        (&["export", "texts", "po", "--locale", "fr", "-o", "x.po"], "the locale `fr` does not have the form ll-cc"),
        (&["export", "texts", "po", "--from", "en", "-o", "x.po"], "the locale `en` does not have the form ll-cc"),
        (&["import", "texts", "x.po", "--locale", "fr"], "the locale `fr` does not have the form ll-cc"),
        (&["coverage", "--show", "missing", "--locale", "fr"], "the locale `fr` does not have the form ll-cc"),
        (&["export", "texts", "xliff", "--by", "segment", "-o", "x.xlf"], "`--by` has no effect on this format"),
        (&["export", "texts", "po", "--raw-cells", "-o", "x.po"], "`--raw-cells` has no effect on this format"),
        (&["export", "texts", "unity", "--raw-cells", "-o", "x.csv"], "`--raw-cells` has no effect on this format"),
        // Errors of the sources come before a missing locale that results from them.
        (&["export", "texts", "po", "nowhere", "-o", "x.po"], "`nowhere` does not exist"),
        (&["export", "texts", "po", "nowhere", "-o", "x.po", "--no-config"], "`nowhere` does not exist"),
        (&["export", "texts", "po", "empty", "-o", "x.po", "--no-config"], "no Lipz files in `empty`"),
        (&["import", "texts", "x.po", "-o", "nowhere", "--no-config"], "`nowhere` does not exist"),
        (&["import", "texts", "x.po", "-o", "empty", "--no-config"], "no Lipz files in `empty`"),
    ] {
        let (code, error) = told(arguments);
        assert!(code == 2 && error.contains(expected), "{arguments:?}: {error}");
        assert_eq!(error.matches("error[").count(), 1, "{arguments:?}: {error}");
    }
    scene.write("empty.csv", "");
    assert!(told(&["import", "texts", "empty.csv"]).1.contains("the file has no header"));
    assert!(told(&["import", "texts", "empty.csv", "-o", "voices/shoe.lipz"]).1.contains("LZ1901"));
    scene.write(
        "wide.csv",
        "\u{feff}key\tde-de\nshoe\tÄ {name}\n".encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<_>>(),
    );
    let (code, error) = told(&["import", "texts", "wide.csv"]);
    assert!(code == 0 && error.contains("LZ1909"), "{error}");
    assert!(read(scene.path(), "voices/shoe.lipz").contains("\"Ä {name}\""));
}

/// Tools repeat entries. The texts of the project are counted, not the entries.
#[test]
fn a_text_that_is_replaced_by_equal_entries_is_counted_once() {
    let scene = project();
    let entry = ("shoe", "Shoes, {name}!", "Treter, {name}!");
    scene.write("de-de.po", po(&[entry; 300]));
    let import = lipz(scene.path(), ["import", "texts", "de-de.po"]);
    assert!(
        import.stderr.contains("LZ1909") && import.stderr.contains(": 1 text of the project was replaced"),
        "{import:?}"
    );
    assert!(read(scene.path(), "voices/shoe.lipz").contains("Treter"));
}

/// Source texts are edited in Lipz files. An edit of one in an exchange file is reported because it has no effect.
#[test]
fn source_texts_of_a_file_are_not_imported() {
    let scene = project();
    let folder = scene.path();
    lipz(folder, ["export", "texts", "csv", "--locale", "de-de", "-o", "a.csv"]);
    let table = read(folder, "a.csv");
    scene.write("a.csv", table.replace("\"Shoes, {name}!\"", "\"Boots, {name}!\""));
    let import = lipz(folder, ["import", "texts", "a.csv"]);
    assert!(
        import.code == 0 && import.stderr.contains("warning[LZ1908]: 1 source text of the file differs"),
        "{import:?}"
    );
    assert!(import.stderr.contains("Boots") && import.stderr.contains("a.csv:3:"), "{import:?}");
    scene.write("en.po", po(&[("shoe", "Shoes, {name}!", "Boots, {name}!")]).replace("de_DE", "en_US"));
    let import = lipz(folder, ["import", "texts", "en.po"]);
    assert!(import.stderr.contains("texts in en-us are not imported because it is the source locale"), "{import:?}");
    assert_eq!(voices(folder), [MAYOR, SHOE]);
}

#[test]
fn a_clip_that_does_not_fit_is_left_out_of_an_export() {
    let scene = project();
    scene.write("voices/shoe.lipz", SHOE.replace("Schuhe", "Schuhe|"));
    let export = lipz(scene.path(), ["export", "texts", "po", "-o", "de.po"]);
    assert_eq!(export.code, 0, "{export:?}");
    assert!(export.stderr.contains("warning[LZ1903]: the text in de-de has 2 segments"), "{export:?}");
    assert!(read(scene.path(), "de.po").contains("msgctxt \"shoe\"\nmsgid \"Shoes, {name}!\"\nmsgstr \"\"\n"));
}

/// A template does not have a locale, and translators may choose any name. `lipz check` does not accept all of them.
#[test]
fn a_language_that_the_project_does_not_accept_is_not_imported() {
    let scene = project();
    let french = po(&[("shoe", "Shoes, {name}!", "Chaussures, {name} !")]).replace("de_DE", "fr");
    scene.write("fr.po", &french);
    let refused = lipz(scene.path(), ["import", "texts", "fr.po"]);
    assert!(
        refused.code == 1 && refused.stderr.contains("the language `fr` is not a locale of the project"),
        "{refused:?}"
    );
    scene.write("a.csv", "key,en-us,fr,de-de\nshoe,\"Shoes, {name}!\",\"Chaussures, {name} !\",\"Treter, {name}\"\n");
    let left_out = lipz(scene.path(), ["import", "texts", "a.csv"]);
    assert!(left_out.code == 0 && left_out.stderr.contains("a.csv:1:11"), "{left_out:?}");
    assert!(left_out.stderr.contains("the column `fr` is not imported"), "{left_out:?}");
    let shoe = read(scene.path(), "voices/shoe.lipz");
    assert!(!shoe.contains("text_fr") && shoe.contains("Treter"), "{shoe}");
    let named = lipz(scene.path(), ["import", "texts", "fr.po", "--locale", "fr-fr"]);
    assert_eq!((named.code, named.stderr.as_str()), (0, ""));
    assert!(read(scene.path(), "voices/shoe.lipz").contains("text_fr-fr"));
    scene.write("lipz.toml", read(scene.path(), "lipz.toml") + "extended-locales = true\n");
    assert_eq!(lipz(scene.path(), ["import", "texts", "fr.po"]).code, 0);
}

#[test]
fn the_drama_goes_out_and_comes_back() {
    let repository = repository();
    let scene = Scene::new();
    for (format, name) in [
        ("po", "de-de.po"),
        ("xliff", "a.xlf"),
        ("xliff-1.2", "b.xlf"),
        ("csv", "texts.csv"),
        ("xlsx", "c.xlsx"),
        ("json", "d.json"),
    ] {
        let output = scene.path().join(name);
        let output = output.to_str().unwrap();
        let settings = ["--config", "default-locale=en-us", "fixtures/drama", "--locale", "de-de", "-o", output];
        let export = lipz(&repository, ["export", "texts", format].into_iter().chain(settings));
        assert_eq!(export.code, 0, "{}", export.stderr);
        let import = ["import", "texts", output, "-o", "fixtures/drama", "--from", "en-us", "--check"];
        let import = lipz(&repository, import);
        assert_eq!(import.code, 0, "{}", import.stderr);
        assert!(import.stdout.starts_with("texts that would be imported: 0 new, 4"), "{}", import.stdout);
        assert!(import.stdout.ends_with(" unchanged\n"), "{}", import.stdout);
    }
}

#[test]
fn json_is_as_its_schema_says() {
    let json = |path: &str| serde_json::from_str(&read(&repository(), path)).unwrap();
    let schema = jsonschema::validator_for(&json("docs/lipz-texts.schema.json")).unwrap();
    let mut file: serde_json::Value = json("fixtures/texts/all.json");
    assert!(schema.is_valid(&file));
    file["clips"][0]["segments"][0]["translations"]["de-de"]["state"] = "done".into();
    assert!(!schema.is_valid(&file));
}
