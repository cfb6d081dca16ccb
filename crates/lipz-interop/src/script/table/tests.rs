//! Tests of scripts in tables.

use super::super::Script;

#[test]
fn a_csv_without_the_columns_is_no_script() {
    for text in ["", "a,b\n1,2\n", "file\nx\n"] {
        assert_eq!(Script::read("a.csv", text.as_bytes(), None).2.len(), 1, "{text}");
    }
    assert_eq!(Script::read("a.csv", b"file,text\nonly-file\n", None).2.len(), 1);
    let twice = b"file,text\na.wav,One.\na.ogg,One.\nA.mp3,Two.\n";
    let (script, _, found) = Script::read("a.csv", twice, None);
    assert_eq!((script.text_of("a"), found.len()), (Some("One."), 1));
}

#[test]
fn columns_may_be_divided_as_spreadsheets_do_it() {
    for csv in ["file;text\na;Well, yes.\n", "text\tFILE\nWell, yes.\ta\n"] {
        let (script, _, found) = Script::read("a.csv", csv.as_bytes(), None);
        assert_eq!((found, script.text_of("a")), (Vec::new(), Some("Well, yes.")));
    }
}

#[test]
fn rows_that_say_nothing_are_marked() {
    let csv = "file,text\r\na,One.\r\n,Two.\r\nb\r\n";
    let (_, source, found) = Script::read("a.csv", csv.as_bytes(), None);
    let marked = found.iter().map(|found| {
        let span = found.primary.as_ref().unwrap().span;
        (found.message.as_str(), &source.text[span.start as usize..span.end as usize])
    });
    let expected = [("the row has no file name", ",Two."), ("the row has no text", "b")];
    assert_eq!(marked.collect::<Vec<_>>(), expected);
    let (_, _, found) = Script::read("a.csv", b"file,words\na,One.\n", None);
    assert_eq!(found[0].message, "the first line has no column `text`");
}

/// The ID and the text of each line.
type Lines = Vec<(String, String)>;

/// Returns the lines of a table, and its problems with their lines and columns.
fn lines(table: &str) -> (Lines, Vec<(String, usize, usize)>) {
    let (script, source, found) = Script::read_lines("a.csv", table.as_bytes(), None);
    let lines = script.lines().iter().map(|line| (line.path.to_owned(), line.text.to_owned())).collect();
    let problem = |found: &lipz_diagnostics::Diagnostic| {
        let before = &source.text[..found.start() as usize];
        let column = before.rsplit('\n').next().unwrap().len() + 1;
        (found.message.clone(), before.matches('\n').count() + 1, column)
    };
    (lines, found.iter().map(problem).collect())
}

fn owned(lines: &[(&str, &str)]) -> Lines {
    lines.iter().map(|(id, text)| ((*id).to_owned(), (*text).to_owned())).collect()
}

#[test]
fn ids_have_priority_and_are_shown_as_written() {
    let table = "file,id,text\nscene1.rpy,Mara.Hello,Hello.\nscene1.rpy,Otto_Yes,Yes.\n,,\n";
    assert_eq!(lines(table), (owned(&[("Mara.Hello", "Hello."), ("Otto_Yes", "Yes.")]), vec![]));
    let yarn = "language,id,text,file,node,lineNumber\nen,line:0a1B,Hello.,a.yarn,Start,1\n";
    assert_eq!(lines(yarn).0, owned(&[("0a1B", "Hello.")]));
    let (_, _, found) = Script::read_lines("a.csv", b"id,text\n,Hello.\n", None);
    assert_eq!(found[0].message, "the row has no ID");
    assert_eq!(lines("File,Text\nAct1\\Mara.WAV,Hello.\n").0, owned(&[("Act1\\Mara", "Hello.")]));
}

/// The recording sheets of Yarn Spinner's extension for Visual Studio Code (`StringExtractor.cs` of its language
/// server, version 3): columns that the project chooses, and an empty row after each block of lines.
#[test]
fn recording_sheets_of_yarn_spinner_have_any_columns() {
    let sheet = "character,text,id,file,line\r\nMara,\"Hello, {0}!\",line:mara_hello,C:\\game\\Town.yarn,3\r\n,,,,\r\n\
        Player,Yes: [wave]now[/wave].,line:yes,C:\\game\\Town.yarn,9\r\n,,,,\r\n";
    let expected = owned(&[("mara_hello", "Hello, {0}!"), ("yes", "Yes: [wave]now[/wave].")]);
    assert_eq!(lines(sheet), (expected, vec![]));
    let (script, _, _) = Script::read_lines("a.csv", sheet.as_bytes(), None);
    assert_eq!(script.line_of("mara_hello").unwrap().parts, ["Hello, ", "!"]);
    let (script, _, found) = Script::read("a.csv", b"file,id,text\nTown.yarn,line:a,Mara: Hello.\n", None);
    assert_eq!((script.text_of("a"), found), (Some("Hello."), vec![]), "the name of the speaker is not spoken");
}

