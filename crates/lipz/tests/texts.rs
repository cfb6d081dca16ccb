//! `lipz texts`: to translators and back, and what does not fit.
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

/// A project of two clips, one of which is translated.
fn project() -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n");
    scene.write("voices/act1/mayor.lipz", MAYOR);
    scene.write("voices/shoe.lipz", SHOE);
    scene
}

/// A PO file of German translations: the texts of `mayor` and `shoe`, with their sources.
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

/// The paths below `voices`, with what is in them.
fn voices(folder: &Path) -> [String; 2] {
    ["voices/act1/mayor.lipz", "voices/shoe.lipz"].map(|name| read(folder, name))
}

#[test]
fn a_week_of_a_localiser() {
    let scene = project();
    let folder = scene.path();
    let export = lipz(folder, ["texts", "export", "po", "--locale", "de-de", "-o", "de-de.po"]);
    assert_eq!((export.code, export.stderr.as_str()), (0, ""));
    assert_eq!(export.stdout, "texts of 2 clips for de-de written into de-de.po\n");
    let again = lipz(folder, ["texts", "export", "po", "--locale", "de-de", "-o", "de-de.po"]);
    assert!(again.code == 1 && again.stderr.contains("[LZ0906]"), "{}", again.stderr);

    let same = lipz(folder, ["texts", "import", "de-de.po"]);
    let summary = "texts imported: 0 new, 2 unchanged\nlipz-texts.txt is new: ";
    assert!(same.code == 0 && same.stdout.starts_with(summary), "{same:?}");
    assert_eq!(voices(folder), [MAYOR, SHOE]);

    // The translator works; the Lipz file of another clip is edited meanwhile.
    let translated = read(folder, "de-de.po").replace(
        "msgid \"{louder} Mayor? | Mayor!\"\nmsgstr \"\"",
        "msgid \"{louder} Mayor? | Mayor!\"\nmsgstr \"{louder} Herr Bürgermeister? | Bürgermeister!\"",
    );
    scene.write("de-de.po", &translated);
    scene.write("voices/shoe.lipz", SHOE.replace("Schuhe", "Treter"));
    let check = lipz(folder, ["texts", "import", "de-de.po", "--check"]);
    let expected = "texts that would be imported: 1 new, 1 newer in the project, which stays\n";
    assert_eq!((check.code, check.stdout.as_str()), (0, expected), "{}", check.stderr);
    assert_eq!(read(folder, "voices/act1/mayor.lipz"), MAYOR);
    let import = lipz(folder, ["texts", "import", "de-de.po"]);
    assert_eq!(import.stdout, "texts imported: 1 new, 1 newer in the project, which stays\n");
    let [mayor, shoe] = voices(folder);
    assert!(mayor.contains("  \"text_de-de\" : \"{louder} Herr Bürgermeister?|Bürgermeister!\",\n"), "{mayor}");
    assert_eq!(shoe, SHOE.replace("Schuhe", "Treter"));
    assert_eq!(lipz(folder, ["fmt", "--check", "voices/act1"]).code, 0, "it was in its canonical layout");
    let all = lipz(folder, ["check"]);
    assert!(!all.stderr.contains("LZ06"), "{}", all.stderr);
}

#[test]
fn every_shape_of_a_csv_comes_back() {
    for shape in ["sheet", "unity", "godot", "unreal", "yarn"] {
        let scene = project();
        let folder = scene.path();
        let arguments = ["texts", "export", "csv", "--locale", "de-de", "--shape", shape, "--by", "segment", "-o", "."];
        let export = lipz(folder, arguments);
        assert_eq!(export.code, 0, "{shape}: {}", export.stderr);
        let name = if shape == "yarn" { "de-de.csv" } else { "texts.csv" };
        let table = read(folder, name).replace("Schuhe", "Treter");
        // Excel of a German system, as it saves tables.
        scene.write(name, format!("\u{feff}{table}"));
        let import = lipz(folder, ["texts", "import", name]);
        assert_eq!((import.code, import.stderr.as_str()), (0, ""), "{shape}");
        assert_eq!(voices(folder), [MAYOR.to_owned(), SHOE.replace("Schuhe", "Treter")], "{shape}");
    }
}

