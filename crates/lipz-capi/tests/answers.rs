//! The functions give the answers of the reader, on every query to every golden bank.
#![allow(unsafe_code, clippy::unwrap_used, clippy::cast_possible_truncation, reason = "tests")]

mod common;

use common::{Answer, DRAMA, SMALL, SPLIT, bank, ptr, text_of};
use lipz_bank::{Micros, Samples, Seconds};
use lipz_capi::*;

#[test]
fn clips_are_found_by_id_key_and_slot() {
    for bytes in [DRAMA, SMALL] {
        let (expected, bank) = bank(bytes);
        let info = Answer::<BankInfo>::from_call(|out| unsafe { lipz_bank_info(Some(&bank), out) }).ok();
        assert_eq!(info.clip_count as usize, expected.clip_count());
        assert_eq!(info.locale_count as usize, expected.locales().count());
        assert_eq!(info.fingerprint, expected.fingerprint());
        for clip in expected.clips() {
            let (key, length) = ptr(clip.key());
            let id = Answer::from_call(|out| unsafe { lipz_clip_id_of_key(key, length, out) }).ok();
            assert_eq!(id, clip.id().get());
            let by_id = Answer::<Clip>::from_call(|out| unsafe { lipz_clip_by_id(Some(&bank), id, out) }).ok();
            let by_key =
                Answer::<Clip>::from_call(|out| unsafe { lipz_clip_by_key(Some(&bank), key, length, out) }).ok();
            let by_slot = Answer::<Clip>::from_call(|out| unsafe { lipz_clip_at(Some(&bank), clip.slot(), out) }).ok();
            for found in [by_id, by_key, by_slot] {
                assert_eq!((found.id, found.slot), (id, clip.slot()));
                assert_eq!((found.frame_count, found.segment_count), (clip.frame_count(), clip.segment_count()));
                let fps = clip.fps().map_or((0, 0), |fps| (fps.numerator(), fps.denominator()));
                assert_eq!((found.fps_numerator, found.fps_denominator), fps);
                assert_eq!(found.viseme_type, clip.viseme_type().map_or(0, |kind| kind as u32));
                assert_eq!((found.has_visemes == 1, found.has_events == 1), (clip.has_visemes(), clip.has_events()));
            }
            let found = Answer::from_call(|out| unsafe { lipz_clip_key(Some(&bank), Some(&by_id), out) }).ok();
            assert_eq!(text_of(found), clip.key());
            let frames = Answer::from_call(|out| unsafe { lipz_clip_frames(Some(&bank), Some(&by_id), out) }).ok();
            assert_eq!(text_of(frames).as_bytes(), clip.frames());
        }
    }
}

/// The sample rate of the times in samples, in Hz.
const RATE_HZ: u32 = 44_100;

/// One time in all units.
#[derive(Clone, Copy, Debug)]
struct Asked {
    us: i64,
    seconds: f64,
    short: f32,
    position: i64,
}

/// Calls `ask` with each clip of a bank, as C and the reader know it, and times before, in and behind it.
fn at_all_times(ask: impl Fn(Option<&Bank>, Option<&Clip>, &lipz_bank::Clip<'_, '_>, Asked)) {
    let (expected, bank) = bank(SMALL);
    let bank = Some(&bank);
    for clip in expected.clips() {
        let found = Answer::<Clip>::from_call(|out| unsafe { lipz_clip_by_id(bank, clip.id().get(), out) }).ok();
        for us in (-50_000..3_000_000).step_by(33_333) {
            let (seconds, position) = (us as f64 / 1e6, us * 441 / 10_000);
            ask(bank, Some(&found), &clip, Asked { us, seconds, short: seconds as f32, position });
        }
    }
}

#[test]
fn all_units_of_time_lead_to_the_frame_of_the_reader() {
    at_all_times(|bank, found, clip, asked| {
        let answers = [
            (
                Answer::from_call(|out| unsafe { lipz_frame_at_us(bank, found, asked.us, out) }),
                clip.frame_at(Micros(asked.us)),
            ),
            (
                Answer::from_call(|out| unsafe { lipz_frame_at_seconds(bank, found, asked.seconds, out) }),
                clip.frame_at(Seconds(asked.seconds)),
            ),
            (
                Answer::from_call(|out| unsafe { lipz_frame_at_seconds_f32(bank, found, asked.short, out) }),
                clip.frame_at(Seconds(asked.short)),
            ),
            (
                Answer::from_call(|out| unsafe { lipz_frame_at_samples(bank, found, asked.position, RATE_HZ, out) }),
                clip.frame_at(Samples { position: asked.position, rate_hz: RATE_HZ }),
            ),
        ];
        for (found, expected) in answers {
            assert_eq!(found.some(), expected, "{asked:?}");
        }
    });
}

