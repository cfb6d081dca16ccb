//! Linked objects of shards are the bank made by packing all sources together: byte for byte, in any number and order.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]
#![cfg(feature = "shards")]

mod support;

use lipz_bank::{Bank, Recording};
use lipz_compiler::babble::BabbleProfiles;
use lipz_compiler::shard::Link;
use lipz_compiler::{Compiled, Compiler, Input, Options, Voices};
use lipz_layout::{CHECKED_FROM, Header, TEXT_HAS_LENGTH, U32};
use proptest::prelude::*;
use std::fs;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;
use support::shards::{drama, objects, project, variants};
use zerocopy::{FromBytes, IntoBytes};

/// Links to a bank in memory, and checks that linking to a file has the same result.
fn linked(compiler: &Compiler<'_>, inputs: &[Input], shards: u16, turn: usize) -> Compiled {
    let folder = tempfile::tempdir().unwrap();
    let mut paths = objects(compiler, inputs, shards, folder.path());
    let turn = turn % paths.len();
    paths.rotate_left(turn);
    let link = Link::open(&paths).unwrap();
    let linked = compiler.link_to_bank(&link);
    let path = folder.path().join("linked.lipzbank");
    let to_file = compiler.link(&link, &path);
    assert_eq!(to_file.reports, linked.reports);
    assert_eq!(to_file.bank.map(|file| file.length_bytes), linked.bank.as_ref().map(Vec::len));
    assert!(fs::read(&path).ok() == linked.bank);
    linked
}

fn assert_same(compiler: &Compiler<'_>, inputs: &[Input], shards: u16, turn: usize) {
    let packed = compiler.compile(inputs);
    let linked = linked(compiler, inputs, shards, turn);
    assert!(packed.bank.is_some(), "{:?}", packed.reports);
    assert!(packed.bank == linked.bank, "{shards} shards");
    assert_eq!(packed.reports, linked.reports, "{shards} shards");
}

#[test]
fn the_drama_in_any_number_of_shards() {
    let inputs = drama();
    let recordings = inputs.iter().step_by(5).map(|input| (input.key.clone(), Recording::new(1_000_000, 7)));
    let with_profiles = Options::new().babble(BabbleProfiles::default()).recordings(recordings);
    let with_profiles = with_profiles.default_locale("en-us").unwrap();
    for options in variants().into_iter().chain([with_profiles]) {
        for (turn, shards) in [1, 2, 3, 7, 16, 64, 150].into_iter().enumerate() {
            assert_same(&Compiler::new(options.clone()), &inputs, shards, turn * 3);
        }
    }
}

#[test]
fn no_clips_and_many_threads() {
    for threads in 1..=4 {
        let compiler = Compiler::new(Options::new().threads(threads));
        assert_same(&compiler, &[], 3, 0);
        let folders = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
        let alone = Compiler::new(Options::new().threads(1));
        for (compiler, folder) in [(&compiler, &folders[0]), (&alone, &folders[1])] {
            objects(compiler, &drama(), 4, folder.path());
        }
        for name in ["0-of-4.lipzobj", "3-of-4.lipzobj"] {
            let [one, other] = folders.each_ref().map(|folder| fs::read(folder.path().join(name)).unwrap());
            assert!(one == other, "{threads} threads: {name}");
        }
    }
}

