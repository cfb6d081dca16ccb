//! Numbers that need more bits than those of small banks.
// Tests and their helpers: they run with the workspace's compiler, not with the oldest one of the reader.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

mod common;

use common::forge::{ForgedClip, bank};
use common::{finding, verified};
use lipz_bank::layout::{NO_TEXT, TEXT_WIDE};
use lipz_bank::{Error, ErrorKind, Fps, Micros};

fn clip(key: &'static str, frame_count: usize, starts: Vec<u32>) -> ForgedClip {
    ForgedClip { key, frames: vec![b'A'; frame_count], starts }
}

/// The ends of texts of more than 65,535 bytes wrap around, as often as there are segments.
#[test]
fn ends_of_wide_texts_wrap_around() {
    let lengths = [0xFFFE, 0, 0xFFFE, 0x8000, 4];
    let pool = "é".repeat(lengths.iter().sum::<usize>() / 2);
    let ends: Vec<u16> = lengths
        .iter()
        .scan(0, |end, length| {
            *end += length;
            Some(*end as u16)
        })
        .collect();
    let with = |entry| bank(&[clip("a", 2, vec![1; 4])], 1, &[entry], &ends, pool.as_bytes());
    let bytes = with(TEXT_WIDE);
    let bank = verified(&bytes);
    let locale = bank.locale("00000000").expect("a locale");
    let segments = bank.clip_by_key("a").expect("the clip").segments();
    let found: Vec<_> = segments.filter_map(|segment| Some(segment.text(locale)?.len())).collect();
    assert_eq!(found, lengths);
    assert_eq!(finding(&with(0)).map(Error::kind), Some(ErrorKind::TextReference), "not marked as wide");
}

/// Texts that fit into 16 bits are not marked as wide, and no text has no end.
#[test]
fn entries_agree_with_the_ends() {
    let kind = |entry, end| {
        let bytes = bank(&[clip("a", 0, vec![])], 1, &[entry], &[end], &[b'x'; 0xFFFF]);
        finding(&bytes).map(Error::kind)
    };
    let damage = Some(ErrorKind::TextReference);
    assert_eq!([kind(0, 0xFFFF), kind(NO_TEXT, 0), kind(1, 0xFFFE)], [None; 3]);
    assert_eq!([kind(TEXT_WIDE, 0xFFFF), kind(NO_TEXT, 1), kind(1, 0xFFFF)], [damage; 3]);
}

/// Clips of more segments than are compared at once, in front of others and as the last one.
#[test]
fn segments_behind_many_others() {
    let few: Vec<u32> = vec![1, 1, 2, 3, 5, 8, 8, 9, 10, 11];
    let clips = [clip("a", 0, vec![0; 0xFFFE]), clip("b", 12, few.clone()), clip("c", 12, few.clone())];
    let bytes = bank(&clips, 0, &[], &[0], &[]);
    let bank = verified(&bytes);
    assert_eq!(bank.clip_by_key("a").map(|clip| clip.segment_count()), Some(0xFFFF));
    for key in ["b", "c"] {
        let clip = bank.clip_by_key(key).expect("the clip");
        let starts: Vec<u32> = clip.segments().skip(1).map(|segment| segment.start_frame()).collect();
        assert_eq!(starts, few);
        let of_frame: Vec<u32> = (0..12).filter_map(|frame| Some(clip.segment_of_frame(frame)?.index())).collect();
        assert_eq!(of_frame, [0, 2, 3, 4, 4, 5, 5, 5, 7, 8, 9, 10]);
    }
}

/// A clip of an hour, at the highest rate.
#[test]
fn clips_of_many_frames() {
    let bytes = bank(&[clip("a", 3_600_000, vec![70_000])], 0, &[], &[0], &[]);
    let bank = verified(&bytes);
    let clip = bank.clip_by_key("a").expect("a clip").or_fps(Fps::whole(1000));
    assert_eq!(clip.frame_at(Micros(3_599_999_999)), Some(3_599_999));
    let index = |frame| clip.segment_of_frame(frame).map(|segment| segment.index());
    assert_eq!([index(69_999), index(70_000), index(3_600_000)], [Some(0), Some(1), None]);
    assert_eq!((clip.frames().len(), clip.viseme(3_599_999).code()), (3_600_000, b'A'));
}
