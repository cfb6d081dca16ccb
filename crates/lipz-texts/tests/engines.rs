//! String tables of engines, as the engines read them.
#![allow(clippy::unwrap_used, reason = "tests")]

mod engine_readers;

use engine_readers::{godot, unity, unreal, unreal_po, yarn};
use lipz_texts::{Collect, Exchange, Format, ReadOptions, Shape, State, WriteOptions, read, write};

/// Files in the form that users of the engines have.
#[test]
fn the_readers_read_the_files_of_their_engines() {
    let table = "Key,Id,Shared Comments,English(en),German (Germany)(de-DE)\nhi,7,,Hi.,Hallo.\n";
    assert_eq!(unity(table, "German (Germany)", "de-DE")["hi"], "Hallo.");
    assert_eq!(unity(table, "German", "de")["hi"], "", "there is no such column");
    let table = "language,id,text,file,node,lineNumber,lock,comment\n\
        de-DE,line:tom-01,Komm schnell.,Town.yarn,Start,3,801a2d12,\n";
    assert_eq!(yarn(table, &[("line:tom-01", "Come, quickly.")])["line:tom-01"], "Komm schnell.");
    assert!(yarn(table, &[("line:tom-01", "Come.")])["line:tom-01"].starts_with("(NEEDS UPDATE)"));
    let table = "keys,en,_notes,de\nDISK,\"Line\\nbreak\",x,\"C:\\\\x \\\"\"y\\\"\"\"\n";
    assert_eq!(
        (godot(table, "de")["DISK"].as_str(), godot(table, "en")["DISK"].as_str()),
        ("C:\\x \"y\"", "Line\nbreak")
    );
    let table = "Key,SourceString,Comment\nDISK,\"A \\\"\"disk\\\"\"\\nin C:\\\\x\",\n";
    assert_eq!(unreal(table)["DISK"], "A \"disk\"\nin C:\\x");
    let file = "msgid \"\"\nmsgstr \"\"\n\"Language: de\\n\"\n\n#. Key:\tGreet,1\n#. SourceLocation:\t/Game/Dialogue\n\
        #: /Game/Dialogue\nmsgctxt \"Town,Greet\\\\,1\"\nmsgid \"Hi.\\r\\nYou\"\nmsgstr \"Hallo.\\r\\nDu\"\n";
    let game = [("Town", "Greet,1", "Hi.\r\nYou")];
    assert_eq!(unreal_po(file, &game)["Town,Greet,1"], "Hallo.\r\nDu");
    assert_eq!(unreal_po(file, &[("Town", "Greet,1", "Hi.")]).len(), 0, "the text of the game is different");
}

/// The dialogue script of a language, as `ExportDialogueScriptCommandlet.cpp` of Unreal Engine 4.18 writes it.
#[test]
fn dialogue_scripts_of_unreal_are_translations_of_recordings() {
    let script = "\u{feff}\"SpeakingVoice\",\"TargetVoices\",\"SpokenDialogue\",\"VoiceActorDirection\",\
        \"AudioFileName\",\"DialogueAsset\",\"IsRecorded\",\"LocalizationKeys\",\"SpeakingVoiceGUID\",\
        \"TargetVoiceGUIDs\",\"DialogueAssetGUID\"\n\
        \"Mara\",\"(\"\"Otto\"\")\",\"'Wer da?' C:\\neu\",\"\",\"Mara_Gate_0.wav\",\
        \"/Game/Mara_Gate.Mara_Gate\",\"True\",\"(\"\"A058_C174\"\")\",\"3A5B\",\"(\"\"77C1\"\")\",\"A058\"\n";
    let read_as = |options: ReadOptions| read(Format::Csv, script.as_bytes(), &options);
    let german = read_as(ReadOptions::new("en-us").known(["de-de", "fr-fr"]).wanted(["de-de"]));
    assert_eq!(german.diagnostics, []);
    let entries: Vec<_> = german
        .entries
        .iter()
        .map(|entry| (entry.key.text.as_str(), &*entry.locale, entry.text.text.as_str()))
        .collect();
    assert_eq!(entries, [("Mara_Gate_0", "de-de", "'Wer da?' C:\\neu")]);
    let unknown = read_as(ReadOptions::new("en-us").known(["de-de", "fr-fr"]));
    let mut help = unknown.diagnostics.iter().filter_map(|found| found.help.as_deref());
    assert!(help.any(|help| help.starts_with("name the locale of the column `SpokenDialogue`")), "{unknown:?}");
}

const TEXT: &str = "- Quoth \"he\", 'C:\\x'.";
const GERMAN: &str = "- Ja, =x, 'C:\\x', \"so\".";

/// Returns the table of a clip in an engine's shape, and the messages about it.
fn table(shape: Shape, source: &str, german: &str) -> (String, Vec<String>) {
    let clip = serde_json::json!({ "visemes": "MA", "text_en-us": source, "text_de-de": german }).to_string();
    let document = lipz_file::parse(clip.as_bytes()).document.unwrap();
    let units = Collect::new("en-us", ["de-de"]).unit("act1/otto", &document, &mut Vec::new());
    let exchange =
        Exchange { source_locale: "en-us".into(), locales: vec!["de-de".into()], units: units.into_iter().collect() };
    let written = write(Format::Csv, &exchange, &WriteOptions::new().shape(shape));
    let messages = written.diagnostics.iter().map(|diagnostic| diagnostic.message.clone()).collect();
    (String::from_utf8(written.files[0].bytes.clone()).unwrap(), messages)
}

