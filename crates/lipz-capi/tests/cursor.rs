//! A cursor in C acts like the reader's cursor for any steps, and is rejected where necessary.
#![allow(unsafe_code, clippy::unwrap_used, clippy::cast_possible_truncation, reason = "tests")]

mod common;

use common::{DIALOGUES, Opened, SMALL, ask, dialogue, micros, name_of, samples, seconds, seconds_f32};
use lipz_bank::{Micros, Samples, Seconds};
use lipz_capi::*;

/// A random number generator with a fixed seed.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % bound
    }
}

fn cursor(of_c: &Dialogue, clip: &Clip) -> Result<Cursor, Status> {
    ask(|out| unsafe { lipz_cursor_new(Some(of_c), Some(clip), size_of::<Cursor>(), out) })
}

/// Returns the events that are due, as written in Lipz files.
fn events(of_c: &Dialogue, cursor: &mut Cursor) -> Vec<std::string::String> {
    let take = || ask(|out| unsafe { lipz_cursor_take_event(Some(of_c), Some(cursor), out) }).ok();
    std::iter::from_fn(take).map(|event: Event| common::written(&event)).collect()
}

/// Returns the indices of the segments that are due.
fn segments(of_c: &Dialogue, mut cursor: Cursor) -> Vec<u32> {
    let take = || ask(|out| unsafe { lipz_cursor_take_segment(Some(of_c), Some(&mut cursor), out) }).ok();
    std::iter::from_fn(take).map(|segment: Segment| segment.index).collect()
}

