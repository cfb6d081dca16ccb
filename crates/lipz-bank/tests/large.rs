//! Numbers that need more bits than those of small banks: crafted banks with large sections.
// Tests and their helpers: they run with the workspace's compiler, not with the oldest one of the reader.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

mod common;

use common::{changed, finding, put, record_of, section, u32_at, verified, with_section, SMALL};
use lipz_bank::layout::{Tag, NO_TEXT, TEXT_WIDE};
use lipz_bank::{ErrorKind, Micros};

/// Ends of 28 bits: a text of more than two million bytes, followed by a short one.
#[test]
fn wide_ends_use_all_four_bytes() {
    let long = "é".repeat(0x12_3456);
    let ends = [long.len(), long.len() + 3];
    let mut pool: Vec<u8> =
        ends.iter().flat_map(|end| (0..4).map(move |byte| (end >> (7 * byte)) as u8 & 0x7F)).collect();
    pool.extend_from_slice(long.as_bytes());
    pool.extend_from_slice(b"end");
    let bytes = changed(&with_section(SMALL, Tag::TEXTS, &pool), |bank| {
        let index = section(bank, Tag::TEXT_INDEX);
        let silent = verified(SMALL).clip_by_key("act2/silent").expect("a clip of two segments").slot() as usize;
        bank[index.clone()].fill(0xFF);
        put(bank, index.start + 4 * silent, TEXT_WIDE.to_le_bytes());
    });
    let bank = verified(&bytes);
    let clip = bank.clip_by_key("act2/silent").expect("the same clip");
    let (german, english) = (bank.locale("de-de").expect("a locale"), bank.locale("en-us").expect("a locale"));
    let texts: Vec<_> = clip.segments().filter_map(|segment| segment.text(german)).collect();
    assert_eq!(texts.len(), 2);
    assert!(texts[0].as_str() == long && texts[1].as_str() == "end");
    assert!(clip.segments().all(|segment| segment.text(english).is_none()));
    assert_eq!(u32_at(&bytes, section(&bytes, Tag::TEXT_INDEX).end - 4), NO_TEXT);
}

/// The index of far starts has a low and a high half.
#[test]
fn far_starts_behind_many_others() {
    let starts = &SMALL[section(SMALL, Tag::STARTS)];
    let many = [&[0; 4 * 0x1_0002][..], starts].concat();
    let far = record_of(SMALL, "act2/far");
    let bytes = changed(&with_section(SMALL, Tag::STARTS, &many), |bank| put(bank, far + 48, [2, 0, 1, 0]));
    let (bank, small) = (verified(&bytes), verified(SMALL));
    let starts = |bank: &lipz_bank::Bank<'_>| {
        let clip = bank.clip_by_key("act2/far").expect("a clip of twelve segments");
        clip.segments().map(|segment| segment.start_frame()).collect::<Vec<_>>()
    };
    assert_eq!(starts(&bank), starts(&small));
}

/// A clip of more than 65,535 frames has far starts: inline ones could not be told from unused ones.
#[test]
fn clips_of_many_frames() {
    let frames = vec![b'A'; 70_000];
    let clip = record_of(SMALL, "act2/unspecified");
    let with = |count: u32, flags: u8, starts: [u8; 4]| {
        let bank = with_section(SMALL, Tag::FRAMES, &[&SMALL[section(SMALL, Tag::FRAMES)], &frames[..]].concat());
        changed(&bank, |bank| {
            put(bank, clip + 24, (section(SMALL, Tag::FRAMES).len() as u32).to_le_bytes());
            put(bank, clip + 28, count.to_le_bytes());
            put(bank, clip + 47, [flags]);
            put(bank, clip + 48, starts);
        })
    };
    assert_eq!(finding(&with(65_535, 1, [0xFF; 4])), None);
    let error = finding(&with(65_536, 1, [0xFF; 4])).expect("damage");
    assert_eq!((error.kind(), error.offset_bytes() as usize), (ErrorKind::SegmentStarts, clip));
    let bytes = with(70_000, 3, [0; 4]);
    let bank = verified(&bytes);
    let clip = bank.clip_by_key("act2/unspecified").expect("a clip").or_fps(lipz_bank::Fps::whole(1000));
    assert_eq!(clip.frame_at(Micros(69_999_999)), Some(69_999));
    assert_eq!(clip.segment_of_frame(69_999).map(|segment| segment.index()), Some(0));
    assert_eq!((clip.frames().len(), clip.viseme(69_999).code()), (70_000, b'A'));
}
