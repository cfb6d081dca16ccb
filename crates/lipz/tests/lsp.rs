//! `lipz lsp` from the view of an editor: over standard input and output, on real files.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

mod support;

use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use support::editor::{Editor, uri};
use support::{files, lipz, repository};
use tempfile::TempDir;

/// Returns a copy of the drama in which a test may write files.
fn drama() -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().canonicalize().unwrap();
    let acts = ["act1", "act2", "act3"].iter().flat_map(|act| files(&format!("fixtures/drama/{act}"), "lipz"));
    for file in acts.chain(["fixtures/drama/lipz.toml".to_owned()]) {
        let to = root.join(file.strip_prefix("fixtures/drama/").unwrap());
        fs::create_dir_all(to.parent().unwrap()).unwrap();
        fs::copy(repository().join(&file), to).unwrap();
    }
    (folder, root)
}

fn codes(diagnostics: &[Value]) -> Vec<&str> {
    diagnostics.iter().map(|diagnostic| diagnostic["code"].as_str().unwrap()).collect()
}

/// A diagnostic in the form that both report: code, severity, line and message.
type Told = (String, String, u64, String);

fn told_by_check(folder: &Path, file: &str) -> Vec<Told> {
    let outcome = lipz(folder, ["check", "--no-config", "--output-format", "json", file]);
    let document: Value = serde_json::from_str(&outcome.stdout).unwrap();
    let told = |found: &Value| {
        let line = found["span"]["start"]["line"].as_u64();
        let text = |field: &str| found[field].as_str().unwrap().to_owned();
        (text("code"), text("severity"), line.map_or(0, |line| line - 1), text("message"))
    };
    let mut told: Vec<Told> = document["diagnostics"].as_array().unwrap().iter().map(told).collect();
    told.sort();
    told
}

fn told_by_server(diagnostics: &[Value]) -> Vec<Told> {
    let told = |found: &Value| {
        let severity = if found["severity"] == 1 { "error" } else { "warning" };
        let message = found["message"].as_str().unwrap().lines().next().unwrap();
        let line = found["range"]["start"]["line"].as_u64().unwrap();
        (found["code"].as_str().unwrap().to_owned(), severity.to_owned(), line, message.to_owned())
    };
    let mut told: Vec<Told> = diagnostics.iter().map(told).collect();
    told.sort();
    told
}

/// Whether both report the same. The server appends the remark about the marked characters to the message.
fn are_same(server: &[Told], check: &[Told]) -> bool {
    let is_same = |(one, other): (&Told, &Told)| {
        (&one.0, &one.1, one.2) == (&other.0, &other.1, other.2) && one.3.starts_with(other.3.lines().next().unwrap())
    };
    server.len() == check.len() && server.iter().zip(check).all(is_same)
}

#[test]
fn each_bad_file_has_the_diagnostics_of_check() {
    let repository = repository();
    let mut editor = Editor::start();
    editor.ask("initialize", &json!({ "capabilities": {} }));
    editor.tell("initialized", &json!({}));
    let mut compared = 0;
    for file in files("fixtures/bad", "lipz").into_iter().filter(|file| file.matches('/').count() == 2) {
        let path = repository.join(&file);
        let bytes = fs::read(&path).unwrap();
        // An editor does not open files that are not text, and removes byte order marks.
        let Ok(text) = String::from_utf8(bytes) else { continue };
        if text.starts_with('\u{feff}') {
            continue;
        }
        let expected = told_by_check(&repository, &file);
        editor.open(&path, &text);
        let mut last = Vec::new();
        editor.diagnostics(&path, |diagnostics| {
            last = told_by_server(diagnostics);
            are_same(&last, &expected)
        });
        editor.tell("textDocument/didClose", &json!({ "textDocument": { "uri": uri(&path) } }));
        compared += 1;
    }
    assert!(compared > 120, "{compared}");
    assert_eq!(editor.end(), 0);
}

