//! A cursor in C does what the reader's cursor does, whatever the steps; and it is refused where it has to be.
#![allow(unsafe_code, clippy::unwrap_used, clippy::cast_possible_truncation, reason = "tests")]

mod common;

use common::{Answer, DRAMA, SMALL, bank, ptr, text_of};
use lipz_bank::{Micros, Samples, Seconds};
use lipz_capi::*;

/// Random numbers, always the same ones.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % bound
    }
}

fn cursor(bank: &Bank, clip: &Clip) -> Answer<Cursor> {
    Answer::from_call(|out| unsafe { lipz_cursor_new(Some(bank), Some(clip), size_of::<Cursor>(), out) })
}

fn clip(bank: &Bank, key: &str) -> Clip {
    let (key, length) = ptr(key);
    Answer::from_call(|out| unsafe { lipz_clip_by_key(Some(bank), key, length, out) }).ok()
}

/// What is due, as it is written in Lipz files.
fn events(bank: &Bank, cursor: &mut Cursor) -> Vec<std::string::String> {
    let mut taken = Vec::new();
    while let Some(event) =
        Answer::<Event>::from_call(|out| unsafe { lipz_cursor_take_event(Some(bank), Some(cursor), out) }).some()
    {
        taken.push(common::written(&event));
    }
    taken
}

/// The indices of the segments that are due.
fn segments(bank: &Bank, mut cursor: Cursor) -> Vec<u32> {
    let mut taken = Vec::new();
    while let Some(segment) =
        Answer::<Segment>::from_call(|out| unsafe { lipz_cursor_take_segment(Some(bank), Some(&mut cursor), out) })
            .some()
    {
        taken.push(segment.index);
    }
    taken
}

/// Moves both cursors by the same step, and says what is due in the reader's.
fn step(
    bank: &Bank,
    ours: &mut Cursor,
    clip: &lipz_bank::Clip<'_, '_>,
    theirs: &mut lipz_bank::Cursor,
    random: &mut Random,
) -> (Vec<u32>, Vec<std::string::String>) {
    let us = random.below(9_000_000) as i64 - 500_000;
    let (samples, seconds) = (Samples { position: us * 48 / 1000, rate_hz: 48_000 }, Seconds(us as f64 / 1e6));
    let (bank, ours) = (Some(bank), Some(ours));
    let (status, due) = unsafe {
        match random.below(14) {
            0 => (lipz_cursor_loop_us(bank, ours, us), Some(theirs.loop_to(clip, Micros(us)))),
            1 => (lipz_cursor_loop_samples(bank, ours, samples.position, 48_000), Some(theirs.loop_to(clip, samples))),
            2 => (lipz_cursor_finish(bank, ours), Some(theirs.finish(clip))),
            3 => (lipz_cursor_seek_us(bank, ours, us), {
                theirs.seek(clip, Micros(us));
                None
            }),
            4 => (lipz_cursor_seek_seconds(bank, ours, seconds.0), {
                theirs.seek(clip, seconds);
                None
            }),
            5 => (lipz_cursor_advance_seconds(bank, ours, seconds.0), Some(theirs.advance_to(clip, seconds))),
            6 => {
                let short = Seconds(us as f32 / 1e6);
                (lipz_cursor_advance_seconds_f32(bank, ours, short.0), Some(theirs.advance_to(clip, short)))
            }
            7 => (
                lipz_cursor_advance_samples(bank, ours, samples.position, 48_000),
                Some(theirs.advance_to(clip, samples)),
            ),
            _ => (lipz_cursor_advance_us(bank, ours, us), Some(theirs.advance_to(clip, Micros(us)))),
        }
    };
    assert_eq!(status, LIPZ_OK);
    due.map_or_else(Default::default, |due| {
        (due.clone().map(|segment| segment.index()).collect(), due.events().map(|event| event.to_string()).collect())
    })
}

#[test]
fn it_does_what_the_readers_cursor_does() {
    let mut random = Random(7);
    for bytes in [SMALL, DRAMA] {
        let (reader, bank) = bank(bytes);
        for found in reader.clips() {
            let mut asked = clip(&bank, found.key());
            if found.fps().is_none() {
                (asked.fps_numerator, asked.fps_denominator) = (24, 1);
            }
            let given = found.or_fps(lipz_bank::Fps::whole(24));
            let speaker = reader.event_name("otto").or(reader.event_name("amy"));
            let (lead, hold) = (random.below(200_000) as u32, random.below(6) as u8);
            let mut theirs = lipz_bank::Cursor::new(&given)
                .unwrap()
                .with_lead(lipz_bank::Lead::micros(lead))
                .with_hold(lipz_bank::ConsonantHold::frames(hold))
                .with_speaker(speaker);
            let mut ours = cursor(&bank, &asked).ok();
            (ours.lead_us, ours.hold_frames) = (lead, hold.into());
            let name = speaker.unwrap();
            let (text, length) = ptr(name.as_str());
            let named =
                Answer::<EventName>::from_call(|out| unsafe { lipz_event_name(Some(&bank), text, length, out) }).ok();
            (ours.speaker_id, ours.speaker_bank) = (named.id, named.bank);
            for _ in 0..60 {
                let (due, told) = step(&bank, &mut ours, &found, &mut theirs, &mut random);
                assert_eq!(segments(&bank, ours), due, "{}", found.key());
                assert_eq!(events(&bank, &mut ours), told);
                same_picture(&bank, &ours, &found, &theirs);
                same_characters(&bank, &ours, &found, &theirs);
            }
        }
    }
}

