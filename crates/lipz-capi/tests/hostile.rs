//! Null pointers, foreign structs and damaged files lead to a status and an empty answer.
#![allow(unsafe_code, clippy::unwrap_used, clippy::cast_possible_wrap, reason = "tests")]

mod common;

use common::{
    DIALOGUES, DRAMA, DUBBED, FIRST_OF_SET, GERMAN, PATCH, SECOND_OF_SET, SET, SMALL, ask, bytes, dialogue, micros,
    opened, places, samples, seconds, seconds_f32, text_of,
};
use lipz_bank::ErrorKind;
use lipz_capi::*;
use std::mem::MaybeUninit;

#[test]
fn null_pointers_are_a_status() {
    let of_c = &dialogue(&[SMALL]).of_c;
    let (of_c, null, time) = (Some(of_c), std::ptr::null(), micros(0));
    let clip: Clip = ask(|out| unsafe { lipz_dialogue_next_clip(of_c, null, 0, Some(&mut 0), out) }).unwrap();
    let segment: Segment = ask(|out| unsafe { lipz_clip_segment(of_c, Some(&clip), 0, out) }).unwrap();
    let locale: Locale = ask(|out| unsafe { lipz_dialogue_locale(of_c, null, 0, out) }).unwrap();
    let mut place = [FilePlace { words: [0; LIPZ_FILE_WORDS] }];
    let small = bytes(SMALL);
    let no_bytes = Bytes { data: null.cast(), length_bytes: 64 };
    let mut unopened = MaybeUninit::uninit();
    unsafe {
        let statuses = [
            lipz_dialogue_open(None, place.as_mut_ptr(), &small, 1, 0, None),
            lipz_dialogue_open(Some(&mut unopened), std::ptr::null_mut(), &small, 1, 0, None),
            lipz_dialogue_open(Some(&mut unopened), place.as_mut_ptr(), null.cast(), 1, 0, None),
            lipz_dialogue_open(Some(&mut unopened), place.as_mut_ptr(), &small, usize::MAX, 0, None),
            lipz_dialogue_open(Some(&mut unopened), place.as_mut_ptr(), &no_bytes, 1, 0, None),
            lipz_dialogue_open_bank(None, None, Some(&small)),
            lipz_dialogue_open_bank(Some(&mut unopened), None, Some(&small)),
            lipz_dialogue_open_bank(Some(&mut unopened), Some(&mut MaybeUninit::uninit()), None),
            lipz_dialogue_open_bank(Some(&mut unopened), Some(&mut MaybeUninit::uninit()), Some(&no_bytes)),
            lipz_dialogue_supply(None, place.as_mut_ptr(), 1, Some(&small), 0, None),
            ask::<SetBank>(|out| lipz_set_bank_by_index(None, 0, out)).unwrap_err(),
            ask::<DialogueInfo>(|out| lipz_dialogue_info(None, out)).unwrap_err(),
            lipz_dialogue_info(of_c, None),
            ask::<Clip>(|out| lipz_dialogue_clip(None, clip.id, out)).unwrap_err(),
            lipz_dialogue_clip(of_c, clip.id, None),
            ask::<Clip>(|out| lipz_dialogue_clip_by_key(of_c, null, 1, out)).unwrap_err(),
            ask::<Clip>(|out| lipz_dialogue_next_clip(of_c, null, 0, None, out)).unwrap_err(),
            ask::<u64>(|out| lipz_clip_id_of_key(null, 1, out)).unwrap_err(),
            ask::<u32>(|out| lipz_clip_frame_at(of_c, None, time, out)).unwrap_err(),
            lipz_clip_frame_at(of_c, Some(&clip), time, None),
            ask::<Text>(|out| lipz_segment_text(of_c, None, Some(&locale), out)).unwrap_err(),
            ask::<Text>(|out| lipz_segment_text(of_c, Some(&segment), None, out)).unwrap_err(),
            ask::<Name>(|out| lipz_dialogue_event_name(of_c, null, 5, out)).unwrap_err(),
            ask::<VoicedClip>(|out| lipz_clip_in_voice(of_c, Some(&clip), None, out)).unwrap_err(),
            ask::<Face>(|out| lipz_clip_face_at(of_c, Some(&clip), time, Some(&Who::default()), None, None, out))
                .unwrap_err(),
            ask::<Rig>(|out| lipz_dialogue_rig(of_c, null, 1, out)).unwrap_err(),
            ask::<String>(|out| lipz_rig_weight_name(of_c, None, 0, out)).unwrap_err(),
            lipz_rig_weights(of_c, Some(&Rig::default()), None, None, None, std::ptr::null_mut(), 1),
            lipz_status_message(LIPZ_OK, None),
            lipz_cursor_new(of_c, Some(&clip), size_of::<Cursor>(), None),
            lipz_cursor_advance(of_c, None, time),
            ask::<Event>(|out| lipz_cursor_take_event(of_c, None, out)).unwrap_err(),
            ask::<Viseme>(|out| lipz_cursor_viseme(of_c, None, out)).unwrap_err(),
            ask::<Weights>(|out| lipz_babble_at(of_c, None, time, 1.0, out)).unwrap_err(),
        ];
        assert!(statuses.iter().all(|status| *status == LIPZ_NULL_POINTER), "{statuses:?}");
        let mut mouth = MaybeUninit::uninit();
        assert_eq!(lipz_clip_viseme_at(None, None, time, Some(&mut mouth)), LIPZ_NULL_POINTER);
        assert_eq!(mouth.assume_init(), Viseme(b'-'), "the mouth rests");
    }
}