#[test]
fn a_project_is_checked_whole_and_its_files_while_they_are_typed() {
    let (_folder, root) = drama();
    let path = root.join("act1/mara-hello.lipz");
    let text = "{\n  \"visemes\" : \"MAEO\",\n  \"viseme_type\" : \"blair\",\n  \"text_en-us\" : \"𝄞 Hi\",\n  \"events\" : \"mara sees otto\"\n}\n";
    fs::write(&path, text).unwrap();
    let mut editor = Editor::in_folder(&root);
    editor.open(&path, text);
    editor.diagnostics(&path, <[Value]>::is_empty);
    // After a character of two UTF-16 units.
    editor.change(&path, [3, 21, 3, 23], "{Hi");
    let found = editor.diagnostics(&path, |found| !found.is_empty());
    assert_eq!(
        (codes(&found), found[0]["range"]["start"]["character"].as_u64()),
        (vec!["LZ0505"], Some(21)),
        "{found:?}"
    );
    assert_eq!(found[0]["range"]["end"]["character"], 22);
    // Problems that only the project shows: a second file with the same key on case-insensitive systems.
    editor.change(&path, [3, 21, 3, 22], "");
    fs::write(root.join("act1/MARA-hello.lipz"), text).unwrap();
    editor.tell("textDocument/didSave", &json!({ "textDocument": { "uri": uri(&path) } }));
    editor.diagnostics(&path, |found| codes(found).contains(&"LZ0801"));
    fs::remove_file(root.join("act1/MARA-hello.lipz")).unwrap();
    editor.tell("textDocument/didSave", &json!({ "textDocument": { "uri": uri(&path) } }));
    editor.diagnostics(&path, <[Value]>::is_empty);
    // Settings apply once they are saved.
    let settings = fs::read_to_string(root.join("lipz.toml")).unwrap();
    fs::write(root.join("lipz.toml"), settings.replace("\"otto\", ", "")).unwrap();
    editor.tell(
        "workspace/didChangeWatchedFiles",
        &json!({ "changes": [{ "uri": uri(&root.join("lipz.toml")), "type": 2 }] }),
    );
    editor.diagnostics(&path, |found| codes(found).contains(&"LZ0704"));
    assert_eq!(editor.end(), 0);
}

#[test]
fn fixes_formatting_completion_hover_symbols_and_links() {
    let (_folder, root) = drama();
    let path = root.join("new.lipz");
    fs::write(
        root.join("lipz.toml"),
        format!("{}\n[audio]\nfolder = \"sound\"\n", fs::read_to_string(root.join("lipz.toml")).unwrap()),
    )
    .unwrap();
    fs::create_dir(root.join("sound")).unwrap();
    fs::write(root.join("sound/new.wav"), support::sound::wav(8_000, &[0; 800])).unwrap();
    let text = "{ \"visemes\": \"MA EO\", \"viseme_type\": \"blair\",\n\"fps\": 10, \"events\": \"otto does \" }";
    fs::write(&path, text).unwrap();
    let mut editor = Editor::in_folder(&root);
    editor.open(&path, text);
    editor.diagnostics(&path, |found| codes(found).contains(&"LZ0402"));
    let range = json!({ "start": { "line": 0, "character": 16 }, "end": { "line": 0, "character": 16 } });
    let context = json!({ "diagnostics": [], "only": ["quickfix"] });
    let asked = json!({ "textDocument": { "uri": uri(&path) }, "range": range, "context": context });
    let actions = editor.ask("textDocument/codeAction", &asked);
    let edit = &actions["result"][0]["edit"]["documentChanges"][0]["edits"][0];
    assert_eq!((&edit["newText"], &edit["range"]["start"]["character"]), (&json!("\"MAEO\""), &json!(13)), "{actions}");
    let actions = editor.ask_at("textDocument/completion", &path, 1, 32, &json!({}));
    let labels: Vec<&str> =
        actions["result"].as_array().unwrap().iter().map(|item| item["label"].as_str().unwrap()).collect();
    assert!(labels.contains(&"salute") && labels.contains(&"wave"), "{actions}");
    let hover = editor.ask_at("textDocument/hover", &path, 0, 18, &json!({}));
    let shown = hover["result"]["contents"]["value"].as_str().unwrap();
    assert!(shown.starts_with("![the mouth](data:image/svg+xml,") && shown.contains("frame 3, 0.300 s"), "{shown}");
    let format = json!({ "textDocument": { "uri": uri(&path) }, "options": { "tabSize": 2, "insertSpaces": true } });
    let formatted = editor.ask("textDocument/formatting", &format);
    assert!(formatted["result"][0]["newText"].as_str().unwrap().contains("\n  \"visemes\""), "{formatted}");
    let symbols = editor.ask("textDocument/documentSymbol", &json!({ "textDocument": { "uri": uri(&path) } }));
    assert_eq!(symbols["result"][0]["name"], "visemes");
    let links = editor.ask("textDocument/documentLink", &json!({ "textDocument": { "uri": uri(&path) } }));
    assert_eq!(links["result"][0]["target"], uri(&root.join("sound/new.wav")), "{links}");
    editor.change(&path, [0, 0, 0, 1], "");
    let formatted = editor.ask("textDocument/formatting", &format);
    assert!(formatted["error"]["message"].as_str().unwrap().starts_with("the file cannot be formatted"), "{formatted}");
    assert_eq!(editor.end(), 0);
}