#[test]
fn engines_show_the_texts_of_the_project() {
    let unity_table = table(Shape::Unity, TEXT, GERMAN).0;
    assert_eq!(unity(&unity_table, "German (Germany)", "de-DE")["act1/otto"], GERMAN);
    assert_eq!(unity(&unity_table, "English (United States)", "en-US")["act1/otto"], TEXT);
    let yarn_table = table(Shape::Yarn, TEXT, GERMAN).0;
    assert_eq!(yarn(&yarn_table, &[("line:act1/otto", TEXT)])["line:act1/otto"], GERMAN);
    let godot_table = table(Shape::Godot, TEXT, GERMAN).0;
    assert_eq!(godot(&godot_table, "de_DE")["act1/otto"], GERMAN);
    assert_eq!(unreal(&table(Shape::Unreal, TEXT, GERMAN).0)["act1/otto"], TEXT);
    // Both engines replace this escape also behind a backslash.
    for shape in [Shape::Godot, Shape::Unreal] {
        let messages = table(shape, "C:\\new", "").1;
        assert_eq!(messages, ["a text of `act1/otto` has \\n, which the engine reads as a different character"]);
    }
}

#[test]
fn unreal_imports_translations_from_po() {
    let clip = serde_json::json!({ "visemes": "MA", "text_en-us": TEXT, "text_de-de": GERMAN }).to_string();
    let document = lipz_file::parse(clip.as_bytes()).document.unwrap();
    let mut unit = Collect::new("en-us", ["de-de"]).unit("act1/otto, twice", &document, &mut Vec::new()).unwrap();
    unit.file = Some("voices/act1/otto, twice.lipz".into());
    let exchange = Exchange { source_locale: "en-us".into(), locales: vec!["de-de".into()], units: vec![unit] };
    let options = WriteOptions::new().namespace(Some("Town, old".into()));
    let written = write(Format::Po, &exchange, &options);
    let file = String::from_utf8(written.files[0].bytes.clone()).unwrap();
    assert_eq!(unreal_po(&file, &[("Town, old", "act1/otto, twice", TEXT)])["Town, old,act1/otto, twice"], GERMAN);
    let mut entries = read(Format::Po, file.as_bytes(), &ReadOptions::new("en-us")).entries;
    lipz_texts::resolve_keys(&mut entries, &["act1/otto, twice"].into());
    assert_eq!((entries[0].key.text.as_str(), entries[0].text.text.as_str()), ("act1/otto, twice", GERMAN));
}

#[test]
fn tables_of_engines_come_back_unchanged() {
    for shape in Shape::ALL {
        let text = "C:\\new\n'- x";
        let file = table(shape, TEXT, text).0;
        let incoming = read(Format::Csv, file.as_bytes(), &ReadOptions::new("en-us"));
        let [entry] = incoming.entries.as_slice() else { unreachable!("{shape:?}: {:?}", incoming.diagnostics) };
        assert_eq!((entry.key.text.as_str(), entry.text.text.as_str()), ("act1/otto", text), "{shape:?}");
    }
}

#[test]
fn tables_of_other_tools_are_read() {
    let read = |table: &str| read(Format::Csv, table.as_bytes(), &ReadOptions::new("en-us").wanted(["de-de"]));
    // Yarn Spinner puts a note before translations of older texts.
    let yarn = "language,id,text,file,node,lineNumber,lock,comment\nde-DE,line:otto,(NEEDS UPDATE) Ja.,,,,801a2d12,\n";
    let incoming = read(yarn);
    let entry = &incoming.entries[0];
    assert_eq!((entry.key.text.as_str(), entry.text.text.as_str(), entry.state), ("otto", "Ja.", State::Initial));
    // Weblate and the Translate Toolkit, of a PO file.
    let weblate = "\"location\",\"source\",\"target\",\"id\",\"fuzzy\",\"context\",\"translator_comments\",\"developer_comments\"\n\
        \"a.lipz\",\"Hi.\",\"Hallo.\",\"\",\"True\",\"otto\",\"\",\"\"\n";
    for (table, state) in [(weblate, State::Initial), ("context,source,target\notto,Hi.,Hallo.\n", State::Translated)] {
        let incoming = read(table);
        assert_eq!(incoming.diagnostics, []);
        let entry = &incoming.entries[0];
        assert_eq!((entry.key.text.as_str(), entry.text.text.as_str(), entry.state), ("otto", "Hallo.", state));
        assert_eq!(entry.source.as_ref().unwrap().text, "Hi.");
    }
    let nameless = lipz_texts::read(Format::Csv, weblate.as_bytes(), &ReadOptions::new("en-us"));
    let found = nameless.diagnostics.iter().find(|found| found.message == "no column has translations").unwrap();
    assert!(found.help.iter().any(|help| help.contains("`target` with `--locale`")), "{found:?}");
}

/// Apostrophes of a spreadsheet are removed, although a column of the team looks like one of Unity.
#[test]
fn a_column_in_parentheses_makes_no_table_of_unity() {
    let table = "key,Notes (draft),de-de\na,,'- Was?\n";
    let incoming = read(Format::Csv, table.as_bytes(), &ReadOptions::new("en-us"));
    assert_eq!(incoming.entries[0].text.text, "- Was?");
    let unity = "Key,English(en-us),German(de-de)\na,,'- Was?\n";
    let incoming = read(Format::Csv, unity.as_bytes(), &ReadOptions::new("en-us"));
    assert_eq!(incoming.entries[0].text.text, "'- Was?");
}