#[test]
fn damage_has_the_number_and_the_place_of_the_reader() {
    for length in (1..SMALL.len()).step_by(7) {
        let cut = SMALL.get(..length).unwrap();
        let expected = lipz_bank::Bank::open(cut).unwrap_err();
        let (status, problem) = opened(&[cut], places(1), 0).unwrap_err();
        assert_eq!(status, u32::from(expected.kind().number()));
        assert_eq!((problem.file, problem.offset_bytes), (0, expected.offset_bytes()));
    }
    let mut damaged = PATCH.to_vec();
    *damaged.last_mut().unwrap() ^= 1;
    let (status, problem) = opened(&[SMALL, &damaged], places(2), 0).unwrap_err();
    assert_eq!((status, problem.file), (u32::from(ErrorKind::Checksum.number()), 1));
    assert!(opened(&[SMALL, &damaged], places(2), LIPZ_UNVERIFIED).is_ok());
}

#[test]
fn what_does_not_fit_is_named() {
    let fails = |files: &[&[u8]], kind: ErrorKind, file| {
        let (status, problem) = opened(files, places(files.len()), 0).unwrap_err();
        assert_eq!((status, problem.file), (u32::from(kind.number()), file), "{kind:?}");
    };
    fails(&[], ErrorKind::LayerCount, 0);
    fails(&[GERMAN], ErrorKind::TextsOnly, 0);
    fails(&[PATCH], ErrorKind::OtherBase, 0);
    fails(&[DRAMA, &[]], ErrorKind::TooShort, 1);
    fails(&[DRAMA, GERMAN], ErrorKind::OtherClips, 1);
    fails(&[DRAMA, PATCH], ErrorKind::OtherBase, 1);
    fails(&[SMALL, PATCH, DRAMA], ErrorKind::NotALayer, 2);
    fails(&[SMALL, SET], ErrorKind::NotALayer, 1);
    fails(&[SET], ErrorKind::OtherBank, 0);
    fails(&[SET, SECOND_OF_SET, FIRST_OF_SET], ErrorKind::OtherBank, 1);
}