/// Makes the edits of a rename on disk like an editor.
fn apply(edit: &Value) -> usize {
    let changes = edit["documentChanges"].as_array().unwrap();
    for change in changes {
        let path = change["textDocument"]["uri"].as_str().unwrap().strip_prefix("file://").unwrap();
        let text = fs::read_to_string(path).unwrap();
        let mut lines: Vec<Vec<u16>> = text.split('\n').map(|line| line.encode_utf16().collect()).collect();
        let mut edits: BTreeMap<(usize, usize), (usize, &str)> = BTreeMap::new();
        for edit in change["edits"].as_array().unwrap() {
            let at = |end: &str, part: &str| usize::try_from(edit["range"][end][part].as_u64().unwrap()).unwrap();
            assert_eq!(at("start", "line"), at("end", "line"));
            edits.insert(
                (at("start", "line"), at("start", "character")),
                (at("end", "character"), edit["newText"].as_str().unwrap()),
            );
        }
        for ((line, start), (end, new)) in edits.into_iter().rev() {
            lines[line].splice(start..end, new.encode_utf16());
        }
        let lines: Vec<String> = lines.iter().map(|line| String::from_utf16(line).unwrap()).collect();
        fs::write(path, lines.join("\n")).unwrap();
    }
    changes.len()
}

