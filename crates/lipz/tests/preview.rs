//! `lipz preview` as its own page and foreign pages see it: its responses, and the files that it writes.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use serde_json::{Value, json};
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::process::{Child, Command, Stdio};
use std::time::Duration;
use support::{Scene, lipz};

const MAYOR: &str = "{\n  \"visemes\": \"MAAAEO--|MAAEEO--\",\n  \"text_en-us\": \"Mayor?|Mayor!\", \"note\": 1,\n  \
                     \"fps\": 24, \"viseme_type\": \"blair\"\n}\n";

/// A preview that runs until the end of the test.
struct Running {
    process: Child,
    port: u16,
    token: String,
}

/// The response to a request.
struct Answer {
    status: u16,
    head: String,
    body: Vec<u8>,
}

impl Running {
    fn start(scene: &Scene, arguments: &[&str]) -> Running {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lipz"));
        command.arg("preview").args(arguments).current_dir(scene.path());
        let mut process = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(process.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let rest = line.trim().strip_prefix("http://127.0.0.1:").unwrap();
        let (port, token) = rest.trim_end_matches('/').split_once('/').unwrap();
        Running { process, port: port.parse().unwrap(), token: token.to_owned() }
    }

    /// Sends a request with these headers, in addition to those for its length.
    fn send(&self, method: &str, path: &str, headers: &[(&str, &str)], body: &str) -> Answer {
        let headers: String = headers.iter().map(|(name, value)| format!("{name}: {value}\r\n")).collect();
        let length = body.len();
        self.say(&format!(
            "{method} {path} HTTP/1.1\r\n{headers}Connection: close\r\nContent-Length: {length}\r\n\r\n{body}"
        ))
    }

    /// Sends exactly these bytes.
    fn say(&self, request: &str) -> Answer {
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

    fn host(&self) -> String {
        format!("127.0.0.1:{}", self.port)
    }

    fn get(&self, path: &str) -> Answer {
        self.send("GET", &format!("/{}/{path}", self.token), &[("Host", &self.host())], "")
    }

    fn post(&self, path: &str, change: &Value) -> Answer {
        let origin = format!("http://{}", self.host());
        let headers = [("Host", self.host()), ("Origin", origin)];
        let headers = headers.each_ref().map(|(name, value)| (*name, value.as_str()));
        self.send("POST", &format!("/{}/{path}", self.token), &headers, &change.to_string())
    }
}

impl Answer {
    fn json(&self) -> Value {
        let json = serde_json::from_slice(&self.body);
        assert!(json.is_ok(), "{}", String::from_utf8_lossy(&self.body));
        json.unwrap()
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

fn project() -> Scene {
    let scene = Scene::new();
    scene.write("voices/act1/mayor.lipz", MAYOR);
    scene.write("voices/act1/otto.lipz", r#"{ "visemes": "MA", "text_en-us": "No|Yes", "fps": 24 }"#);
    scene
}

/// Returns the file of the mayor's clip.
fn mayor(scene: &Scene) -> String {
    fs::read_to_string(scene.path().join("voices/act1/mayor.lipz")).unwrap()
}

/// Returns a change of the mayor's clip.
fn change(source: &str, elements: &Value) -> Value {
    json!({ "key": "act1/mayor", "source": source, "elements": elements })
}

#[test]
fn the_page_gets_the_bank_that_a_game_gets() {
    let scene = project();
    let preview = Running::start(&scene, &["voices"]);
    let page = preview.get("");
    assert_eq!(page.status, 200);
    assert!(page.head.contains("frame-ancestors 'none'"), "{}", page.head);
    let list = preview.get("api/clips").json();
    let keys: Vec<&str> = list["clips"].as_array().unwrap().iter().map(|clip| clip["key"].as_str().unwrap()).collect();
    assert_eq!(keys, ["act1/mayor", "act1/otto"]);
    assert_eq!(list["clips"][1]["is_left_out"], true, "it has an error: {list}");
    assert_eq!(list["clips"][1]["errors"], 1);
    let clip = preview.get("api/clip?key=act1%2Fotto").json();
    assert_eq!(clip["diagnostics"][0]["code"], "LZ0601", "{clip}");
    fs::remove_file(scene.path().join("voices/act1/otto.lipz")).unwrap();
    assert_eq!(lipz(scene.path(), ["pack", "voices", "-o", "a.lipzbank"]).code, 0);
    assert_eq!(preview.get("api/bank").body, fs::read(scene.path().join("a.lipzbank")).unwrap());
    assert_eq!(preview.get("api/clip?key=nobody").status, 404);
    assert_eq!(preview.get("api/sound?key=act1%2Fmayor").status, 404);
    assert_eq!(preview.get("../../../../etc/passwd").status, 404);
    assert_eq!(preview.get("web/lipz.wasm").body.get(..4), Some(&b"\0asm"[..]));
}

/// Characters come from events, from `{speaker: …}` in texts, from words of keys, and for dubs from their originals.
/// The same applies to a bank.
#[test]
fn the_list_knows_who_is_in_a_clip() {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n[registry]\ncharacters = [\"Ivo\", \"Old_Man\", \"mara\", \"otto\"]\n[voices]\nen-us = \"en/{key}\"\nde-de = \"de/{key}\"\n");
    let clip = |text: &str, events: &str| {
        format!(r#"{{ "visemes": "MA--|EO--", "fps": 24, "text_en-us": "{text}", "events": "{events}" }}"#)
    };
    scene.write("voices/en/one.lipz", clip("{speaker: Mara} Hi.|Well.", "otto feels sad|"));
    scene.write("voices/en/otto/two.lipz", clip("Hi.|{speaker:} {speaker: Ärzte} Well.", "|"));
    scene.write("voices/en/three-IVO_x.lipz", clip("Hi.|Ivory.", "|"));
    scene.write("voices/en/ivory.lipz", clip("Hi.|Well.", "|"));
    scene.write("voices/en/old-man_the-queen.lipz", clip("Hi.|Well.", "old-mill feels sad|"));
    scene.write("voices/en/old_mill-man/queen.lipz", clip("Hi.|Well.", "|"));
    scene.write("voices/en/queen.lipz", clip("{speaker: The Queen} Hi.|Well.", "|"));
    scene.write("voices/de/one.lipz", r#"{ "visemes": "MA--|EO--", "fps": 24 }"#);
    scene.write("voices/en/broken-mara.lipz", "{");
    let of = |preview: &Running| {
        let list = preview.get("api/clips").json();
        let row = |clip: &Value| format!("{} {}", clip["key"].as_str().unwrap(), clip["characters"]);
        list["clips"].as_array().unwrap().iter().map(row).collect::<Vec<_>>()
    };
    let found = of(&Running::start(&scene, &[]));
    let expected = [
        r#"de/one ["mara","otto"]"#,
        r#"en/broken-mara ["mara"]"#,
        "en/ivory null",
        r#"en/old-man_the-queen ["Old_Man","The Queen","old-mill"]"#,
        r#"en/old_mill-man/queen ["old-mill"]"#,
        r#"en/one ["mara","otto"]"#,
        r#"en/otto/two ["otto","Ärzte"]"#,
        r#"en/queen ["The Queen"]"#,
        r#"en/three-IVO_x ["Ivo"]"#,
    ];
    assert_eq!(found, expected);
    fs::remove_file(scene.path().join("voices/en/broken-mara.lipz")).unwrap();
    assert_eq!(lipz(scene.path(), ["pack", "-o", "a.lipzbank"]).code, 0);
    let of_bank = of(&Running::start(&scene, &["a.lipzbank"]));
    assert_eq!(of_bank[0], r#"de/one ["Mara","otto"]"#, "only the text spells her name");
}

#[test]
fn pages_of_others_neither_read_nor_write() {
    let scene = project();
    let preview = Running::start(&scene, &["voices"]);
    let own = preview.host();
    let path = |path: &str| format!("/{}/{path}", preview.token);
    let evil = ("Origin", "http://evil.example");
    let save = change(MAYOR, &json!({ "events": "a|b" })).to_string();
    let refused = [
        preview.send("GET", "/api/clips", &[("Host", &own)], ""),
        preview.send("GET", "/", &[("Host", &own)], ""),
        preview.send("GET", &path("api/clips"), &[("Host", "evil.example")], ""),
        preview.send("GET", &path("api/clips"), &[("Host", &own), evil], ""),
        preview.send("GET", &path("api/bank"), &[("Host", &own), ("Sec-Fetch-Site", "cross-site")], ""),
        preview.send("POST", &path("api/save"), &[("Host", &own)], &save),
        preview.send("POST", &path("api/save"), &[("Host", &own), evil], &save),
        preview.send("POST", &path("api/save"), &[("Host", &own), ("Origin", "null")], &save),
        preview.send("POST", "/00000000000000000000000000000000/api/save", &[("Host", &own)], &save),
        preview.send("OPTIONS", &path("api/save"), &[("Host", &own), evil], ""),
    ];
    for answer in refused {
        assert_eq!(answer.status, 403, "{}", answer.head);
        assert!(!answer.head.to_lowercase().contains("access-control"), "{}", answer.head);
        assert!(!String::from_utf8_lossy(&answer.body).contains("mayor"));
    }
    assert_eq!(mayor(&scene), MAYOR);
}

#[test]
fn changes_are_written_as_the_file_is_laid_out() {
    let scene = project();
    let preview = Running::start(&scene, &["voices"]);
    let edit = change(MAYOR, &json!({ "visemes": "MAAAEE--|MAAEEO--", "text_de-de": "Meister?|Meister!" }));
    let draft = preview.post("api/draft", &edit);
    let length = u32::from_le_bytes(draft.body[..4].try_into().unwrap()) as usize;
    let document: Value = serde_json::from_slice(&draft.body[4..4 + length]).unwrap();
    assert_eq!(document["result"], "draft", "{document}");
    assert!(lipz_bank::Bank::open(&draft.body[4 + length..]).unwrap().clip_by_key("act1/mayor").is_some());
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

/// Returns the JSON part of a draft's response, and its bank.
fn drafted(answer: &Answer) -> (Value, &[u8]) {
    let length = u32::from_le_bytes(answer.body[..4].try_into().unwrap()) as usize;
    (serde_json::from_slice(&answer.body[4..4 + length]).unwrap(), &answer.body[4 + length..])
}

#[test]
fn of_a_clip_with_errors_what_is_right_is_shown() {
    let scene = project();
    let preview = Running::start(&scene, &["voices"]);
    let edit = json!({ "text_de-de": "Meister?", "text_fr-fr": "Maire ?|Maire !" });
    let answer = preview.post("api/draft", &change(MAYOR, &edit));
    let (document, bank) = drafted(&answer);
    assert_eq!(document["diagnostics"][0]["code"], "LZ0601", "{document}");
    let bank = lipz_bank::Bank::open(bank).unwrap();
    let tags: Vec<&str> = bank.locales().map(|locale| bank.locale_tag(locale)).collect();
    assert_eq!(tags, ["en-us", "fr-fr"], "a text with too few segments is omitted");
    assert_eq!(bank.clip_by_key("act1/mayor").unwrap().segments().count(), 2);
    let answer = preview.post("api/draft", &change("{ \"visemes\": 1 ", &json!({})));
    assert_eq!(drafted(&answer).0["result"], "refused", "no document, no draft");
}

const DUBBED: &str = "sources = [\"v\"]\nroot = \"v\"\ndefault-locale = \"en-us\"\n[voices]\nen-us = \"{key}\"\n\
                      de-de = \"de/{key}\"\n[lints]\nwarnings = \"deny\"\n";
const DUB: &str = r#"{ "fps": 24, "viseme_type": "blair", "visemes": "AAA-" }"#;

/// Returns a project with a dub whose original has these visemes.
fn dubbed(visemes: &str) -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", DUBBED);
    let rest = r#""text_en-us": "Aye!", "text_de-de": "Ja!""#;
    let original = format!(r#"{{ "fps": 24, "viseme_type": "blair", "visemes": "{visemes}", {rest} }}"#);
    scene.write("v/aye.lipz", original);
    scene.write("v/de/aye.lipz", DUB);
    scene
}

#[test]
fn a_dub_is_packed_with_its_original() {
    let scene = dubbed("MA-");
    let preview = Running::start(&scene, &[]);
    let edit = json!({ "key": "de/aye", "source": DUB, "elements": { "visemes": "EAA-" } });
    let answer = preview.post("api/draft", &edit);
    let (document, bank) = drafted(&answer);
    assert_eq!(document["diagnostics"], json!([]));
    let bank = lipz_bank::Bank::open(bank).unwrap();
    let segment = bank.clip_by_key("de/aye").unwrap().segments().next().unwrap();
    assert_eq!(segment.text(bank.locale("de-de").unwrap()).unwrap().as_str(), "Ja!");
    assert_eq!(preview.post("api/save", &edit).json()["result"], "saved");
}

#[test]
fn a_dub_is_not_to_blame_for_its_original() {
    let scene = dubbed("M?-");
    let preview = Running::start(&scene, &[]);
    let edit = json!({ "key": "de/aye", "source": DUB, "elements": { "visemes": "EAA-" } });
    let answer = preview.post("api/draft", &edit);
    let (document, bank) = drafted(&answer);
    assert_eq!(document["diagnostics"], json!([]));
    let bank = lipz_bank::Bank::open(bank).unwrap();
    let segment = bank.clip_by_key("de/aye").unwrap().segments().next().unwrap();
    assert_eq!(segment.text(bank.locale("de-de").unwrap()).unwrap().as_str(), "Ja!", "its texts are right");
    let wrong = json!({ "key": "de/aye", "source": DUB, "elements": { "visemes": "E?A-" } });
    assert_eq!(preview.post("api/save", &wrong).json()["diagnostics"][0]["code"], "LZ0401", "its own errors count");
    assert_eq!(preview.post("api/save", &edit).json()["result"], "saved");
    assert!(fs::read_to_string(scene.path().join("v/de/aye.lipz")).unwrap().contains("EAA-"));
    // An original that is not valid JSON cannot be compared.
    scene.write("v/aye.lipz", "{ \"fps\": ");
    let source = fs::read_to_string(scene.path().join("v/de/aye.lipz")).unwrap();
    let edit = json!({ "key": "de/aye", "source": source, "elements": { "visemes": "OAA-" } });
    assert_eq!(preview.post("api/save", &edit).json()["result"], "saved");
}

#[test]
fn texts_in_files_of_their_own_are_shown() {
    let scene = project();
    fs::remove_file(scene.path().join("voices/act1/otto.lipz")).unwrap();
    let file = MAYOR.replace("\"note\"", "\"text_de-de\": \"Meister?|Meister!\", \"note\"");
    scene.write("voices/act1/mayor.lipz", file);
    scene.prepare(&["pack", "voices", "-o", "a.lipzbank", "--config", "split-locales=true"]);
    let preview = Running::start(&scene, &["a.lipzbank+a.*.lipztexts"]);
    assert_eq!(preview.get("api/clips").json()["locales"], json!(["de-de", "en-us"]));
    let bytes = preview.get("api/bank").body;
    let bank = lipz_bank::Bank::open(&bytes).unwrap().verify().unwrap();
    let segment = bank.clip_by_key("act1/mayor").unwrap().segment(1).unwrap();
    assert_eq!(segment.text(bank.locale("de-de").unwrap()).unwrap().as_str(), "Meister!");
    let refused = lipz(scene.path(), ["preview", "voices+a.de-de.lipztexts"]);
    assert!(refused.code == 2 && refused.stderr.contains("`voices`"), "{refused:?}");
}

#[test]
fn of_one_file_the_rest_of_the_project_is_not_missed() {
    let scene = project();
    let samples = [0_i16; 8000];
    for name in ["mayor", "nobody"] {
        scene.write(&format!("recordings/act1/{name}.wav"), support::sound::wav(16_000, &samples));
    }
    let told = |source: &str| {
        let preview = Running::start(&scene, &[source, "--config", "root=voices", "--audio", "recordings"]);
        // The first version is 0. If the recordings have been compared before the first request, no later change
        // follows.
        preview.get("api/changes?since=0");
        preview.get("api/clips").json()["diagnostics"].to_string()
    };
    assert!(told("voices").contains("LZ1702"));
    let single = told("voices/act1/mayor.lipz");
    assert!(!single.contains("LZ1702"), "{single}");
}

/// Returns a project with a recording of a sentence.
fn recorded() -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n[audio]\nfolder = \"rec\"\n");
    scene.write("rec/bobby.wav", fs::read(support::repository().join("fixtures/speech/bobby.wav")).unwrap());
    scene.write("voices/bobby.lipz", "{ \"text_en-us\": \"Bobby ripped the ledger.\" }");
    scene
}

#[test]
fn the_phones_of_a_synced_clip_are_known() {
    let scene = recorded();
    let preview = Running::start(&scene, &[]);
    assert_eq!(preview.get("api/phones?key=bobby").json(), json!([]), "nothing was synced");
    drop(preview);
    scene.prepare(&["sync", "--config", "sync.textgrids=grids", "--quiet"]);
    let phones = |options: &[&str]| Running::start(&scene, options).get("api/phones?key=bobby").json();
    let heard = phones(&[]);
    let names: Vec<&str> = heard.as_array().unwrap().iter().map(|found| found["phone"].as_str().unwrap()).collect();
    assert!(names.starts_with(&["B", "AA"]) && names.contains(&"JH"), "{heard}");
    let grid = fs::read_to_string(scene.path().join("grids/bobby.TextGrid")).unwrap();
    let from_grid = grid.lines().filter(|line| line.trim() == "text = \"JH\"").count();
    assert_eq!(names.iter().filter(|name| **name == "JH").count(), from_grid, "as in the TextGrid");
    // Manual corrections take precedence.
    let settings = fs::read_to_string(scene.path().join("lipz.toml")).unwrap();
    scene.write("lipz.toml", settings + "[sync]\ntextgrids = \"grids\"\n");
    scene.write("grids/bobby.TextGrid", grid.replace("\"JH\"", "\"ZH\""));
    assert!(phones(&[]).to_string().contains("\"ZH\""));
    // An exported page contains them.
    assert_eq!(lipz(scene.path(), ["preview", "--output", "site"]).code, 0);
    let clip = fs::read_to_string(scene.path().join("site/data/clip-0.js")).unwrap();
    assert!(clip.contains(r#""phones":[{"phone":"B","#) && clip.contains("\"ZH\""), "{clip}");
    // Another take, which lipz has not analysed yet.
    scene.write("rec/bobby.wav", support::sound::voice(&[(true, 900)], 2));
    assert_eq!(phones(&[]), json!([]));
}

#[test]
fn recordings_are_named_on_the_command_line_too() {
    let scene = project();
    let samples: Vec<i16> = (0..8000).map(|at| if at % 80 < 40 { 900 } else { -900 }).collect();
    scene.write("recordings/act1/mayor.wav", support::sound::wav(16_000, &samples));
    let preview = Running::start(&scene, &["voices", "--audio", "recordings"]);
    assert_eq!(preview.get("api/clips").json()["clips"][0]["has_sound"], true);
    assert_eq!(preview.get("api/sound?key=act1%2Fmayor").body.get(..4), Some(&b"RIFF"[..]));
    fs::remove_file(scene.path().join("voices/act1/otto.lipz")).unwrap();
    scene.prepare(&["pack", "voices", "-o", "a.lipzbank"]);
    let bank = Running::start(&scene, &["a.lipzbank", "--audio", "recordings"]);
    assert_eq!(bank.get("api/clips").json()["clips"][0]["has_sound"], true);
    assert_eq!(bank.get("api/clip?key=act1%2Fmayor").json()["has_sound"], true);
    assert_eq!(bank.get("api/sound?key=act1%2Fmayor").status, 200);
    assert_eq!(lipz(scene.path(), ["preview", "a.lipzbank", "--audio", "nowhere"]).code, 2);
}

#[test]
fn what_somebody_else_wrote_is_kept() {
    let scene = project();
    let preview = Running::start(&scene, &["voices"]);
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
    let preview = Running::start(&scene, &["voices"]);
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
    let preview = Running::start(&scene, &["voices", "--read-only"]);
    let answer = preview.post("api/save", &change(MAYOR, &json!({ "events": "a|b" })));
    assert_eq!((answer.status, &answer.json()["result"]), (403, &json!("refused")));
    assert_eq!(preview.get("api/clips").json()["is_read_only"], true);
    assert_eq!(mayor(&scene), MAYOR);
    fs::remove_file(scene.path().join("voices/act1/otto.lipz")).unwrap();
    scene.prepare(&["pack", "voices", "-o", "a.lipzbank"]);
    let bank = Running::start(&scene, &["a.lipzbank"]);
    assert_eq!(bank.get("api/clips").json()["clips"][0]["key"], "act1/mayor");
    assert_eq!(bank.get("api/clip?key=act1%2Fmayor").json()["path"], Value::Null);
}

#[test]
fn a_change_that_is_too_long_is_refused_with_a_word() {
    let preview = Running::start(&project(), &["voices"]);
    let (host, token) = (preview.host(), &preview.token);
    for length in [u64::from(u32::MAX), u64::MAX / 2] {
        let answer = preview.say(&format!(
            "POST /{token}/api/save HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nContent-Length: {length}\r\n\r\n{{"
        ));
        assert_eq!((answer.status, answer.head.contains("Content Too Large")), (413, true));
        assert_eq!(String::from_utf8(answer.body).unwrap(), "The change exceeds the size limit of a Lipz file.\n");
    }
}

#[test]
fn what_cannot_be_served_is_told() {
    let scene = project();
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let outcome = lipz(scene.path(), ["preview", "voices", "--port", &port]);
    assert_eq!(outcome.code, 2);
    assert!(outcome.stderr.contains("name a different port"), "{}", outcome.stderr);
    assert_eq!(lipz(scene.path(), ["preview", "-"]).code, 2);
    let missing = lipz(scene.path(), ["preview", "missing.lipzbank"]);
    assert_eq!(missing.code, 2, "{}", missing.stderr);
}

#[test]
fn keys_with_spaces_and_signs_are_kept_apart() {
    let scene = Scene::new();
    for key in ["a b", "a+b", "ä&c"] {
        let file = format!(r#"{{ "visemes": "MA", "fps": 24, "text_en-us": "{key}" }}"#);
        scene.write(&format!("v/{key}.lipz"), file);
    }
    let preview = Running::start(&scene, &["v"]);
    // As pages encode them, in both forms.
    for (query, key) in [("a+b", "a b"), ("a%20b", "a b"), ("a%2Bb", "a+b"), ("%C3%A4%26c", "ä&c")] {
        let clip = preview.get(&format!("api/clip?key={query}")).json();
        assert_eq!(clip["key"], key);
        assert_eq!(clip["elements"][1], json!(["text_en-us", key]), "{clip}");
    }
}

/// A client without permission cannot make the server read a body, because the response comes before the body.
#[test]
fn bodies_of_others_are_not_read() {
    let scene = project();
    let preview = Running::start(&scene, &["voices"]);
    let mut stream = TcpStream::connect(("127.0.0.1", preview.port)).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
    stream.write_all(b"POST /wrong/x HTTP/1.1\r\nHost: x\r\nContent-Length: 400000000\r\n\r\n").unwrap();
    let part = vec![0; 1 << 20];
    // The server closes the connection long before all of it is sent.
    let sent = (0..400).take_while(|_| stream.write_all(&part).is_ok()).count();
    assert!(sent < 100, "{sent} MiB were taken");
    let began = std::time::Instant::now();
    let mut garbage = TcpStream::connect(("127.0.0.1", preview.port)).unwrap();
    garbage.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
    garbage.write_all(b"\x16\x03\x01 no request").unwrap();
    let _ = garbage.read_to_end(&mut Vec::new());
    assert!(began.elapsed() < Duration::from_secs(5), "what is no request is not waited for");
}

/// A name of a recording may be a link to anything.
#[cfg(unix)]
#[test]
fn only_audio_gets_into_a_page_and_nothing_is_written_through_links() {
    let scene = project();
    fs::remove_file(scene.path().join("voices/act1/otto.lipz")).unwrap();
    scene.write("secret.txt", "root:x:0:0");
    fs::create_dir_all(scene.path().join("recordings/act1")).unwrap();
    let recording = scene.path().join("recordings/act1/mayor.wav");
    std::os::unix::fs::symlink(scene.path().join("secret.txt"), &recording).unwrap();
    let preview = Running::start(&scene, &["voices", "--audio", "recordings"]);
    let answer = preview.get("api/sound?key=act1%2Fmayor");
    assert_eq!(answer.status, 404);
    assert!(String::from_utf8_lossy(&answer.body).contains("LZ1704"), "{}", String::from_utf8_lossy(&answer.body));
    let export = ["preview", "voices", "--config", "root=voices", "--audio", "recordings", "-o", "site"];
    let exported = lipz(scene.path(), export);
    assert!(exported.code == 1 && exported.stderr.contains("LZ1704"), "{exported:?}");
    assert!(exported.stdout.contains("1 clip, 0 recordings"), "{exported:?}");
    assert!(!scene.path().join("site/data/sound-0.js").exists());
    // A link to audio is right.
    scene.write("elsewhere.wav", support::sound::wav(16_000, &[0; 8000]));
    fs::remove_file(&recording).unwrap();
    std::os::unix::fs::symlink(scene.path().join("elsewhere.wav"), &recording).unwrap();
    assert!(lipz(scene.path(), export).stdout.contains("1 clip, 1 recording"));

    let index = scene.path().join("site/index.html");
    fs::remove_file(&index).unwrap();
    std::os::unix::fs::symlink(scene.path().join("secret.txt"), &index).unwrap();
    let refused = lipz(scene.path(), export);
    assert!(refused.code == 2 && refused.stderr.contains("is a link"), "{refused:?}");
    assert_eq!(fs::read_to_string(scene.path().join("secret.txt")).unwrap(), "root:x:0:0");
}

/// A pipe in place of a file would hold a request forever.
#[cfg(unix)]
#[test]
fn a_file_that_became_a_pipe_is_refused() {
    let scene = project();
    let preview = Running::start(&scene, &["voices"]);
    let path = scene.path().join("voices/act1/mayor.lipz");
    fs::remove_file(&path).unwrap();
    assert!(Command::new("mkfifo").arg(&path).status().unwrap().success());
    let edit = change(MAYOR, &json!({ "visemes": "MAAAEE--|MAAEEO--" }));
    let saved = preview.post("api/save", &edit).json();
    assert_eq!(saved["result"], "refused", "{saved}");
}

#[test]
fn a_retake_is_noticed() {
    let scene = project();
    fs::remove_file(scene.path().join("voices/act1/otto.lipz")).unwrap();
    scene.write("recordings/act1/mayor.wav", support::sound::wav(16_000, &[0; 8000]));
    let preview = Running::start(&scene, &["voices", "--config", "root=voices", "--audio", "recordings"]);
    let settled = |mut version: u64| loop {
        let next = preview.get("api/clips").json()["version"].as_u64().unwrap();
        if next == version {
            return version;
        }
        version = next;
        std::thread::sleep(Duration::from_millis(1500));
    };
    let before = settled(u64::MAX);
    scene.write("recordings/act1/mayor.wav", support::sound::wav(16_000, &[0; 4000]));
    let changed = preview.get(&format!("api/changes?since={before}")).json()["version"].as_u64();
    assert_ne!(changed, Some(before), "the page hears of it");
}