#[test]
fn all_units_of_time_lead_to_the_viseme_of_the_reader() {
    at_all_times(|bank, found, clip, asked| {
        let answers = [
            (
                Answer::from_call(|out| unsafe { lipz_viseme_at_us(bank, found, asked.us, out) }),
                clip.viseme_at(Micros(asked.us)),
            ),
            (
                Answer::from_call(|out| unsafe { lipz_viseme_at_seconds(bank, found, asked.seconds, out) }),
                clip.viseme_at(Seconds(asked.seconds)),
            ),
            (
                Answer::from_call(|out| unsafe { lipz_viseme_at_seconds_f32(bank, found, asked.short, out) }),
                clip.viseme_at(Seconds(asked.short)),
            ),
            (
                Answer::from_call(|out| unsafe { lipz_viseme_at_samples(bank, found, asked.position, RATE_HZ, out) }),
                clip.viseme_at(Samples { position: asked.position, rate_hz: RATE_HZ }),
            ),
        ];
        for (found, expected) in answers {
            assert_eq!(found.ok(), Viseme(expected.code()), "{asked:?}");
        }
    });
}

#[test]
fn all_units_of_time_lead_to_the_segment_of_the_reader() {
    at_all_times(|bank, found, clip, asked| {
        let answers = [
            (
                Answer::from_call(|out| unsafe { lipz_segment_at_us(bank, found, asked.us, out) }),
                clip.segment_at(Micros(asked.us)),
            ),
            (
                Answer::from_call(|out| unsafe { lipz_segment_at_seconds(bank, found, asked.seconds, out) }),
                clip.segment_at(Seconds(asked.seconds)),
            ),
            (
                Answer::from_call(|out| unsafe { lipz_segment_at_seconds_f32(bank, found, asked.short, out) }),
                clip.segment_at(Seconds(asked.short)),
            ),
            (
                Answer::from_call(|out| unsafe { lipz_segment_at_samples(bank, found, asked.position, RATE_HZ, out) }),
                clip.segment_at(Samples { position: asked.position, rate_hz: RATE_HZ }),
            ),
        ];
        for (found, expected) in answers {
            let found: Option<Segment> = found.some();
            assert_eq!(found.map(|segment| segment.index), expected.map(|segment| segment.index()), "{asked:?}");
        }
    });
}

#[test]
fn segments_have_the_texts_and_events_of_the_reader() {
    for bytes in [DRAMA, SMALL] {
        let (expected, bank) = bank(bytes);
        let bank = Some(&bank);
        for clip in expected.clips() {
            let found = Answer::<Clip>::from_call(|out| unsafe { lipz_clip_by_id(bank, clip.id().get(), out) }).ok();
            for segment in clip.segments() {
                let found = Answer::<Segment>::from_call(|out| unsafe {
                    lipz_segment_at(bank, Some(&found), segment.index(), out)
                })
                .ok();
                assert_eq!((found.start_frame, found.end_frame), (segment.start_frame(), segment.end_frame()));
                let string = Answer::from_call(|out| unsafe { lipz_segment_event_string(bank, Some(&found), out) });
                assert_eq!(string.some().map(text_of), segment.event());
                let written: Vec<_> = (0..)
                    .map_while(|index| {
                        Answer::<Event>::from_call(|out| unsafe { lipz_segment_event(bank, Some(&found), index, out) })
                            .some()
                    })
                    .map(|event| common::written(&event))
                    .collect();
                assert_eq!(written, segment.events().map(|event| event.to_string()).collect::<Vec<_>>());
                for (index, locale) in (0..).zip(expected.locales()) {
                    let (tag, length) = ptr(locale.tag());
                    let by_tag =
                        Answer::<Locale>::from_call(|out| unsafe { lipz_locale_by_tag(bank, tag, length, out) }).ok();
                    let by_index = Answer::<Locale>::from_call(|out| unsafe { lipz_locale_at(bank, index, out) }).ok();
                    assert_eq!((by_tag.index, text_of(by_index.tag)), (index, locale.tag()));
                    assert_eq!(by_tag.is_default == 1, locale.is_default());
                    let text = Answer::<Text>::from_call(|out| unsafe {
                        lipz_segment_text(bank, Some(&found), Some(&by_tag), out)
                    })
                    .some();
                    let text = text.map(|text| {
                        let string = String { data: text.data, length_bytes: text.length_bytes };
                        (text_of(string), text.is_fallback == 1)
                    });
                    assert_eq!(text, segment.text(locale).map(|text| (text.as_str(), text.is_fallback())));
                }
            }
        }
    }
}

