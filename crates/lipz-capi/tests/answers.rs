//! The functions return the same answers as the reader, for every query of every golden file, alone and with others.
#![allow(unsafe_code, clippy::unwrap_used, clippy::cast_possible_truncation, reason = "tests")]

mod common;

use common::{DIALOGUES, Opened, ask, dialogue, micros, name_of, ptr, samples, seconds, seconds_f32, text_of, written};
use lipz_bank::{Micros, Samples, Seconds, VoiceSource};
use lipz_capi::*;

/// The sample rate of the times in samples.
const RATE_HZ: u32 = 44_100;

#[test]
fn clips_are_found_by_id_key_and_prefix() {
    for files in DIALOGUES {
        let Opened { of_c, reader } = &dialogue(files);
        let of_c = Some(of_c);
        let info: DialogueInfo = ask(|out| unsafe { lipz_dialogue_info(of_c, out) }).unwrap();
        assert_eq!(info.clip_count as usize, reader.clip_count());
        assert_eq!(info.locale_count as usize, reader.locales().count());
        assert_eq!((info.voice_count as usize, info.file_count as usize), (reader.voices().count(), files.len()));
        for prefix in ["", "act1/", "de/", "nowhere/"] {
            let (text, length) = ptr(prefix);
            let mut position = 0;
            let mut next =
                || ask(|out| unsafe { lipz_dialogue_next_clip(of_c, text, length, Some(&mut position), out) }).ok();
            let found: Vec<u64> = std::iter::from_fn(|| next().map(|clip: Clip| clip.id)).collect();
            assert_eq!(found, reader.clips_under(prefix).map(|clip| clip.id().get()).collect::<Vec<_>>(), "{prefix}");
        }
        for clip in reader.clips() {
            let (key, length) = ptr(clip.key());
            let id = ask(|out| unsafe { lipz_clip_id_of_key(key, length, out) }).unwrap();
            assert_eq!(id, clip.id().get());
            let by_id = ask(|out| unsafe { lipz_dialogue_clip(of_c, id, out) });
            let by_key = ask(|out| unsafe { lipz_dialogue_clip_by_key(of_c, key, length, out) });
            for found in [by_id, by_key].map(Result::<Clip, Status>::unwrap) {
                assert_eq!((found.id, found.file, found.slot), (id, clip.file(), clip.slot()));
                assert_eq!((found.frame_count, found.segment_count), (clip.frame_count(), clip.segment_count()));
                let fps = clip.fps().map_or((0, 0), |fps| (fps.numerator(), fps.denominator()));
                assert_eq!((found.fps_numerator, found.fps_denominator), fps);
                assert_eq!(found.viseme_type, clip.viseme_type().map_or(0, |kind| kind as u32));
                assert_eq!((found.has_visemes == 1, found.has_events == 1), (clip.has_visemes(), clip.has_events()));
            }
            let by_id = by_id.as_ref().ok();
            assert_eq!(text_of(ask(|out| unsafe { lipz_clip_key(of_c, by_id, out) }).unwrap()), clip.key());
            let frames = ask(|out| unsafe { lipz_clip_frames(of_c, by_id, out) }).unwrap();
            assert_eq!(text_of(frames).as_bytes(), clip.frames());
            let recording: Option<Recording> = ask(|out| unsafe { lipz_clip_recording(of_c, by_id, out) }).ok();
            let recording = recording.map(|recording| (recording.length_us, recording.content_hash));
            assert_eq!(recording, clip.recording().map(|found| (found.length_us(), found.content_hash())));
        }
    }
}

