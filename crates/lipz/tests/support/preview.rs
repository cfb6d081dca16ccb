//! A running `lipz preview`, and requests to it.

use super::Scene;
use serde_json::{Value, json};
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// The file of a clip with a note, which is not an element of the format.
pub(crate) const MAYOR: &str = "{\n  \"visemes\": \"MAAAEO--|MAAEEO--\",\n  \"text_en-us\": \"Mayor?|Mayor!\", \"note\": 1,\n  \
                     \"fps\": 24, \"viseme_type\": \"blair\"\n}\n";

/// A preview that runs until the end of the test.
pub(crate) struct Preview {
    process: Child,
    pub(crate) port: u16,
    pub(crate) token: String,
}

/// The response to a request.
pub(crate) struct Answer {
    pub(crate) status: u16,
    pub(crate) head: String,
    pub(crate) body: Vec<u8>,
}

impl Preview {
    pub(crate) fn start(scene: &Scene, arguments: &[&str]) -> Preview {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lipz"));
        command.arg("preview").args(arguments).current_dir(scene.path());
        let mut process = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(process.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let rest = line.trim().strip_prefix("http://127.0.0.1:").unwrap();
        let (port, token) = rest.trim_end_matches('/').split_once('/').unwrap();
        Preview { process, port: port.parse().unwrap(), token: token.to_owned() }
    }

    /// Sends a request with these headers, in addition to those for its length.
    pub(crate) fn send(&self, method: &str, path: &str, headers: &[(&str, &str)], body: &str) -> Answer {
        let headers: String = headers.iter().map(|(name, value)| format!("{name}: {value}\r\n")).collect();
        let length = body.len();
        self.say(&format!(
            "{method} {path} HTTP/1.1\r\n{headers}Connection: close\r\nContent-Length: {length}\r\n\r\n{body}"
        ))
    }

    /// Sends exactly these bytes.
    pub(crate) fn say(&self, request: &str) -> Answer {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
        stream.write_all(request.as_bytes()).unwrap();
        stream.shutdown(Shutdown::Write).unwrap();
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
        let split = bytes.windows(4).position(|four| four == b"\r\n\r\n").unwrap();
        let head = String::from_utf8(bytes[..split].to_vec()).unwrap();
        let status = head.split(' ').nth(1).unwrap().parse().unwrap();
        Answer { status, head, body: bytes[split + 4..].to_vec() }
    }

    pub(crate) fn host(&self) -> String {
        format!("127.0.0.1:{}", self.port)
    }

    pub(crate) fn get(&self, path: &str) -> Answer {
        self.send("GET", &format!("/{}/{path}", self.token), &[("Host", &self.host())], "")
    }

    pub(crate) fn post(&self, path: &str, change: &Value) -> Answer {
        let origin = format!("http://{}", self.host());
        let headers = [("Host", self.host()), ("Origin", origin)];
        let headers = headers.each_ref().map(|(name, value)| (*name, value.as_str()));
        self.send("POST", &format!("/{}/{path}", self.token), &headers, &change.to_string())
    }
}

impl Answer {
    pub(crate) fn json(&self) -> Value {
        let json = serde_json::from_slice(&self.body);
        assert!(json.is_ok(), "{}", String::from_utf8_lossy(&self.body));
        json.unwrap()
    }

    /// Returns the JSON part of a draft's response, and its bank.
    pub(crate) fn drafted(&self) -> (Value, &[u8]) {
        let length = u32::from_le_bytes(self.body[..4].try_into().unwrap()) as usize;
        (serde_json::from_slice(&self.body[4..4 + length]).unwrap(), &self.body[4 + length..])
    }
}

impl Drop for Preview {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

pub(crate) fn project() -> Scene {
    let scene = Scene::new();
    scene.write("voices/act1/mayor.lipz", MAYOR);
    scene.write("voices/act1/otto.lipz", r#"{ "visemes": "MA", "text_en-us": "No|Yes", "fps": 24 }"#);
    scene
}

/// Returns the file of the mayor's clip.
pub(crate) fn mayor(scene: &Scene) -> String {
    fs::read_to_string(scene.path().join("voices/act1/mayor.lipz")).unwrap()
}

/// Returns a change of the mayor's clip.
pub(crate) fn change(source: &str, elements: &Value) -> Value {
    json!({ "key": "act1/mayor", "source": source, "elements": elements })
}