#[test]
fn every_status_has_a_message() {
    let own = [LIPZ_OK, LIPZ_NONE, LIPZ_NULL_POINTER, LIPZ_NOT_UTF8, LIPZ_NOT_OPENED, LIPZ_OTHER_VERSION, LIPZ_ABSENT];
    for status in own {
        assert!(ask::<String>(|out| lipz_status_message(status, out)).is_ok());
    }
    for kind in ErrorKind::ALL {
        let message = ask(|out| lipz_status_message(kind.number().into(), out)).unwrap();
        assert_eq!(text_of(message), kind.message());
    }
    assert_eq!(ask::<String>(|out| lipz_status_message(200, out)).err(), Some(LIPZ_NONE));
}

#[test]
fn strings_that_are_asked_for_are_utf8() {
    let of_c = &dialogue(&[SMALL]).of_c;
    let text = [0xFF_u8, 0xFE];
    let found: Result<Clip, _> =
        ask(|out| unsafe { lipz_dialogue_clip_by_key(Some(of_c), text.as_ptr().cast(), 2, out) });
    assert_eq!(found.err(), Some(LIPZ_NOT_UTF8));
}

#[test]
fn what_was_not_opened_answers_nothing() {
    let zeros = Dialogue { words: [0; LIPZ_DIALOGUE_WORDS] };
    let info: Result<DialogueInfo, _> = ask(|out| unsafe { lipz_dialogue_info(Some(&zeros), out) });
    assert_eq!(info.err(), Some(LIPZ_NOT_OPENED));
    let mut failed = MaybeUninit::new(dialogue(&[SMALL]).of_c);
    let nothing = bytes(&[0; 3]);
    let status = unsafe { lipz_dialogue_open(Some(&mut failed), places(1).as_mut_ptr(), &nothing, 1, 0, None) };
    assert_eq!(status, u32::from(ErrorKind::TooShort.number()));
    let failed = unsafe { failed.assume_init() };
    let info: Result<DialogueInfo, _> = ask(|out| unsafe { lipz_dialogue_info(Some(&failed), out) });
    assert_eq!(info.err(), Some(LIPZ_NOT_OPENED), "a dialogue of before does not stay");
}

#[test]
fn one_bank_is_opened_and_nothing_else() {
    let open = |contents: &[u8]| {
        let mut of_c = MaybeUninit::new(dialogue(&[SMALL]).of_c);
        let file = Box::leak(Box::new(MaybeUninit::uninit()));
        let status = unsafe { lipz_dialogue_open_bank(Some(&mut of_c), Some(file), Some(&bytes(contents))) };
        (status, unsafe { of_c.assume_init() })
    };
    let (status, one) = open(DRAMA);
    let info: DialogueInfo = ask(|out| unsafe { lipz_dialogue_info(Some(&one), out) }).unwrap();
    let whole: DialogueInfo = ask(|out| unsafe { lipz_dialogue_info(Some(&dialogue(&[DRAMA]).of_c), out) }).unwrap();
    assert_eq!((status, info.clip_count, info.locale_count), (LIPZ_OK, whole.clip_count, whole.locale_count));
    for (contents, kind) in [
        (GERMAN, ErrorKind::TextsOnly),
        (PATCH, ErrorKind::OtherBase),
        (SET, ErrorKind::NotABank),
        (&DRAMA[..99], ErrorKind::WrongLength),
        (&[], ErrorKind::TooShort),
    ] {
        let (status, refused) = open(contents);
        assert_eq!(status, u32::from(kind.number()), "{kind:?}");
        let info: Result<DialogueInfo, _> = ask(|out| unsafe { lipz_dialogue_info(Some(&refused), out) });
        assert_eq!(info.err(), Some(LIPZ_NOT_OPENED), "a dialogue of before does not stay");
    }
}

