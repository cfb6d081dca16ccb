//! The latency of an editor: responses to a keystroke in a Lipz file of one megabyte, which is checked as a whole, and
//! to other requests.
#![allow(
    missing_docs,
    clippy::expect_used,
    reason = "a bench program: criterion's macros, and a stop at the first surprise"
)]

use criterion::{Criterion, criterion_group, criterion_main};
use lipz_benches::files;
use lipz_lsp::{CheckedProject, serve};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, PipeReader, PipeWriter, Read, Write, pipe};
use std::thread;

/// The generator's clips to join. Those of one viseme type are one megabyte long with five locales.
const CLIPS: usize = 2600;
const LOCALES: usize = 5;
/// The number of segments in the file with emotions.
const EMOTIONAL_SEGMENTS: usize = 8000;

/// Returns a file with the segments of many clips.
fn large_file() -> String {
    let mut joined: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for (_, json) in files(CLIPS, LOCALES) {
        let clip: BTreeMap<String, Value> = serde_json::from_str(&json).expect("a Lipz file");
        if clip["viseme_type"] != "blair" {
            continue;
        }
        let text = |name: &str| clip.get(name).and_then(Value::as_str);
        let segments = text("visemes").expect("mouth shapes").matches('|').count();
        let names = clip.keys().filter(|name| *name == "visemes" || name.starts_with("text_"));
        for name in names.map(String::as_str).chain(["events"]) {
            let part = text(name).map_or_else(|| "|".repeat(segments), str::to_owned);
            joined.entry(name.to_owned()).or_default().push(part);
        }
    }
    let mut elements: Vec<String> =
        joined.iter().map(|(name, parts)| format!("{name:?}: {:?}", parts.join("|"))).collect();
    elements.extend(["\"fps\": 24".to_owned(), "\"viseme_type\": \"blair\"".to_owned()]);
    format!("{{\n  {}\n}}\n", elements.join(",\n  "))
}

/// Returns a file in which every segment has an emotion, in its event and in its texts.
fn emotional_file() -> String {
    let repeated = |part: &str| vec![part; EMOTIONAL_SEGMENTS].join("|");
    let parts = [
        ("events", "mara feels fear 4 + joy 1, nods"),
        ("text_de-de", "{anger 2.2} Ich habe {calm} Nein gesagt."),
        ("text_en-us", "{anger 2.2} I have {calm} said no."),
        ("visemes", "MAEO-----AAAAELMO---------"),
    ];
    let elements = parts.map(|(name, part)| format!("{name:?}: {:?}", repeated(part)));
    format!("{{\n  \"fps\": 24, \"viseme_type\": \"blair\",\n  {}\n}}\n", elements.join(",\n  "))
}

/// An editor with an open file.
struct Editor {
    to: PipeWriter,
    from: BufReader<PipeReader>,
    version: i32,
}

impl Editor {
    fn open(text: &str) -> Editor {
        let ((input, to), (from, output)) = (pipe().expect("a pipe"), pipe().expect("a pipe"));
        thread::spawn(move || serve(BufReader::new(input), output, |_, _| CheckedProject::default()));
        let mut editor = Editor { to, from: BufReader::new(from), version: 0 };
        editor.say(&json!({ "jsonrpc": "2.0", "id": 1, "method": "initialize", "params": { "capabilities": {} } }));
        editor.hear();
        editor.say(&json!({ "jsonrpc": "2.0", "method": "initialized", "params": {} }));
        let document = json!({ "uri": "untitled:large", "languageId": "lipz", "version": 0, "text": text });
        editor.tell("textDocument/didOpen", &json!({ "textDocument": document }));
        editor.wait_for_diagnostics();
        editor
    }

    /// Types a letter into the first segment, or deletes it, and waits for the diagnostics.
    fn type_letter(&mut self, line: usize) {
        self.version += 1;
        let (end, text) = if self.version % 2 == 1 { (20, "x") } else { (21, "") };
        let range = json!({ "start": { "line": line, "character": 20 }, "end": { "line": line, "character": end } });
        self.tell(
            "textDocument/didChange",
            &json!({
                "textDocument": { "uri": "untitled:large", "version": self.version },
                "contentChanges": [{ "range": range, "text": text }],
            }),
        );
        self.wait_for_diagnostics();
    }

    /// Sends a request, and waits for the response.
    fn ask(&mut self, method: &str, params: &Value) -> Value {
        self.say(&json!({ "jsonrpc": "2.0", "id": 7, "method": method, "params": params }));
        loop {
            let message = self.hear();
            if message["id"] == 7 {
                assert!(!message["result"].is_null(), "{method}: {message:.300}");
                return message;
            }
        }
    }

    fn tell(&mut self, method: &str, params: &Value) {
        self.say(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    fn say(&mut self, message: &Value) {
        let message = message.to_string();
        write!(self.to, "Content-Length: {}\r\n\r\n{message}", message.len()).expect("a server that listens");
    }

    fn hear(&mut self) -> Value {
        let mut length = 0;
        loop {
            let mut line = String::new();
            self.from.read_line(&mut line).expect("a server that speaks");
            if let Some(number) = line.strip_prefix("Content-Length: ") {
                length = number.trim().parse().expect("a length");
            } else if line.trim().is_empty() {
                break;
            }
        }
        let mut message = vec![0; length];
        self.from.read_exact(&mut message).expect("a whole message");
        serde_json::from_slice(&message).expect("JSON")
    }

    fn wait_for_diagnostics(&mut self) {
        loop {
            let message = self.hear();
            if message["method"] == "textDocument/publishDiagnostics" && message["params"]["version"] == self.version {
                return;
            }
        }
    }
}

fn keystroke(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("a keystroke in 1 MB");
    for (name, text) in [("dialogue", large_file()), ("emotions", emotional_file())] {
        assert!((900_000..1_300_000).contains(&text.len()), "{} bytes", text.len());
        let line = text.lines().position(|line| line.contains("\"text_en-us\"")).expect("English texts");
        let mut editor = Editor::open(&text);
        group.bench_function(name, |bencher| bencher.iter(|| editor.type_letter(line)));
    }
}

/// Other requests of editors: at the pointer or the cursor, and after a pause in typing.
fn requests(criterion: &mut Criterion) {
    let text = large_file();
    let lines: Vec<&str> = text.lines().collect();
    let line = lines.iter().position(|line| line.contains("\"visemes\"")).expect("mouth shapes");
    let document = json!({ "uri": "untitled:large" });
    let at = |line: usize, character: usize| json!({ "textDocument": document, "position": { "line": line, "character": character } });
    let whole = json!({ "start": { "line": line, "character": 20 }, "end": { "line": line, "character": 20 } });
    let last = lines[line].len() - 10;
    let options = json!({ "tabSize": 2, "insertSpaces": true });
    let mut editor = Editor::open(&text);
    let mut group = criterion.benchmark_group("1 MB");
    for (method, params) in [
        ("completion", at(lines.len() - 2, 0)),
        ("hover", at(line, last)),
        ("documentSymbol", json!({ "textDocument": document })),
        ("documentLink", json!({ "textDocument": document })),
        ("codeAction", json!({ "textDocument": document, "range": whole, "context": { "diagnostics": [] } })),
        ("formatting", json!({ "textDocument": document, "options": options })),
    ] {
        let method = format!("textDocument/{method}");
        group.bench_function(&method, |bencher| bencher.iter(|| editor.ask(&method, &params)));
    }
}

criterion_group!(benches, keystroke, requests);
criterion_main!(benches);
