//! `lipz pack`, `lipz unpack`, `lipz sync` and other commands leave complete files and no temporary ones when
//! interrupted at any moment.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use support::tree;

/// Interrupts per test, spread evenly over the time of a full run.
const INTERRUPTS: u32 = 20;
/// The exit code of an interrupted run.
const INTERRUPTED: i32 = 130;

fn lipz(folder: &Path, arguments: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lipz"));
    command.args(arguments).current_dir(folder).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

/// Runs the command once to the end and then interrupts it many times. Calls `prepare` before each run, and `look`
/// after it.
fn interrupt(folder: &Path, arguments: &[&str], prepare: impl Fn(), look: impl Fn()) {
    prepare();
    let start = Instant::now();
    assert!(lipz(folder, arguments).wait().unwrap().success());
    let whole_run = start.elapsed().max(Duration::from_millis(1));
    let mut interrupted = 0;
    support::make_interruptible();
    for number in 0..INTERRUPTS {
        prepare();
        let child = lipz(folder, arguments);
        std::thread::sleep(whole_run * number / INTERRUPTS);
        let signal = if number % 2 == 0 { "-INT" } else { "-TERM" };
        // Fails if the run has ended already.
        let _ = Command::new("kill").args([signal, &child.id().to_string()]).stderr(Stdio::null()).status();
        let output = child.wait_with_output().unwrap();
        match output.status.code() {
            Some(INTERRUPTED) => {
                interrupted += 1;
                assert_eq!(String::from_utf8(output.stderr).unwrap(), "interrupted\n");
            }
            // Before the program handles signals, the signal itself ends it.
            ended => assert!(matches!(ended, Some(0) | None), "{ended:?}"),
        }
        look();
    }
    assert!(interrupted > 0, "no run was interrupted while it worked: the test shows nothing");
}

#[test]
fn an_interrupted_pack_leaves_one_bank_with_texts() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for clip in 0..4 {
        let frames = "M".repeat(1_000_000);
        support::write(folder, &format!("voices/clip-{clip}.lipz"), format!("{{\"visemes\":\"{frames}\"}}"));
    }
    support::write(folder, "old/aye.lipz", "{ \"text_en-us\": \"Aye.\" }");
    assert!(lipz(folder, &["pack", "old", "-o", "old.lipzbank"]).wait().unwrap().success());
    assert!(lipz(folder, &["pack", "voices", "-o", "new.lipzbank"]).wait().unwrap().success());
    let (old, new) = (fs::read(folder.join("old.lipzbank")).unwrap(), fs::read(folder.join("new.lipzbank")).unwrap());
    let output = folder.join("out/dialogue.lipzbank");
    fs::create_dir(folder.join("out")).unwrap();
    interrupt(
        folder,
        &["pack", "voices", "-o", "out/dialogue.lipzbank"],
        || fs::write(&output, &old).unwrap(),
        || {
            let found = fs::read(&output).unwrap();
            assert!(found == old || found == new, "neither bank");
            assert_eq!(tree(&folder.join("out")), ["dialogue.lipzbank"], "a temporary file is left");
        },
    );
}

#[test]
fn an_interrupted_unpack_leaves_whole_files() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let text = "{\n  \"text_en-us\": \"Aye.\"\n}\n";
    for clip in 0..1000 {
        support::write(folder, &format!("voices/{clip}.lipz"), text);
    }
    assert!(lipz(folder, &["pack", "voices", "-o", "voices.lipzbank"]).wait().unwrap().success());
    let output = folder.join("out");
    interrupt(
        folder,
        &["unpack", "voices.lipzbank", "-o", "out"],
        || {
            if output.exists() {
                fs::remove_dir_all(&output).unwrap();
            }
        },
        || {
            let files = if output.exists() { tree(&output) } else { Vec::new() };
            for file in files {
                let whole = fs::read_to_string(folder.join("voices").join(&file)).unwrap();
                assert_eq!(fs::read_to_string(output.join(&file)).unwrap(), whole, "{file}");
            }
        },
    );
}