#[test]
fn what_does_not_fit() {
    let mut scene = project();
    let import = ["texts", "import", "de-de.po", "--quiet"];
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
    assert!(read(scene.path(), "voices/act1/mayor.lipz").contains("\"{louder} A "), "the other is imported");
    scene.write("voices/act1/mayor.lipz", MAYOR);
    scene.write("de-de.po", po(&[("shoe", "Shoes, {name}!", "A, {name}"), ("shoe", "Shoes, {name}!", "B, {name}")]));
    scene.expect("LZ1905-text-conflict-twice", &import);
    // Rows of two tables, one of which has no texts in the locale, are no conflict, in whatever order.
    for rows in ["shoe,\nshoe,\"Schuhe, {name}!\"", "shoe,\"Schuhe, {name}!\"\nshoe,"] {
        scene.write("a.csv", format!("key,de-de\n{rows}\n"));
        let imported = lipz(scene.path(), ["texts", "import", "a.csv"]);
        assert!(imported.code == 0 && !imported.stderr.contains("LZ1905"), "{imported:?}");
    }
    scene.write("de-de.po", po(&[("shoe", "Shoes, {name}!", "Schuhe, {nmae}!")]));
    scene.expect("LZ1906-placeholder", &[&import[..], &["--deny", "placeholder"]].concat());
    assert_eq!(read(scene.path(), "voices/shoe.lipz"), SHOE, "what is denied is not imported");
    scene.write(
        "de-de.po",
        po(&[("shoe", "Shoes, {name}!", "Treter, {name}!")]).replace("\nmsgctxt", "\n#, fuzzy\nmsgctxt"),
    );
    scene.expect("LZ1907-unfinished-translation", &import);
    scene.write("a.csv", "key,en-us,de-de,Deutsch\nshoe,\"Shoes, {name}!\",\"Schuhe, {name}!\",x\n,,y,\n");
    scene.expect("LZ1908-exchange-loss", &["texts", "import", "a.csv", "--quiet"]);
    scene.write("a.csv", "key;en-us;de-de\nshoe;Shoes, {name}!;Treter, {name}!\n");
    scene.expect("LZ1909-text-replaced", &["texts", "import", "a.csv", "--quiet"]);
    scene.write("voices/shoe.lipz", SHOE);

    // Both change the same text.
    lipz(scene.path(), ["texts", "export", "po", "--locale", "de-de", "-o", "de-de.po", "--force"]);
    scene.write("de-de.po", read(scene.path(), "de-de.po").replace("Schuhe", "Treter"));
    scene.write("voices/shoe.lipz", SHOE.replace("Schuhe", "Latschen"));
    scene.expect("LZ1905-text-conflict", &import);
    assert!(read(scene.path(), "voices/shoe.lipz").contains("Latschen"));
    let forced = lipz(scene.path(), ["texts", "import", "de-de.po", "--force"]);
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
        (&["texts", "export", "po", "-o", "x.lipz"][..], "is the name of a Lipz file"),
        (&["texts", "export", "po", "--locale", "de-de", "--locale", "fr-fr", "-o", "x.po"], "each locale has its own"),
        (&["texts", "export", "po", "--locale", "de-de", "--locale", "fr-fr", "-o", "-"], "several files cannot go"),
        (
            &["texts", "export", "po", "--no-config", "voices", "-o", "x.po"],
            "the locale that is translated is not known",
        ),
        (&["texts", "import", "x.docx"], "names no format"),
        (&["texts", "import", "x.po"], "`x.po` does not exist"),
        (&["texts", "import", "x.po", "-o", "nowhere"], "`nowhere` does not exist"),
        (&["texts", "export", "po", "--locale", "fr", "-o", "x.po"], "the locale `fr` does not have the form ll-cc"),
        (&["texts", "export", "po", "--from", "en", "-o", "x.po"], "the locale `en` does not have the form ll-cc"),
        (&["texts", "import", "x.po", "--locale", "fr"], "the locale `fr` does not have the form ll-cc"),
        (&["coverage", "--missing", "fr"], "the locale `fr` does not have the form ll-cc"),
        (&["texts", "export", "xliff", "--by", "segment", "-o", "x.xlf"], "`--by` changes nothing here"),
        (&["texts", "export", "po", "--shape", "unity", "-o", "x.po"], "`--shape` changes nothing here"),
        (&["texts", "export", "po", "--raw-cells", "-o", "x.po"], "`--raw-cells` changes nothing here"),
        // What is wrong with the sources comes before a locale that is missing because of it.
        (&["texts", "export", "po", "nowhere", "-o", "x.po"], "`nowhere` does not exist"),
        (&["texts", "export", "po", "nowhere", "-o", "x.po", "--no-config"], "`nowhere` does not exist"),
        (&["texts", "export", "po", "empty", "-o", "x.po", "--no-config"], "no Lipz files in `empty`"),
        (&["texts", "import", "x.po", "-o", "nowhere", "--no-config"], "`nowhere` does not exist"),
        (&["texts", "import", "x.po", "-o", "empty", "--no-config"], "no Lipz files in `empty`"),
    ] {
        let (code, error) = told(arguments);
        assert!(code == 2 && error.contains(expected), "{arguments:?}: {error}");
        assert_eq!(error.matches("error[").count(), 1, "{arguments:?}: {error}");
    }
    scene.write("empty.csv", "");
    assert!(told(&["texts", "import", "empty.csv"]).1.contains("the file has no header"));
    assert!(told(&["texts", "import", "empty.csv", "-o", "voices/shoe.lipz"]).1.contains("LZ1901"));
    scene.write(
        "wide.csv",
        "\u{feff}key\tde-de\nshoe\tÄ {name}\n".encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<_>>(),
    );
    let (code, error) = told(&["texts", "import", "wide.csv"]);
    assert!(code == 0 && error.contains("LZ1909"), "{error}");
    assert!(read(scene.path(), "voices/shoe.lipz").contains("\"Ä {name}\""));
}

