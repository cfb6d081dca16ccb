//! Verified banks that would expand to far more than their length: they are refused quickly.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::{Dialogue, Locale};
use lipz_compiler::inspect::ClipDetails;
use lipz_compiler::{Documents, Replacements, stats, unpack};
use lipz_diagnostics::Code;
use lipz_layout::{TEXT_HAS_LENGTH, TEXT_MAX_BYTES, text_count};
use lipz_testkit::dialogues::places;
use lipz_testkit::forge::{ForgedClip, bank};

/// Returns a clip with this number of segments, each with the same text of maximum length.
fn bomb(segment_count: usize) -> Vec<u8> {
    let clip = ForgedClip { key: "k", frames: vec![], starts: vec![0; segment_count - 1] };
    let pool = [&text_count(TEXT_MAX_BYTES)[..], &[b'a'; TEXT_MAX_BYTES]].concat();
    bank(&[clip], 1, &vec![TEXT_HAS_LENGTH; segment_count], &pool)
}

#[test]
fn texts_that_would_fill_gigabytes_are_refused() {
    let bytes = bomb(60_000);
    assert!(bytes.len() < 1 << 20);
    let mut files = places(1);
    let dialogue = Dialogue::open(&mut files, [bytes.as_slice()]).unwrap();
    let documents = Documents::from_dialogue(&dialogue).unwrap();
    let report = documents.iter().next().unwrap().unwrap_err();
    assert_eq!(report.diagnostics[0].code, Code::SourceDamaged);
    assert!(report.diagnostics[0].message.contains("exceed the size limit"));

    let folder = tempfile::tempdir().unwrap();
    assert!(unpack(&dialogue, folder.path(), false, &Replacements::default(), &|_| ()).is_err());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "nothing was written");

    let locales: Vec<Locale> = dialogue.locales().collect();
    assert!(!ClipDetails::is_bounded(&dialogue, &dialogue.clip_by_key("k").unwrap(), &locales));
    assert!(!stats::is_bounded(&dialogue));
}

#[test]
fn texts_that_fit_are_not() {
    let bytes = bomb(100);
    let mut files = places(1);
    let dialogue = Dialogue::open(&mut files, [bytes.as_slice()]).unwrap();
    let documents = Documents::from_dialogue(&dialogue).unwrap();
    assert!(documents.iter().all(|document| document.is_ok()));
    let locales: Vec<Locale> = dialogue.locales().collect();
    assert!(ClipDetails::is_bounded(&dialogue, &dialogue.clip_by_key("k").unwrap(), &locales));
    assert!(stats::is_bounded(&dialogue));
}
