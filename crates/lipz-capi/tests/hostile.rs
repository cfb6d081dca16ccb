//! Null pointers, foreign structs and damaged banks: a status, and an empty answer.
#![allow(unsafe_code, clippy::unwrap_used, reason = "tests")]

mod common;

use common::{Answer, DRAMA, GERMAN, SMALL, SPLIT, bank, ptr, text_of};
use lipz_bank::ErrorKind;
use lipz_capi::*;

#[test]
fn null_pointers_are_a_status() {
    let (_, bank) = bank(SMALL);
    let (bank, null) = (Some(&bank), std::ptr::null());
    let clip = Answer::<Clip>::from_call(|out| unsafe { lipz_clip_at(bank, 0, out) }).ok();
    let segment = Answer::<Segment>::from_call(|out| unsafe { lipz_segment_at(bank, Some(&clip), 0, out) }).ok();
    let locale = Answer::<Locale>::from_call(|out| unsafe { lipz_locale_at(bank, 0, out) }).ok();
    unsafe {
        let statuses = [
            Answer::<Bank>::from_call(|out| lipz_bank_open(std::ptr::null(), 64, out, None)).status,
            lipz_bank_open(SMALL.as_ptr(), SMALL.len(), None, None),
            lipz_bank_verify(None, None),
            lipz_bank_use_texts(None, GERMAN.as_ptr(), GERMAN.len(), None),
            Answer::<BankInfo>::from_call(|out| lipz_bank_info(None, out)).status,
            lipz_bank_info(bank, None),
            Answer::<Clip>::from_call(|out| lipz_clip_by_id(None, clip.id, out)).status,
            lipz_clip_by_id(bank, clip.id, None),
            Answer::<Clip>::from_call(|out| lipz_clip_by_key(bank, null, 1, out)).status,
            Answer::<u64>::from_call(|out| lipz_clip_id_of_key(null, 1, out)).status,
            Answer::<u32>::from_call(|out| lipz_frame_at_us(bank, None, 0, out)).status,
            lipz_frame_at_us(bank, Some(&clip), 0, None),
            Answer::<Text>::from_call(|out| lipz_segment_text(bank, None, Some(&locale), out)).status,
            Answer::<Text>::from_call(|out| lipz_segment_text(bank, Some(&segment), None, out)).status,
            Answer::<Locale>::from_call(|out| lipz_locale_by_tag(bank, null, 5, out)).status,
            Answer::<EventName>::from_call(|out| lipz_event_name(bank, null, 5, out)).status,
            lipz_status_message(LIPZ_OK, None),
            lipz_cursor_new(bank, Some(&clip), size_of::<Cursor>(), None),
            lipz_cursor_advance_us(bank, None, 0),
            Answer::<Event>::from_call(|out| lipz_cursor_take_event(bank, None, out)).status,
            Answer::<Viseme>::from_call(|out| lipz_cursor_viseme(bank, None, out)).status,
            Answer::<Weights>::from_call(|out| lipz_babble_at_us(bank, None, 0, 1.0, out)).status,
            Answer::<u32>::from_call(|out| lipz_lead_one_frame(None, out)).status,
        ];
        assert!(statuses.iter().all(|status| *status == LIPZ_NULL_POINTER), "{statuses:?}");
        let mouth = Answer::<Viseme>::from_call(|out| lipz_viseme_at_us(None, None, 0, out));
        assert_eq!((mouth.status, mouth.written()), (LIPZ_NULL_POINTER, Viseme(b'-')));
    }
}

#[test]
fn damage_has_the_number_and_the_place_of_the_reader() {
    for length in (0..SMALL.len()).step_by(7) {
        let cut = SMALL.get(..length).unwrap();
        let expected = lipz_bank::Bank::open(cut).unwrap_err();
        let mut place = std::mem::MaybeUninit::uninit();
        let opened =
            Answer::<Bank>::from_call(|out| unsafe { lipz_bank_open(cut.as_ptr(), length, out, Some(&mut place)) });
        assert_eq!(opened.status, u32::from(expected.kind().number()));
        assert_eq!(unsafe { place.assume_init() }, expected.offset_bytes());
        assert!(opened.written().data.is_null());
    }
}