/// Without a bank, the project's locale and profiles are unknown.
#[test]
fn a_set_without_banks_is_absent() {
    let of_c = opened(&[SET, &[], &[]], places(3), 0).unwrap();
    let null = std::ptr::null();
    let locale: Result<Locale, _> = ask(|out| unsafe { lipz_dialogue_locale(Some(&of_c), null, 0, out) });
    let profile: Result<FaceProfile, _> = ask(|out| unsafe { lipz_dialogue_face_profile(Some(&of_c), null, 0, out) });
    assert_eq!((locale.err(), profile.err()), (Some(LIPZ_ABSENT), Some(LIPZ_ABSENT)));
}

/// Handles from one version of a dialogue are rejected by another version.
#[test]
fn handles_of_another_version_lead_to_nothing() {
    let (own, other) = (dialogue(&[SMALL]), dialogue(&[SMALL, PATCH]));
    for (own, other) in [(&own, &other), (&other, &own)] {
        let (of_c, clip) = (Some(&own.of_c), own.clip("act1/blair"));
        let foreign = other.clip("act1/blair");
        let segment = |clip: &Clip| ask(|out| unsafe { lipz_clip_segment(of_c, Some(clip), 0, out) });
        let text = |segment: &Segment, locale: &Locale| {
            ask::<Text>(|out| unsafe { lipz_segment_text(of_c, Some(segment), Some(locale), out) })
        };
        let segment_of_own: Segment = segment(&clip).unwrap();
        assert_eq!(segment(&foreign).err(), Some(LIPZ_NONE));
        let (here, there) = (own.locale("en-us").unwrap(), other.locale("en-us").unwrap());
        assert!(text(&segment_of_own, &here).is_ok());
        assert_eq!(text(&segment_of_own, &there).err(), Some(LIPZ_NONE));
        let foreign_segment = Segment { version: foreign.version, ..segment_of_own };
        assert_eq!(text(&foreign_segment, &here).err(), Some(LIPZ_NONE));
    }
    let dubbed = dialogue(&[DUBBED]);
    let clip = dubbed.clip(dubbed.reader.clips().next().unwrap().key());
    let foreign = Voice { version: 1, ..Voice::default() };
    let voiced: VoicedClip =
        ask(|out| unsafe { lipz_clip_in_voice(Some(&dubbed.of_c), Some(&clip), Some(&foreign), out) }).unwrap();
    assert_eq!((voiced.clip.id, voiced.spoken), (clip.id, LIPZ_ORIGINAL), "the clip itself");
}

#[test]
fn banks_of_a_set_come_when_they_are_needed() {
    let index = bytes(SET);
    let named: Vec<SetBank> = (0..)
        .map_while(|number| ask(|out| unsafe { lipz_set_bank_by_index(Some(&index), number, out) }).ok())
        .collect();
    assert_eq!(named.len(), 2);
    assert!(text_of(named[1].file_name).ends_with(".lipzbank"));
    assert_eq!(named[0].length_bytes as usize, FIRST_OF_SET.len());

    let files = places(3);
    let mut of_c = opened(&[SET, &[], &[]], files, 0).unwrap();
    let whole = dialogue(&[SET, FIRST_OF_SET, SECOND_OF_SET]);
    let find = |of_c: &Dialogue, id| {
        let mut clip = MaybeUninit::uninit();
        let status = unsafe { lipz_dialogue_clip(Some(of_c), id, Some(&mut clip)) };
        (status, unsafe { clip.assume_init() })
    };
    let mut supplied = 0;
    for clip in whole.reader.clips() {
        let (status, found) = find(&of_c, clip.id().get());
        if status == LIPZ_ABSENT {
            let contents = [FIRST_OF_SET, SECOND_OF_SET];
            let (right, wrong) = (contents[found.file as usize - 1], contents[2 - found.file as usize]);
            let mut supply = |contents: &[u8]| {
                let mut problem = MaybeUninit::uninit();
                let place = files.as_mut_ptr();
                let status = unsafe {
                    lipz_dialogue_supply(
                        Some(&mut of_c),
                        place,
                        found.file,
                        Some(&bytes(contents)),
                        0,
                        Some(&mut problem),
                    )
                };
                (status, unsafe { problem.assume_init() }.file)
            };
            assert_eq!(supply(wrong), (u32::from(ErrorKind::OtherBank.number()), found.file));
            assert_eq!(supply(right), (LIPZ_OK, 0));
            assert_eq!(supply(right), (LIPZ_NONE, 0), "it is there");
            supplied += 1;
        }
        let (status, found) = find(&of_c, clip.id().get());
        assert_eq!((status, found.file, found.slot), (LIPZ_OK, clip.file(), clip.slot()));
    }
    assert_eq!(supplied, 2);
}

