//! Errors of banks: each kind of damage is reported with its offset.
// Tests run with the workspace's compiler, not with the oldest one that the reader supports.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::cast_possible_truncation, clippy::incompatible_msrv)]

use lipz_bank::{Error, ErrorKind};
use lipz_layout::{MAGIC, MAX_INTEGER_FPS, NO_TEXT, TEXT_FALLBACK, TEXT_HAS_LENGTH, Tag};
use lipz_testkit::golden::{
    RECORDED, SMALL, STRIPPED, changed, entry_of, key_record_of, put, record_of, refusal, section, u32_at,
};

/// Returns the kind and offset of the error in a small bank that `change` has changed.
fn found(change: impl FnOnce(&mut Vec<u8>)) -> (ErrorKind, usize) {
    let error = refusal(&changed(SMALL, change)).expect("damage");
    (error.kind(), error.offset_bytes() as usize)
}

fn start(tag: Tag) -> usize {
    section(SMALL, tag).start
}

/// Numbers appear in users' scripts, logs and bug reports, so their meanings never change.
#[test]
fn numbers_are_stable() {
    use ErrorKind::*;
    let table = [
        (1, TooShort),
        (2, NotABank),
        (3, TextMode),
        (4, UnsupportedVersion),
        (5, WrongLength),
        (6, DirectoryOutOfBounds),
        (7, SectionOutOfBounds),
        (8, SectionShape),
        (9, SectionMissing),
        (10, SectionUnknown),
        (11, SectionTwice),
        (12, Checksum),
        (13, ClipIndex),
        (14, ClipKey),
        (15, ClipOrder),
        (16, FrameRange),
        (17, FrameCode),
        (18, FrameRate),
        (19, ClipFlags),
        (20, SegmentStarts),
        (21, TextReference),
        (22, Utf8),
        (23, EventReference),
        (24, LocaleOrder),
        (25, SectionPlace),
        (26, DirectoryTooLong),
        (27, Fingerprint),
        (28, OtherClips),
        (29, TextsOnly),
        (30, TypedEvent),
        (31, EventName),
        (32, Babble),
        (33, BankNotVerified),
        (34, Recording),
        (35, Curve),
        (36, Layer),
        (37, OtherBase),
        (38, NotALayer),
        (39, LayerCount),
        (40, Voice),
        (41, Face),
        (42, NotASet),
        (43, Set),
        (44, OtherBank),
        (45, Phones),
        (46, Rig),
    ];
    let kinds: Vec<_> = ErrorKind::ALL.iter().map(|&kind| (kind as u8, kind)).collect();
    assert_eq!(table[..], kinds, "the table above has every kind, and numbers that it has stay");
}

#[test]
fn messages_say_number_and_place() {
    let error = refusal(&SMALL[..100]).expect("damage");
    let message = "the file does not have the length in its header (cut off, or with bytes appended)";
    assert_eq!(error.to_string(), format!("{message} (bank error 5, at byte 16)"));
    for kind in ErrorKind::ALL {
        assert!(!kind.message().is_empty() && !kind.message().ends_with('.'));
    }
}

#[test]
fn beginnings_of_files() {
    use ErrorKind::{NotABank, TextMode, TooShort};
    let kind = |bytes: &[u8]| refusal(bytes).map(|error| (error.kind(), error.offset_bytes()));
    assert_eq!(kind(b""), Some((TooShort, 0)));
    assert_eq!(kind(&SMALL[..3]), Some((TooShort, 3)));
    assert_eq!(kind(&SMALL[..63]), Some((TooShort, 63)));
    assert_eq!(kind(b"{ \"visemes\": \"AO\" }"), Some((NotABank, 0)));
    assert_eq!(kind(&[0; 200]), Some((NotABank, 0)));
    // The effect of a text-mode copy on the magic number: CR LF to LF, or LF to CR LF.
    let replaced = |with: &[u8]| [with, &SMALL[8..]].concat();
    assert_eq!(kind(&replaced(b"\x89LPZ\n\x1a\n")), Some((TextMode, 0)));
    assert_eq!(kind(&replaced(b"\x89LPZ\r\r\n\x1a\r\n")), Some((TextMode, 0)));
    assert_eq!(&SMALL[..8], &MAGIC);
}

