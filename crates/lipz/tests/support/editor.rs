//! An editor that communicates with `lipz lsp` over standard input and output.
#![allow(clippy::panic, reason = "a test stops at the first surprise")]

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::Duration;

/// The time limit for an answer, because busy machines are slow.
const PATIENCE: Duration = Duration::from_secs(60);

pub(crate) struct Editor {
    server: Child,
    input: ChildStdin,
    messages: Receiver<Value>,
    requests: u32,
    version: u32,
    /// The files whose diagnostics were published, as far as they were waited for.
    published: Vec<String>,
}

/// Returns the URI of a file.
pub(crate) fn uri(path: &Path) -> String {
    format!("file://{}", path.to_str().unwrap().replace(' ', "%20"))
}

impl Editor {
    /// Starts the server.
    pub(crate) fn start() -> Editor {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lipz"));
        let command = command.arg("lsp").stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::inherit());
        let mut server = command.spawn().unwrap();
        let (input, output) = (server.stdin.take().unwrap(), server.stdout.take().unwrap());
        let (sender, messages) = channel();
        thread::spawn(move || {
            let mut output = BufReader::new(output);
            while let Some(message) = read(&mut output) {
                if sender.send(message).is_err() {
                    return;
                }
            }
        });
        Editor { server, input, messages, requests: 0, version: 1, published: Vec::new() }
    }

    /// Starts the server with an open folder.
    pub(crate) fn in_folder(folder: &Path) -> Editor {
        let mut editor = Editor::start();
        let snippets = json!({ "completion": { "completionItem": { "snippetSupport": true } } });
        let folders = json!([{ "uri": uri(folder), "name": "project" }]);
        let params = json!({
            "processId": null, "rootUri": null, "workspaceFolders": folders,
            "capabilities": { "textDocument": snippets }, "initializationOptions": { "pictures": true },
        });
        let answer = editor.ask("initialize", &params);
        assert_eq!(answer["result"]["serverInfo"]["name"], "lipz");
        editor.tell("initialized", &json!({}));
        editor
    }

    /// Sends bytes unchanged.
    pub(crate) fn send_bytes(&mut self, bytes: &[u8]) {
        // A server that has ended does not read. Its earlier output shows the reason.
        let _ = self.input.write_all(bytes).and_then(|()| self.input.flush());
    }

    /// Sends a message.
    pub(crate) fn send(&mut self, message: &Value) {
        let text = message.to_string();
        self.send_bytes(format!("Content-Length: {}\r\n\r\n{text}", text.len()).as_bytes());
    }

    pub(crate) fn tell(&mut self, method: &str, params: &Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    /// Sends a request, and waits for its answer.
    pub(crate) fn ask(&mut self, method: &str, params: &Value) -> Value {
        self.requests += 1;
        let id = self.requests;
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }));
        self.wait(|message| message["id"] == id && message.get("method").is_none())
    }

    /// Waits for the first message of this kind.
    pub(crate) fn wait(&mut self, mut is_meant: impl FnMut(&Value) -> bool) -> Value {
        let mut others = String::new();
        loop {
            match self.messages.recv_timeout(PATIENCE) {
                Ok(message) if is_meant(&message) => return message,
                Ok(message) => others += &format!("\n{message:.400}"),
                Err(error) => panic!("{error}, after{others}"),
            }
        }
    }

    /// Waits until the diagnostics of a file meet a condition, and returns them.
    pub(crate) fn diagnostics(&mut self, path: &Path, mut are_meant: impl FnMut(&[Value]) -> bool) -> Vec<Value> {
        let uri = uri(path);
        let message = self.wait(|message| {
            let params = &message["params"];
            message["method"] == "textDocument/publishDiagnostics"
                && params["uri"] == uri.as_str()
                && are_meant(params["diagnostics"].as_array().unwrap())
        });
        message["params"]["diagnostics"].as_array().unwrap().clone()
    }

    /// Waits until the diagnostics of a file are published, in any order with those of others.
    pub(crate) fn diagnostics_of(&mut self, path: &Path) {
        let uri = uri(path);
        while !self.published.contains(&uri) {
            self.published_next();
        }
    }

    /// Waits until the diagnostics of a file are published, and gives all files whose diagnostics were until then, and
    /// shortly after.
    pub(crate) fn published_until(&mut self, path: &Path) -> Vec<String> {
        let uri = uri(path);
        self.published.clear();
        while !self.published.contains(&uri) {
            self.published_next();
        }
        while let Ok(message) = self.messages.recv_timeout(Duration::from_millis(500)) {
            self.published.extend(message["params"]["uri"].as_str().map(str::to_owned));
        }
        self.published.clone()
    }

    fn published_next(&mut self) {
        let message = self.wait(|message| message["method"] == "textDocument/publishDiagnostics");
        self.published.extend(message["params"]["uri"].as_str().map(str::to_owned));
    }

    /// Opens a file with this text.
    pub(crate) fn open(&mut self, path: &Path, text: &str) {
        let document = json!({ "uri": uri(path), "languageId": "lipz", "version": self.version, "text": text });
        self.tell("textDocument/didOpen", &json!({ "textDocument": document }));
    }

    /// Replaces a range, `[line, character, line, character]`.
    pub(crate) fn change(&mut self, path: &Path, range: [u32; 4], text: &str) {
        self.version += 1;
        let [line, character, last_line, end] = range;
        let range = json!({ "start": { "line": line, "character": character }, "end": { "line": last_line, "character": end } });
        let document = json!({ "uri": uri(path), "version": self.version });
        let changes = json!([{ "range": range, "text": text }]);
        self.tell("textDocument/didChange", &json!({ "textDocument": document, "contentChanges": changes }));
    }

    /// Sends a request about a position.
    pub(crate) fn ask_at(&mut self, method: &str, path: &Path, line: u32, character: u32, more: &Value) -> Value {
        let position = json!({ "line": line, "character": character });
        let mut params = json!({ "textDocument": { "uri": uri(path) }, "position": position });
        params.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        self.ask(method, &params)
    }

    /// Shuts the server down and returns its exit code.
    pub(crate) fn end(mut self) -> i32 {
        assert_eq!(self.ask("shutdown", &Value::Null)["result"], Value::Null);
        self.tell("exit", &Value::Null);
        self.exit_code()
    }

    /// Waits for the server to end.
    pub(crate) fn exit_code(mut self) -> i32 {
        drop(self.input);
        self.server.wait().unwrap().code().unwrap()
    }
}

/// Returns the next message of the server, or `None` after its end.
fn read(output: &mut impl BufRead) -> Option<Value> {
    let mut length = 0;
    loop {
        let mut line = String::new();
        if output.read_line(&mut line).unwrap() == 0 {
            return None;
        }
        match line.trim_end().split_once(": ") {
            Some(("Content-Length", number)) => length = number.parse().unwrap(),
            Some(_) => {}
            None => break,
        }
    }
    let mut bytes = vec![0; length];
    output.read_exact(&mut bytes).unwrap();
    Some(serde_json::from_slice(&bytes).unwrap())
}
