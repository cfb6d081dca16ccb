//! Frame rates of unverified banks: a program gets a valid rate or `None`.
// Tests run with the workspace's compiler, not with the oldest one that the reader supports.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::incompatible_msrv)]

use lipz_bank::playback::{ConsonantHold, Lead};
use lipz_bank::{Bank, Cursor, Fps, Micros};
use lipz_layout::Tag;
use lipz_testkit::exercise::{Effort, every_query};
use lipz_testkit::golden::{SMALL, changed, put, record_of, section};

/// The offset of `rate` in a clip record, and the first stored rate of `RATE`.
const RATE: usize = 12;
const FIRST_RECORD: u16 = lipz_layout::MAX_INTEGER_FPS + 1;

/// Handles the rate of a clip as in docs/guides/playback.md.
fn play_as_documented(bytes: &[u8], key: &str) -> Option<Fps> {
    let bank = Bank::open(bytes).expect("the header is whole");
    let clip = bank.clip_by_key(key).expect("a clip");
    let fps = clip.fps();
    let cursor = Cursor::new(&clip).zip(fps).map(|(cursor, fps)| {
        cursor
            .with_lead(Lead::one_frame(fps))
            .with_hold(ConsonantHold::readable(fps).max(ConsonantHold::for_display(16_667, fps)))
    });
    if let Some(mut cursor) = cursor {
        assert!(cursor.advance_to(&clip, Micros(0)).count() > 0);
    }
    every_query(&bank, Effort::All);
    fps
}

#[test]
fn a_clip_of_no_frames_a_second_has_no_rate() {
    let record = record_of(SMALL, "act1/blair");
    let bank = changed(SMALL, |bank| put(bank, record + RATE, 0_u16.to_le_bytes()));
    assert_eq!(play_as_documented(&bank, "act1/blair"), None);
    assert_eq!(play_as_documented(SMALL, "act1/blair"), Some(Fps::whole(24)));
}

#[test]
fn a_damaged_rate_record_is_no_rate() {
    let rates = section(SMALL, Tag::RATES).start;
    let record = record_of(SMALL, "act1/blair");
    let half = Fps::new(25, 2).expect("a rate");
    let with = |numerator: u32, denominator: u32, reciprocal: u64| {
        let bank = changed(SMALL, |bank| {
            put(bank, record + RATE, FIRST_RECORD.to_le_bytes());
            put(bank, rates, reciprocal.to_le_bytes());
            put(bank, rates + 8, numerator.to_le_bytes());
            put(bank, rates + 12, denominator.to_le_bytes());
        });
        play_as_documented(&bank, "act1/blair")
    };
    let right = half.frames_per_micro_q64();
    assert_eq!(with(25, 2, right), Some(half));
    for (numerator, denominator) in [(0, 0), (0, 2), (25, 0), (50, 4), (1, 2), (u32::MAX, 1), (1, u32::MAX)] {
        assert_eq!(with(numerator, denominator, right), None, "{numerator}/{denominator}");
    }
    assert_eq!([with(25, 2, right - 1), with(25, 2, right + 1), with(25, 2, 0), with(25, 2, u64::MAX)], [None; 4]);
}