#[test]
fn header_and_directory() {
    use ErrorKind::*;
    assert_eq!(found(|bank| put(bank, 20, [2, 0])), (UnsupportedVersion, 20));
    assert_eq!(found(|bank| put(bank, 16, [0, 0])), (WrongLength, 16));
    assert_eq!(found(|bank| bank.push(0)), (WrongLength, 16));
    assert_eq!(found(|bank| put(bank, 40, 65_u32.to_le_bytes())), (DirectoryTooLong, 40));
    let cut = |bank: &mut Vec<u8>| {
        bank.truncate(100);
        put(bank, 16, 100_u32.to_le_bytes());
    };
    assert_eq!(found(cut), (DirectoryOutOfBounds, 40));
    let frames = entry_of(SMALL, Tag::FRAMES);
    assert_eq!(found(|bank| put(bank, frames + 4, u32::MAX.to_le_bytes())), (SectionOutOfBounds, frames));
    assert_eq!(found(|bank| put(bank, frames + 8, (SMALL.len() as u32).to_le_bytes())), (SectionOutOfBounds, frames));
    let clips = entry_of(SMALL, Tag::CLIPS);
    assert_eq!(found(|bank| put(bank, clips + 12, [32])), (SectionShape, clips));
    assert_eq!(found(|bank| put(bank, clips + 8, 191_u32.to_le_bytes())), (SectionShape, clips));
    let twice = entry_of(SMALL, Tag::SOURCE_INDEX);
    assert_eq!(found(|bank| put(bank, twice, b"TEXT")), (SectionTwice, twice));
    let optional = |bank: &mut Vec<u8>, entry: usize| {
        put(bank, entry, b"ABCD");
        put(bank, entry + 14, [0, 0]);
    };
    let last = entry_of(SMALL, Tag::EVENT_STRINGS);
    assert_eq!(found(|bank| optional(bank, last)), (SectionMissing, 40));
    // The entry after a missing section is out of order.
    assert_eq!(found(|bank| optional(bank, frames)), (SectionUnknown, entry_of(SMALL, Tag::STARTS)));
    assert_eq!(found(|bank| put(bank, frames, b"ABCD")), (SectionUnknown, frames));
}

/// Newer minor versions and unknown sections are accepted.
#[test]
fn what_is_accepted() {
    let newer = changed(SMALL, |bank| put(bank, 22, [7, 0]));
    assert_eq!(refusal(&newer), None);
    let optional = changed(SMALL, |bank| {
        put(bank, entry_of(SMALL, Tag::SOURCES), b"NEWS");
        put(bank, entry_of(SMALL, Tag::SOURCE_INDEX), b"MORE");
    });
    assert_eq!(refusal(&optional), None);
}

#[test]
fn checksum() {
    let mut bank = SMALL.to_vec();
    *bank.last_mut().expect("bytes") ^= 1;
    let error = refusal(&bank).expect("damage");
    assert_eq!((error.kind(), error.offset_bytes()), (ErrorKind::Checksum, 8));
}

