//! Numbers that need more bits than those of small banks.
// Tests and their helpers: they run with the workspace's compiler, not with the oldest one of the reader.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

mod common;

use common::forge::{ForgedClip, bank};
use common::{finding, verified};
use lipz_bank::layout::{NO_TEXT, TEXT_WIDE};
use lipz_bank::{ErrorKind, Fps, Micros};

fn clip(key: &'static str, frame_count: usize, starts: Vec<u32>, has_far_starts: bool) -> ForgedClip {
    ForgedClip { key, frames: vec![b'A'; frame_count], starts, has_far_starts }
}

/// Ends of 28 bits: a text of more than two million bytes, followed by a short one.
#[test]
fn wide_ends_use_all_four_bytes() {
    let long = "é".repeat(0x12_3456);
    let ends = [long.len(), long.len() + 3];
    let mut pool: Vec<u8> =
        ends.iter().flat_map(|end| (0..4).map(move |byte| (end >> (7 * byte)) as u8 & 0x7F)).collect();
    pool.extend_from_slice(long.as_bytes());
    pool.extend_from_slice(b"end");
    let bytes = bank(&[clip("a", 2, vec![1], false)], 2, &[TEXT_WIDE, NO_TEXT], &pool);
    let bank = verified(&bytes);
    let clip = bank.clip_by_key("a").expect("the clip");
    let (first, second) = (bank.locale("00000000").expect("a locale"), bank.locale("00000001").expect("a locale"));
    let texts: Vec<_> = clip.segments().filter_map(|segment| segment.text(first)).collect();
    assert_eq!(texts.len(), 2);
    assert!(texts[0].as_str() == long && texts[1].as_str() == "end");
    assert!(clip.segments().all(|segment| segment.text(second).is_none()));
}

/// The index of far starts has a low and a high half.
#[test]
fn far_starts_behind_many_others() {
    let many = clip("a", 0, vec![0; 0x1_0002], true);
    let few: Vec<u32> = vec![1, 1, 2, 3, 5, 8, 8, 9, 10, 11];
    let bytes = bank(&[many, clip("b", 12, few.clone(), true)], 0, &[], &[]);
    let bank = verified(&bytes);
    let clip = bank.clip_by_key("b").expect("the clip");
    let starts: Vec<u32> = clip.segments().skip(1).map(|segment| segment.start_frame()).collect();
    assert_eq!(starts, few);
    let of_frame: Vec<u32> = (0..12).filter_map(|frame| Some(clip.segment_of_frame(frame)?.index())).collect();
    assert_eq!(of_frame, [0, 2, 3, 4, 4, 5, 5, 5, 7, 8, 9, 10]);
}

/// A clip of more than 65,535 frames has far starts: inline ones could not be told from unused ones.
#[test]
fn clips_of_many_frames() {
    assert_eq!(finding(&bank(&[clip("a", 65_535, vec![65_535], false)], 0, &[], &[])), None);
    let error = finding(&bank(&[clip("a", 65_536, vec![], false)], 0, &[], &[])).expect("damage");
    assert_eq!(error.kind(), ErrorKind::SegmentStarts);
    let bytes = bank(&[clip("a", 70_000, vec![], true)], 0, &[], &[]);
    let bank = verified(&bytes);
    let clip = bank.clip_by_key("a").expect("a clip").or_fps(Fps::whole(1000));
    assert_eq!(clip.frame_at(Micros(69_999_999)), Some(69_999));
    assert_eq!(clip.segment_of_frame(69_999).map(|segment| segment.index()), Some(0));
    assert_eq!((clip.frames().len(), clip.viseme(69_999).code()), (70_000, b'A'));
}
