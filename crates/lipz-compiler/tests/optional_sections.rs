//! Requirements for every optional section: it is written, `verify` checks it, and splitting and comparing banks keep
//! it. A new section fails here until each of these supports it.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::{Bank, Recording};
use lipz_compiler::diff::diff;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Input, SplitBank, Voices};
use lipz_layout::Tag;
use lipz_testkit::dialogues;
use lipz_testkit::golden::{self, changed, directory, entry_of, put};

/// Returns a bank with all of them, and one of the same clips without any.
fn banks() -> (Vec<u8>, Vec<u8>) {
    let inputs =
        ["a", "a_de"].map(|key| Input::from_bytes(key, r#"{ "fps": 24, "visemes": "MA-", "text_en-us": " {m} Ma!" }"#));
    let curved = r#"{ "fps": 24, "visemes": "MA-", "text_en-us": " {m} Ma!", "curves": { "joy": "0:0 2:2.2" },
        "phones": "sil@0 M@40 AA@80" }"#;
    let curved = ["a", "a_de"].map(|key| Input::from_bytes(key, curved));
    let compile =
        |settings: Settings, inputs: &[Input]| Compiler::new(settings.options).compile(inputs).into_bank().unwrap();
    let mut with = Settings::parse("[babble.robot]\nrate = 12\n[face]\nhead = 1\n[rig]\nvrm = true\n", "", "").unwrap();
    with.options = with.options.recordings([("a", Recording::new(1_500_000, 7))]);
    with.options = with.options.voices(Voices::new("en-us").unwrap().dub("de-de", "{key}_de").unwrap());
    let without = Settings::parse("strip = true\n", "", "").unwrap();
    (compile(with, &curved), compile(without, &inputs))
}

fn has(bank: &[u8], tag: Tag) -> bool {
    directory(bank).iter().any(|entry| entry.tag == tag.0)
}

#[test]
fn every_optional_section_is_known_to_all_that_must_know_it() {
    let (with, without) = banks();
    let split = SplitBank::from_bytes(&with).unwrap();
    let not_in_base = Tag::OPTIONAL.into_iter().filter(|section| !section.is_in_base).map(|section| section.tag);
    assert_eq!(not_in_base.collect::<Vec<_>>(), [Tag::SOURCE_INDEX, Tag::SOURCES, Tag::LAYER]);
    // Only banks on top of others have a layer: see `layers.rs` next to this test.
    for section in Tag::OPTIONAL.into_iter().filter(|section| section.tag != Tag::LAYER) {
        let tag = section.tag;
        let name = String::from_utf8_lossy(&tag.0);
        assert!(
            has(&with, tag),
            "no bank with {name}: add the input for which `lower` writes it to `banks` of this test"
        );
        assert!(!has(&without, tag), "{name} is not optional: banks that say nothing in it have it, too");
        assert_eq!(has(&split.base, tag), section.is_in_base, "{name} in the base bank");
        // The others are read only by the compiler, which checks them itself (LZ0905).
        if !section.is_in_base {
            continue;
        }
        let is_refused = |at: usize| {
            let bytes = changed(&with, |bank| bank[at] ^= 0xFF);
            Bank::open(&bytes).and_then(Bank::verify).is_err()
        };
        assert!(golden::section(&with, tag).any(is_refused), "verify does not check {name}");
        // The bank as a program sees it that skips the section.
        let group = Tag::OPTIONAL.iter().filter(|other| other.group == section.group);
        let hide = |bank: &mut Vec<u8>| {
            group
                .zip(b'0'..)
                .for_each(|(other, digit)| put(bank, entry_of(&with, other.tag), [b'N', b'E', b'W', digit]));
        };
        let hidden = changed(&with, hide);
        let is_seen = dialogues::with(&[&with], |old| dialogues::with(&[&hidden], |new| !diff(old, new).is_empty()));
        assert!(is_seen, "diff does not compare {name}");
    }
}
