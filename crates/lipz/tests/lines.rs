//! `lipz check --lines`: clips and the lines of a game's script.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use support::{Scene, lipz};

/// A table of Ren'Py, with a line that has no clip.
const TABLE: &str = "Identifier\tCharacter\tDialogue\tFilename\tLine Number\tRen'Py Script\n\
    mara_hello\tMara\tHello, Otto. You?\tgame/script.rpy\t12\tsay\n\
    otto_yes\tOtto\tYes.\tgame/script.rpy\t13\tsay\n";

fn scene() -> Scene {
    let scene = Scene::new();
    scene.write(
        "lipz.toml",
        "sources = [\"voices\"]\nroot = \"voices\"\ndefault-locale = \"en-us\"\n\n[voices]\nde-de = \"de/{key}\"\n",
    );
    scene.write(
        "voices/act1/mara_hello.lipz",
        r#"{ "visemes": "MA|EO", "text_en-us": "{smiling} Hello, Otto.| You?" }"#,
    );
    scene.write("voices/act1/otto_yes.lipz", r#"{ "text_en-us": "Yes." }"#);
    scene.write("voices/de/act1/mara_hello.lipz", r#"{ "visemes": "MA|EO" }"#);
    scene.write("dialogue.tab", TABLE);
    scene
}

#[test]
fn clips_and_lines_that_belong_together_are_silent() {
    let scene = scene();
    let check = |script: &str| lipz(scene.path(), ["check", "--lines", script, "--allow", "LZ2004"]);
    let checked = check("dialogue.tab");
    assert_eq!((checked.code, checked.stderr.as_str()), (0, ""));
    let yarn = "language,id,text,file,node,lineNumber,lock,comment\nen,line:mara_hello,\"Hello, Otto. You?\",a.yarn,Start,1,,\n\
        en,line:otto_yes,Yes.,a.yarn,Start,2,,\n";
    scene.write("lines.csv", yarn);
    assert_eq!(check("lines.csv").stderr, "");
    let ink = r##"{"inkVersion":21,"root":["^Hello, Otto. You?","#","^id:mara_hello","/#","\n","^Yes.","#","^id:otto_yes","/#","\n"]}"##;
    scene.write("story.json", ink);
    assert_eq!(check("story.json").stderr, "");
    // articy:draft X
    let objects = r#"{"Objects":[
        {"Type":"DialogueFragment","Properties":{"TechnicalName":"mara_hello","Text":"mara_hello.Text"}},
        {"Type":"DialogueFragment","Properties":{"TechnicalName":"otto_yes","Text":"otto_yes.Text"}}]}"#;
    let texts = r#"{"mara_hello.Text":{"":{"Text":"Hello, Otto. You?"},"Context":"Flow"},
        "otto_yes.Text":{"":{"Text":"Yes."},"Context":"Flow"}}"#;
    scene.write("export/package_01_objects.json", objects);
    assert!(check("export/package_01_objects.json").stderr.contains("[LZ1104]"), "without texts");
    scene.write("export/package_01_localization.json", texts);
    assert_eq!(check("export/package_01_objects.json").stderr, "");
    scene.write("export/package_01_localization.json", texts.replace("Yes.", "No."));
    assert!(check("export/package_01_objects.json").stderr.contains("[LZ1921]"));
    scene.write("lines.msg", "{1}{mara_hello}{Hello, Otto. You?}\n{2}{otto_yes}{Yes.}\n");
    assert_eq!(check("lines.msg").stderr, "");
    for (file, content, message) in [
        ("lines.toml", "a = 1\n", "the first line does not name the columns"),
        ("lines.json", "id,text\n", "the file is not JSON"),
        ("lines.json", "[]", "the file is neither a compiled story of Ink nor an exported project of articy:draft"),
        ("lines.csv", "id,text\nmara_hello,Hello, Otto.\n", "lines.csv:2:18"),
    ] {
        scene.write(file, content);
        let refused = check(file);
        assert!(refused.code != 0 && refused.stderr.contains(message), "{refused:?}");
    }
}

/// A game replaces interpolations and expressions by texts that a script does not have.
#[test]
fn inserted_texts_match_any_text() {
    let scene = scene();
    let check = |script: &str| lipz(scene.path(), ["check", "--lines", script, "--allow", "LZ2004"]);
    scene.write("dialogue.tab", TABLE.replace("Hello, Otto. You?", "Hello, [friend!t]. {w=0.5}[question]?"));
    assert_eq!(check("dialogue.tab").stderr, "");
    scene.write("dialogue.tab", TABLE.replace("Hello, Otto. You?", "Hullo, [friend!t]. {w=0.5}[question]?"));
    assert!(check("dialogue.tab").stderr.contains("[LZ1921]"));
    let sheet = "character,text,id\nMara,\"Mara: Hello, {0}. [wave]You?[/wave]\",line:mara_hello\n,,\n\
        Otto,Otto: Yes.,line:otto_yes\n";
    scene.write("sheet.csv", sheet);
    assert_eq!(check("sheet.csv").stderr, "");
    scene.write("sheet.csv", sheet.replace("Otto: Yes.", "Otto: No."));
    assert_eq!(check("sheet.csv").stderr.matches("[LZ1921]").count(), 1);
}