/// A clip whose file has no frame rate plays with that of the struct; one that has it keeps it.
#[test]
fn the_caller_supplies_a_frame_rate() {
    let (_, bank) = bank(SMALL);
    let bank = Some(&bank);
    let clip_of = |key| {
        let (key, length) = ptr(key);
        Answer::<Clip>::from_call(|out| unsafe { lipz_clip_by_key(bank, key, length, out) }).ok()
    };
    let at = |clip: &Clip| Answer::<u32>::from_call(|out| unsafe { lipz_frame_at_us(bank, Some(clip), 500_000, out) });
    let mut clip = clip_of("act2/unspecified");
    assert_eq!((clip.fps_denominator, at(&clip).status), (0, LIPZ_NONE));
    (clip.fps_numerator, clip.fps_denominator) = (4, 1);
    assert_eq!(at(&clip).ok(), 2);
    (clip.fps_numerator, clip.fps_denominator) = (0, 7);
    assert_eq!(at(&clip).status, LIPZ_NONE, "no frame rate");
    let mut clip = clip_of("act1/blair");
    let own = at(&clip).ok();
    (clip.fps_numerator, clip.fps_denominator) = (1, 1);
    assert_eq!(at(&clip).ok(), own);
}

/// Locales and names are numbers: in another version of their bank these may be another locale's and name's.
#[test]
fn a_locale_of_another_version_leads_to_no_text() {
    let newer = {
        let mut bytes = DRAMA.to_vec();
        bytes[8] ^= 1; // the checksum, which `verify` looks at
        Vec::leak(bytes)
    };
    let open = |bytes: &'static [u8]| {
        Answer::<Bank>::from_call(|out| unsafe { lipz_bank_open(bytes.as_ptr(), bytes.len(), out, None) }).ok()
    };
    let banks = [open(DRAMA), open(newer)];
    let (tag, tag_length) = ptr("de-de");
    let (name, name_length) = ptr("otto");
    let id = lipz_bank::ClipId::from_key("act1/mara-good-evening").get();
    let segment = Segment { clip_id: id, index: 1, ..Segment::default() };
    for (own, other) in [(banks[0], banks[1]), (banks[1], banks[0])] {
        let german = |bank: Bank| {
            Answer::<Locale>::from_call(|out| unsafe { lipz_locale_by_tag(Some(&bank), tag, tag_length, out) }).ok()
        };
        let text = |locale: Locale| {
            Answer::<Text>::from_call(|out| unsafe {
                lipz_segment_text(Some(&own), Some(&segment), Some(&locale), out)
            })
        };
        let text_of_own = text(german(own)).ok();
        let string = String { data: text_of_own.data, length_bytes: text_of_own.length_bytes };
        assert_eq!(text_of(string), "Du bist spät dran,");
        assert_eq!(text(german(other)).status, LIPZ_NONE);

        let otto = |bank: Bank| {
            Answer::<EventName>::from_call(|out| unsafe { lipz_event_name(Some(&bank), name, name_length, out) }).ok()
        };
        let event =
            Answer::<Event>::from_call(|out| unsafe { lipz_segment_event(Some(&own), Some(&segment), 0, out) }).ok();
        assert_eq!((event.object.id, event.object.bank), (otto(own).id, otto(own).bank));
        assert_ne!(event.object.bank, otto(other).bank);
        assert_eq!((event.character.id, event.character.bank), (LIPZ_NO_NAME, 0));
    }
}

/// The first locale of one text bank is not the first one of another.
#[test]
fn a_locale_of_another_text_bank_leads_to_no_text() {
    let (expected, base) = bank(SPLIT);
    let with = |texts: &'static [u8]| {
        let mut bank = base;
        let status = unsafe { lipz_bank_use_texts(Some(&mut bank), texts.as_ptr(), texts.len(), None) };
        assert_eq!(status, LIPZ_OK);
        bank
    };
    let (german, english) = (with(common::GERMAN), with(common::ENGLISH));
    let first = |bank| Answer::<Locale>::from_call(|out| unsafe { lipz_locale_at(Some(bank), 0, out) }).ok();
    assert_eq!([text_of(first(&german).tag), text_of(first(&english).tag)], ["de-de", "en-us"]);
    let texts = |bank: &Bank, locale: &Locale| {
        let segments = expected.clips().map(|clip| Segment { clip_id: clip.id().get(), ..Segment::default() });
        let answers = segments.map(|segment| {
            Answer::<Text>::from_call(|out| unsafe { lipz_segment_text(Some(bank), Some(&segment), Some(locale), out) })
        });
        answers.filter(|answer| answer.status == LIPZ_OK).count()
    };
    assert!(texts(&german, &first(&german)) > 0 && texts(&english, &first(&english)) > 0);
    assert_eq!([texts(&german, &first(&english)), texts(&english, &first(&german))], [0; 2]);
    assert_eq!(texts(&base, &first(&german)), 0);
}

#[test]
fn names_and_the_default_locale() {
    let (expected, bank) = bank(DRAMA);
    let (name, length) = ptr("otto");
    let found = Answer::<EventName>::from_call(|out| unsafe { lipz_event_name(Some(&bank), name, length, out) }).ok();
    assert_eq!((found.id, text_of(found.name)), (expected.event_name("otto").unwrap().id(), "otto"));
    let locale = Answer::<Locale>::from_call(|out| unsafe { lipz_locale_default(Some(&bank), out) }).ok();
    assert_eq!(text_of(locale.tag), "en-us");
}
