//! Findings about banks and outputs: damaged banks, keys that lead out of a folder, files that are
//! there already. Whatever fails leaves the file system as it was.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use lipz_bank::ClipId;
use lipz_bank::layout::{CHECKED_FROM, Tag, checksum};
use std::fs;
use std::os::unix::fs::symlink;
use support::{Scene, lipz, tree};

/// A scene with a bank `b.lipzbank` of two clips, `act1/aye` and `no`.
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

/// Where a section is in the bank, by its directory entry.
fn section(bank: &[u8], tag: Tag) -> std::ops::Range<usize> {
    let at = bank.windows(4).position(|window| window == tag.0).unwrap();
    let number = |at: usize| u32::from_le_bytes(bank[at..at + 4].try_into().unwrap()) as usize;
    number(at + 4)..number(at + 4) + number(at + 8)
}

/// Makes the checksum right again, as someone would who damages a bank on purpose.
fn seal(bank: &mut [u8]) {
    let sum = checksum(&bank[CHECKED_FROM..]);
    bank[8..16].copy_from_slice(&sum.to_le_bytes());
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
    assert!(!scene.path().join("out").exists(), "nothing is made for a bank that is refused");
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
    scene.finish(4);
}

/// A bank that verifies, but whose key leads out of the folder: made from one with a key of the same
/// length. With one clip, every id has the slot 0.
#[test]
fn a_key_that_leads_out_of_the_folder() {
    let mut scene = Scene::new();
    scene.write("voices/act1/ottos.lipz", r#"{ "text_en-us": "Aye." }"#);
    scene.prepare(&["pack", "voices", "-o", "b.lipzbank", "--quiet"]);
    let whole = bank(&scene);
    for (name, key) in [("parent", "../a/ottos"), ("absolute", "/tmp/ottos"), ("device", "act1/con.a")] {
        let mut bank = whole.clone();
        let names = section(&bank, Tag::NAMES);
        let at = bank[names.clone()].windows(10).position(|window| window == b"act1/ottos").unwrap() + names.start;
        bank[at..at + 10].copy_from_slice(key.as_bytes());
        let record = section(&bank, Tag::CLIPS).start;
        bank[record..record + 8].copy_from_slice(&ClipId::of(key).get().to_le_bytes());
        seal(&mut bank);
        let file = format!("{name}.lipzbank");
        scene.write(&file, &bank);
        scene.prepare(&["verify", &file, "--quiet"]);
        let before = tree(scene.path());
        scene.expect(&format!("LZ0803-refused-key-unpack-{name}"), &["unpack", &file, "-o", "out/here", "--force"]);
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
    scene.prepare(&["unpack", "b.lipzbank", "-o", "out", "--force"]);
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
    scene.expect("LZ0904-output-failed-link-leads-out-forced", &["unpack", "b.lipzbank", "-o", "out", "--force"]);
    assert_eq!(tree(&scene.path().join("outside")), ["mine.txt"], "nothing was written outside");

    // A file that is a link is replaced, not followed.
    fs::remove_file(scene.path().join("out/act1")).unwrap();
    fs::create_dir(scene.path().join("out/act1")).unwrap();
    symlink("../../outside/mine.txt", scene.path().join("out/act1/aye.lipz")).unwrap();
    assert_eq!(lipz(scene.path(), ["unpack", "b.lipzbank", "-o", "out"]).code, 1);
    scene.prepare(&["unpack", "b.lipzbank", "-o", "out", "--force"]);
    assert_eq!(fs::read(scene.path().join("outside/mine.txt")).unwrap(), b"mine");
    assert!(!scene.path().join("out/act1/aye.lipz").is_symlink());
    scene.finish(2);
}

#[test]
fn outputs_that_cannot_be_written() {
    let mut scene = scene();
    scene.write("a-file", "mine");
    fs::create_dir(scene.path().join("a-folder.lipzbank")).unwrap();
    let before = tree(scene.path());
    scene.expect("LZ0904-output-failed-folder", &["pack", "voices", "-o", "a-folder.lipzbank"]);
    scene.expect("LZ0904-output-failed-no-folder", &["pack", "voices", "-o", "nowhere/b.lipzbank"]);
    scene.expect("LZ0904-output-failed-below-file", &["pack", "voices", "-o", "a-file/b.lipzbank"]);
    scene.expect("LZ0904-output-failed-unpack-file", &["unpack", "b.lipzbank", "-o", "a-file"]);
    assert_eq!(tree(scene.path()), before, "nothing is written, nothing is left behind");
    scene.finish(4);
}