struct Random(u64);

impl Random {
    fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 32) as u32
    }
}

/// Changes bytes of all files, and makes every query, with structs of the intact dialogue and with random ones.
#[test]
fn queries_are_total_on_damaged_files_and_foreign_structs() {
    let mut random = Random(0x9E37_79B9_7F4A_7C15);
    let mut open_count = 0;
    for files in DIALOGUES {
        let mut damaged: Vec<Vec<u8>> = files.iter().map(|file| file.to_vec()).collect();
        for _ in 0..400 {
            let number = random.next() as usize % files.len();
            let place = random.next() as usize % files[number].len();
            damaged[number][place] ^= 1 << (random.next() % 8);
            let contents: Vec<&[u8]> = damaged.iter().map(Vec::as_slice).collect();
            let mut files_of_c = vec![FilePlace { words: [0; LIPZ_FILE_WORDS] }; files.len()];
            if let Ok(of_c) = opened(&contents, &mut files_of_c, LIPZ_UNVERIFIED) {
                open_count += 1;
                for _ in 0..4 {
                    every_query(&of_c, &mut random);
                }
            }
            damaged[number][place] = files[number][place];
        }
    }
    assert!(open_count > 2000, "{open_count}");
}

fn every_query(of_c: &Dialogue, random: &mut Random) {
    let dialogue = Some(of_c);
    let times = [
        micros(random.next().into()),
        samples(random.next().into(), random.next()),
        seconds(f64::from_bits(u64::from(random.next()) << 32)),
        seconds_f32(f32::from_bits(random.next())),
    ];
    unsafe {
        let _ = ask::<DialogueInfo>(|out| lipz_dialogue_info(dialogue, out));
        let _ = ask::<FileInfo>(|out| lipz_dialogue_file_by_index(dialogue, random.next() % 5, out));
        let mut position = u64::from(random.next() % 9) | u64::from(random.next() % 3) << 32;
        let found = ask(|out| lipz_dialogue_next_clip(dialogue, std::ptr::null(), 0, Some(&mut position), out));
        let mut clip: Clip = found.unwrap_or_default();
        match random.next() % 4 {
            0 => clip.slot = random.next(),
            1 => clip = Clip { file: random.next() % 5, slot: random.next() % 20, ..clip },
            2 => clip.fps_numerator = random.next(),
            _ => {}
        }
        let (asked, number) = (Some(&clip), random.next() >> (random.next() % 32));
        let _ = ask::<Clip>(|out| lipz_dialogue_clip(dialogue, clip.id, out));
        let _ = ask::<Clip>(|out| lipz_dialogue_clip_by_key(dialogue, c"act1/blair".as_ptr(), 10, out));
        let _ = ask::<String>(|out| lipz_clip_key(dialogue, asked, out));
        let _ = ask::<String>(|out| lipz_clip_frames(dialogue, asked, out));
        let _ = ask::<Viseme>(|out| lipz_clip_viseme(dialogue, asked, number, out));
        let _ = ask::<u64>(|out| lipz_clip_start_of_frame_us(dialogue, asked, number, out));
        let _ = ask::<u32>(|out| lipz_clip_hold_frames(dialogue, asked, number, out));
        let _ = ask::<Recording>(|out| lipz_clip_recording(dialogue, asked, out));
        let locale = match ask(|out| lipz_dialogue_locale_by_index(dialogue, number % 4, out)) {
            Ok(locale) => Locale { place: number % 5, ..locale },
            Err(_) => Locale::default(),
        };
        let voice = match ask(|out| lipz_dialogue_voice_by_index(dialogue, number % 4, out)) {
            Ok(voice) => Voice { place: number % 5, ..voice },
            Err(_) => Voice::default(),
        };
        let _ = ask::<VoicedClip>(|out| lipz_clip_in_voice(dialogue, asked, Some(&voice), out));
        let _ = ask::<Voice>(|out| lipz_clip_voice(dialogue, asked, out));
        let segment = Segment {
            clip_id: clip.id,
            version: clip.version,
            file: clip.file,
            slot: clip.slot,
            index: number % 13,
            start_frame: number,
            end_frame: number,
        };
        let segment = Some(&segment);
        let _ = ask::<Segment>(|out| lipz_clip_segment(dialogue, asked, number, out));
        let _ = ask::<Text>(|out| lipz_segment_text(dialogue, segment, Some(&locale), out));
        let _ = ask::<String>(|out| lipz_segment_event_string(dialogue, segment, out));
        let _ = ask::<Event>(|out| lipz_segment_event(dialogue, segment, number % 5, out));
        let _ = ask::<Name>(|out| lipz_dialogue_event_name(dialogue, c"amy".as_ptr(), 3, out));
        for time in times {
            at_a_time(dialogue, asked, time, number);
        }
        every_move(of_c, &clip, times, random);
    }
}

