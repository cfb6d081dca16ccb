//! Interesting inputs that the fuzzers have found, and a fixed number of changed copies: short fuzzing, with the same
//! inputs in every run.
#![allow(clippy::unwrap_used, clippy::cast_possible_truncation, reason = "tests")]
#![allow(clippy::expect_used, clippy::unnecessary_map_or, reason = "helpers of the reader's tests")]

use lipz_testkit::fuzz::{TARGETS, kind_of_foreign};
use lipz_testkit::golden::Random;
use std::fs;
use std::path::{Path, PathBuf};

fn fuzz() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz")
}

/// Returns the seeds of a target, ordered by name.
fn seeds(target: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(fuzz().join("seeds").join(target)).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

/// Makes up to four changes, like a fuzzer.
fn changed(seed: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..=random.below(4) {
        let at = random.below(bytes.len().max(1));
        let end = (at + 1 + random.below(16)).min(bytes.len());
        match random.below(5) {
            0 => bytes.extend_from_within(at..end),
            1 => drop(bytes.drain(at..end)),
            2 => bytes.insert(at, random.next_u64() as u8),
            3 if at < bytes.len() => bytes[at] ^= 1 << random.below(8),
            _ => bytes.truncate(end),
        }
    }
    bytes
}

/// A panic describes the violation; the name of the thread contains the target and the seed.
#[test]
fn the_seeds_and_changes_of_them() {
    std::thread::scope(|scope| {
        for target in TARGETS {
            let replay = move || {
                let seeds = seeds(target.name);
                assert!(!seeds.is_empty(), "no seeds");
                for path in seeds {
                    let seed = fs::read(&path).unwrap();
                    (target.check)(&seed);
                    let mut random = Random(seed.len() as u64);
                    (0..target.copies).for_each(|_| (target.check)(&changed(&seed, &mut random)));
                }
            };
            std::thread::Builder::new().name(target.name.to_owned()).spawn_scoped(scope, replay).unwrap();
        }
    });
}

/// With each new format, the numbers of those after it change, and so must the first bytes of their seeds.
#[test]
fn each_format_has_a_seed_of_its_name() {
    let mut kinds: Vec<&str> = (0..=u8::MAX).map(kind_of_foreign).collect();
    kinds.sort_unstable();
    kinds.dedup();
    let found = seeds("foreign");
    let names: Vec<_> = found.iter().map(|path| path.file_name().unwrap().to_string_lossy()).collect();
    assert_eq!(names, kinds);
    for (path, name) in found.iter().zip(&names) {
        let first = fs::read(path).unwrap()[0];
        assert_eq!(kind_of_foreign(first), *name, "the first byte, {first}");
    }
}

/// Each check has a fuzz target, and each fuzz target a check.
#[test]
fn the_targets_are_those_of_the_fuzzers() {
    let mut programs: Vec<String> = fs::read_dir(fuzz().join("fuzz_targets"))
        .unwrap()
        .filter(|entry| entry.as_ref().unwrap().path().extension().is_some_and(|extension| extension == "rs"))
        .map(|entry| entry.unwrap().path().file_stem().unwrap().to_string_lossy().into_owned())
        .collect();
    programs.sort();
    let mut names = TARGETS.map(|target| target.name);
    names.sort_unstable();
    assert_eq!(programs, names);
    let manifest = fs::read_to_string(fuzz().join("Cargo.toml")).unwrap();
    for name in names {
        let program = fs::read_to_string(fuzz().join(format!("fuzz_targets/{name}.rs"))).unwrap();
        assert!(program.contains(&format!("lipz_testkit::fuzz::{name}(bytes)")), "{name}");
        assert!(fuzz().join(format!("fuzz_targets/{name}.options")).exists(), "{name}");
        assert!(manifest.contains(&format!("name = \"{name}\"\n")), "{name}");
    }
}