/// Calls `check` with each clip of all dialogues, in C and in the reader.
fn of_all_clips(check: impl Fn(&Opened, &Dialogue, &Clip, &lipz_bank::Clip<'_>)) {
    for files in DIALOGUES {
        let opened = dialogue(files);
        for clip in opened.reader.clips() {
            check(&opened, &opened.of_c, &opened.clip(clip.key()), &clip);
        }
    }
}

/// Compares an expression of the reader with a function of C, for times before, in and after a clip, in all units.
macro_rules! at_all_times {
    ($us:expr, |$of_c:ident, $time:ident| $found:expr, $expected:expr) => {{
        let us: i64 = $us;
        let (position, at) = (us * 441 / 10_000, us as f64 / 1e6);
        let $of_c = micros(us);
        let $time = Micros(us);
        assert_eq!($found, $expected, "{us} µs");
        let $of_c = samples(position, RATE_HZ);
        let $time = Samples { position, rate_hz: RATE_HZ };
        assert_eq!($found, $expected, "{position} samples");
        let $of_c = seconds(at);
        let $time = Seconds(at);
        assert_eq!($found, $expected, "{at} s");
        let $of_c = seconds_f32(at as f32);
        let $time = Seconds(at as f32);
        assert_eq!($found, $expected, "{at} s in 32 bits");
    }};
}

#[test]
fn all_units_of_time_lead_to_the_frame_of_the_reader() {
    of_all_clips(|_, of_c, found, clip| {
        let (of_c, found) = (Some(of_c), Some(found));
        for us in (-50_000..2_000_000).step_by(33_333) {
            at_all_times!(
                us,
                |asked, time| ask(|out| unsafe { lipz_clip_frame_at(of_c, found, asked, out) }).ok(),
                clip.frame_at(time)
            );
            at_all_times!(
                us,
                |asked, time| ask(|out| unsafe { lipz_clip_viseme_at(of_c, found, asked, out) }),
                Ok(Viseme(clip.viseme_at(time).code()))
            );
            at_all_times!(
                us,
                |asked, time| ask(|out| unsafe { lipz_clip_segment_at(of_c, found, asked, out) })
                    .ok()
                    .map(|segment: Segment| segment.index),
                clip.segment_at(time).map(|segment| segment.index())
            );
        }
        for frame in 0..clip.frame_count() + 2 {
            let viseme = ask(|out| unsafe { lipz_clip_viseme(of_c, found, frame, out) });
            assert_eq!(viseme, Ok(Viseme(clip.viseme(frame).code())));
            let start = ask(|out| unsafe { lipz_clip_start_of_frame_us(of_c, found, frame, out) }).ok();
            assert_eq!(start, clip.fps().map(|fps| fps.start_of_frame_us(frame)));
        }
        for us in [0, 1, 16_667, 33_333, 100_000] {
            let hold = ask(|out| unsafe { lipz_clip_hold_frames(of_c, found, us, out) }).ok();
            let of_reader = |fps| match us {
                0 => lipz_bank::playback::ConsonantHold::readable(fps),
                _ => lipz_bank::playback::ConsonantHold::for_display(us, fps),
            };
            assert_eq!(hold, clip.fps().map(|fps| of_reader(fps).frame_count().into()));
        }
    });
}

#[test]
fn segments_have_the_texts_and_events_of_the_reader() {
    let texts = std::cell::Cell::new(0);
    of_all_clips(|opened, of_c, clip_of_c, clip| {
        let of_c = Some(of_c);
        for segment in clip.segments() {
            let found: Segment =
                ask(|out| unsafe { lipz_clip_segment(of_c, Some(clip_of_c), segment.index(), out) }).unwrap();
            assert_eq!((found.start_frame, found.end_frame), (segment.start_frame(), segment.end_frame()));
            let string = ask(|out| unsafe { lipz_segment_event_string(of_c, Some(&found), out) });
            assert_eq!(string.map(text_of).ok(), segment.event());
            let event = |index| ask(|out| unsafe { lipz_segment_event(of_c, Some(&found), index, out) }).ok();
            let events: Vec<_> = (0..).map_while(event).map(|event: Event| written(&event)).collect();
            assert_eq!(events, segment.events().map(|event| event.to_string()).collect::<Vec<_>>());
            for (index, locale) in (0..).zip(opened.reader.locales()) {
                let tag = opened.reader.locale_tag(locale);
                let by_tag = opened.locale(tag).unwrap();
                let by_index: Locale = ask(|out| unsafe { lipz_dialogue_locale_by_index(of_c, index, out) }).unwrap();
                assert_eq!((by_tag.place, text_of(by_index.tag)), (by_index.place, tag));
                assert_eq!(by_tag.is_default == 1, opened.reader.default_locale() == Some(locale));
                let text = ask(|out| unsafe { lipz_segment_text(of_c, Some(&found), Some(&by_tag), out) }).ok();
                let text = text.map(|text: Text| {
                    let string = String { data: text.data, length_bytes: text.length_bytes };
                    (text_of(string), text.is_fallback == 1)
                });
                assert_eq!(text, segment.text(locale).map(|text| (text.as_str(), text.is_fallback())));
                texts.set(texts.get() + i32::from(text.is_some()));
            }
        }
    });
    assert!(texts.get() > 100, "{texts:?}");
}

#[test]
fn voices_are_those_of_the_reader() {
    let dubs = std::cell::Cell::new(0);
    of_all_clips(|opened, of_c, clip_of_c, clip| {
        let of_c = Some(of_c);
        for (index, voice) in (0..).zip(opened.reader.voices()) {
            let tag = opened.reader.voice_tag(voice);
            let (text, length) = ptr(tag);
            let by_tag: Voice = ask(|out| unsafe { lipz_dialogue_voice(of_c, text, length, out) }).unwrap();
            let by_index: Voice = ask(|out| unsafe { lipz_dialogue_voice_by_index(of_c, index, out) }).unwrap();
            assert_eq!((by_tag.place, text_of(by_index.tag)), (by_index.place, tag));
            assert_eq!(by_tag.is_original == 1, voice.is_original());
            let found: VoicedClip =
                ask(|out| unsafe { lipz_clip_in_voice(of_c, Some(clip_of_c), Some(&by_tag), out) }).unwrap();
            let expected = clip.in_voice(voice);
            assert_eq!((found.clip.file, found.clip.slot), (expected.clip.file(), expected.clip.slot()));
            let spoken = match expected.spoken {
                VoiceSource::Dub => LIPZ_DUB,
                VoiceSource::OtherDub => LIPZ_OTHER_DUB,
                _ => LIPZ_ORIGINAL,
            };
            assert_eq!(found.spoken, spoken);
            dubs.set(dubs.get() + spoken);
            let of_clip: Option<Voice> = ask(|out| unsafe { lipz_clip_voice(of_c, Some(&found.clip), out) }).ok();
            let expected = expected.clip.voice().map(|voice| opened.reader.voice_tag(voice));
            assert_eq!(of_clip.map(|voice| text_of(voice.tag)), expected);
        }
    });
    assert!(dubs.get() > 0);
}

#[test]
fn curves_and_emotions_are_those_of_the_reader() {
    let curves = std::cell::Cell::new(0);
    of_all_clips(|_, of_c, clip_of_c, clip| {
        let (of_c, clip_of_c) = (Some(of_c), Some(clip_of_c));
        for (index, curve) in (0..).zip(clip.curves()) {
            let (name, length) = ptr(curve.name().as_str());
            let named: Curve = ask(|out| unsafe { lipz_clip_curve(of_c, clip_of_c, name, length, out) }).unwrap();
            let found: Curve = ask(|out| unsafe { lipz_clip_curve_by_index(of_c, clip_of_c, index, out) }).unwrap();
            assert_eq!((named.place, named.key_count), (found.place, curve.key_count()));
            let found = Some(&found);
            for (index, key) in (0..).zip(curve.keys()) {
                let found: CurveKey = ask(|out| unsafe { lipz_curve_key(of_c, found, index, out) }).unwrap();
                assert_eq!((found.frame, found.thousandths), (key.frame, key.value.thousandths()));
            }
            // Jumps, and a cursor that starts anywhere, change no value.
            let mut cursor = CurveCursor { key: u32::MAX };
            for us in (-50_000..1_500_000).step_by(66_667) {
                for is_with in [false, true] {
                    let mut kept = |asked| {
                        let cursor = Some(&mut cursor).filter(|_| is_with);
                        ask(|out| unsafe { lipz_curve_value_at(of_c, found, asked, cursor, out) }).ok()
                    };
                    at_all_times!(
                        us,
                        |asked, time| kept(asked),
                        curve.value_at(time).map(lipz_bank::curve::CurveValue::thousandths)
                    );
                }
            }
            let value = ask(|out| unsafe { lipz_curve_value(of_c, found, 3, out) });
            assert_eq!(value, Ok(curve.value(3).thousandths()));
            curves.set(curves.get() + 1);
        }
        let behind = clip.curves().count() as u32;
        let none: Result<Curve, _> = ask(|out| unsafe { lipz_clip_curve_by_index(of_c, clip_of_c, behind, out) });
        assert_eq!(none.err(), Some(LIPZ_NONE));
        for (who, of_reader) in [(None, lipz_bank::face::Who::Speaker)].into_iter().chain(characters()) {
            let sums = |emotions: Emotions| (emotions.thousandths.to_vec(), emotions.strongest, emotions.sum);
            for us in [-1, 0, 500_000, 1_200_000] {
                at_all_times!(
                    us,
                    |asked, time| ask(|out| unsafe {
                        lipz_clip_emotions_at(of_c, clip_of_c, asked, who.as_ref(), out)
                    })
                    .map(sums),
                    Ok(of_reader_sums(&clip.emotions_at(time, of_reader)))
                );
            }
        }
    });
    assert!(curves.get() > 20, "{curves:?}");
}

fn of_reader_sums(emotions: &lipz_bank::face::Emotions) -> (Vec<i32>, u32, i32) {
    let values = emotions.iter().map(|(_, value)| value.thousandths()).collect();
    (values, emotions.strongest().map_or(LIPZ_NEUTRAL, |(emotion, _)| emotion as u32), emotions.sum().thousandths())
}

/// Mara as a listener and as the speaker.
fn characters() -> [(Option<Who>, lipz_bank::face::Who<'static>); 2] {
    let (data, length_bytes) = ptr("mara");
    [(0, lipz_bank::face::Who::Other("mara")), (1, lipz_bank::face::Who::SpeakerNamed("mara"))]
        .map(|(is_speaker, who)| (Some(Who { name: String { data, length_bytes }, is_speaker }), who))
}

#[test]
fn faces_are_those_of_the_reader() {
    of_all_clips(|opened, of_c, clip_of_c, clip| {
        let (of_c, clip_of_c) = (Some(of_c), Some(clip_of_c));
        let own = (None, opened.reader.default_face_profile());
        let named = opened.reader.face_profiles().map(|profile| {
            let (name, length) = ptr(profile.name());
            (Some(ask(|out| unsafe { lipz_dialogue_face_profile(of_c, name, length, out) }).unwrap()), profile)
        });
        for (of_c_profile, profile) in std::iter::once(own).chain(named) {
            let of_c_profile: Option<&FaceProfile> = of_c_profile.as_ref();
            for (who, of_reader) in [(None, lipz_bank::face::Who::Speaker)].into_iter().chain(characters()) {
                for us in [-1, 0, 700_000, 3_000_000] {
                    let look = LookAt { pitch: 3000, yaw: -9000, is_person: 0 };
                    let value = lipz_bank::curve::CurveValue::from_thousandths;
                    let to = lipz_bank::face::LookAt::point(value(3000), value(-9000));
                    at_all_times!(
                        us,
                        |asked, time| ask(|out| unsafe {
                            lipz_clip_face_at(of_c, clip_of_c, asked, who.as_ref(), of_c_profile, Some(&look), out)
                        })
                        .map(fields_of_c),
                        Ok(fields(clip.face_at(time, of_reader, &profile, to)))
                    );
                    at_all_times!(
                        us,
                        |asked, time| ask(|out| unsafe { lipz_face_idle_at(of_c, asked, 7, of_c_profile, None, out) })
                            .map(fields_of_c),
                        Ok(fields(profile.idle_at(time, 7, lipz_bank::face::LookAt::AHEAD)))
                    );
                }
            }
        }
    });
}

#[test]
fn articulation_and_weights_are_those_of_the_reader() {
    let rigs = std::cell::Cell::new(0);
    of_all_clips(|opened, of_c, clip_of_c, clip| {
        let (of_c, clip_of_c) = (Some(of_c), Some(clip_of_c));
        let own = (None, opened.reader.default_articulation());
        let named = opened.reader.articulations().map(|profile| {
            let (name, length) = ptr(profile.name());
            (Some(ask(|out| unsafe { lipz_dialogue_articulation_profile(of_c, name, length, out) }).unwrap()), profile)
        });
        for (of_c_profile, profile) in std::iter::once(own).chain(named) {
            for us in [-1, 0, 250_000, 700_000, 3_000_000] {
                at_all_times!(
                    us,
                    |asked, time| ask(|out| unsafe {
                        lipz_clip_articulation_at(of_c, clip_of_c, asked, of_c_profile.as_ref(), out)
                    })
                    .map(|mouth: Articulation| mouth.thousandths),
                    Ok(*clip.articulation_at(time, &profile).values())
                );
            }
        }
        let mouth = clip.articulation_at(Micros(250_000), &opened.reader.default_articulation());
        for rig in opened.reader.rigs() {
            let (name, length) = ptr(rig.name());
            let found: Rig = ask(|out| unsafe { lipz_dialogue_rig(of_c, name, length, out) }).unwrap();
            let name = |index| ask::<String>(|out| unsafe { lipz_rig_weight_name(of_c, Some(&found), index, out) });
            let names: Vec<_> = (0..found.weight_count).map(|index| text_of(name(index).unwrap())).collect();
            assert_eq!(names, rig.weight_names().collect::<Vec<_>>());
            assert_eq!(name(found.weight_count).unwrap_err(), LIPZ_NONE);
            let articulation = Articulation { thousandths: *mouth.values() };
            // One place more, which becomes 0.
            let mut weights = vec![7; rig.weight_count() + 1];
            let status = unsafe {
                let (data, length) = (weights.as_mut_ptr(), weights.len());
                lipz_rig_weights(of_c, Some(&found), Some(&articulation), None, None, data, length)
            };
            let mut expected = vec![lipz_bank::curve::CurveValue::default(); weights.len()];
            rig.weights(&mouth, &Default::default(), &Default::default(), &mut expected);
            assert_eq!((status, weights), (LIPZ_OK, expected.iter().map(|value| value.thousandths()).collect()));
            rigs.set(rigs.get() + 1);
        }
    });
    assert!(rigs.get() > 20, "{rigs:?}");
}

fn fields_of_c(face: Face) -> [i32; 9] {
    let Face { blink, head_pitch, head_yaw, head_roll, eye_pitch, eye_yaw, brows, shrug, breath } = face;
    [blink, head_pitch, head_yaw, head_roll, eye_pitch, eye_yaw, brows, shrug, breath]
}

fn fields(face: lipz_bank::face::Face) -> [i32; 9] {
    let head = [face.head_pitch, face.head_yaw, face.head_roll].map(lipz_bank::curve::CurveValue::thousandths);
    let eyes = [face.eye_pitch, face.eye_yaw].map(lipz_bank::curve::CurveValue::thousandths);
    let rest = [face.brows, face.shrug, face.breath].map(lipz_bank::curve::CurveValue::thousandths);
    [&[face.blink.thousandths()][..], &head, &eyes, &rest].concat().try_into().unwrap()
}

#[test]
fn babble_is_that_of_the_reader() {
    for files in DIALOGUES {
        let Opened { of_c, reader } = &dialogue(files);
        let of_c = Some(of_c);
        let own: Babble = ask(|out| unsafe { lipz_dialogue_babble(of_c, std::ptr::null(), 0, out) }).unwrap();
        let named = reader.babbles().map(|profile| {
            let (name, length) = ptr(profile.name());
            (ask(|out| unsafe { lipz_dialogue_babble(of_c, name, length, out) }).unwrap(), profile)
        });
        for (of_c_profile, profile) in std::iter::once((own, reader.default_babble())).chain(named) {
            let of_c_profile = Some(&of_c_profile);
            for us in (-50_000..900_000).step_by(33_333) {
                let pair = |weights: Weights| (weights.ooh, weights.aah);
                let of_reader = |weights: lipz_bank::babble::Weights| {
                    (u32::from(weights.ooh.ten_thousandths()), u32::from(weights.aah.ten_thousandths()))
                };
                at_all_times!(
                    us,
                    |asked, time| ask(|out| unsafe { lipz_babble_at(of_c, of_c_profile, asked, 0.7, out) }).map(pair),
                    Ok(of_reader(profile.at(time, 0.7)))
                );
                at_all_times!(
                    us,
                    |asked, time| ask(|out| unsafe { lipz_babble_at_level(of_c, of_c_profile, asked, 30_000, out) })
                        .map(pair),
                    Ok(of_reader(profile.at(time, lipz_bank::babble::VoiceLevel(30_000))))
                );
            }
        }
        let none: Result<Babble, _> = ask(|out| unsafe { lipz_dialogue_babble(of_c, ptr("nobody").0, 6, out) });
        assert_eq!(none.err(), Some(LIPZ_NONE));
    }
}

#[test]
fn names_are_those_of_the_reader() {
    for files in DIALOGUES {
        let opened = dialogue(files);
        for name in ["otto", "amy", "nobody"] {
            let (text, length) = ptr(name);
            let found = ask(|out| unsafe { lipz_dialogue_event_name(Some(&opened.of_c), text, length, out) }).ok();
            assert_eq!(found.and_then(name_of), opened.reader.event_name(name).map(lipz_bank::EventName::as_str));
        }
    }
}

/// A clip without a frame rate in its file plays with that of the struct; other clips keep theirs.
#[test]
fn the_caller_supplies_a_frame_rate() {
    let opened = dialogue(&[common::SMALL]);
    let at =
        |clip: &Clip| ask(|out| unsafe { lipz_clip_frame_at(Some(&opened.of_c), Some(clip), micros(500_000), out) });
    let mut clip = opened.clip("act2/unspecified");
    assert_eq!((clip.fps_denominator, at(&clip)), (0, Err(LIPZ_NONE)));
    (clip.fps_numerator, clip.fps_denominator) = (4, 1);
    assert_eq!(at(&clip), Ok(2));
    (clip.fps_numerator, clip.fps_denominator) = (0, 7);
    assert_eq!(at(&clip), Err(LIPZ_NONE), "no frame rate");
    let mut clip = opened.clip("act1/blair");
    let own = at(&clip);
    (clip.fps_numerator, clip.fps_denominator) = (1, 1);
    assert_eq!(at(&clip), own);
}