fn same_picture(bank: &Bank, ours: &Cursor, clip: &lipz_bank::Clip<'_, '_>, theirs: &lipz_bank::Cursor) {
    let mouth = Answer::from_call(|out| unsafe { lipz_cursor_viseme(Some(bank), Some(ours), out) }).ok();
    assert_eq!(mouth, Viseme(theirs.viseme(clip).code()));
    let open = Answer::<u32>::from_call(|out| unsafe { lipz_cursor_openness(Some(bank), Some(ours), out) }).some();
    let kind = clip.viseme_type().filter(|_| clip.frame_count() > 0);
    assert_eq!(open, kind.map(|kind| theirs.viseme(clip).openness(kind).ten_thousandths().into()));
    let segment =
        Answer::<Segment>::from_call(|out| unsafe { lipz_cursor_segment(Some(bank), Some(ours), out) }).some();
    assert_eq!(segment.map(|segment| segment.index), theirs.segment(clip).map(|segment| segment.index()));
    let frame = match (theirs.frame(), theirs.is_over()) {
        (Some(frame), _) => frame,
        (None, is_over) => {
            if is_over {
                LIPZ_OVER
            } else {
                LIPZ_WAITING
            }
        }
    };
    assert_eq!(ours.frame, frame);
}

fn same_characters(bank: &Bank, ours: &Cursor, clip: &lipz_bank::Clip<'_, '_>, theirs: &lipz_bank::Cursor) {
    let name = |name: EventName| (name.id != LIPZ_NO_NAME).then(|| text_of(name.name));
    let of = |found: Character| [found.name, found.feels, found.stares_at, found.points_at].map(name);
    let at = |index| {
        Answer::<Character>::from_call(|out| unsafe { lipz_cursor_character_at(Some(bank), Some(ours), index, out) })
    };
    let found: Vec<_> = (0..).map_while(|index| at(index).some()).map(of).collect();
    let expected: Vec<_> = theirs
        .characters(clip)
        .map(|(who, state)| {
            [who, state.emotion, state.stares_at, state.points_at].map(|name| name.map(lipz_bank::EventName::as_str))
        })
        .collect();
    assert_eq!(found, expected);
    let speaker = Answer::from_call(|out| unsafe { lipz_cursor_character(Some(bank), Some(ours), None, out) }).ok();
    let state = theirs.state(clip, None);
    assert_eq!(
        of(speaker)[1..],
        [state.emotion, state.stares_at, state.points_at].map(|name| name.map(lipz_bank::EventName::as_str))
    );
}

#[test]
fn a_cursor_of_another_version_is_refused() {
    let (_, bank) = bank(SMALL);
    let clip = clip(&bank, "act1/blair");
    let mut started = cursor(&bank, &clip).ok();
    let size = size_of::<Cursor>();
    for size_bytes in [0, size - 4, size + 8] {
        let status = unsafe { lipz_cursor_new(Some(&bank), Some(&clip), size_bytes, None) };
        assert_eq!(status, LIPZ_OTHER_VERSION, "before anything is written");
    }
    started.size_bytes = 0;
    let viseme = Answer::<Viseme>::from_call(|out| unsafe { lipz_cursor_viseme(Some(&bank), Some(&started), out) });
    assert_eq!((viseme.status, viseme.written()), (LIPZ_OTHER_VERSION, Viseme(b'-')));
    assert_eq!(unsafe { lipz_cursor_advance_us(Some(&bank), Some(&mut started), 0) }, LIPZ_OTHER_VERSION);
    assert_eq!(started.frame, LIPZ_WAITING, "it stays where it was");
}

#[test]
fn a_cursor_needs_a_frame_rate() {
    let (_, bank) = bank(SMALL);
    let mut clip = clip(&bank, "act2/unspecified");
    assert_eq!(cursor(&bank, &clip).status, LIPZ_NONE);
    (clip.fps_numerator, clip.fps_denominator) = (10, 1);
    assert_eq!(cursor(&bank, &clip).ok().fps_numerator, 10);
    clip.id ^= 1;
    assert_eq!(cursor(&bank, &clip).status, LIPZ_NONE, "no clip");
}

/// A program that forgets to open a bank again after its bytes have changed is told so.
#[test]
fn other_bytes_are_not_read_as_those_that_were_opened() {
    let mut bytes = SMALL.to_vec();
    let open = |bytes: &[u8]| {
        Answer::<Bank>::from_call(|out| unsafe { lipz_bank_open(bytes.as_ptr(), bytes.len(), out, None) }).ok()
    };
    let bank = open(&bytes);
    let count = |bank: &Bank| Answer::<BankInfo>::from_call(|out| unsafe { lipz_bank_info(Some(bank), out) });
    assert_eq!(count(&bank).ok().clip_count, 12);
    let elsewhere = Bank { data: DRAMA.as_ptr(), length_bytes: DRAMA.len(), ..bank };
    assert_eq!(count(&elsewhere).status, LIPZ_NOT_OPENED, "another bank");
    let shorter = Bank { length_bytes: bank.length_bytes - 1, ..bank };
    assert_eq!(count(&shorter).status, LIPZ_NOT_OPENED, "another length");
    let unopened = Bank { places: [0; LIPZ_PLACE_WORDS], ..bank };
    assert_eq!(count(&unopened).status, LIPZ_NOT_OPENED, "never opened");
    *bytes.get_mut(8).unwrap() ^= 1; // the checksum
    let newer = Bank { data: bytes.as_ptr(), ..bank };
    assert_eq!(count(&newer).status, LIPZ_NOT_OPENED, "another version");
    assert_eq!(count(&open(&bytes)).ok().clip_count, 12);
}