#[test]
fn the_help_names_the_formats() {
    let help = lipz(scene().path(), ["check", "--help"]).stdout;
    for name in ["Ren'Py", "Yarn Spinner", "Unreal", "CSV", "Ink", "articy", ".msg"] {
        assert!(help.contains(name), "{name}");
    }
}

#[test]
fn ids_have_priority_over_files_and_are_shown_as_written() {
    let scene = scene();
    let table = "file,id,text\nscript.rpy,Mara_Hello,\"Hello, Otto. You?\"\nscript.rpy,Otto_No,No.\n";
    scene.write("lines.csv", table);
    let checked = lipz(scene.path(), ["check", "--lines", "lines.csv", "--allow", "LZ2004"]);
    assert!(checked.stderr.contains("no clip has the key of the line `Otto_No`"), "{checked:?}");
    assert!(checked.stderr.contains("2 warnings in 2 files"), "{checked:?}");
}

#[test]
fn a_line_of_several_clips_is_reported() {
    let mut scene = scene();
    scene.write("voices/act2/otto_yes.lipz", r#"{ "text_en-us": "Of course." }"#);
    scene.expect(
        "LZ1919-line-without-clip-several",
        &["check", "--lines", "dialogue.tab", "--allow", "LZ2004", "--quiet"],
    );
    scene.write("dialogue.tab", TABLE.replace("otto_yes", "act1/otto_yes"));
    let check = ["check", "--lines", "dialogue.tab", "--allow", "LZ2004", "--quiet"];
    let whole = lipz(scene.path(), check);
    assert!(whole.stderr.contains("voices/act2/otto_yes.lipz\n"), "{whole:?}");
    assert!(whole.stderr.contains("1 warning in 1 file"), "the whole key fits one clip: {whole:?}");
    // A key without folders belongs to the clip outside of folders.
    scene.write("dialogue.tab", TABLE);
    scene.write("voices/otto_yes.lipz", r#"{ "text_en-us": "Yes." }"#);
    let outside = lipz(scene.path(), check);
    assert_eq!(outside.stderr.matches("warning[LZ1920]").count(), 2, "{outside:?}");
    assert!(!outside.stderr.contains("LZ1919"), "{outside:?}");
    scene.finish(1);
}

#[test]
fn single_files_are_not_the_whole_script() {
    let scene = scene();
    let check = |files: &[&str]| {
        let arguments = [&["check", "--lines", "dialogue.tab", "--allow", "LZ2004"], files].concat();
        lipz(scene.path(), arguments).stderr
    };
    assert_eq!(check(&["voices/act1/otto_yes.lipz"]), "");
    scene.write("dialogue.tab", TABLE.replace("Yes.", "Of course."));
    assert!(check(&["voices/act1/otto_yes.lipz"]).contains("LZ1921"));
    scene.write("dialogue.tab", TABLE.replace("otto_yes", "otto_no"));
    assert!(check(&["voices/act1/otto_yes.lipz"]).contains("LZ1920"));
    assert!(check(&["voices"]).contains("LZ1919"), "a folder can be");
}

#[test]
fn texts_are_compared_in_the_source_locale() {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\nroot = \"voices\"\n");
    scene.write("voices/a.lipz", r#"{ "text_de-de": "Ja.", "text_en-us": "Yes." }"#);
    scene.write("lines.csv", "id,text\na,No.\n");
    let check = || lipz(scene.path(), ["check", "--lines", "lines.csv", "--allow", "LZ1911"]);
    let unknown = check();
    assert!(!unknown.stderr.contains("LZ1921"), "{unknown:?}");
    assert!(
        unknown.stdout.contains("hint: lipz did not compare the texts of clips in several languages"),
        "{unknown:?}"
    );
    let approved = lipz(scene.path(), ["approve", "--all", "--from", "en-us"]);
    assert_eq!(approved.code, 0, "{approved:?}");
    let recorded = check();
    assert!(
        recorded.stderr.contains("the text differs from the line in lines.csv\n --> voices/a.lipz:1:38"),
        "{recorded:?}"
    );
    scene.write("lines.csv", "id,text\na,Yes.\n");
    assert_eq!(check().stderr, "");
    // A single text needs no locale.
    let scene = Scene::new();
    scene.write("b.lipz", r#"{ "text_ja-jp": "こんにちは。|元気？" }"#);
    scene.write("lines.csv", "id,text\nb,\"こんにちは。\r\n元気？\"\n");
    let check = || lipz(scene.path(), ["check", "--lines", "lines.csv", "."]).stderr;
    assert_eq!(check(), "");
    scene.write("lines.csv", "id,text\nb,こんにちは。\n");
    assert!(check().contains("LZ1921"));
}

#[test]
fn clips_and_lines_without_each_other_are_reported() {
    let mut scene = scene();
    let check = ["check", "--lines", "dialogue.tab", "--allow", "LZ2004", "--quiet"];
    scene.write("dialogue.tab", TABLE.replace("otto_yes", "otto_no"));
    scene.expect("LZ1919-line-without-clip", &[&check[..], &["--allow", "LZ1920"]].concat());
    scene.expect("LZ1920-clip-without-line", &[&check[..], &["--allow", "LZ1919"]].concat());
    scene.write("dialogue.tab", TABLE.replace("Yes.", "Of course."));
    scene.expect("LZ1921-line-differs", &check);
    let denied = lipz(scene.path(), [&check[..], &["--deny", "line-differs"]].concat());
    assert_eq!(denied.code, 1);
    scene.finish(3);
}
