//! Forged voices and dubs in banks: `verify` refuses everything that contradicts docs/reference/bank-format.md, and
//! without it no query returns wrong clips.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::{Bank, Error, ErrorKind, VoiceSource};
use lipz_compiler::{Compiler, Input, Options, Voices};
use lipz_layout::{DUB_OF, NO_DUB, OTHER_DUB, Tag};
use lipz_testkit::golden::{changed, section};
use std::ops::Range;

const TAGS: &[u8] = b"en-us\0de-at\0de-de\0";

/// Returns a bank with a line with a German dub, which is also played for Austrians, and a line without one.
fn bank() -> Vec<u8> {
    let files = [("aye", "MA|EO"), ("de/aye", "AAA|E"), ("no", "O|O")];
    let file = |codes| format!(r#"{{ "visemes": "{codes}", "viseme_type": "blair", "text_en-us": "Aye|aye" }}"#);
    let inputs = files.map(|(key, codes)| Input::from_bytes(key, file(codes)));
    let voices = Voices::new("en-us").unwrap().dub("de-de", "de/{key}").unwrap().dub("de-at", "at/{key}").unwrap();
    Compiler::new(Options::new().voices(voices)).compile(&inputs).into_bank().unwrap()
}

fn slot(bytes: &[u8], key: &str) -> u32 {
    Bank::open(bytes).unwrap().clip_by_key(key).unwrap().slot()
}

/// Returns the entry of the clip in a slot in the table of a voice, not counting the original's.
fn entry(bytes: &[u8], voice: usize, slot: u32) -> Range<usize> {
    let start = section(bytes, Tag::DUBS).start + (voice * 3 + slot as usize) * 4;
    start..start + 4
}

fn error(bytes: &[u8]) -> Option<ErrorKind> {
    let bank = Bank::open(bytes).unwrap();
    for clip in bank.clips() {
        for voice in bank.voices() {
            let _ = (clip.in_voice(voice), clip.voice(), clip.original()); // no panic
        }
    }
    bank.verify().err().map(Error::kind)
}

#[test]
fn a_voice_leads_to_its_dub_and_back() {
    let bytes = bank();
    assert_eq!(&bytes[section(&bytes, Tag::VOICES)], TAGS);
    let bank = Bank::open(&bytes).unwrap().verify().unwrap();
    let tags: Vec<_> = bank.voices().map(|voice| (bank.voice_tag(voice), voice.is_original())).collect();
    assert_eq!(tags, [("en-us", true), ("de-at", false), ("de-de", false)]);
    let played = |key: &str, tag: &str| {
        let voiced = bank.clip_by_key(key).unwrap().in_voice(bank.voice(tag).unwrap());
        (voiced.clip.key(), voiced.spoken)
    };
    for asked in ["aye", "de/aye"] {
        assert_eq!(played(asked, "en-us"), ("aye", VoiceSource::Original));
        assert_eq!(played(asked, "de-de"), ("de/aye", VoiceSource::Dub));
        assert_eq!(played(asked, "de-at"), ("de/aye", VoiceSource::OtherDub));
    }
    assert_eq!(played("no", "de-de"), ("no", VoiceSource::Original));
    assert!(bank.voice("fr-fr").is_none());
    assert_eq!(bank.clip_by_key("de/aye").unwrap().voice(), bank.voice("de-de"));
}

#[test]
fn entries_that_lead_elsewhere_are_refused() {
    let bytes = bank();
    let (aye, dub, no) = (slot(&bytes, "aye"), slot(&bytes, "de/aye"), slot(&bytes, "no"));
    let (austrian, german) = (0, 1);
    let value = |voice, slot| u32::from_le_bytes(bytes[entry(&bytes, voice, slot)].try_into().unwrap());
    let expected = [(german, aye, dub), (german, dub, aye | DUB_OF), (austrian, aye, dub | OTHER_DUB)];
    for (voice, slot, entry) in expected {
        assert_eq!(value(voice, slot), entry);
    }
    assert_eq!((value(austrian, dub), value(german, no)), (NO_DUB, NO_DUB));
    let wrong = [
        (german, aye, aye, "itself"),
        (german, aye, no, "no dub"),
        (german, aye, NO_DUB, "a dub that nothing leads to"),
        (german, aye, 3, "no slot"),
        (german, dub, no | DUB_OF, "another original"),
        (german, dub, NO_DUB, "an original that is not led back to"),
        (german, dub, dub | DUB_OF, "itself"),
        (german, no, aye | DUB_OF, "a second dub"),
        (german, no, dub, "a second original"),
        (austrian, dub, aye | DUB_OF, "a dub in two voices"),
        (austrian, dub, no | OTHER_DUB, "a dub that has a dub"),
        (austrian, aye, aye | OTHER_DUB, "itself"),
        (austrian, aye, DUB_OF | OTHER_DUB | dub, "both"),
        (austrian, aye, OTHER_DUB | 3, "no slot"),
        (austrian, no, NO_DUB - 1, "no slot"),
    ];
    for (voice, slot, value, what) in wrong {
        let forged = changed(&bytes, |bank| bank[entry(&bytes, voice, slot)].copy_from_slice(&value.to_le_bytes()));
        assert_eq!(error(&forged), Some(ErrorKind::Voice), "{what}");
    }
}

#[test]
fn tags_that_are_not_in_order_are_refused() {
    let bytes = bank();
    let wrong: [&[u8; 18]; 7] = [
        b"en-us\0de-de\0de-at\0",
        b"de-de\0de-at\0de-de\0",
        b"en-us\0de-at\0de-at\0",
        b"en-us\0de-at\0de-deX",
        b"en-us\0de-at-de-de\0",
        b"\0n-us\0de-at\0de-de\0",
        b"en-us\0de-at\0de-\xFFe\0",
    ];
    for tags in wrong {
        let forged = changed(&bytes, |bank| bank[section(&bytes, Tag::VOICES)].copy_from_slice(tags));
        assert_eq!(error(&forged), Some(ErrorKind::Voice), "{}", String::from_utf8_lossy(tags));
    }
    let original_last =
        changed(&bytes, |bank| bank[section(&bytes, Tag::VOICES)].copy_from_slice(b"zz-zz\0de-at\0de-de\0"));
    assert_eq!(error(&original_last), None, "the original comes first, whatever its tag");
}

#[test]
fn every_byte_counts() {
    let bytes = bank();
    for at in section(&bytes, Tag::DUBS) {
        for bit in 0..8 {
            let forged = changed(&bytes, |bank| bank[at] ^= 1 << bit);
            // A change that only selects a different dub as the replacement remains valid.
            let is_other = entry(&bytes, 0, slot(&bytes, "aye")).contains(&at);
            assert!(error(&forged) == Some(ErrorKind::Voice) || is_other, "byte {at}, bit {bit}");
        }
    }
}
