//! `lipz pack --depfile`: parsed independently, and used by Make if it is installed.
#![cfg(unix)]
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "tests")]

mod support;

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, SystemTime};
use support::{Scene, lipz, tree};

const CLIP: &str = r#"{ "text_en-us": "Aye." }"#;

/// Names that need escapes.
const NAMES: [&str; 6] = ["plain", "with blanks in it", "$HOME and $$", "# one", "act 1/é (2), 50%", "take=1"];

/// Returns the names before and after the colon of the first rule, as GNU Make reads them ("Rule Syntax"): `\` escapes
/// a blank, `#`, `:` and, before these, itself; `$$` is `$`.
fn parse(depfile: &str) -> (String, Vec<String>) {
    let rule = depfile.lines().next().unwrap();
    let mut names = vec![String::new()];
    let mut rest = rule.chars().peekable();
    while let Some(c) = rest.next() {
        let name = names.last_mut().unwrap();
        match c {
            '\\' if rest.next_if(|next| matches!(next, ' ' | '#' | ':')).is_some_and(|next| {
                name.push(next);
                true
            }) => {}
            '$' => {
                assert_eq!(rest.next(), Some('$'), "a lone $ in {rule}");
                name.push('$');
            }
            ' ' => names.push(String::new()),
            '#' => unreachable!("a comment in {rule}"),
            c => name.push(c),
        }
    }
    let target = names.remove(0);
    (target.strip_suffix(':').expect("a target").to_owned(), names)
}

#[test]
fn without_its_depfile_the_bank_is_packed_and_the_run_fails() {
    let scene = Scene::new();
    scene.write("voices/aye.lipz", CLIP);
    scene.write("file", "");
    let outcome = lipz(scene.path(), ["pack", "voices", "-o", "b.lipzbank", "--depfile", "file/b.d"]);
    assert_eq!(outcome.code, 2);
    assert!(outcome.stderr.contains("error[LZ0904]: `file/b.d` "), "{}", outcome.stderr);
    assert!(outcome.stdout.contains("1 clip packed into b.lipzbank"), "{}", outcome.stdout);
    assert_eq!(tree(scene.path()), ["b.lipzbank", "file", "voices", "voices/aye.lipz"]);
}

#[test]
fn settings_that_appear_are_a_change() {
    let scene = Scene::new();
    scene.write("voices/aye.lipz", CLIP);
    scene.write("build/here", "");
    let listed = |arguments: &[&str]| {
        scene.prepare(&[&["pack", "voices"], arguments].concat());
        let depfile = fs::read_to_string(scene.path().join(arguments.last().unwrap())).unwrap();
        parse(&depfile).1
    };
    let in_build = ["-o", "build/b.lipzbank", "--depfile", "build/b.d"];
    assert_eq!(listed(&in_build), [".", "voices", "voices/aye.lipz"]);
    assert_eq!(listed(&["-o", "b.lipzbank", "--depfile", "build/b.d"]), ["voices", "voices/aye.lipz"]);
    assert_eq!(
        listed(&["-o", "build/b.lipzbank", "--no-config", "--depfile", "build/b.d"]),
        ["voices", "voices/aye.lipz"]
    );
    scene.write("lipz.toml", "");
    assert_eq!(listed(&in_build), ["voices", "voices/aye.lipz", "lipz.toml"]);
}

#[test]
fn every_file_and_folder_is_listed() {
    let scene = Scene::new();
    for name in NAMES {
        scene.write(&format!("voices/{name}.lipz"), CLIP);
    }
    scene.write("voices/notes.txt", "no source");
    fs::create_dir_all(scene.path().join("voices/empty/for later")).unwrap();
    scene.write("more voices/aye.lipz", CLIP);
    let arguments = ["pack", "voices", "more voices/*.lipz", "-o", "out/my bank", "--depfile", "out/my bank.d"];
    scene.prepare(&arguments);
    let (target, mut dependencies) = parse(&fs::read_to_string(scene.path().join("out/my bank.d")).unwrap());
    assert_eq!(target, "out/my bank");
    dependencies.sort();
    let mut expected = tree(scene.path());
    expected.retain(|path| !path.starts_with("out") && !path.ends_with(".txt"));
    // The folder in which a `lipz.toml` may appear.
    expected.insert(0, ".".into());
    assert_eq!(dependencies, expected);
}