#[test]
fn an_interrupted_sync_leaves_whole_files_and_goes_on_where_it_ended() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for clip in 0..8 {
        let sound = support::sound::voice(&[(false, 200), (true, 700), (false, 200)], clip);
        support::write(folder, &format!("rec/{clip}.wav"), sound);
        support::write(folder, &format!("rec/{clip}.txt"), "Who goes there?");
    }
    let arguments = ["sync", "rec", "-o", "voices", "--config", "audio.locale=en-us", "--quiet", "--allow", "warnings"];
    let prepare = || {
        let _ = fs::remove_dir_all(folder.join("voices"));
    };
    interrupt(folder, &arguments, prepare, || {
        let left = if folder.join("voices").exists() { tree(&folder.join("voices")) } else { Vec::new() };
        assert!(left.iter().all(|name| name.ends_with(".lipz") || name == "lipz-sync.txt"), "{left:?}");
        if left.iter().any(|name| name.ends_with(".lipz")) {
            let checked = support::lipz(folder, ["check", "voices", "--allow", "warnings"]);
            assert_eq!((checked.code, checked.stderr.as_str()), (0, ""), "whole files");
        }
        let rest = support::lipz(
            folder,
            ["sync", "rec", "-o", "voices", "--config", "audio.locale=en-us", "--allow", "warnings"],
        );
        assert!(rest.code == 0 && !rest.stdout.contains("kept"), "what was made is known: {}", rest.stdout);
    });
}

/// Checks that each file in `voices` is the complete old or new one, and that there are no further files.
fn are_old_or_new(folder: &Path, names: &[String], (old, new): (&str, &str)) {
    assert_eq!(tree(&folder.join("voices")), names, "a file is lost, or a temporary one is left");
    for name in names {
        let text = fs::read_to_string(folder.join("voices").join(name)).unwrap();
        assert!(text == old || text == new, "{name}: {text:?}");
    }
}

#[test]
fn an_interrupted_fmt_leaves_whole_files_and_no_others() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let (old, new) = ("{\"text_en-us\": \"Aye.\"}", "{\n  \"text_en-us\" : \"Aye.\"\n}\n");
    let names: Vec<String> = (0..300).map(|clip| format!("{clip:04}.lipz")).collect();
    interrupt(
        folder,
        &["fmt", "voices"],
        || names.iter().for_each(|name| support::write(folder, &format!("voices/{name}"), old)),
        || are_old_or_new(folder, &names, (old, new)),
    );
}

/// Several threads read and write: no thread ends the process while another one writes.
#[test]
fn an_interrupted_import_leaves_whole_files_and_no_others() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    support::write(folder, "lipz.toml", "sources = [\"voices\"]\ndefault-locale = \"en-us\"\n");
    let names: Vec<String> = (0..200).map(|clip| format!("{clip:04}.lipz")).collect();
    let table: String = names.iter().map(|name| format!("{},Ja.\n", name.trim_end_matches(".lipz"))).collect();
    support::write(folder, "de.csv", format!("key,de-de\n{table}"));
    let (old, new) = ("{ \"text_en-us\": \"Aye.\" }\n", "{ \"text_en-us\": \"Aye.\", \"text_de-de\": \"Ja.\" }\n");
    interrupt(
        folder,
        &["import", "texts", "de.csv", "--quiet"],
        || names.iter().for_each(|name| support::write(folder, &format!("voices/{name}"), old)),
        || are_old_or_new(folder, &names, (old, new)),
    );
}

/// Reading may block forever: a pipe without a writer, a network that hangs.
#[test]
fn a_pack_that_waits_for_a_file_ends_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("b.lipzbank"), "old").unwrap();
    assert!(Command::new("mkfifo").arg(folder.join("f.lipz")).status().unwrap().success());
    support::make_interruptible();
    for cache in [&[][..], &["--cache", "b.cache"]] {
        let arguments = [&["pack", "f.lipz", "-o", "b.lipzbank"], cache].concat();
        let mut child = lipz(folder, &arguments);
        std::thread::sleep(Duration::from_millis(500));
        let start = Instant::now();
        assert!(Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap().success());
        let ended = loop {
            match child.try_wait().unwrap() {
                Some(ended) => break ended,
                None if start.elapsed() > Duration::from_secs(20) => {
                    child.kill().unwrap();
                    break child.wait().unwrap();
                }
                None => std::thread::sleep(Duration::from_millis(10)),
            }
        };
        assert_eq!(ended.code(), Some(INTERRUPTED));
        assert_eq!(fs::read(folder.join("b.lipzbank")).unwrap(), b"old");
    }
}