#[test]
fn every_status_has_a_message() {
    for kind in ErrorKind::ALL {
        let message = Answer::from_call(|out| lipz_status_message(kind.number().into(), out)).ok();
        assert_eq!(text_of(message), kind.message());
    }
    for status in [LIPZ_OK, LIPZ_NONE, LIPZ_NULL_POINTER, LIPZ_NOT_UTF8, LIPZ_NOT_OPENED, LIPZ_OTHER_VERSION] {
        assert_eq!(Answer::<String>::from_call(|out| lipz_status_message(status, out)).status, LIPZ_OK);
    }
    assert_eq!(Answer::<String>::from_call(|out| lipz_status_message(200, out)).status, LIPZ_NONE);
}

#[test]
fn strings_that_are_asked_for_are_utf8() {
    let (_, bank) = bank(SMALL);
    let bytes = [0xFF_u8, 0xFE];
    let found =
        Answer::<Clip>::from_call(|out| unsafe { lipz_clip_by_key(Some(&bank), bytes.as_ptr().cast(), 2, out) });
    assert_eq!((found.status, found.written().id), (LIPZ_NOT_UTF8, 0));
}

#[test]
fn a_text_bank_belongs_to_its_bank() {
    let (_, mut split) = bank(SPLIT);
    let (tag, length) = ptr("de-de");
    let german =
        |bank: &Bank| Answer::<Locale>::from_call(|out| unsafe { lipz_locale_by_tag(Some(bank), tag, length, out) });
    assert_eq!(german(&split).status, LIPZ_NONE);
    assert_eq!(unsafe { lipz_bank_use_texts(Some(&mut split), GERMAN.as_ptr(), GERMAN.len(), None) }, LIPZ_OK);
    assert_eq!(unsafe { lipz_bank_verify(Some(&split), None) }, LIPZ_OK);
    let locale = german(&split).ok();
    let (key, key_length) = ptr("act1/toonboom");
    let clip = Answer::<Clip>::from_call(|out| unsafe { lipz_clip_by_key(Some(&split), key, key_length, out) }).ok();
    let segment =
        Answer::<Segment>::from_call(|out| unsafe { lipz_segment_at(Some(&split), Some(&clip), 0, out) }).ok();
    let text =
        Answer::<Text>::from_call(|out| unsafe { lipz_segment_text(Some(&split), Some(&segment), Some(&locale), out) });
    let text = text.ok();
    assert_eq!(text_of(String { data: text.data, length_bytes: text.length_bytes }), "Nur");

    let (_, mut drama) = bank(DRAMA);
    let status = unsafe { lipz_bank_use_texts(Some(&mut drama), GERMAN.as_ptr(), GERMAN.len(), None) };
    assert_eq!(status, u32::from(ErrorKind::OtherClips.number()));
    assert!(drama.texts.is_null(), "the bank is as it was");
}

/// Every byte of a small bank is changed, and every query goes on: with numbers of the intact bank, and
/// with random ones.
#[test]
fn queries_are_total_on_damaged_banks_and_foreign_structs() {
    let mut random = 0x9E37_79B9_7F4A_7C15_u64;
    let mut next = || {
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (random >> 32) as u32
    };
    let (_, intact) = bank(SMALL);
    let clips: Vec<Clip> =
        (0..12).map(|slot| Answer::from_call(|out| unsafe { lipz_clip_at(Some(&intact), slot, out) }).ok()).collect();
    for place in 0..SMALL.len() {
        let mut bytes = SMALL.to_vec();
        *bytes.get_mut(place).unwrap() ^= 1 << (place % 8);
        let clip = clips.get(place % clips.len()).unwrap();
        let opened = Answer::<Bank>::from_call(|out| unsafe { lipz_bank_open(bytes.as_ptr(), bytes.len(), out, None) });
        // With the places that are found in these bytes, and with forged ones beside the right checksum.
        let mut bank = Bank { data: bytes.as_ptr(), length_bytes: bytes.len(), ..intact };
        if place % 2 == 0 && opened.status == LIPZ_OK {
            bank = opened.ok();
        } else if place % 3 == 0 {
            *bank.places.get_mut(2 + next() as usize % 32).unwrap() ^= next() >> (next() % 32);
        }
        every_query(&bank, clip, next() % 16);
        let foreign = Clip { fps_numerator: next(), fps_denominator: next(), ..*clip };
        every_query(&bank, &Clip { id: next().into(), ..foreign }, next());
        every_query(&bank, &Clip { frame_count: next(), segment_count: next(), ..foreign }, next());
    }
}