/// # Safety
/// The contract of the library.
unsafe fn at_a_time(dialogue: Option<&Dialogue>, clip: Option<&Clip>, time: Time, number: u32) {
    let who = Who { name: String { data: c"mara".as_ptr(), length_bytes: 4 }, is_speaker: number % 3 };
    let version = clip.map_or(0, |clip| clip.version);
    let look = LookAt { pitch: number as i32, yaw: number.rotate_left(9) as i32, is_person: number % 2 };
    let place = |index: u32| if index == 3 { LIPZ_BUILT_IN } else { index };
    let profile = FaceProfile { index: place(number % 4), version, ..FaceProfile::default() };
    let babble = Babble { index: place(number % 4), version, ..Babble::default() };
    let articulation = ArticulationProfile { index: place(number % 4), version, ..ArticulationProfile::default() };
    let rig = Rig { index: number % 5, version, weight_count: number, ..Rig::default() };
    unsafe {
        let _ = ask::<u32>(|out| lipz_clip_frame_at(dialogue, clip, time, out));
        let _ = ask::<Viseme>(|out| lipz_clip_viseme_at(dialogue, clip, time, out));
        let _ = ask::<Segment>(|out| lipz_clip_segment_at(dialogue, clip, time, out));
        let _ = ask::<Emotions>(|out| lipz_clip_emotions_at(dialogue, clip, time, Some(&who), out));
        let (who, look) = (Some(&who), Some(&look));
        let _ = ask::<Face>(|out| lipz_clip_face_at(dialogue, clip, time, who, Some(&profile), look, out));
        let _ = ask::<Face>(|out| lipz_face_idle_at(dialogue, time, number.into(), Some(&profile), look, out));
        let mouth = ask(|out| lipz_clip_articulation_at(dialogue, clip, time, Some(&articulation), out));
        let mouth: Articulation = mouth
            .unwrap_or(Articulation { thousandths: [u16::try_from(number & 0xFFFF).unwrap(); LIPZ_ARTICULATOR_COUNT] });
        let emotions = Emotions { thousandths: [number as i32; LIPZ_EMOTION_COUNT], ..Emotions::default() };
        let face = Face { blink: number as i32, brows: i32::MIN, shrug: i32::MAX, ..Face::default() };
        let mut weights = [0; 20];
        let (count, feel) = ((number % 20) as usize, Some(&emotions));
        let _ = lipz_rig_weights(dialogue, Some(&rig), Some(&mouth), feel, Some(&face), weights.as_mut_ptr(), count);
        let _ = ask::<String>(|out| lipz_rig_weight_name(dialogue, Some(&rig), number, out));
        let _ = ask::<Weights>(|out| lipz_babble_at(dialogue, Some(&babble), time, f32::from_bits(number), out));
        let _ = ask::<Weights>(|out| lipz_babble_at_level(dialogue, Some(&babble), time, number, out));
        let found = ask(|out| lipz_clip_curve_by_index(dialogue, clip, number % 9, out));
        let mut curve: Curve = found.unwrap_or_default();
        if number % 2 == 0 {
            curve.place = number;
        }
        let mut cursor = CurveCursor { key: number.rotate_left(9) };
        let _ = ask::<Curve>(|out| lipz_clip_curve(dialogue, clip, c"joy".as_ptr(), 3, out));
        let _ = ask::<CurveKey>(|out| lipz_curve_key(dialogue, Some(&curve), number, out));
        let _ = ask::<i32>(|out| lipz_curve_value(dialogue, Some(&curve), number, out));
        let _ = ask::<i32>(|out| lipz_curve_value_at(dialogue, Some(&curve), time, Some(&mut cursor), out));
    }
}

