//! LIP files: writing reproduces the bytes that were read, and no content of a file makes reading panic.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

use lipz_diagnostics::{Code, Diagnostic};
use lipz_interop::fallout::lip::{ByteOrder, Lip, Marker};
use proptest::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};

fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/interop/fallout")
}

fn fixture(name: &str) -> Vec<u8> {
    fs::read(fixtures().join(name)).unwrap()
}

/// Two words between silence.
fn hello() -> Lip {
    let positions = [0, 4410, 6614, 11026, 15436, 22050, 26460, 35280];
    let kinds = [1, 1, 0, 0, 0, 1, 0, 1];
    let markers = kinds.into_iter().zip(positions).map(|(kind, position)| Marker { kind, position });
    Lip::new(*b"ELD_1\0\0\0", vec![0x00, 0x1F, 0x04, 0x23, 0x08, 0x12, 0x01], markers.collect())
}

fn codes(diagnostics: &[Diagnostic]) -> Vec<Code> {
    diagnostics.iter().map(|diagnostic| diagnostic.code).collect()
}

#[test]
fn a_file_as_the_game_has_them_has_nothing_unusual() {
    assert_eq!(hello().oddities("eld_1"), []);
    assert_eq!(hello().write().len(), 44 + 7 + 8 * 8);
    assert_eq!(Lip::read(&hello().write()).unwrap(), hello());
}

#[test]
fn all_words_are_big_endian() {
    let bytes = hello().write();
    assert_eq!(bytes[..8], [0, 0, 0, 2, 0, 0, 0x58, 0]);
    assert_eq!(bytes[0x10..0x20], [0, 0, 0x89, 0xD0, 0, 0, 0, 7, 0, 0, 0, 0, 0, 0, 0, 8]);
    assert_eq!(bytes[0x20..0x2C], *b"ELD_1\0\0\0VOC\0");
    assert_eq!(bytes[0x33..0x43], [0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0x11, 0x3A]);
}

#[test]
fn each_oddity_has_its_diagnostic_and_is_kept() {
    type Change = fn(&mut Lip);
    let changes: [(Code, &str, Change); 15] = [
        (Code::LipHeader, "bytes 0x04 to 0x07", |lip| lip.constant = 0x5801),
        (Code::LipHeader, "bit 1: it is being played", |lip| lip.flags = 2),
        (Code::LipHeader, "bytes 0x0c to 0x0f", |lip| lip.unknown_0c = 1),
        (Code::LipHeader, "bytes 0x18 to 0x1b", |lip| lip.unknown_18 = u32::MAX),
        (Code::LipHeader, "bytes 0x28 to 0x2b", |lip| lip.extension = *b"ACM\0"),
        (Code::LipLength, "bytes 0x10 to 0x13", |lip| lip.length_word = 35_282_u32.to_be_bytes()),
        (Code::LipName, "bytes 0x20 to 0x27", |lip| lip.name = *b"ELD_2\0\0\0"),
        (Code::LipName, "bytes 0x20 to 0x27", |lip| lip.name = *b"ELD_1\0.A"),
        (Code::LipName, "bytes 0x20 to 0x27", |lip| lip.name = *b"ELD_\xE9\0\0\0"),
        (Code::LipPhoneme, "byte 0x2e", |lip| lip.phonemes[2] = 0x2A),
        (Code::LipMarkerType, "bytes 0x33 to 0x3a", |lip| lip.markers[0].kind = 0),
        (Code::LipMarkerType, "bytes 0x3b to 0x42", |lip| lip.markers[1].kind = 2),
        (Code::LipMarkerOrder, "bytes 0x33 to 0x3a", |lip| lip.markers[0].position = 2),
        (Code::LipMarkerOrder, "bytes 0x43 to 0x4a", |lip| lip.markers[2].position = 4408),
        (Code::LipTrailing, "bytes 0x73 to 0x74", |lip| lip.trailing = vec![0, 0]),
    ];
    for (code, note, change) in changes {
        let mut lip = hello();
        change(&mut lip);
        let read = Lip::read(&lip.write()).unwrap();
        assert_eq!(read, lip, "{code}");
        let found = read.oddities("ELD_1");
        assert_eq!(codes(&found), [code], "{found:?}");
        assert!(found[0].notes.iter().any(|found| found == note), "{note}: {found:?}");
    }
}

#[test]
fn counts_that_do_not_belong_together_are_reported() {
    let mut fewer = hello();
    fewer.markers.truncate(4);
    let mut more = hello();
    more.phonemes.truncate(2);
    let mut nothing = hello();
    nothing.phonemes.clear();
    nothing.markers.clear();
    for lip in [fewer, more, nothing] {
        assert_eq!(Lip::read(&lip.write()).unwrap(), lip);
        assert!(codes(&lip.oddities("eld_1")).contains(&Code::LipCounts));
    }
}

#[test]
fn names_may_use_all_eight_bytes() {
    let lip = Lip { name: *b"ELDER_12", ..hello() };
    assert_eq!((lip.sound().as_str(), lip.oddities("elder_12")), ("ELDER_12", Vec::new()));
}

#[test]
fn the_length_is_read_the_right_way_round() {
    let mut lip = hello();
    assert_eq!(lip.length().order, ByteOrder::Big);
    lip.length_word.reverse();
    assert_eq!(lip.oddities("eld_1"), [], "most files of the game are like this");
    assert_eq!((lip.length().order, lip.length().bytes), (ByteOrder::Little, 35_280));
    lip.length_word = 35_281_u32.to_le_bytes();
    assert_eq!((lip.length().order, lip.length().bytes), (ByteOrder::Little, 35_281));
    assert_eq!(codes(&lip.oddities("eld_1")), [Code::LipLength]);
}

