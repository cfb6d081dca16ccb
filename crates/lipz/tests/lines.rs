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
    let unreadable = check("lipz.toml");
    assert!(
        unreadable.code != 0 && unreadable.stderr.contains("the first line does not name the columns"),
        "{unreadable:?}"
    );
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
