//! `lipz preview` as foreign pages and programs see it, and files that it does not serve.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use serde_json::json;
use std::fs;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::Duration;
use support::lipz;
use support::preview::{MAYOR, Preview, change, mayor, project};

#[test]
fn pages_of_others_neither_read_nor_write() {
    let scene = project();
    let preview = Preview::start(&scene, &["voices"]);
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

/// A client without permission cannot make the server read a body, because the response comes before the body.
#[test]
fn bodies_of_others_are_not_read() {
    let scene = project();
    let preview = Preview::start(&scene, &["voices"]);
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
    let preview = Preview::start(&scene, &["voices", "--audio", "recordings"]);
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

    // Nor is a folder created where a link leads.
    fs::remove_file(&index).unwrap();
    fs::create_dir(scene.path().join("other")).unwrap();
    fs::remove_dir_all(scene.path().join("site/page")).unwrap();
    std::os::unix::fs::symlink(scene.path().join("other"), scene.path().join("site/page")).unwrap();
    let refused = lipz(scene.path(), export);
    assert!(refused.code == 2 && refused.stderr.contains("`site/page` is a link"), "{refused:?}");
    assert_eq!(fs::read_dir(scene.path().join("other")).unwrap().count(), 0);
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
    scene.write("notes.txt", "");
    let file = lipz(scene.path(), ["preview", "voices", "-o", "notes.txt/site"]);
    assert!(file.code == 2 && file.stderr.contains("because `notes.txt` is a file"), "{file:?}");
    let missing = lipz(scene.path(), ["preview", "missing.lipzbank"]);
    assert_eq!(missing.code, 2, "{}", missing.stderr);
}