#[test]
fn clip_records() {
    use ErrorKind::*;
    let (clip, key) = (record_of(SMALL, "act1/blair"), key_record_of(SMALL, "act1/blair"));
    // The offsets of the fields are those of docs/reference/bank-format.md.
    let of_key = |at: usize, new: &[u8]| found(|bank| put(bank, key + at, new));
    assert_eq!(of_key(0, &[0; 8]), (ClipIndex, key), "id");
    assert_eq!(of_key(8, &u32::MAX.to_le_bytes()), (ClipKey, key), "key offset");
    assert_eq!(of_key(12, &[9]), (ClipKey, key), "key length");
    assert_eq!(of_key(14, &[0, 0]), (SegmentStarts, clip), "segment count");
    assert_eq!(of_key(14, &[0, 1]), (SegmentStarts, clip), "segment count");
    let field = |at: usize, new: &[u8]| found(|bank| put(bank, clip + at, new));
    assert_eq!(field(0, &u32::MAX.to_le_bytes()), (FrameRange, clip), "frames offset");
    assert_eq!(field(4, &78_u32.to_le_bytes()), (FrameRange, clip), "frame count");
    assert_eq!(field(8, &1_u32.to_le_bytes()), (SegmentStarts, clip), "first segment");
    assert_eq!(field(12, &0_u16.to_le_bytes()), (FrameRate, clip), "no frames a second");
    let rates = section(SMALL, Tag::RATES).len() / 16;
    let behind = MAX_INTEGER_FPS + 1 + rates as u16;
    assert_eq!(field(12, &behind.to_le_bytes()), (FrameRate, clip), "a rate that is not there");
    assert_eq!(field(14, &[2]), (FrameCode, clip), "viseme type");
    assert_eq!(field(14, &[4]), (ClipFlags, clip), "viseme type");
    assert_eq!(field(15, &[0]), (ClipFlags, clip), "frames without visemes");
    assert_eq!(field(15, &[0x81]), (ClipFlags, clip), "flags");
    let frame = start(Tag::FRAMES) + u32_at(SMALL, clip) as usize;
    assert_eq!(found(|bank| put(bank, frame + 3, b"Z")), (FrameCode, clip));
    let fewer = |bank: &mut Vec<u8>| put(bank, entry_of(SMALL, Tag::KEYS) + 8, 176_u32.to_le_bytes());
    assert_eq!(found(fewer), (ClipKey, start(Tag::KEYS)));
}

#[test]
fn segment_starts() {
    use ErrorKind::*;
    let (clip, starts) = (record_of(SMALL, "act1/blair"), start(Tag::STARTS));
    let entry = |index: usize, new: u32| found(|bank| put(bank, starts + 4 * index, new.to_le_bytes()));
    // The first clip, which has segments.
    assert_eq!(entry(0, 1), (FrameRange, clip), "the first frame of all");
    assert_eq!(entry(1, 1000), (SegmentStarts, clip), "a start after the next one");
    let count = section(SMALL, Tag::STARTS).len() / 4;
    assert_eq!(entry(count - 1, 1000).0, FrameRange, "behind the last frame of all");
    let shorter =
        |bank: &mut Vec<u8>| put(bank, entry_of(SMALL, Tag::STARTS) + 8, (4 * count as u32 - 4).to_le_bytes());
    assert_eq!(found(shorter).0, TextReference, "text starts are as many");
}

/// A rate is in lowest terms and has exactly one valid reciprocal, even if that is a whole number without rounding.
/// Whole rates are in the clip records.
#[test]
fn frame_rates() {
    let rate = start(Tag::RATES);
    let with = |numerator: u32, denominator: u32, reciprocal: u64| {
        let bank = changed(SMALL, |bank| {
            put(bank, rate, reciprocal.to_le_bytes());
            put(bank, rate + 8, numerator.to_le_bytes());
            put(bank, rate + 12, denominator.to_le_bytes());
        });
        refusal(&bank).map(|error| (error.kind(), error.offset_bytes() as usize))
    };
    let damage = Some((ErrorKind::FrameRate, rate));
    let reciprocal =
        |numerator, denominator| lipz_bank::Fps::new(numerator, denominator).expect("a rate").frames_per_micro_q64();
    let half = reciprocal(25, 2);
    assert_eq!(with(25, 2, half), None);
    assert_eq!([with(25, 2, half - 1), with(25, 2, half + 1), with(50, 4, half)], [damage; 3]);
    let exact = 1 << 54; // 2^64 * 15625 / (16 * 10^6)
    assert_eq!(with(15_625, 16, exact), None);
    assert_eq!([with(15_625, 16, exact - 1), with(15_625, 16, exact + 1)], [damage; 2]);
    assert_eq!([with(24, 1, reciprocal(24, 1)), with(0, 0, 0)], [damage; 2]);
}