/// Plays with a cursor of random numbers.
fn every_move(of_c: &Dialogue, clip: &Clip, times: [Time; 4], random: &mut Random) {
    let dialogue = Some(of_c);
    let mut number = || random.next() >> (random.next() % 32);
    let mut cursor = Cursor {
        size_bytes: u32::try_from(size_of::<Cursor>()).unwrap(),
        frame: number(),
        clip_id: clip.id,
        fps_numerator: number(),
        fps_denominator: number() % 7,
        viseme_type: number() % 5,
        lead_us: number(),
        hold_frames: number() % 300,
        speaker_id: number() % 3,
        speaker_bank: number(),
        mouth_frame: number(),
        next_segment: number() % 17,
        flags: number(),
        due_segment: number() % 13,
        due_end: number(),
        due_around_to: number(),
        due_event: number() % 3,
    };
    for (step, time) in times.into_iter().enumerate() {
        unsafe {
            let moving = Some(&mut cursor);
            let _ = match step {
                0 => lipz_cursor_advance(dialogue, moving, time),
                1 => lipz_cursor_loop(dialogue, moving, time),
                2 => lipz_cursor_seek(dialogue, moving, time),
                _ => lipz_cursor_finish(dialogue, moving),
            };
            let (mut segments, mut taken) = (cursor, 0);
            while ask::<Segment>(|out| lipz_cursor_take_segment(dialogue, Some(&mut segments), out)).is_ok() {
                taken += 1;
            }
            while ask::<Event>(|out| lipz_cursor_take_event(dialogue, Some(&mut cursor), out)).is_ok() {
                taken += 1;
            }
            assert!(taken < 1 << 20);
            let at = Some(&cursor);
            let _ = ask::<Viseme>(|out| lipz_cursor_viseme(dialogue, at, out));
            let _ = ask::<u32>(|out| lipz_cursor_openness(dialogue, at, out));
            let _ = ask::<Segment>(|out| lipz_cursor_segment(dialogue, at, out));
            let _ = ask::<Character>(|out| lipz_cursor_character(dialogue, at, None, out));
            let name = Name { bank: cursor.speaker_bank, id: cursor.speaker_id, ..Name::default() };
            let _ = ask::<Character>(|out| lipz_cursor_character(dialogue, at, Some(&name), out));
            let _ = ask::<Character>(|out| lipz_cursor_character_by_index(dialogue, at, cursor.due_event, out));
        }
    }
}