#[test]
fn dubs_and_their_originals() {
    let clip = |key: &str, file: &str| Input::from_bytes(key, file);
    let voices =
        Voices::new("en-us").unwrap().dub("de-de", "de/{key}.ogg").unwrap().dub("fr-fr", "fr/{key}.ogg").unwrap();
    let options = Options::new().default_locale("en-us").unwrap().voices(voices);
    let lines: Vec<Input> = (0..20)
        .flat_map(|line| {
            let original = clip(&format!("line-{line}"), r#"{ "visemes": "MA|O", "text_en-us": "Ma!|Oh." }"#);
            let dub = clip(&format!("de/line-{line}"), r#"{ "visemes": "OO|A", "text_de-de": "Mama!|Oh." }"#);
            [original, dub]
        })
        .collect();
    let compiler = Compiler::new(options);
    [2, 8].into_iter().for_each(|shards| assert_same(&compiler, &lines, shards, 1));
    // Problems between two clips are found when both are present.
    let mut wrong = lines.clone();
    wrong[1] = clip("de/line-0", r#"{ "visemes": "OOA", "text_de-de": "Mama!" }"#);
    wrong[3] = clip("de/line-1", r#"{ "visemes": "OO|A", "text_en-us": "Other!|Oh." }"#);
    let [packed, linked] = [compiler.compile(&wrong), linked(&compiler, &wrong, 8, 3)];
    let messages = |compiled: &Compiled| {
        let diagnostics = compiled.reports.iter().flat_map(|report| &report.diagnostics);
        diagnostics.map(|diagnostic| (diagnostic.code, diagnostic.message.clone())).collect::<Vec<_>>()
    };
    assert!(packed.bank.is_none() && linked.bank.is_none());
    assert_eq!(messages(&packed), messages(&linked));
    assert_eq!(messages(&linked).len(), 2);
}

#[test]
fn keys_that_clash_are_found_across_shards() {
    let inputs = ["A/hello", "a/hello"].map(|key| Input::from_bytes(key, r#"{ "text_en-us": "Hello." }"#));
    let compiler = Compiler::default();
    let [packed, linked] = [compiler.compile(&inputs), linked(&compiler, &inputs, 64, 0)];
    assert!(packed.bank.is_none() && linked.bank.is_none());
    assert_eq!(packed.reports, linked.reports);
}

#[test]
fn damaged_objects_are_refused() {
    let (compiler, folder) = (Compiler::default(), tempfile::tempdir().unwrap());
    let paths = objects(&compiler, &drama()[..3], 2, folder.path());
    let bytes = fs::read(&paths[0]).unwrap();
    for at in (0..bytes.len()).step_by(7) {
        let mut damaged = bytes.clone();
        damaged[at] ^= 1 << (at % 8);
        fs::write(&paths[0], damaged).unwrap();
        let linked = Link::open(&paths).map(|link| compiler.link_to_bank(&link));
        assert!(linked.is_err() || linked.is_ok_and(|linked| linked.bank.is_none()), "byte {at}");
    }
    for length in (0..bytes.len()).step_by(97) {
        fs::write(&paths[0], &bytes[..length]).unwrap();
        let linked = Link::open(&paths).map(|link| compiler.link_to_bank(&link));
        assert!(linked.is_err() || linked.is_ok_and(|linked| linked.bank.is_none()), "{length} bytes");
    }
}

/// Readers can use such a bank, but no compiler makes it.
#[test]
fn objects_whose_texts_are_not_in_order_are_refused() {
    let (compiler, folder) = (Compiler::default(), tempfile::tempdir().unwrap());
    let file = br#"{ "text_en-us": "One two three. | Four five six. | Seven eight nine." }"#;
    let paths = objects(&compiler, &[Input::from_bytes("a", file)], 1, folder.path());
    let bytes = fs::read(&paths[0]).unwrap();
    let start = |tag: &[u8; 4]| {
        let section = Bank::open(&bytes).unwrap().sections().find(|(found, _)| found == tag).unwrap().1;
        section.as_ptr().addr() - bytes.as_ptr().addr()
    };
    let (starts, texts) = (start(b"TXST"), start(b"TEXT"));
    let mut forged = bytes.clone();
    // The first text is counted, and has one letter: the bytes before the second belong to no text.
    let first = U32::new(TEXT_HAS_LENGTH);
    forged[starts..starts + 4].copy_from_slice(first.as_bytes());
    forged[texts..texts + 4].copy_from_slice(b"\0\0\x01O");
    let checksum = lipz_layout::checksum(&forged[CHECKED_FROM..]);
    let (header, _) = Header::mut_from_prefix(&mut forged).unwrap();
    header.checksum = checksum.into();
    Bank::open(&forged).unwrap().verify().unwrap();
    fs::write(&paths[0], forged).unwrap();
    let linked = compiler.link_to_bank(&Link::open(&paths).unwrap());
    assert!(linked.bank.is_none());
    assert!(linked.reports[0].diagnostics[0].message.contains("its clips cannot be read"), "{:?}", linked.reports);
}

/// The copied data must be the verified data.
#[test]
fn objects_that_somebody_writes_to_meanwhile_are_refused() {
    for shards in [2, 150] {
        let folder = tempfile::tempdir().unwrap();
        let paths = objects(&Compiler::default(), &drama(), shards, folder.path());
        let link = Link::open(&paths).unwrap();
        let read = AtomicUsize::new(0);
        let meanwhile = |_| {
            if read.fetch_add(1, Ordering::SeqCst) + 1 == paths.len() {
                // Longer than a tick of the file system's clock.
                std::thread::sleep(Duration::from_millis(50));
                fs::write(&paths[1], fs::read(&paths[1]).unwrap()).unwrap();
            }
        };
        let path = folder.path().join("linked.lipzbank");
        let linked = Compiler::default().progress(meanwhile).link(&link, &path);
        assert!(linked.bank.is_none() && !path.exists(), "{shards} shards");
        let messages: Vec<_> = linked.reports.iter().flat_map(|report| &report.diagnostics).collect();
        assert!(messages.iter().any(|found| found.message.contains("changed during the link")), "{messages:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn linked_is_packed((options, inputs) in project(), shards in 1..=40_u16, turn in 0..40_usize) {
        let compiler = Compiler::new(options);
        let packed = compiler.compile(&inputs);
        let linked = linked(&compiler, &inputs, shards, turn);
        prop_assert!(packed.bank == linked.bank);
        prop_assert_eq!(packed.reports, linked.reports);
    }
}
