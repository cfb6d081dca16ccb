//! The peak memory of packing as a multiple of the bank's size, as stated in docs/inside/performance.md. The test uses
//! the system's figure for the process, minus the program itself and all memory that does not grow with the clips.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, reason = "tests")]
#![allow(unsafe_code, reason = "the standard library does not tell what a child took")]

mod support;

use std::fmt::Write;
use std::fs;
use std::process::{Command, Stdio};
use support::Scene;

/// Clips of the large project.
const CLIPS: usize = 12_000;
/// Runs to measure the memory with clips, and the maximum without.
const RUNS: usize = 4;
/// Clips of a scene.
const SCENE: usize = 200;

/// Returns a clip of realistic size: 160 frames in two segments, and texts in five languages. Each `number` produces a
/// different clip.
fn clip(number: usize) -> String {
    let mut seed = number as u64 + 1;
    let mut next = || {
        seed = seed.wrapping_mul(0x5851_F42D_4C95_7F2D).wrapping_add(0x1405_7B7E_F767_814F);
        (seed >> 33) as usize
    };
    let mouth: String = (0..160).map(|_| ["-", "A", "E", "L", "O", "M", "F", "S"][next() % 8]).collect();
    let (first, second) = mouth.split_at(70);
    let mut clip = format!("{{\"fps\":24,\"viseme_type\":\"blair\",\"visemes\":\"{first}|{second}\"");
    for tag in ["de-de", "en-us", "fr-fr", "ja-jp", "ru-ru"] {
        let mut words = || (0..5).map(|_| format!("wo{:05}", next() % 100_000)).collect::<Vec<_>>().join(" ");
        let _ = write!(clip, ",\"text_{tag}\":\"{}|{}\"", words(), words());
    }
    if number.is_multiple_of(3) {
        clip.push_str(",\"events\":\"otto feels sad|\"");
    }
    clip + "}"
}

/// Returns a clip whose frames and texts take twenty times the memory of its table entries.
fn long_clip(number: usize) -> String {
    let mouth = "-AELOMFS".repeat(800);
    let text = |tag: &str| format!("{tag}{number} ").repeat(1000);
    format!(
        "{{\"visemes\":\"{mouth}\",\"viseme_type\":\"blair\",\"text_de-de\":\"{}\",\"text_en-us\":\"{}\"}}",
        text("Wort"),
        text("word")
    )
}

/// Returns the peak memory of `lipz` in bytes.
#[allow(clippy::zombie_processes, reason = "it is waited for by a call that also tells what it took")]
fn peak_bytes(scene: &Scene, arguments: &[&str]) -> u64 {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lipz"));
    command.args(arguments).args(["--quiet", "--jobs", "2"]).current_dir(scene.path());
    let child = command.stdin(Stdio::null()).spawn().unwrap();
    let pid = libc::pid_t::try_from(child.id()).unwrap();
    // SAFETY: the structs are plain numbers, for which zeros are valid, and the call fills them.
    let (status, usage) = unsafe {
        let (mut status, mut usage) = (0, std::mem::zeroed::<libc::rusage>());
        assert_eq!(libc::wait4(pid, &raw mut status, 0, &raw mut usage), pid);
        (status, usage)
    };
    assert_eq!(status, 0, "{arguments:?}");
    u64::try_from(usage.ru_maxrss).unwrap() * 1024
}

#[test]
fn packing_takes_no_more_than_twice_the_bank() {
    let scene = Scene::new();
    for number in 0..CLIPS {
        scene.write(&format!("voices/scene{:03}/line-{number:06}.lipz", number / SCENE), clip(number));
    }
    let pack = |folder: &str, bank: &str, flags: &[&str]| {
        peak_bytes(&scene, &[&["pack", folder, "-o", &format!("{bank}.lipzbank"), "--no-config"], flags].concat())
    };
    // Memory grows if the machine is busy, and one thread reads most of the files.
    let whole = |bank: &str, flags: &[&str]| {
        let run = |_| {
            let _ = fs::remove_file(scene.path().join("c.cache"));
            pack("voices", bank, flags)
        };
        (0..RUNS).map(run).min().unwrap()
    };
    let peak = whole("whole", &[]);
    let bank = fs::metadata(scene.path().join("whole.lipzbank")).unwrap().len();
    let check = |what: &str, peak: u64, flags: &[&str]| {
        // The memory of the program itself varies between runs by several megabytes. One scene is enough for all of its
        // threads.
        let program = (0..RUNS).map(|_| pack("voices/scene000", "small", flags)).max().unwrap();
        let small = fs::metadata(scene.path().join("small.lipzbank")).unwrap().len();
        let (taken, more) = (peak.saturating_sub(program), bank - small);
        println!("{what}: {peak} bytes, {:.2} times the bank", taken as f64 / more as f64);
        assert!(taken < 2 * more, "{what}: {taken} bytes for {more} bytes more of a bank");
    };
    check("a bank", peak, &[]);
    check("text banks", whole("split", &["--config", "split-locales=true"]), &["--config", "split-locales=true"]);
    let cache = ["--cache", "c.cache"];
    let small_cache = ["--cache", "small.cache"];
    check("a cache", whole("cached", &cache), &small_cache);
    check("nothing changed", pack("voices", "cached", &cache), &small_cache);
    scene.write("voices/scene000/line-000007.lipz", clip(7) + " ");
    check("one file changed", pack("voices", "cached", &cache), &small_cache);
    let bytes = |name: &str| fs::read(scene.path().join(name)).unwrap();
    assert!(bytes("cached.lipzbank") == bytes("whole.lipzbank"));
}

/// Returns the peak memory of linking a folder in this number of shards, and the size of the bank, in bytes.
fn linked(scene: &Scene, folder: &str, shards: usize) -> (u64, u64) {
    scene.write("lipz.toml", format!("sources = [\"{folder}\"]\noutput = \"{folder}.lipzbank\"\n"));
    let plan = format!("{folder}-plan/plan.json");
    scene.prepare(&["shard", "plan", "pack", "--shards", &shards.to_string(), "-o", &plan, "--quiet"]);
    for shard in 0..shards {
        let object = format!("{folder}-plan/{shard}.lipzobj");
        scene.prepare(&["shard", "pack", &plan, &shard.to_string(), "-o", &object, "--quiet"]);
    }
    let bank = format!("{folder}.lipzbank");
    let peak = peak_bytes(scene, &["shard", "link", &format!("{folder}-plan/*.lipzobj"), "-o", &bank]);
    (peak, fs::metadata(scene.path().join(bank)).unwrap().len())
}

#[test]
fn linking_holds_tables_and_no_more() {
    const SHARDS: usize = 16;
    let scene = Scene::new();
    scene.write("one/a.lipz", clip(0));
    let (program, _) = linked(&scene, "one", SHARDS);
    for number in 0..CLIPS / 8 {
        scene.write(&format!("long/line-{number:06}.lipz"), long_clip(number));
    }
    let (peak, bank) = linked(&scene, "long", SHARDS);
    let taken = peak.saturating_sub(program);
    println!("{taken} bytes, {:.2} times the bank", taken as f64 / bank as f64);
    // One object per thread, and one block of each object.
    let most = bank * 2 / SHARDS as u64 + (6 << 20);
    assert!(taken < most, "{taken} bytes for a bank of {bank}");
}
