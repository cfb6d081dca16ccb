//! Tests of scripts and the names of their recordings.

use super::*;

#[test]
fn texts_are_found_by_the_names_of_recordings() {
    let csv =
        "Speaker,File,Text\r\nElder,speech\\ELD_1.WAV,\"Greetings, Chosen.\"\r\nElder,eld_2,\"A \"\"word\"\".\"\r\n";
    let (script, _, found) = Script::read("script.csv", csv.as_bytes(), None);
    assert_eq!(found, []);
    assert_eq!(script.text_of("eld_1"), Some("Greetings, Chosen."));
    assert_eq!(script.text_of("Eld_2"), Some("A \"word\"."));
    assert_eq!(script.text_of("eld_3"), None);
    let (script, _, _) = Script::read("a.csv", "file,text\nM\u{e4}ry,One.\nO\u{308}L,Two.\n".as_bytes(), None);
    assert_eq!(script.text_of("ma\u{308}ry"), Some("One."), "decomposed");
    assert_eq!(script.text_of("\u{d6}l"), Some("Two."), "composed");
    let (script, _, _) = Script::read("ELDER.MSG", b"{100}{eld_1}{Greetings.}", None);
    assert_eq!(script.text_of("ELD_1"), Some("Greetings."));
}

#[test]
fn encodings_of_the_time() {
    let french = b"{1}{eld_1}{D\xE9j\xE0 vu.}";
    assert_eq!(Script::read("a.msg", french, None).0.text_of("eld_1"), Some("Déjà vu."));
    let russian = b"{1}{eld_1}{\xC4\xE0.}";
    let windows_1251 = Encoding::for_label(b"windows-1251");
    assert_eq!(Script::read("a.msg", russian, windows_1251).0.text_of("eld_1"), Some("Да."));
    let (script, _, found) = Script::read("a.msg", "{1}{eld_1}{Да.}".as_bytes(), windows_1251);
    assert_eq!((script.text_of("eld_1"), found.len()), (Some("Да."), 1), "it is UTF-8");
    let utf8 = "\u{feff}{1}{eld_1}{Да.}";
    assert_eq!(Script::read("a.msg", utf8.as_bytes(), None).0.text_of("eld_1"), Some("Да."));
}

#[test]
fn folders_tell_recordings_of_one_name_apart() {
    let csv = "file,text\nact1/mayor.wav,One.\nact2\\mayor,Two.\nmara,Three.\nact1/mara,Four.\n";
    let (script, _, found) = Script::read("script.csv", csv.as_bytes(), None);
    assert_eq!((found, script.len()), (Vec::new(), 4));
    let texts = ["act1/mayor", "rec/Act2/mayor", "mayor", "act3/mayor", "act2/mara", "act1/mara", "contract1/mara"];
    let texts = texts.map(|path| script.text_of(path).unwrap_or_default());
    assert_eq!(texts, ["One.", "Two.", "", "", "Three.", "Four.", "Three."]);
    assert_eq!(
        script.names_without(
            [("rec/act1/mayor.wav", "mayor"), ("x/mara.wav", "mara")].map(|(file, name)| (Path::new(file), name))
        ),
        ["act1/mara", "act2/mayor"]
    );
}

#[test]
fn other_files_are_not_read_as_tables() {
    let (_, _, found) = Script::read_lines("lines.xlsx", b"PK\x03\x04\x14\x00id,text", None);
    assert!(found.iter().any(|found| found.message == "the script is a spreadsheet or an archive"), "{found:?}");
    let (script, _, found) = Script::read_lines("ELDER.MSG", b"{100}{Eld_1}{Greetings.}{101}{}{Silent.}", None);
    assert_eq!((script.lines()[0].path, script.len(), found), ("Eld_1", 1, Vec::new()));
    let (_, _, found) = Script::read_lines("a.msg", b"{100}{}{Greetings.}", None);
    assert_eq!(found[0].message, "no entry of the script has a sound");
}

#[test]
fn paths_of_lines_are_compared_without_case() {
    let (script, _, _) = Script::read_lines("a.csv", "id,text\nAct1\\Mäyor,One.\n".as_bytes(), None);
    let line = script.line_of("act1/ma\u{308}yor").unwrap();
    assert_eq!(line.path, "Act1\\Mäyor");
    assert!(line.has_path("ACT1/mäyor") && !line.has_path("mäyor"));
}
