//! The steps of a plan, run by build engines: they produce the bank of a single run, do no work twice, and repeat only
//! one shard after a change. A missing engine is skipped with a message; with `LIPZ_TOOLS`, it is required.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant, SystemTime};
use support::{Scene, path_with_lipz};

const SHARDS: usize = 8;

/// Returns a project of 80 clips with its plan and the bank of a single run.
fn scene(engine: &str, file: &str) -> Scene {
    let scene = Scene::new();
    scene.write("lipz.toml", "sources = [\"voices\"]\noutput = \"dialogue.lipzbank\"\ndefault-locale = \"en-us\"\n");
    for line in 0..80 {
        scene.write(&format!("voices/{line}.lipz"), format!(r#"{{ "text_en-us": "Line {line}." }}"#));
    }
    scene.prepare(&["pack", "-o", "whole.lipzbank", "--quiet"]);
    scene.prepare(&["shard", "plan", "pack", "--shards", &SHARDS.to_string(), "-o", "build/plan.json", "--quiet"]);
    scene.prepare(&["shard", "emit", engine, "build/plan.json", "-o", file, "--quiet"]);
    scene
}

/// Whether a program is installed.
fn is_there(program: &str) -> bool {
    let found = Command::new(program).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    let is_there = found.is_ok_and(|status| status.success());
    if !is_there {
        assert!(std::env::var_os("LIPZ_TOOLS").is_none(), "needs {program}, which `.ci/install` brings");
        eprintln!("skipped: {program} is not on this machine");
    }
    is_there
}

fn run(scene: &Scene, program: impl AsRef<Path>, arguments: &[&str]) -> String {
    let mut command = Command::new(program.as_ref());
    command.args(arguments).env("PATH", path_with_lipz(scene)).current_dir(scene.path());
    said(&command.output().unwrap())
}

fn said(output: &Output) -> String {
    let said = [&output.stdout[..], &output.stderr].concat();
    let said = String::from_utf8_lossy(&said).into_owned();
    assert!(output.status.success(), "{said}");
    said
}

fn bytes(scene: &Scene, name: &str) -> Vec<u8> {
    fs::read(scene.path().join(name)).unwrap()
}

fn objects(scene: &Scene) -> Vec<(Vec<u8>, SystemTime)> {
    let path = |shard| scene.path().join(format!("build/{shard}-of-{SHARDS}.lipzobj"));
    let object = |path: PathBuf| (fs::read(&path).unwrap(), path.metadata().unwrap().modified().unwrap());
    (0..SHARDS).map(|shard| object(path(shard))).collect()
}

/// Changes a clip after a delay, so that it is newer than all files so far.
fn change(scene: &Scene) {
    std::thread::sleep(Duration::from_millis(1100));
    scene.write("voices/41.lipz", r#"{ "text_en-us": "Another line." }"#);
}

/// Returns the number of objects that the last run has made again, and checks that the bank is that of a single run.
fn changed_objects(scene: &Scene, before: &[(Vec<u8>, SystemTime)]) -> usize {
    scene.prepare(&["pack", "-o", "whole.lipzbank", "--quiet"]);
    assert!(bytes(scene, "dialogue.lipzbank") == bytes(scene, "whole.lipzbank"));
    std::iter::zip(before, objects(scene)).filter(|(one, other)| *one != other).count()
}

#[test]
fn ninja() {
    if !is_there("ninja") {
        return;
    }
    let scene = scene("ninja", "build.ninja");
    let first = run(&scene, "ninja", &["-v"]);
    assert!(bytes(&scene, "dialogue.lipzbank") == bytes(&scene, "whole.lipzbank"), "{first}");
    let again = run(&scene, "ninja", &[]);
    assert!(again.contains("no work to do"), "{again}");
    let before = objects(&scene);
    change(&scene);
    let third = run(&scene, "ninja", &[]);
    assert_eq!(changed_objects(&scene, &before), 1, "{third}");
    let packed = third.lines().filter(|line| line.contains("] shard ")).count();
    assert_eq!((packed, third.contains("link dialogue.lipzbank")), (1, true), "{third}");
    // A file with a new time but the same contents has no effect.
    std::thread::sleep(Duration::from_millis(1100));
    scene.write("voices/41.lipz", r#"{ "text_en-us": "Another line." }"#);
    let touched = run(&scene, "ninja", &[]);
    assert!(!touched.contains("link"), "{touched}");
    assert!(run(&scene, "ninja", &[]).contains("no work to do"));
    // An additional file.
    scene.write("voices/new.lipz", r#"{ "text_en-us": "New." }"#);
    let before = objects(&scene);
    run(&scene, "ninja", &[]);
    assert_eq!(changed_objects(&scene, &before), 1);
}

#[test]
fn make() {
    if !is_there("make") {
        return;
    }
    let scene = scene("make", "plan.mk");
    let make = |scene: &Scene| run(scene, "make", &["-f", "plan.mk", "-j2"]);
    make(&scene);
    assert!(bytes(&scene, "dialogue.lipzbank") == bytes(&scene, "whole.lipzbank"));
    let again = make(&scene);
    assert!(!again.contains("shard pack ") && !again.contains("shard link "), "{again}");
    let before = objects(&scene);
    change(&scene);
    let third = make(&scene);
    assert_eq!(changed_objects(&scene, &before), 1, "{third}");
    assert_eq!((third.matches("shard pack ").count(), third.matches("shard link ").count()), (1, 1), "{third}");
    let again = make(&scene);
    assert!(!again.contains("shard pack ") && !again.contains("shard link "), "{again}");
}

/// Returns the command of HyperQueue from Python that runs the job file of the plan on two workers; `None` if it is not
/// installed.
fn hyperqueue_command(scene: &Scene) -> Option<Command> {
    let python = || {
        let mut python = Command::new("python3");
        python.env("PYTHONPATH", support::repository().join("target/tools")).current_dir(scene.path());
        python.stdout(Stdio::null()).stderr(Stdio::null());
        python
    };
    if !python().args(["-c", "import tomllib, hyperqueue"]).status().is_ok_and(|status| status.success()) {
        assert!(std::env::var_os("LIPZ_TOOLS").is_none(), "needs HyperQueue, which `.ci/install` brings");
        eprintln!("skipped: HyperQueue is not on this machine");
        return None;
    }
    let mut command = python();
    command.env("PATH", path_with_lipz(scene));
    let script = support::repository().join("crates/lipz/tests/support/run_hyperqueue.py");
    command.arg(script).arg("build/job.toml").arg(scene.path());
    Some(command)
}

#[test]
fn hyperqueue() {
    let scene = scene("hyperqueue", "build/job.toml");
    let Some(mut first) = hyperqueue_command(&scene) else { return };
    // Slow enough to be killed in between, with a line for each finished task.
    fs::rename(scene.path().join("bin/lipz"), scene.path().join("bin/fast")).unwrap();
    scene.write("bin/lipz", "#!/bin/sh\nsleep 0.3\nbin/fast \"$@\" && echo \"$2\" >> ended.txt\n");
    run(&scene, "chmod", &["+x", "bin/lipz"]);
    let store = || fs::read_dir(scene.path().join("build/store")).map_or(0, Iterator::count);
    let mut server = first.spawn().unwrap();
    let start = Instant::now();
    while store() < 2 {
        assert!(start.elapsed() < Duration::from_secs(60), "no task ends");
        std::thread::sleep(Duration::from_millis(20));
    }
    server.kill().unwrap();
    server.wait().unwrap();
    assert!(!scene.path().join("dialogue.lipzbank").exists());
    // Started tasks finish, because they outlive their server.
    std::thread::sleep(Duration::from_secs(1));
    let files = || fs::read_dir(scene.path().join("build/store")).unwrap().map(|file| file.unwrap());
    let times = || files().map(|file| (file.file_name(), file.metadata().unwrap().modified().unwrap()));
    let before: Vec<_> = times().collect();
    assert!(hyperqueue_command(&scene).unwrap().status().unwrap().success());
    assert!(bytes(&scene, "dialogue.lipzbank") == bytes(&scene, "whole.lipzbank"));
    let after: Vec<_> = times().collect();
    assert!(before.iter().all(|result| after.contains(result)), "no task runs twice");
    assert_eq!(after.len(), SHARDS, "nothing is lost");
    let ended = fs::read_to_string(scene.path().join("ended.txt")).unwrap();
    assert_eq!(ended.lines().filter(|line| *line == "link").count(), 1, "{ended}");
}

#[test]
fn slurm() {
    let scene = scene("slurm", "build/submit.sh");
    // Runs the script's sbatch commands immediately: each task of an array, then the job that depends on it.
    scene.write(
        "bin/sbatch",
        "#!/bin/sh\nset -eu\nrange=0-0\nfor argument in \"$@\"; do case $argument in --array=*) range=${argument#--array=};;\n\
         --dependency=afterok:7) test -e done;; --dependency=*) exit 3;; esac; last=$argument; done\n\
         for SLURM_ARRAY_TASK_ID in $(seq \"${range%-*}\" \"${range#*-}\"); do export SLURM_ARRAY_TASK_ID\nsh -c \"$last\"\ndone\n\
         touch done\necho '7;cluster'\n",
    );
    run(&scene, "chmod", &["+x", "bin/sbatch"]);
    let path = path_with_lipz(&scene);
    let mut script = Command::new("sh");
    script.args(["build/submit.sh", "--partition=short"]).env("PATH", path).current_dir(scene.path());
    said(&script.output().unwrap());
    assert!(bytes(&scene, "dialogue.lipzbank") == bytes(&scene, "whole.lipzbank"));
}

#[test]
fn names_with_a_meaning_are_refused() {
    let scene = scene("ninja", "build.ninja");
    fs::create_dir(scene.path().join("a b")).unwrap();
    scene.prepare(&["shard", "plan", "pack", "--shards", "2", "-o", "a b/plan.json", "--quiet"]);
    for engine in ["ninja", "make", "hyperqueue", "slurm"] {
        let outcome = support::lipz(scene.path(), ["shard", "emit", engine, "a b/plan.json", "-o", "-"]);
        assert!(outcome.code == 2 && outcome.stderr.contains("LZ1601") && outcome.stdout.is_empty(), "{outcome:?}");
    }
}
