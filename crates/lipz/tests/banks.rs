//! Diagnostics about banks and outputs: damaged banks, keys that lead out of a folder, existing files. A failed command
//! leaves the file system unchanged.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use lipz_layout::Tag;
use std::fs;
use std::os::unix::fs::symlink;
use support::forge::{bank_with_key, seal, section};
use support::{Scene, lipz, tree};

/// Returns a scene with a bank `b.lipzbank` of two clips, `act1/aye` and `no`.
fn scene() -> Scene {
    let scene = Scene::new();
    scene.write("voices/act1/aye.lipz", r#"{ "fps": 24, "visemes": "AEE-", "text_en-us": "{nods} Aye." }"#);
    scene.write("voices/no.lipz", r#"{ "text_en-us": "No.", "text_ja-jp": "いいえ。", "events": "sighs" }"#);
    scene.prepare(&["pack", "voices", "-o", "b.lipzbank", "--quiet"]);
    scene
}

fn bank(scene: &Scene) -> Vec<u8> {
    fs::read(scene.path().join("b.lipzbank")).unwrap()
}

#[test]
fn files_that_are_no_banks() {
    let mut scene = scene();
    let whole = bank(&scene);
    scene.write("text.lipzbank", "Otto: Aye.\nMara: No.\n\nThe light is out, and nobody knows why it is out.\n");
    scene.write("empty.lipzbank", "");
    scene.write("cut.lipzbank", &whole[..whole.len() - 100]);
    scene.write("header.lipzbank", &whole[..40]);
    scene.write("longer.lipzbank", [&whole[..], b"\n"].concat());
    let text_mode: Vec<u8> = whole.iter().copied().filter(|&byte| byte != b'\r').collect();
    scene.write("text-mode.lipzbank", &text_mode);
    let mut newer = whole.clone();
    newer[20] += 1; // the major format version
    seal(&mut newer);
    scene.write("newer.lipzbank", &newer);
    for name in ["text", "empty", "cut", "header", "longer", "text-mode", "newer"] {
        let file = format!("{name}.lipzbank");
        scene.expect(&format!("LZ0902-bank-refused-{name}"), &["verify", &file]);
        for arguments in [&["inspect", &file][..], &["unpack", &file, "-o", "out"]] {
            assert_eq!(lipz(scene.path(), arguments).code, 1, "{arguments:?}");
        }
    }
    scene.expect("LZ0902-bank-refused-missing", &["verify", "nowhere.lipzbank"]);
    scene.expect("LZ0902-bank-refused-folder", &["verify", "voices"]);
    assert!(!scene.path().join("out").exists(), "a refused bank leaves no files");
    scene.finish(9);
}

#[test]
fn banks_that_were_changed() {
    let mut scene = scene();
    let whole = bank(&scene);
    let mut changed = whole.clone();
    *changed.last_mut().unwrap() ^= 0x20;
    scene.write("changed.lipzbank", &changed);
    scene.expect("LZ0903-bank-damaged", &["verify", "changed.lipzbank"]);
    scene.expect("LZ0903-bank-damaged-one-of-two", &["verify", "changed.lipzbank", "b.lipzbank", "--quiet"]);
    let mut frames = whole.clone();
    frames[section(&whole, Tag::FRAMES).start] = b'z';
    seal(&mut frames);
    scene.write("frames.lipzbank", &frames);
    scene.expect("LZ0903-bank-damaged-frame-code", &["verify", "frames.lipzbank"]);
    let mut sources = whole.clone();
    let records = section(&whole, Tag::SOURCES);
    sources[records].fill(0xFF);
    seal(&mut sources);
    scene.write("sources.lipzbank", &sources);
    scene.expect("LZ0905-source-damaged", &["unpack", "sources.lipzbank", "-o", "out"]);
    // The same if the first file could be written.
    let mut last = whole.clone();
    let end = section(&whole, Tag::SOURCES).end;
    last[end - 1] = 0xFF;
    seal(&mut last);
    scene.write("last.lipzbank", &last);
    scene.expect("LZ0905-source-damaged-last", &["unpack", "last.lipzbank", "-o", "out"]);
    assert!(!scene.path().join("out").exists(), "a bank that cannot be decoded leaves no files");
    scene.finish(5);
}

#[test]
fn a_key_that_leads_out_of_the_folder() {
    let mut scene = Scene::new();
    for (name, key) in [("parent", "../a/ottos"), ("absolute", "/tmp/ottos"), ("device", "act1/con.a")] {
        let bank = bank_with_key(&scene, key);
        let file = format!("{name}.lipzbank");
        scene.write(&file, &bank);
        scene.prepare(&["verify", &file, "--quiet"]);
        let before = tree(scene.path());
        scene.expect(&format!("LZ0803-refused-key-unpack-{name}"), &["unpack", &file, "-o", "out/here", "--overwrite"]);
        assert_eq!(tree(scene.path()), before, "{key}: nothing was written");
    }
    scene.finish(3);
}

#[test]
fn unpacking_onto_files_that_exist() {
    let mut scene = scene();
    scene.write("out/no.lipz", "mine");
    let before = tree(scene.path());
    scene.expect("LZ0906-would-overwrite", &["unpack", "b.lipzbank", "-o", "out"]);
    assert_eq!(tree(scene.path()), before, "nothing was written");
    assert_eq!(fs::read(scene.path().join("out/no.lipz")).unwrap(), b"mine");
    scene.prepare(&["unpack", "b.lipzbank", "-o", "out", "--overwrite"]);
    assert!(fs::read_to_string(scene.path().join("out/no.lipz")).unwrap().contains("いいえ。"));
    scene.finish(1);
}

#[test]
fn unpacking_stays_in_its_folder() {
    let mut scene = scene();
    scene.write("outside/mine.txt", "mine");
    fs::create_dir(scene.path().join("out")).unwrap();
    symlink("../outside", scene.path().join("out/act1")).unwrap();
    scene.expect("LZ0904-output-failed-link-leads-out", &["unpack", "b.lipzbank", "-o", "out"]);
    scene.expect("LZ0904-output-failed-link-leads-out-forced", &["unpack", "b.lipzbank", "-o", "out", "--overwrite"]);
    assert_eq!(tree(&scene.path().join("outside")), ["mine.txt"], "nothing was written outside");

    // Links with missing targets, and files in place of folders.
    fs::remove_file(scene.path().join("out/act1")).unwrap();
    symlink("nowhere", scene.path().join("out/act1")).unwrap();
    scene.expect("LZ0904-output-failed-link-to-nowhere", &["unpack", "b.lipzbank", "-o", "out"]);
    fs::remove_file(scene.path().join("out/act1")).unwrap();
    scene.write("out/act1", "mine");
    scene.expect("LZ0904-output-failed-file-for-folder", &["unpack", "b.lipzbank", "-o", "out"]);

    // A link to a file is replaced, not followed.
    fs::remove_file(scene.path().join("out/act1")).unwrap();
    fs::create_dir(scene.path().join("out/act1")).unwrap();
    symlink("../../outside/mine.txt", scene.path().join("out/act1/aye.lipz")).unwrap();
    assert_eq!(lipz(scene.path(), ["unpack", "b.lipzbank", "-o", "out"]).code, 1);
    scene.prepare(&["unpack", "b.lipzbank", "-o", "out", "--overwrite"]);
    assert_eq!(fs::read(scene.path().join("outside/mine.txt")).unwrap(), b"mine");
    assert!(!scene.path().join("out/act1/aye.lipz").is_symlink());

    fs::remove_file(scene.path().join("out/no.lipz")).unwrap();
    fs::create_dir(scene.path().join("out/no.lipz")).unwrap();
    scene.expect("LZ0904-output-failed-folder-for-file", &["unpack", "b.lipzbank", "-o", "out", "--overwrite"]);
    scene.finish(5);
}

#[test]
fn outputs_that_cannot_be_written() {
    let mut scene = scene();
    scene.write("a-file", "mine");
    fs::create_dir(scene.path().join("a-folder.lipzbank")).unwrap();
    let before = tree(scene.path());
    scene.expect("LZ0904-output-failed-folder", &["pack", "voices", "-o", "a-folder.lipzbank"]);
    symlink("nowhere", scene.path().join("dangling")).unwrap();
    scene.expect("LZ0904-output-failed-dangling-link", &["pack", "voices", "-o", "dangling"]);
    fs::remove_file(scene.path().join("dangling")).unwrap();
    assert!(std::process::Command::new("mkfifo").arg(scene.path().join("pipe")).status().unwrap().success());
    scene.expect("LZ0904-output-failed-pipe", &["pack", "voices", "-o", "pipe"]);
    fs::remove_file(scene.path().join("pipe")).unwrap();
    scene.expect("LZ0904-output-failed-below-file", &["pack", "voices", "-o", "a-file/b.lipzbank"]);
    scene.expect("LZ0904-output-failed-unpack-file", &["unpack", "b.lipzbank", "-o", "a-file"]);
    assert_eq!(tree(scene.path()), before, "the folder is unchanged");
    scene.finish(5);
}

#[test]
fn outputs_in_new_folders_and_behind_links() {
    let scene = scene();
    scene.prepare(&["pack", "voices", "-o", "new/folder/b.lipzbank"]);
    let bank = fs::read(scene.path().join("new/folder/b.lipzbank")).unwrap();
    scene.write("old.lipzbank", "old");
    symlink("old.lipzbank", scene.path().join("link.lipzbank")).unwrap();
    scene.prepare(&["pack", "voices", "-o", "link.lipzbank"]);
    assert!(scene.path().join("link.lipzbank").is_symlink());
    assert_eq!(fs::read(scene.path().join("old.lipzbank")).unwrap(), bank);
}

#[test]
fn who_looks_at_one_clip_is_told_of_its_file_alone() {
    let scene = Scene::new();
    for name in ["a", "b"] {
        scene.write(&format!("voices/{name}.lipz"), format!(r#"{{ "text_en-us": "Aye.", "{name}": 1 }}"#));
    }
    let inspect = |arguments: &[&str]| lipz(scene.path(), ["inspect", "voices"].iter().chain(arguments)).stderr;
    assert_eq!(inspect(&[]).matches("[LZ0203]").count(), 2);
    let of_one = inspect(&["a"]);
    assert_eq!((of_one.matches("[LZ0203]").count(), of_one.contains("voices/a.lipz")), (1, true), "{of_one}");
    // The reason why a bank cannot be packed is reported, wherever it is.
    scene.write("voices/c.lipz", r#"{ "fps": 0 }"#);
    assert!(inspect(&["a"]).contains("[LZ0301]"));
}
