//! Tests numbers with more bits than those of small banks.
// Tests run with the workspace's compiler, not with the oldest one that the reader supports.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

use lipz_bank::{Error, ErrorKind, Fps, Micros};
use lipz_layout::{NO_TEXT, TEXT_FALLBACK, TEXT_HAS_LENGTH, TEXT_MAX_BYTES, text_count};
use lipz_testkit::forge::{ForgedClip, bank};
use lipz_testkit::golden::{refusal, verified};

fn clip(key: &'static str, frame_count: usize, starts: Vec<u32>) -> ForgedClip {
    ForgedClip { key, frames: vec![b'A'; frame_count], starts }
}

/// A text that does not end at the start of the next one is preceded by its length, with six bits per byte.
#[test]
fn counted_texts_are_as_long_as_they_say() {
    assert_eq!(text_count(0xFFFF), [0x0F, 0x3F, 0x3F]);
    for length in [0, 1, 0x3F, 0x40, 0xFFFF, 0x1_0000, 0x3_FFFF] {
        let text = [&text_count(length)[..], &vec![b'x'; length]].concat();
        let bytes = bank(&[clip("a", 2, vec![1, 1])], 1, &[0, 1, TEXT_HAS_LENGTH | 2], &[b"ab", &text[..]].concat());
        if length > TEXT_MAX_BYTES {
            assert_eq!(refusal(&bytes).map(Error::kind), Some(ErrorKind::TextReference), "{length} bytes are too many");
            continue;
        }
        let bank = verified(&bytes);
        let locale = bank.locale("00000000").expect("a locale");
        let segments = bank.clip_by_key("a").expect("the clip").segments();
        let found: Vec<_> = segments.filter_map(|segment| Some(segment.text(locale)?.len())).collect();
        assert_eq!(found, [1, 1, length]);
    }
}

/// The texts of a clip with one segment.
#[test]
fn texts_that_are_not_there_or_too_long() {
    let kind = |start, pool: &[u8]| refusal(&bank(&[clip("a", 0, vec![])], 1, &[start], pool)).map(Error::kind);
    let damage = Some(ErrorKind::TextReference);
    assert_eq!([kind(TEXT_HAS_LENGTH, b"\0\0\x02ab"), kind(0, &[b'x'; TEXT_MAX_BYTES])], [None; 2]);
    assert_eq!([kind(TEXT_HAS_LENGTH, b"\0\0\x02a"), kind(0, &[b'x'; TEXT_MAX_BYTES + 1])], [damage; 2]);
}

/// The same before the text of another clip, so that no text ends with the pool.
#[test]
fn a_text_before_others_that_is_too_long() {
    let kind = |length: usize| {
        let clips = [clip("a", 0, vec![]), clip("b", 0, vec![])];
        refusal(&bank(&clips, 1, &[0, length as u32], &vec![b'x'; length + 1])).map(Error::kind)
    };
    assert_eq!([TEXT_MAX_BYTES, TEXT_MAX_BYTES + 1].map(kind), [None, Some(ErrorKind::TextReference)]);
}

/// The conditions of `verify` for the texts of a clip.
#[test]
fn texts_are_all_of_one_kind() {
    let kind = |starts: [u32; 2], pool: &str| {
        let bytes = bank(&[clip("a", 0, vec![0])], 1, &starts, pool.as_bytes());
        refusal(&bytes).map(Error::kind)
    };
    let (damage, fallback) = (Some(ErrorKind::TextReference), TEXT_FALLBACK);
    assert_eq!([kind([0, 2], "éx"), kind([fallback, fallback | 3], "éx"), kind([NO_TEXT; 2], "")], [None; 3]);
    assert_eq!([kind([0, NO_TEXT], "x"), kind([NO_TEXT, 0], "x"), kind([fallback, 0], "x")], [damage; 3]);
    assert_eq!([kind([0, 1], "éx"), kind([2, 0], "éx"), kind([0, 4], "éx")], [damage; 3]);
    assert_eq!(kind([0, TEXT_HAS_LENGTH], "\0\0"), damage, "no room for a count");
}

/// Clips with more segments than are compared at once, before other clips and as the last one.
#[test]
fn segments_behind_many_others() {
    let few: Vec<u32> = vec![1, 1, 2, 3, 5, 8, 8, 9, 10, 11];
    let clips = [clip("a", 0, vec![0; 0xFFFE]), clip("b", 12, few.clone()), clip("c", 12, few.clone())];
    let bytes = bank(&clips, 0, &[], &[]);
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

/// A clip of one hour, at the highest rate.
#[test]
fn clips_of_many_frames() {
    let bytes = bank(&[clip("a", 3_600_000, vec![70_000])], 0, &[], &[]);
    let bank = verified(&bytes);
    let clip = bank.clip_by_key("a").expect("a clip").or_fps(Fps::whole(1000));
    assert_eq!(clip.frame_at(Micros(3_599_999_999)), Some(3_599_999));
    let index = |frame| clip.segment_of_frame(frame).map(|segment| segment.index());
    assert_eq!([index(69_999), index(70_000), index(3_600_000)], [Some(0), Some(1), None]);
    assert_eq!((clip.frames().len(), clip.viseme(3_599_999).code()), (3_600_000, b'A'));
}