#[test]
fn a_character_is_renamed_in_all_files_and_in_the_registry() {
    let (_folder, root) = drama();
    let path = root.join("act1/aa.lipz");
    let text = "{ \"visemes\": \"MA\", \"viseme_type\": \"blair\", \"events\": \"otto sees mara\" }";
    fs::write(&path, text).unwrap();
    let mut editor = Editor::in_folder(&root);
    editor.open(&path, text);
    editor.diagnostics(&path, <[Value]>::is_empty);
    let found = editor.ask_at("textDocument/prepareRename", &path, 0, 57, &json!({}));
    assert_eq!(found["result"]["placeholder"], "otto");
    for (name, why) in [("mara", "is already in use"), ("two words", "a name is one word")] {
        let refused = editor.ask_at("textDocument/rename", &path, 0, 57, &json!({ "newName": name }));
        assert!(refused["error"]["message"].as_str().unwrap().contains(why), "{refused}");
    }
    let renamed = editor.ask_at("textDocument/rename", &path, 0, 57, &json!({ "newName": "öt\"to" }));
    assert!(apply(&renamed["result"]) > 5, "{renamed}");
    assert_eq!(editor.end(), 0);
    let drama = lipz(&root, ["check", "."]);
    assert_eq!((drama.code, drama.stdout.lines().next()), (0, Some("49 files checked")), "{}", drama.stderr);
    assert!(!drama.stderr.contains("LZ07"), "{}", drama.stderr);
    let acts = ["act1", "act2", "act3"].iter().flat_map(|act| files(root.join(act).to_str().unwrap(), "lipz"));
    for file in acts {
        let text = fs::read_to_string(&file).unwrap();
        let document = lipz_file::parse(text.as_bytes()).document.unwrap();
        let events = document.string("events").unwrap_or_default();
        assert!(!events.split([' ', ',', '|']).any(|word| word == "otto"), "{file}: {events}");
    }
    assert!(fs::read_to_string(root.join("lipz.toml")).unwrap().contains(r#""öt\"to""#));
}

#[test]
fn levels_for_some_of_the_files_count() {
    let (_folder, root) = drama();
    let settings = fs::read_to_string(root.join("lipz.toml")).unwrap();
    fs::write(root.join("lipz.toml"), settings + "\n[lints.\"act1/old/**\"]\nunknown-emotion = \"allow\"\n").unwrap();
    let text = r#"{ "visemes": "MA", "viseme_type": "blair", "fps": 24, "events": "feels smug, feels sad" }"#;
    let mut editor = Editor::in_folder(&root);
    for (file, expected) in [("act1/new.lipz", &["LZ0702"][..]), ("act1/old/a.lipz", &[])] {
        let path = root.join(file);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, text).unwrap();
        editor.open(&path, text);
        assert_eq!(codes(&editor.diagnostics(&path, |_| true)), expected, "{file}");
    }
    assert_eq!(editor.end(), 0);
}

#[test]
fn hostile_messages_have_answers_and_end_nothing() {
    let mut editor = Editor::start();
    assert_eq!(editor.ask("textDocument/hover", &json!({}))["error"]["code"], -32002, "before `initialize`");
    editor.ask("initialize", &json!(17));
    assert_eq!(editor.ask("initialize", &json!({}))["error"]["code"], -32600);
    assert_eq!(editor.ask("lipz/nothing", &json!({}))["error"]["code"], -32601);
    assert_eq!(editor.ask("textDocument/hover", &json!([1]))["error"]["code"], -32602);
    for (body, code) in [("{", -32700), ("[]", -32600), ("{\"id\":{},\"method\":7}", -32600), ("\u{0}", -32700)] {
        editor.send_bytes(format!("Content-Length: {}\r\n\r\n{body}", body.len()).as_bytes());
        editor.wait(|message| message["error"]["code"] == code);
    }
    let unopened = Path::new("/nowhere/a.lipz");
    assert_eq!(editor.ask_at("textDocument/hover", unopened, 0, 0, &json!({}))["error"]["code"], -32803);
    editor.change(unopened, [0, 0, 9, 9], "x");
    editor.open(unopened, "\u{feff}{\"events\": \"𝄞 feels \\ud83d\\ude00|");
    for range in [[9, 9, 0, 0], [0, u32::MAX, u32::MAX, 0], [0, 14, 0, 15], [0, 0, 0, 2]] {
        editor.change(unopened, range, "\r\u{2028}{\"events\": \"𝄞");
        let asked = json!({ "textDocument": { "uri": uri(unopened) }, "range": {
            "start": { "line": 0, "character": 0 }, "end": { "line": 9, "character": 9 } }, "context": { "diagnostics": [] } });
        assert!(editor.ask("textDocument/codeAction", &asked)["result"].is_array());
        for method in ["hover", "completion", "rename", "prepareRename"] {
            for character in 0..40 {
                let answer = editor.ask_at(
                    &format!("textDocument/{method}"),
                    unopened,
                    1,
                    character,
                    &json!({ "newName": "a" }),
                );
                assert!(answer.get("result").is_some() || answer["error"]["code"] == -32803, "{answer}");
            }
        }
    }
    assert_eq!(editor.ask("shutdown", &Value::Null)["result"], Value::Null);
    assert_eq!(editor.ask("textDocument/hover", &json!({}))["error"]["code"], -32600, "after `shutdown`");
    editor.tell("exit", &Value::Null);
    assert_eq!(editor.exit_code(), 0);
}

#[test]
fn conversations_that_break_off_end_the_server() {
    let mut editor = Editor::start();
    editor.tell("exit", &Value::Null);
    assert_eq!(editor.exit_code(), 1, "without `shutdown`");
    assert_eq!(Editor::start().exit_code(), 1, "the editor is gone");
    let mut editor = Editor::start();
    editor.send_bytes(b"Content-Length: 99999999999999999999\r\n\r\n");
    assert_eq!(editor.exit_code(), 2);
}

/// Editors take long to show thousands of diagnostics again that have not changed.
#[test]
fn only_diagnostics_that_changed_are_sent() {
    let scene = tempfile::tempdir().unwrap();
    let file = |name: &str| scene.path().join(format!("voices/{name}.lipz"));
    fs::create_dir(scene.path().join("voices")).unwrap();
    fs::write(scene.path().join("lipz.toml"), "sources = [\"voices\"]\n").unwrap();
    let wrong = r#"{ "fps": 24, "visemes": "MA", "viseme_type": "blair", "events": "feels anrgy" }"#;
    (0..50).for_each(|number| fs::write(file(&format!("clip{number}")), wrong).unwrap());
    let mut editor = Editor::in_folder(scene.path());
    editor.open(&file("clip0"), wrong);
    for number in 1..50 {
        // In any order.
        editor.diagnostics_of(&file(&format!("clip{number}")));
    }
    // A file is mended, and all are checked.
    fs::write(file("clip7"), wrong.replace("anrgy", "angry")).unwrap();
    editor.tell("textDocument/didSave", &json!({ "textDocument": { "uri": uri(&file("clip0")) } }));
    let sent = editor.published_until(&file("clip7"));
    assert_eq!(sent.iter().filter(|uri| !uri.ends_with("clip0.lipz")).count(), 1, "{sent:?}");
    assert_eq!(editor.end(), 0);
}

/// Half of a character is replaced, which JSON writes as `\ude01`: both halves are text again.
#[test]
fn halves_of_characters_are_taken() {
    let mut editor = Editor::start();
    editor.ask("initialize", &json!({}));
    let path = Path::new("/nowhere/a.lipz");
    editor.open(path, "{ \"note\": \"\u{1f600}\" }");
    let change = r#"{"jsonrpc":"2.0","method":"textDocument/didChange","params":{"textDocument":{"uri":"file:///nowhere/a.lipz","version":2},"contentChanges":[{"range":{"start":{"line":0,"character":12},"end":{"line":0,"character":13}},"text":"\ude01"}]}}"#;
    editor.send_bytes(format!("Content-Length: {}\r\n\r\n{change}", change.len()).as_bytes());
    let asked = json!({ "textDocument": { "uri": uri(path) }, "options": { "tabSize": 2, "insertSpaces": true } });
    let answer = editor.ask("textDocument/formatting", &asked);
    assert!(answer["result"][0]["newText"].is_string(), "{answer}");
    // A request with half a character has its answer, too.
    let request = r#"{"jsonrpc":"2.0","id":"half","method":"textDocument/hover","params":{"textDocument":{"uri":"\ud83d"},"position":{"line":0,"character":0}}}"#;
    editor.send_bytes(format!("Content-Length: {}\r\n\r\n{request}", request.len()).as_bytes());
    editor.wait(|message| message["id"] == "half");
    assert_eq!(editor.ask("shutdown", &Value::Null)["result"], Value::Null);
}