#[test]
fn tables_of_renpy_have_strings_and_raw_quotes() {
    let head = "Identifier\tCharacter\tDialogue\tFilename\tLine Number\tRen'Py Script\n";
    let table = format!(
        "{head}start_a1\tm\t\"Stop!\" she said.\tgame/script.rpy\t3\tm \"[what]\"\n\
        \t\tOpen the door\tgame/script.rpy\t4\nstart_b2\t\tOne\\ntwo \\\"three\\\".\tgame/script.rpy\t9\t\"[what]\"\n"
    );
    let expected = owned(&[("start_a1", "\"Stop!\" she said."), ("start_b2", "One two \"three\".")]);
    assert_eq!(lines(&table), (expected, vec![]));
    let (_, _, found) = Script::read_lines("dialogue.tab", format!("{head}\t\tOpen\ta.rpy\t4\n").as_bytes(), None);
    assert_eq!(found[0].message, "no row of the table has an identifier");
    assert!(found[0].is_error() && found[0].help.as_ref().unwrap().contains("tab-delimited"), "{found:?}");
}

/// The dialogue script of Unreal, as its localisation dashboard exports it (`ExportDialogueScriptCommandlet.cpp` of
/// Unreal Engine 4.18; its columns are the members of `FDialogueScriptEntry`, which are the same in 5.3): UTF-8 with a
/// byte order mark, all cells in quotes, and lists in parentheses. `AudioFileName` is the recording that the engine
/// imports.
#[test]
fn dialogue_scripts_of_unreal_name_recordings() {
    let head = "\"SpeakingVoice\",\"TargetVoices\",\"SpokenDialogue\",\"VoiceActorDirection\",\"AudioFileName\",\
        \"DialogueAsset\",\"IsRecorded\",\"LocalizationKeys\",\"SpeakingVoiceGUID\",\"TargetVoiceGUIDs\",\
        \"DialogueAssetGUID\"\n";
    let row = |text: &str, recording: &str| {
        format!(
            "\"Mara\",\"(\"\"Otto\"\",\"\"[Otto,Tom]\"\")\",\"{text}\",\"quietly, \"\"sotto voce\"\"\",\
             \"{recording}.wav\",\"/Game/Dialogue/{recording}.{recording}\",\"False\",\"(\"\"A05875C2C7CA4601_C174FFF6\"\")\",\
             \"3A5B\",\"(\"\"77C1\"\",\"\"[77C1,0E12]\"\")\",\"A05875C2C7CA4601\"\n"
        )
    };
    let table = format!(
        "\u{feff}{head}{}{}",
        row("\"\"Who\"\" goes there,\notto?", "Mara_Gate_0"),
        row("C:\\new", "Mara_Disk_0")
    );
    let expected = owned(&[("Mara_Gate_0", "\"Who\" goes there,\notto?"), ("Mara_Disk_0", "C:\\new")]);
    assert_eq!(lines(&table), (expected.clone(), vec![]));
    // The editor of a translator may write UTF-16.
    let wide: Vec<u8> = table.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let (script, _, found) = Script::read_lines("Dialogue.csv", &wide, None);
    let read: Vec<(&str, &str)> = script.lines().iter().map(|line| (line.path, line.text)).collect();
    assert_eq!((owned(&read), found), (expected, vec![]));
    let (script, _, _) = Script::read("Dialogue.csv", table.as_bytes(), None);
    assert_eq!(script.text_of("mara_disk_0"), Some("C:\\new"), "a script of recordings");
}

#[test]
fn broken_rows_are_errors_with_positions() {
    let extra = "the row has more cells than the first line, which names 2";
    for (table, message, line, column) in [
        ("id,text\na,Well, yes.\nb,No.,\n", extra, 2, 8),
        ("id,text\na,Yes.\nb,\"No.\nc,Why?\n", "the cell that starts with this quote is not closed", 3, 3),
        ("id,text\na,\"Yes.\nb,\"No.\"\n", "text follows the quote that closes a cell", 3, 4),
        ("id,text\n\n", "no row follows the names of the columns", 1, 1),
        ("id,text\n,\n", "no row follows the names of the columns", 1, 1),
        ("id,text\n,Yes.\n", "the row has no ID", 2, 1),
    ] {
        assert_eq!(lines(table).1, [(message.to_owned(), line, column)], "{table}");
    }
}