#[test]
fn index_and_order() {
    use ErrorKind::*;
    let (kind, at) = found(|bank| put(bank, start(Tag::PILOTS), [0x55; 4]));
    assert_eq!(kind, ClipIndex);
    assert!(section(SMALL, Tag::KEYS).contains(&at) && at % 16 == 0);
    let order = start(Tag::KEY_ORDER);
    assert_eq!(found(|bank| bank.copy_within(order..order + 4, order + 4)), (ClipOrder, order + 4));
    assert_eq!(found(|bank| put(bank, order + 8, 12_u32.to_le_bytes())), (ClipOrder, order + 8));
    let shorter = |bank: &mut Vec<u8>| put(bank, entry_of(SMALL, Tag::KEY_ORDER) + 8, 44_u32.to_le_bytes());
    assert_eq!(found(shorter), (ClipOrder, order));
}

#[test]
fn texts_and_locales() {
    use ErrorKind::*;
    let starts = section(SMALL, Tag::TEXT_STARTS);
    // In the second locale, of a clip with several segments.
    let segment_count = section(SMALL, Tag::STARTS).len() / 4 - 1;
    let first = u32_at(SMALL, record_of(SMALL, "act1/blair") + 8) as usize;
    let of_clip = starts.start + 4 * (segment_count + first);
    for entry in [1000, TEXT_FALLBACK | 1000, TEXT_HAS_LENGTH | 1000, NO_TEXT - 1, NO_TEXT] {
        let found = found(|bank| put(bank, of_clip + 4, entry.to_le_bytes()));
        assert_eq!(found, (TextReference, of_clip), "{entry:#x}");
    }
    let of_pool = found(|bank| put(bank, starts.end - 4, [0xFF]));
    assert_eq!(of_pool, (TextReference, starts.start), "the length of the pool");
    let fewer = |bank: &mut Vec<u8>| {
        put(bank, entry_of(SMALL, Tag::TEXT_STARTS) + 8, (starts.len() as u32 - 4).to_le_bytes());
    };
    assert_eq!(found(fewer), (TextReference, starts.start));
    let naive = SMALL.windows(3).position(|window| window == "ïv".as_bytes()).expect("naïve");
    assert_eq!(found(|bank| put(bank, naive, b"\xFF")), (Utf8, naive));
    let name = start(Tag::NAMES) + 4;
    assert_eq!(found(|bank| put(bank, name, b"\x80")), (Utf8, name));
    let locales = start(Tag::LOCALES);
    assert_eq!(found(|bank| bank.copy_within(locales..locales + 8, locales + 8)), (LocaleOrder, locales + 8));
    assert_eq!(found(|bank| put(bank, locales + 4, [0])), (LocaleOrder, locales));
    assert_eq!(found(|bank| put(bank, locales + 6, [2])), (LocaleOrder, locales));
}