/// Source texts are edited in Lipz files: who edits them in a file of exchange has to know that nothing comes of it.
#[test]
fn source_texts_of_a_file_are_not_imported() {
    let scene = project();
    let folder = scene.path();
    lipz(folder, ["texts", "export", "csv", "--locale", "de-de", "-o", "a.csv"]);
    let table = read(folder, "a.csv");
    scene.write("a.csv", table.replace("\"Shoes, {name}!\"", "\"Boots, {name}!\""));
    let import = lipz(folder, ["texts", "import", "a.csv"]);
    assert!(
        import.code == 0 && import.stderr.contains("warning[LZ1908]: 1 source text of the file is another one"),
        "{import:?}"
    );
    assert!(import.stderr.contains("Boots") && import.stderr.contains("a.csv:3:"), "{import:?}");
    scene.write("en.po", po(&[("shoe", "Shoes, {name}!", "Boots, {name}!")]).replace("de_DE", "en_US"));
    let import = lipz(folder, ["texts", "import", "en.po"]);
    assert!(import.stderr.contains("texts in en-us are translated, and not imported"), "{import:?}");
    assert_eq!(voices(folder), [MAYOR, SHOE]);
}

#[test]
fn a_clip_that_does_not_fit_is_left_out_of_an_export() {
    let scene = project();
    scene.write("voices/shoe.lipz", SHOE.replace("Schuhe", "Schuhe|"));
    let export = lipz(scene.path(), ["texts", "export", "po", "-o", "de.po"]);
    assert_eq!(export.code, 0, "{export:?}");
    assert!(export.stderr.contains("warning[LZ1903]: the text of de-de has 2 segments"), "{export:?}");
    assert!(read(scene.path(), "de.po").contains("msgctxt \"shoe\"\nmsgid \"Shoes, {name}!\"\nmsgstr \"\"\n"));
}

/// A template has no locale, and its translators may call theirs as they like; `lipz check` does not.
#[test]
fn a_language_that_the_project_does_not_accept_is_not_imported() {
    let scene = project();
    let french = po(&[("shoe", "Shoes, {name}!", "Chaussures, {name} !")]).replace("de_DE", "fr");
    scene.write("fr.po", &french);
    let refused = lipz(scene.path(), ["texts", "import", "fr.po"]);
    assert!(
        refused.code == 1 && refused.stderr.contains("the language `fr` is no locale of the project"),
        "{refused:?}"
    );
    scene.write("a.csv", "key,en-us,fr,de-de\nshoe,\"Shoes, {name}!\",\"Chaussures, {name} !\",\"Treter, {name}\"\n");
    let left_out = lipz(scene.path(), ["texts", "import", "a.csv"]);
    assert!(left_out.code == 0 && left_out.stderr.contains("a.csv:1:11"), "{left_out:?}");
    assert!(left_out.stderr.contains("the column `fr` is not imported"), "{left_out:?}");
    let shoe = read(scene.path(), "voices/shoe.lipz");
    assert!(!shoe.contains("text_fr") && shoe.contains("Treter"), "{shoe}");
    let named = lipz(scene.path(), ["texts", "import", "fr.po", "--locale", "fr-fr"]);
    assert_eq!((named.code, named.stderr.as_str()), (0, ""));
    assert!(read(scene.path(), "voices/shoe.lipz").contains("text_fr-fr"));
    scene.write("lipz.toml", read(scene.path(), "lipz.toml") + "extended-locales = true\n");
    assert_eq!(lipz(scene.path(), ["texts", "import", "fr.po"]).code, 0);
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
        let settings = ["--default-locale", "en-us", "fixtures/drama", "--locale", "de-de", "-o", output];
        let export = lipz(&repository, ["texts", "export", format].into_iter().chain(settings));
        assert_eq!(export.code, 0, "{}", export.stderr);
        let import = ["texts", "import", output, "-o", "fixtures/drama", "--from", "en-us", "--check"];
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