#[test]
fn errors_leave_the_depfile() {
    let scene = Scene::new();
    scene.write("voices/aye.lipz", CLIP);
    let arguments = ["pack", "voices", "-o", "b.lipzbank", "--depfile", "b.d"];
    scene.prepare(&arguments);
    let before = fs::read(scene.path().join("b.d")).unwrap();
    scene.write("voices/no.lipz", "");
    assert_eq!(lipz(scene.path(), arguments).code, 1);
    assert_eq!(fs::read(scene.path().join("b.d")).unwrap(), before);
    // A depfile that cannot be written is reported.
    fs::remove_file(scene.path().join("voices/no.lipz")).unwrap();
    let outcome = lipz(scene.path(), ["pack", "voices", "-o", "b.lipzbank", "--depfile", "voices"]);
    assert_eq!(outcome.code, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("error[LZ0904]"), "{}", outcome.stderr);
}

#[test]
fn a_name_that_make_cannot_read_is_an_error() {
    let scene = Scene::new();
    scene.write("voices/a;b.lipz", CLIP);
    let outcome = lipz(scene.path(), ["pack", "voices", "-o", "b.lipzbank", "--depfile", "b.d"]);
    assert_eq!(outcome.code, 2);
    let expected = "error[LZ0904]: a depfile cannot contain `voices/a;b.lipz`";
    assert!(outcome.stderr.contains(expected), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("the bank itself was written"), "{}", outcome.stderr);
    assert!(!scene.path().join("b.d").exists(), "without it, build engines pack again");
}

/// Sets the modification time of a file or folder.
fn touch(path: &Path, time: SystemTime) {
    fs::File::open(path).unwrap().set_modified(time).unwrap();
}

#[test]
fn make_packs_again_when_something_changes() {
    if Command::new("make").arg("--version").output().is_err() {
        eprintln!("skipped: `make` is not on this machine");
        return;
    }
    let scene = Scene::new();
    for name in NAMES {
        scene.write(&format!("voices/{name}.lipz"), CLIP);
    }
    scene.write("Makefile", "b.lipzbank:\n\t@\"$(LIPZ)\" pack voices -o $@ --depfile b.d\n-include b.d\n");
    let packs = || {
        let output = Command::new("make")
            .arg(format!("LIPZ={}", env!("CARGO_BIN_EXE_lipz")))
            .current_dir(scene.path())
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let packs = String::from_utf8_lossy(&output.stdout).contains("packed into");
        // From now on, everything is older than the bank, except for the files that a step touches.
        let old = SystemTime::now() - Duration::from_secs(60);
        for path in tree(scene.path()).iter().filter(|path| path.starts_with("voices")) {
            touch(&scene.path().join(path), old);
        }
        packs
    };
    assert!(packs(), "there is no bank");
    assert!(!packs(), "nothing changed");
    let soon = SystemTime::now() + Duration::from_secs(60);
    for name in NAMES {
        touch(&scene.path().join(format!("voices/{name}.lipz")), soon);
        assert!(packs(), "{name} changed");
        assert!(!packs(), "nothing changed after {name}");
    }
    scene.write("voices/act 1/new.lipz", CLIP);
    touch(&scene.path().join("voices/act 1"), soon);
    assert!(packs(), "a file was added");
    fs::remove_file(scene.path().join("voices/plain.lipz")).unwrap();
    touch(&scene.path().join("voices"), soon);
    assert!(packs(), "a file was removed, which does not stop a rule");
    assert!(!packs(), "nothing changed at the end");
}
