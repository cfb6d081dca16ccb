//! The files that `lipz preview` writes for its page, and the changes that it refuses.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use serde_json::{Value, json};
use std::fs;
use std::process::Command;
use support::preview::{MAYOR, Preview, change, mayor, project};

#[test]
fn changes_are_written_as_the_file_is_laid_out() {
    let scene = project();
    let preview = Preview::start(&scene, &["voices"]);
    let edit = change(MAYOR, &json!({ "visemes": "MAAAEE--|MAAEEO--", "text_de-de": "Meister?|Meister!" }));
    let draft = preview.post("api/draft", &edit);
    let (document, bank) = draft.drafted();
    assert_eq!(document["result"], "draft", "{document}");
    assert!(lipz_bank::Bank::open(bank).unwrap().clip_by_key("act1/mayor").is_some());
    assert_eq!(mayor(&scene), MAYOR, "a draft does not change the file");
    let before = preview.get("api/clips").json()["version"].as_u64().unwrap();
    let saved = preview.post("api/save", &edit).json();
    assert_eq!(saved["result"], "saved", "{saved}");
    let file = mayor(&scene);
    let expected = MAYOR
        .replace("MAAAEO--", "MAAAEE--")
        .replace("\"Mayor?|Mayor!\",", "\"Mayor?|Mayor!\",\n  \"text_de-de\": \"Meister?|Meister!\",");
    assert_eq!(file, expected);
    let changed = preview.get(&format!("api/changes?since={before}")).json();
    assert_ne!(changed["version"].as_u64(), Some(before), "the page gets the change");
}

#[test]
fn what_somebody_else_wrote_is_kept() {
    let scene = project();
    let preview = Preview::start(&scene, &["voices"]);
    let theirs = MAYOR.replace("Mayor!", "MAYOR!");
    scene.write("voices/act1/mayor.lipz", &theirs);
    let answer = preview.post("api/save", &change(MAYOR, &json!({ "visemes": "MAAAEE--|MAAEEO--" }))).json();
    assert_eq!(answer["result"], "conflict", "{answer}");
    assert!(answer["theirs"].as_str().unwrap().contains("MAYOR!"), "{answer}");
    assert!(answer["yours"].as_str().unwrap().contains("MAAAEE--"), "{answer}");
    assert_eq!(mayor(&scene), theirs);
}

#[test]
fn changes_with_errors_are_refused() {
    let scene = project();
    let preview = Preview::start(&scene, &["voices"]);
    let answer = preview.post("api/save", &change(MAYOR, &json!({ "visemes": "MA" }))).json();
    assert_eq!(
        (&answer["result"], &answer["diagnostics"][0]["code"]),
        (&json!("errors"), &json!("LZ0601")),
        "{answer}"
    );
    let other = preview.post("api/save", &change(MAYOR, &json!({ "fps": "24" }))).json();
    assert_eq!(other["result"], "refused", "{other}");
    assert_eq!(preview.post("api/save", &json!(["nonsense"])).status, 400);
    assert_eq!(mayor(&scene), MAYOR);
}

#[test]
fn read_only_and_banks_are_not_written() {
    let scene = project();
    let preview = Preview::start(&scene, &["voices", "--read-only"]);
    let answer = preview.post("api/save", &change(MAYOR, &json!({ "events": "a|b" })));
    assert_eq!((answer.status, &answer.json()["result"]), (403, &json!("refused")));
    assert_eq!(preview.get("api/clips").json()["is_read_only"], true);
    assert_eq!(mayor(&scene), MAYOR);
    fs::remove_file(scene.path().join("voices/act1/otto.lipz")).unwrap();
    scene.prepare(&["pack", "voices", "-o", "a.lipzbank"]);
    let bank = Preview::start(&scene, &["a.lipzbank"]);
    assert_eq!(bank.get("api/clips").json()["clips"][0]["key"], "act1/mayor");
    assert_eq!(bank.get("api/clip?key=act1%2Fmayor").json()["path"], Value::Null);
}

/// A pipe in place of a file would hold a request forever.
#[cfg(unix)]
#[test]
fn a_file_that_became_a_pipe_is_refused() {
    let scene = project();
    let preview = Preview::start(&scene, &["voices"]);
    let path = scene.path().join("voices/act1/mayor.lipz");
    fs::remove_file(&path).unwrap();
    assert!(Command::new("mkfifo").arg(&path).status().unwrap().success());
    let edit = change(MAYOR, &json!({ "visemes": "MAAAEE--|MAAEEO--" }));
    let saved = preview.post("api/save", &edit).json();
    assert_eq!(saved["result"], "refused", "{saved}");
}

#[test]
fn a_change_that_is_too_long_is_refused_with_a_word() {
    let preview = Preview::start(&project(), &["voices"]);
    let (host, token) = (preview.host(), &preview.token);
    for length in [u64::from(u32::MAX), u64::MAX / 2] {
        let answer = preview.say(&format!(
            "POST /{token}/api/save HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nContent-Length: {length}\r\n\r\n{{"
        ));
        assert_eq!((answer.status, answer.head.contains("Content Too Large")), (413, true));
        assert_eq!(String::from_utf8(answer.body).unwrap(), "The change exceeds the size limit of a Lipz file.\n");
    }
}