fn every_query(bank: &Bank, clip: &Clip, number: u32) {
    let (bank, time_us) = (Some(bank), i64::from(number) * 1000);
    let origin = origin(bank);
    unsafe {
        let segment =
            Segment { clip_id: clip.id, index: number % 13, start_frame: number, end_frame: number, reserved: number };
        let locale = Locale { index: number % 3, ..Locale::default() };
        Answer::<BankInfo>::from_call(|out| lipz_bank_info(bank, out));
        let named = Curve { place: number % 7, key_count: number, bank: origin, ..Curve::default() };
        let (clip_of, named) = (Some(clip), Some(&named));
        Answer::<Curve>::from_call(|out| lipz_clip_curve_at(bank, clip_of, number, out));
        Answer::<Curve>::from_call(|out| lipz_clip_curve(bank, clip_of, c"joy".as_ptr(), 3, out));
        Answer::<CurveKey>::from_call(|out| lipz_clip_curve_key(bank, clip_of, named, number, out));
        Answer::<i32>::from_call(|out| lipz_clip_curve_value(bank, clip_of, named, None, number, out));
        Answer::<Emotions>::from_call(|out| lipz_clip_emotions_at_us(bank, clip_of, time_us, out));
        Answer::<i32>::from_call(|out| lipz_clip_curve_value_at_us(bank, clip_of, named, None, time_us, out));
        every_face(bank, clip_of, named, number);
        Answer::<Clip>::from_call(|out| lipz_clip_at(bank, number, out));
        Answer::<Clip>::from_call(|out| lipz_clip_by_id(bank, clip.id, out));
        Answer::<String>::from_call(|out| lipz_clip_key(bank, Some(clip), out));
        Answer::<String>::from_call(|out| lipz_clip_frames(bank, Some(clip), out));
        Answer::<Viseme>::from_call(|out| lipz_clip_viseme(bank, Some(clip), number, out));
        Answer::<u64>::from_call(|out| lipz_clip_start_of_frame_us(bank, Some(clip), number, out));
        Answer::<Recording>::from_call(|out| lipz_clip_recording(bank, Some(clip), out));
        Answer::<VoicedClip>::from_call(|out| lipz_clip_in_voice(bank, clip_of, c"de-de".as_ptr(), 5, out));
        Answer::<String>::from_call(|out| lipz_clip_voice(bank, clip_of, out));
        Answer::<String>::from_call(|out| lipz_voice_at(bank, number % 4, out));
        Answer::<u32>::from_call(|out| lipz_frame_at_us(bank, Some(clip), time_us, out));
        Answer::<u32>::from_call(|out| lipz_frame_at_samples(bank, Some(clip), time_us, number, out));
        Answer::<u32>::from_call(|out| lipz_frame_at_seconds(bank, Some(clip), f64::from(number), out));
        Answer::<u32>::from_call(|out| lipz_frame_at_seconds_f32(bank, Some(clip), f32::from_bits(number), out));
        Answer::<Segment>::from_call(|out| lipz_segment_at_us(bank, Some(clip), time_us, out));
        Answer::<Segment>::from_call(|out| lipz_segment_at(bank, Some(clip), number, out));
        Answer::<Text>::from_call(|out| lipz_segment_text(bank, Some(&segment), Some(&locale), out));
        Answer::<String>::from_call(|out| lipz_segment_event_string(bank, Some(&segment), out));
        Answer::<Event>::from_call(|out| lipz_segment_event(bank, Some(&segment), number % 5, out));
        Answer::<Locale>::from_call(|out| lipz_locale_at(bank, number, out));
        Answer::<Locale>::from_call(|out| lipz_locale_default(bank, out));
    }
    every_move(bank, clip, number);
}

/// What tells the bank apart from others: as much of the checksum in its header as a curve has. 0 if the bank has no header.
///
/// # Safety
/// The contract of the library.
fn origin(bank: Option<&Bank>) -> u32 {
    let bytes = bank.filter(|bank| bank.length_bytes >= 20 && !bank.data.is_null());
    // SAFETY: so many bytes are there.
    let bytes = bytes.map(|bank| unsafe { std::slice::from_raw_parts(bank.data, bank.length_bytes) });
    bytes.map_or(0, |bytes| u32::from_le_bytes([bytes[8], bytes[9], bytes[10], bytes[11]]))
}