#[test]
fn other_files_are_refused_with_a_reason() {
    let version = |bytes: [u8; 4]| {
        let mut file = hello().write();
        file[..4].copy_from_slice(&bytes);
        Lip::read(&file).unwrap_err()
    };
    for (bytes, reason) in [
        ([0, 0, 0, 1], "version 1, which lipz does not read"),
        ([2, 0, 0, 0], "little-endian"),
        (*b"LIP ", "Knights of the Old Republic"),
        ([0, 0, 0, 3], "its version is 3, not 2"),
    ] {
        let refused = version(bytes);
        assert_eq!(refused.code, Code::LipVersion);
        assert!(refused.message.contains(reason) && refused.help.is_some(), "{refused:?}");
    }
}

#[test]
fn a_file_cut_anywhere_is_refused() {
    let whole = hello().write();
    for length in 0..whole.len() {
        let refused = Lip::read(&whole[..length]).unwrap_err();
        assert_eq!(refused.code, Code::LipCutOff, "{length}");
    }
}

#[test]
fn counts_that_no_file_holds_are_refused() {
    for at in [0x14, 0x1C] {
        let mut bytes = hello().write();
        bytes[at..at + 4].copy_from_slice(&u32::MAX.to_be_bytes());
        assert_eq!(Lip::read(&bytes).unwrap_err().code, Code::LipCutOff);
    }
}

#[test]
fn a_file_full_of_oddities_lists_some_and_counts_the_rest() {
    let markers = (0..5000).rev().map(|position| Marker { kind: 9, position }).collect();
    let found = Lip::new(*b"ELD_1\0\0\0", vec![0xFF; 4999], markers).oddities("eld_1");
    assert!(found.len() < 400, "{}", found.len());
    assert!(found.iter().any(|diagnostic| diagnostic.notes.contains(&"4899 more like this are not listed".into())));
}

/// The fixtures: like most files of the game, with a little-endian length; without irregularities; with an 8-byte name
/// that belongs to a different file, flags, a phoneme beyond the last, a marker that runs backwards and a byte at the
/// end; truncated; of version 1. `LIPZ_BLESS=1 cargo test -p lipz-interop --test fallout_lip` writes them.
fn made() -> Vec<(&'static str, Vec<u8>)> {
    let plain = hello();
    let mut as_most = plain.clone();
    as_most.length_word.reverse();
    let mut odd = plain.clone();
    odd.name = *b"LYNETTE9";
    odd.flags = 3;
    odd.phonemes[5] = 0x2B;
    odd.markers[3].position = odd.markers[2].position - 2000;
    odd.trailing = b"\x1A".to_vec();
    let mut cut_off = plain.write();
    cut_off.truncate(90);
    // The game's structure in memory: words, some of them pointers, then names.
    let mut version_1 = vec![0; 360];
    version_1[3] = 1;
    version_1[0x06] = 0x58;
    version_1[0x50..0x55].copy_from_slice(b"ELD_1");
    vec![
        ("eld_1.lip", as_most.write()),
        ("eld_2.lip", Lip { name: *b"ELD_2\0\0\0", ..plain.clone() }.write()),
        ("eld_odd.lip", odd.write()),
        ("eld_cut.lip", cut_off),
        ("eld_old.lip", version_1),
    ]
}

#[test]
fn fixtures_are_as_they_are_made() {
    for (name, bytes) in made() {
        if std::env::var_os("LIPZ_BLESS").is_some_and(|value| value == "1") {
            fs::create_dir_all(fixtures()).unwrap();
            fs::write(fixtures().join(name), &bytes).unwrap();
        }
        assert_eq!(fixture(name), bytes, "{name}");
        match Lip::read(&bytes) {
            Ok(lip) => assert_eq!(lip.write(), bytes, "{name}"),
            Err(_) => assert!(["eld_cut.lip", "eld_old.lip"].contains(&name)),
        }
    }
}

fn any_lip() -> impl Strategy<Value = Lip> {
    let words = (any::<u32>(), any::<u32>(), any::<u32>(), any::<[u8; 4]>(), any::<u32>());
    let marker = (any::<u32>(), any::<u32>()).prop_map(|(kind, position)| Marker { kind, position });
    let lists = (
        prop::collection::vec(any::<u8>(), 0..60),
        prop::collection::vec(marker, 0..60),
        prop::collection::vec(any::<u8>(), 0..9),
    );
    (words, any::<([u8; 8], [u8; 4])>(), lists).prop_map(|(words, (name, extension), (phonemes, markers, trailing))| {
        let (constant, flags, unknown_0c, length_word, unknown_18) = words;
        Lip { constant, flags, unknown_0c, length_word, unknown_18, name, extension, phonemes, markers, trailing }
    })
}

proptest! {
    #[test]
    fn what_is_written_is_read(lip in any_lip()) {
        let bytes = lip.write();
        let read = Lip::read(&bytes).unwrap();
        read.oddities("eld_1");
        prop_assert_eq!(read.write(), bytes);
        prop_assert_eq!(read, lip);
    }

    #[test]
    fn what_is_read_is_written(changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6)) {
        let mut bytes = hello().write();
        for (index, byte) in changes {
            let at = index.index(bytes.len());
            bytes[at] = byte;
        }
        if let Ok(lip) = Lip::read(&bytes) {
            lip.oddities("eld_1");
            prop_assert_eq!(lip.write(), bytes);
        }
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        if let Ok(lip) = Lip::read(&bytes) {
            prop_assert_eq!(lip.write(), bytes);
        }
    }
}