/// Moves both cursors by the same step, and returns what is due in the reader's cursor.
fn step(
    of_c: &Dialogue,
    ours: &mut Cursor,
    clip: &lipz_bank::Clip<'_>,
    theirs: &mut lipz_bank::Cursor,
    random: &mut Random,
) -> (Vec<u32>, Vec<std::string::String>) {
    let us = random.below(9_000_000) as i64 - 500_000;
    let (position, at) = (us * 48 / 1000, us as f64 / 1e6);
    let of_samples = Samples { position, rate_hz: 48_000 };
    let (of_c, ours) = (Some(of_c), Some(ours));
    let (status, due) = unsafe {
        match random.below(12) {
            0 => (lipz_cursor_loop(of_c, ours, micros(us)), Some(theirs.loop_to(clip, Micros(us)))),
            1 => (lipz_cursor_loop(of_c, ours, samples(position, 48_000)), Some(theirs.loop_to(clip, of_samples))),
            2 => (lipz_cursor_finish(of_c, ours), Some(theirs.finish(clip))),
            3 => (lipz_cursor_seek(of_c, ours, micros(us)), {
                theirs.seek(clip, Micros(us));
                None
            }),
            4 => (lipz_cursor_seek(of_c, ours, seconds(at)), {
                theirs.seek(clip, Seconds(at));
                None
            }),
            5 => (lipz_cursor_advance(of_c, ours, seconds(at)), Some(theirs.advance_to(clip, Seconds(at)))),
            6 => {
                let short = at as f32;
                (lipz_cursor_advance(of_c, ours, seconds_f32(short)), Some(theirs.advance_to(clip, Seconds(short))))
            }
            7 => {
                (lipz_cursor_advance(of_c, ours, samples(position, 48_000)), Some(theirs.advance_to(clip, of_samples)))
            }
            _ => (lipz_cursor_advance(of_c, ours, micros(us)), Some(theirs.advance_to(clip, Micros(us)))),
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
    for files in DIALOGUES {
        let opened = dialogue(files);
        let Opened { of_c, reader } = &opened;
        for found in reader.clips() {
            let mut asked = opened.clip(found.key());
            if found.fps().is_none() {
                (asked.fps_numerator, asked.fps_denominator) = (24, 1);
            }
            let given = found.or_fps(lipz_bank::Fps::whole(24));
            let speaker = reader.event_name("otto").or(reader.event_name("amy"));
            let (lead, hold) = (random.below(200_000) as u32, random.below(6) as u8);
            let mut theirs = lipz_bank::Cursor::new(&given)
                .unwrap()
                .with_lead(lipz_bank::playback::Lead::micros(lead))
                .with_hold(lipz_bank::playback::ConsonantHold::frames(hold))
                .with_speaker(speaker);
            let mut ours = cursor(of_c, &asked).unwrap();
            (ours.lead_us, ours.hold_frames) = (lead, hold.into());
            if let Some(name) = speaker {
                let named = opened.name(name.as_str());
                (ours.speaker_id, ours.speaker_bank) = (named.id, named.bank);
            }
            for _ in 0..60 {
                let (due, expected) = step(of_c, &mut ours, &given, &mut theirs, &mut random);
                assert_eq!(segments(of_c, ours), due, "{}", found.key());
                assert_eq!(events(of_c, &mut ours), expected);
                same_mouth(of_c, &ours, &given, &theirs);
                same_characters(of_c, &ours, &given, &theirs);
            }
        }
    }
}

fn same_mouth(of_c: &Dialogue, ours: &Cursor, clip: &lipz_bank::Clip<'_>, theirs: &lipz_bank::Cursor) {
    let mouth = ask(|out| unsafe { lipz_cursor_viseme(Some(of_c), Some(ours), out) });
    assert_eq!(mouth, Ok(Viseme(theirs.viseme(clip).code())));
    let open = ask(|out| unsafe { lipz_cursor_openness(Some(of_c), Some(ours), out) }).ok();
    assert_eq!(open, theirs.openness(clip).map(|openness| openness.ten_thousandths().into()));
    let segment = ask(|out| unsafe { lipz_cursor_segment(Some(of_c), Some(ours), out) }).ok();
    assert_eq!(segment.map(|segment: Segment| segment.index), theirs.segment(clip).map(|segment| segment.index()));
    let stopped = if theirs.is_over() { LIPZ_OVER } else { LIPZ_WAITING };
    assert_eq!(ours.frame, theirs.frame().unwrap_or(stopped));
}

fn same_characters(of_c: &Dialogue, ours: &Cursor, clip: &lipz_bank::Clip<'_>, theirs: &lipz_bank::Cursor) {
    let of = |found: Character| [found.name, found.feels, found.stares_at, found.points_at].map(name_of);
    let at = |index| ask(|out| unsafe { lipz_cursor_character_by_index(Some(of_c), Some(ours), index, out) });
    let found: Vec<_> = (0..).map_while(|index| at(index).ok()).map(of).collect();
    let spelled = |name: Option<lipz_bank::EventName<'_>>| name.map(|name| name.to_string());
    let expected: Vec<_> = theirs
        .characters(clip)
        .map(|(who, state)| [who, state.emotion, state.stares_at, state.points_at].map(spelled))
        .collect();
    let found: Vec<_> = found.iter().map(|names| names.map(|name| name.map(str::to_owned))).collect();
    assert_eq!(found, expected);
    let speaker = ask(|out| unsafe { lipz_cursor_character(Some(of_c), Some(ours), None, out) }).unwrap();
    let state = theirs.state(clip, None);
    let expected = [state.emotion, state.stares_at, state.points_at].map(spelled);
    let found: Vec<_> = of(speaker)[1..].iter().map(|name| name.map(str::to_owned)).collect();
    assert_eq!(found, expected);
}

#[test]
fn a_cursor_of_another_version_is_refused() {
    let opened = dialogue(&[SMALL]);
    let (of_c, clip) = (Some(&opened.of_c), opened.clip("act1/blair"));
    let mut started = cursor(&opened.of_c, &clip).unwrap();
    let size = size_of::<Cursor>();
    for size_bytes in [0, size - 4, size + 8] {
        let status = unsafe { lipz_cursor_new(of_c, Some(&clip), size_bytes, None) };
        assert_eq!(status, LIPZ_OTHER_VERSION, "before anything is written");
    }
    started.size_bytes = 0;
    let viseme: Result<Viseme, _> = ask(|out| unsafe { lipz_cursor_viseme(of_c, Some(&started), out) });
    assert_eq!(viseme, Err(LIPZ_OTHER_VERSION));
    assert_eq!(unsafe { lipz_cursor_advance(of_c, Some(&mut started), micros(0)) }, LIPZ_OTHER_VERSION);
    assert_eq!(started.frame, LIPZ_WAITING, "it stays where it was");
}

#[test]
fn a_cursor_needs_a_frame_rate() {
    let opened = dialogue(&[SMALL]);
    let mut clip = opened.clip("act2/unspecified");
    assert_eq!(cursor(&opened.of_c, &clip).err(), Some(LIPZ_NONE));
    (clip.fps_numerator, clip.fps_denominator) = (10, 1);
    assert_eq!(cursor(&opened.of_c, &clip).unwrap().fps_numerator, 10);
    clip.id ^= 1;
    assert_eq!(cursor(&opened.of_c, &clip).err(), Some(LIPZ_NONE), "no clip");
}

/// The patch changes a text and no visemes, so the line continues where it was.
#[test]
fn a_cursor_goes_on_in_another_version() {
    let (before, after) = (dialogue(&[SMALL]), dialogue(&[SMALL, common::PATCH]));
    let mut kept = cursor(&before.of_c, &before.clip("act1/blair")).unwrap();
    assert_eq!(unsafe { lipz_cursor_advance(Some(&before.of_c), Some(&mut kept), micros(500_000)) }, LIPZ_OK);
    let frame = kept.frame;
    assert_eq!(unsafe { lipz_cursor_advance(Some(&after.of_c), Some(&mut kept), micros(500_000)) }, LIPZ_OK);
    assert_eq!(kept.frame, frame);
    assert_eq!(segments(&after.of_c, kept), [0; 0], "nothing is due twice");
}