#[test]
fn events() {
    use ErrorKind::*;
    let (references, records) = (start(Tag::EVENT_REFS), start(Tag::EVENTS));
    assert_eq!(found(|bank| put(bank, references + 8, [99])), (EventReference, references + 8));
    assert_eq!(found(|bank| put(bank, records + 20, [0xFF; 4])), (EventReference, records + 16), "length");
    assert_eq!(found(|bank| put(bank, records + 8, [1])), (TypedEvent, records), "first typed event");
    assert_eq!(found(|bank| put(bank, records + 12, u32::MAX.to_le_bytes())), (TypedEvent, records), "count");
    let (typed, typed_bytes) = (start(Tag::TYPED_EVENTS), section(SMALL, Tag::TYPED_EVENTS).len());
    let shorter = |bank: &mut Vec<u8>| {
        put(bank, entry_of(SMALL, Tag::TYPED_EVENTS) + 8, (typed_bytes as u32 - 16).to_le_bytes());
    };
    assert_eq!(found(shorter).0, TypedEvent, "a string whose events are not all there");
    for verb in [0, 13, 255] {
        assert_eq!(found(|bank| put(bank, typed + 8, [verb])), (TypedEvent, typed), "verb {verb}");
    }
    // The first is `amy feels sad`. Its character may change, but its verb may not change to another kind.
    assert_eq!(found(|bank| put(bank, typed + 8, [4])), (TypedEvent, typed), "an object that is too many");
    assert_eq!(found(|bank| put(bank, typed, [4])), (TypedEvent, typed), "character");
    assert_eq!(found(|bank| put(bank, typed + 4, [4])), (TypedEvent, typed), "object");
    assert_eq!(found(|bank| put(bank, typed + 4, [0xFF; 4])), (TypedEvent, typed), "no object");
    assert_eq!(refusal(&changed(SMALL, |bank| put(bank, typed, [0xFF; 4]))), None, "the speaker");
    let names = start(Tag::EVENT_NAMES);
    assert_eq!(found(|bank| put(bank, names + 8, [0])), (EventName, names + 8), "offset");
    assert_eq!(found(|bank| put(bank, names + 4, [0])), (EventName, names), "an empty name");
    let pool_end = section(SMALL, Tag::EVENT_STRINGS).end;
    let (last, order) = (pool_end - "amydoorsadwave".len(), names + 8);
    assert_eq!(found(|bank| put(bank, last, b"zmy")), (EventName, order), "not in order");
    let longer = changed(STRIPPED, |bank| {
        let (length, strings) = (bank.len() as u32 + 1, section(STRIPPED, Tag::EVENT_STRINGS).len() as u32 + 1);
        put(bank, 16, length.to_le_bytes());
        put(bank, entry_of(STRIPPED, Tag::EVENT_STRINGS) + 8, strings.to_le_bytes());
        bank.push(b'!');
    });
    assert_eq!(refusal(&longer).map(Error::kind), Some(EventName), "a byte that belongs to no name");
}

#[test]
fn recordings() {
    use ErrorKind::{Recording, SectionShape};
    let finding_in = |change: &dyn Fn(&mut Vec<u8>)| {
        refusal(&changed(RECORDED, |bank| change(bank))).map(|error| (error.kind(), error.offset_bytes() as usize))
    };
    let (entry, section) = (entry_of(RECORDED, Tag::RECORDINGS), section(RECORDED, Tag::RECORDINGS));
    let records: Vec<usize> = section.step_by(16).collect();
    assert_eq!(records.len(), 3);
    let has_none = |record: &usize| RECORDED[*record..*record + 8] == [0xFF; 8];
    let (none, some) = (
        *records.iter().find(|record| has_none(record)).unwrap(),
        *records.iter().find(|record| !has_none(record)).unwrap(),
    );
    // Any length and any hash may be valid, except for lengths that exceed every time.
    for byte in 0..16 {
        let is_sign = byte == 7;
        let found = finding_in(&|bank| bank[some + byte] ^= 0x80);
        assert_eq!(found, is_sign.then_some((Recording, some)), "byte {byte}");
        // A missing recording has one fixed length and no hash. (Without the sign, it is the longest time.)
        let found = finding_in(&|bank| bank[none + byte] ^= 0x80);
        assert_eq!(found, (!is_sign).then_some((Recording, none)), "byte {byte}");
    }
    assert_eq!(finding_in(&|bank| put(bank, entry + 12, [8])), Some((SectionShape, entry)));
    assert_eq!(
        finding_in(&|bank| put(bank, entry + 8, 32_u32.to_le_bytes())).map(|(kind, _)| kind),
        Some(SectionShape)
    );
}
