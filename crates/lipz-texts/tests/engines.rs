//! String tables of engines, as the engines read them.
#![allow(clippy::unwrap_used, reason = "tests")]

mod engine_readers;

use engine_readers::{godot, unity, unreal, yarn};

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
}
