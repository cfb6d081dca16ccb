//! `lipz pack` leaves the old bank complete when killed at any moment.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Kills per run of the test, spread evenly over the time of a full run.
const KILLS: u32 = 60;

/// Writes sources of a bank that takes a while to write: several megabytes of frames.
fn write_sources(folder: &Path, code: &str) {
    std::fs::create_dir_all(folder).unwrap();
    for clip in 0..4 {
        let file = format!("{{\"visemes\":\"{}\"}}", code.repeat(2_000_000));
        std::fs::write(folder.join(format!("clip-{clip}.lipz")), file).unwrap();
    }
}

fn pack(sources: &Path, bank: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lipz"));
    command.arg("pack").arg(sources).arg("-o").arg(bank).stdout(Stdio::null()).stderr(Stdio::null());
    command
}

#[test]
fn a_killed_pack_leaves_the_old_bank_or_the_new_one() {
    let folder = tempfile::tempdir().unwrap();
    let (old_sources, new_sources) = (folder.path().join("old"), folder.path().join("new"));
    write_sources(&old_sources, "A");
    write_sources(&new_sources, "M");
    let bank = folder.path().join("dialogue.lipzbank");
    assert!(pack(&new_sources, &bank).status().unwrap().success());
    let new = std::fs::read(&bank).unwrap();
    let start = Instant::now();
    assert!(pack(&old_sources, &bank).status().unwrap().success());
    let whole_run = start.elapsed();
    let old = std::fs::read(&bank).unwrap();
    assert!(old != new);

    let mut replaced = 0;
    for kill in 0..KILLS {
        std::fs::write(&bank, &old).unwrap();
        let mut child = pack(&new_sources, &bank).spawn().unwrap();
        std::thread::sleep(whole_run * kill / KILLS);
        child.kill().unwrap();
        child.wait().unwrap();
        let found = std::fs::read(&bank).unwrap();
        assert!(found == old || found == new, "killed after {:?}: neither bank", whole_run * kill / KILLS);
        replaced += u32::from(found == new);
    }
    assert!(replaced < KILLS, "no run was killed before its end, so the test proves nothing");
    // Killed runs leave a temporary file, which does not affect the next run.
    assert!(pack(&new_sources, &bank).status().unwrap().success());
    assert!(std::fs::read(&bank).unwrap() == new);
    assert!(whole_run > Duration::from_millis(1));
}

/// Files are flushed to disk and renamed in groups. Each file is complete between these steps, and in the middle of a
/// group.
#[test]
fn a_killed_fmt_loses_no_source() {
    const FILES: usize = 300;
    const FEW_KILLS: u32 = 20;
    let folder = tempfile::tempdir().unwrap();
    let old = |number: usize| format!("{{\"text_en-us\": \"Aye, {number}.\"}}");
    let new = |number: usize| format!("{{\n  \"text_en-us\" : \"Aye, {number}.\"\n}}\n");
    let path = |number: usize| folder.path().join(format!("{number}.lipz"));
    let write = || (0..FILES).for_each(|number| std::fs::write(path(number), old(number)).unwrap());
    let fmt = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lipz"));
        command.arg("fmt").arg(folder.path()).stdout(Stdio::null()).stderr(Stdio::null());
        command
    };
    write();
    let start = Instant::now();
    assert!(fmt().status().unwrap().success());
    let whole_run = start.elapsed();
    let mut unfinished = 0;
    for kill in 0..FEW_KILLS {
        write();
        let mut child = fmt().spawn().unwrap();
        std::thread::sleep(whole_run * kill / FEW_KILLS);
        child.kill().unwrap();
        child.wait().unwrap();
        let is_old = |number: usize| {
            let text = std::fs::read_to_string(path(number)).unwrap();
            assert!(text == old(number) || text == new(number), "{number}: {text:?}");
            text == old(number)
        };
        unfinished += usize::from((0..FILES).filter(|&number| is_old(number)).count() > 0);
    }
    assert!(unfinished > 0, "no run was killed before its end, so the test proves nothing");
    assert!(fmt().status().unwrap().success(), "temporary files of killed runs are hidden, and do not matter");
    assert!((0..FILES).all(|number| std::fs::read_to_string(path(number)).unwrap() == new(number)));
}