/// Curves with a cursor of a forged number, and the face of somebody.
///
/// # Safety
/// The contract of the library.
unsafe fn every_face(bank: Option<&Bank>, clip: Option<&Clip>, curve: Option<&Curve>, number: u32) {
    let time_us = i64::from(number) * 1000;
    let mut cursor = CurveCursor { key: number.rotate_left(9) };
    let who = Who { name: String { data: c"mara".as_ptr(), length_bytes: 4 }, is_speaker: number % 3 };
    let far = Curve { place: number, bank: origin(bank), ..Curve::default() };
    let look_at = LookAt { pitch: number.rotate_left(3) as i32, yaw: number as i32, is_person: number % 2 };
    for curve in [curve, Some(&far)] {
        Answer::<i32>::from_call(|out| unsafe {
            lipz_clip_curve_value_at_us(bank, clip, curve, Some(&mut cursor), time_us, out)
        });
    }
    Answer::<Emotions>::from_call(|out| unsafe { lipz_clip_emotions_of_us(bank, clip, Some(&who), time_us, out) });
    Answer::<Face>::from_call(|out| unsafe {
        lipz_clip_face_of_us(bank, clip, Some(&who), None, Some(&look_at), time_us, out)
    });
}

/// Plays with a cursor of forged numbers.
fn every_move(bank: Option<&Bank>, clip: &Clip, number: u32) {
    let time_us = i64::from(number) * 1000;
    let mut cursor = Cursor {
        size_bytes: u32::try_from(size_of::<Cursor>()).unwrap(),
        frame: number,
        clip_id: clip.id,
        fps_numerator: number,
        fps_denominator: number % 7,
        viseme_type: number % 5,
        lead_us: number,
        hold_frames: number % 300,
        speaker_id: number % 3,
        speaker_bank: bank.map_or(0, |bank| bank.places[0]),
        mouth_frame: number.wrapping_mul(3),
        next_segment: number % 17,
        flags: number,
        due_segment: number % 13,
        due_end: number,
        due_around_to: number.rotate_left(7),
        due_event: number % 3,
    };
    unsafe {
        let mut taken = 0;
        for step in 0..5 {
            let status = match step {
                0 => LIPZ_OK,
                1 => lipz_cursor_advance_us(bank, Some(&mut cursor), time_us),
                2 => lipz_cursor_loop_seconds(bank, Some(&mut cursor), f64::from(number)),
                3 => lipz_cursor_seek_samples(bank, Some(&mut cursor), time_us, number),
                _ => lipz_cursor_finish(bank, Some(&mut cursor)),
            };
            let mut segments = cursor;
            while Answer::<Segment>::from_call(|out| lipz_cursor_take_segment(bank, Some(&mut segments), out)).status
                == LIPZ_OK
            {
                taken += 1;
            }
            while Answer::<Event>::from_call(|out| lipz_cursor_take_event(bank, Some(&mut cursor), out)).status
                == LIPZ_OK
            {
                taken += 1;
            }
            assert!(taken < 1 << 20, "{status}");
            Answer::<Viseme>::from_call(|out| lipz_cursor_viseme(bank, Some(&cursor), out));
            Answer::<u32>::from_call(|out| lipz_cursor_openness(bank, Some(&cursor), out));
            Answer::<Segment>::from_call(|out| lipz_cursor_segment(bank, Some(&cursor), out));
            Answer::<Character>::from_call(|out| lipz_cursor_character(bank, Some(&cursor), None, out));
            Answer::<Character>::from_call(|out| lipz_cursor_character_at(bank, Some(&cursor), number, out));
        }
        let babble = Babble { index: number % 2, bank: cursor.speaker_bank, ..Babble::default() };
        Answer::<Weights>::from_call(|out| {
            lipz_babble_at_us(bank, Some(&babble), time_us, f32::from_bits(number), out)
        });
        Answer::<Weights>::from_call(|out| lipz_babble_at_us_level(bank, Some(&babble), time_us, number, out));
        Answer::<u32>::from_call(|out| lipz_hold_for_display(Some(clip), number, out));
        Answer::<u32>::from_call(|out| lipz_viseme_openness(Viseme(b'A'), number, out));
    }
}
