//! What holds for every optional section: it is written, `verify` looks at it, and splitting and comparing banks do
//! not lose it. A new section fails here until each of these knows it.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::{Bank, Recording};
use lipz_compiler::diff::diff;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Compiler, Input, SplitBank, Voices};
use lipz_layout::Tag;
use lipz_testkit::dialogues;
use lipz_testkit::golden::{changed, directory, entry_of, put, section};

/// Only the compiler reads them, which checks them itself (LZ0905).
const FOR_TOOLS: [Tag; 2] = [Tag::SOURCE_INDEX, Tag::SOURCES];

/// Only banks over others have it, and a stack of them looks at it: `layers.rs` beside this test.
const OF_STACKS: [Tag; 1] = [Tag::LAYER];

/// Sections of which a bank has all of a group or none.
const GROUPS: [&[Tag]; 2] = [&[Tag::CURVE_CLIPS, Tag::CURVES, Tag::CURVE_KEYS], &[Tag::VOICES, Tag::DUBS]];

/// A bank with all of them, and one of the same clips with none.
fn banks() -> (Vec<u8>, Vec<u8>) {
    let inputs =
        ["a", "a_de"].map(|key| Input::from_bytes(key, r#"{ "fps": 24, "visemes": "MA-", "text_en-us": " {m} Ma!" }"#));
    let curved = r#"{ "fps": 24, "visemes": "MA-", "text_en-us": " {m} Ma!", "curves": { "joy": "0:0 2:2.2" } }"#;
    let curved = ["a", "a_de"].map(|key| Input::from_bytes(key, curved));
    let compile =
        |settings: Settings, inputs: &[Input]| Compiler::new(settings.options).compile(inputs).into_bank().unwrap();
    let mut with = Settings::parse("[babble.robot]\nrate = 12\n[face]\nhead = 1\n", "", "").unwrap();
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
    for (tag, _) in Tag::OPTIONAL.into_iter().filter(|(tag, _)| !OF_STACKS.contains(tag)) {
        let name = String::from_utf8_lossy(&tag.0);
        assert!(has(&with, tag), "no bank with {name}: set what `lower` writes it for in `banks` of this test");
        assert!(!has(&without, tag), "{name} is not optional: banks that say nothing in it have it, too");
        if FOR_TOOLS.contains(&tag) {
            continue;
        }
        assert!(has(&split.base, tag), "split.rs drops {name}");
        let is_refused = |at: usize| {
            let bytes = changed(&with, |bank| bank[at] ^= 0xFF);
            Bank::open(&bytes).and_then(Bank::verify).is_err()
        };
        assert!(section(&with, tag).any(is_refused), "verify does not look at {name}");
        // The bank as a program sees it, if it skips the section.
        let alone = [tag];
        let group = GROUPS.into_iter().find(|group| group.contains(&tag)).unwrap_or(&alone);
        let hide = |bank: &mut Vec<u8>| {
            group
                .iter()
                .zip(b'0'..)
                .for_each(|(tag, digit)| put(bank, entry_of(&with, *tag), [b'N', b'E', b'W', digit]));
        };
        let hidden = changed(&with, hide);
        let is_seen = dialogues::with(&[&with], |old| dialogues::with(&[&hidden], |new| !diff(old, new).is_empty()));
        assert!(is_seen, "diff does not see {name}");
    }
}
