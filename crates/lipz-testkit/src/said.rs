//! Passes the rates, visemes and events of a bank, damaged or not, to the functions that take such values.

use lipz_bank::articulation::{ArticulationProfile, Articulator, Phone, Rig};
use lipz_bank::babble::{Babble, VoiceLevel, Weight};
use lipz_bank::curve::{CurveCursor, CurveValue};
use lipz_bank::face::{Emotion, FaceCurve, FaceProfile, LookAt, Who};
use lipz_bank::playback::{ConsonantHold, Lead};
use lipz_bank::{Bank, Clip, ClipId, Event, EventName, Fps, Micros, Time, Viseme, VisemeType, Voice};
use std::hint::black_box;

/// Keys of variants, some of which no file can have.
pub(crate) const VARIANTS: [&str; 6] = ["few", "few-fem", "many-fem", "", "--", "żona-"];

/// Calls every function of a frame rate, and every function with a frame rate as an argument.
fn of_fps(fps: Fps) {
    let again = Fps::new(fps.numerator(), fps.denominator());
    assert_eq!(again, Some(fps), "a rate that is not valid");
    assert_eq!(again.map(Fps::frames_per_micro_q64), Some(fps.frames_per_micro_q64()));
    black_box((fps.to_f64(), fps.start_of_frame_us(u32::MAX), fps.frame_at(Micros(i64::MAX))));
    for lead in [Lead::one_frame(fps), Lead::two_frames(fps), Lead::micros(u32::MAX)] {
        black_box(lead.us());
    }
    for picture_us in [0, 16_667, u32::MAX] {
        black_box(ConsonantHold::for_display(picture_us, fps));
    }
    black_box((ConsonantHold::readable(fps), ConsonantHold::frames(u8::MAX)));
}

/// Makes the queries of a clip about visemes and babble.
pub(crate) fn of_clip(clip: &Clip<'_>) {
    if let Some(fps) = clip.fps() {
        of_fps(fps);
    }
    black_box(clip.recording().map(|recording| (recording.length_us(), recording.content_hash())));
    let Some(kind) = clip.viseme_type() else { return };
    assert_eq!(VisemeType::from_number(kind as u8), Some(kind));
    let codes = clip.frames();
    assert_eq!(kind.contains_all(codes), codes.iter().all(|&code| kind.contains(code)));
    assert_eq!((kind.name().parse(), kind.contains_all(kind.codes().as_bytes())), (Ok(kind), true));
}

/// Makes the queries of a clip's curves. A cursor returns the same values as a search.
pub(crate) fn of_curves(clip: &Clip<'_>, limit: usize) {
    let curves = clip.curves();
    let most = curves.size_hint().1.unwrap_or(usize::MAX);
    let curves: Vec<_> = curves.take(limit + 1).collect();
    assert!(curves.len() <= most.min(limit));
    let mut cursor = CurveCursor::new();
    for curve in &curves {
        black_box((clip.curve(curve.name().as_str()), curve.name().to_words()));
        assert!(curve.keys().take(limit + 1).count() <= limit.min(curve.key_count() as usize));
        assert!(clip.curve_in_place(curve.place()).as_ref() == Some(curve), "the place of a curve leads to it");
        assert_eq!(CurveCursor::from_word(cursor.to_word()), cursor);
        black_box(CurveCursor::from_word(u32::MAX).value(curve, 7));
        black_box((curve.key(u32::MAX), curve.value(u32::MAX), cursor.value(curve, 7)));
        for time in [-1, 0, 41_667, 3_600_000_000, 100_000, i64::MAX] {
            let value = curve.value_at(Micros(time));
            assert!(value.is_some() || clip.fps().is_none());
            black_box((cursor.value_at(curve, Micros(time)), value.map(CurveValue::to_f32)));
        }
    }
    for time in [-1, 0, 500_000, i64::MAX] {
        let emotions = clip.emotions_at(Micros(time), Who::Speaker);
        let most = emotions.strongest().map(|(emotion, value)| (Emotion::from_name(emotion.name()), value));
        assert!(most.is_none_or(|(emotion, value)| emotion.is_some_and(|emotion| emotions.get(emotion) == value)));
        black_box((emotions.sum(), emotions.iter().count(), clip.emotions_at(Micros(time), "amy").strongest()));
        let named =
            [Who::Speaker, Who::SpeakerNamed("amy"), Who::Other("")].map(|who| clip.emotions_at(Micros(time), who));
        assert_eq!(named[0], emotions);
        black_box(named);
    }
    black_box((clip.curve_in_place(u32::MAX), clip.curves().nth(usize::MAX), clip.curves().nth(1)));
    let named = curves.first().and_then(|curve| clip.curve(curve.name()));
    let way = |value: CurveValue| value.towards(CurveValue::from_thousandths(i32::MIN), 1, 3).thousandths();
    black_box((clip.curve("joy"), named.map(|curve| way(curve.value(0)))));
}

/// Makes the queries of the mouth at a time.
pub(crate) fn of_mouth(clip: &Clip<'_>, time: impl Time) {
    let shape = Viseme::from_code(clip.viseme_at(time).code());
    black_box((shape.to_char(), shape.is_rest(), VisemeType::ALL.map(|kind| shape.openness(kind))));
    black_box((Weight::from_digit(shape.code()), Weight::from_digits(shape.code(), b'9').ten_thousandths()));
    let open = clip.openness_or_babble(time, &Babble::DEFAULT, VoiceLevel::UNMEASURED);
    assert!((0.0..1.0).contains(&open.to_f32()) && clip.openness_at(time).is_none_or(|own| own == open));
}

/// Makes the queries of the babble profiles.
pub(crate) fn of_babble(bank: &Bank<'_>, limit: usize) {
    let babbles: Vec<Babble<'_>> = bank.babbles().take(limit + 1).collect();
    assert!(babbles.len() <= limit);
    for babble in babbles.iter().chain([&bank.default_babble()]) {
        of_fps(babble.rate());
        black_box(bank.babble(babble.name()).is_some());
        black_box((babble.ooh(), babble.aah(), babble.ooh_power_transfer(), babble.aah_power_transfer()));
        for time in [-1, 0, 41_667, i64::MAX] {
            let weights = babble.at(Micros(time), || 0.5);
            assert!(weights.ooh.ten_thousandths() < 10_000 && weights.aah.to_f32() < 1.0);
        }
    }
}

/// Makes the queries of the face profiles, and of their faces. Returns whether there are any.
pub(crate) fn of_faces(bank: &Bank<'_>, limit: usize) -> bool {
    let profiles: Vec<FaceProfile<'_>> = bank.face_profiles().take(limit + 1).collect();
    assert!(profiles.len() <= limit);
    black_box(bank.default_face_profile());
    for profile in &profiles {
        black_box((bank.face_profile(profile.name()).is_some(), profile.blink_length_ms(), profile.pose_ms()));
        black_box((profile.double_blink_percent(), profile.glance_percent(), profile.fixation_ms()));
        black_box((profile.head_motion_thousandths(), profile.head_follows_thousandths()));
        let blinks = Emotion::ALL.map(|emotion| profile.blink_interval_ms(Some(emotion)));
        black_box((blinks, profile.blink_interval_ms(None)));
        for time in [-1, 0, 41_667, i64::MAX] {
            let far = CurveValue::from_thousandths(i32::MAX);
            black_box(profile.idle_at(Micros(time), u64::MAX, LookAt::point(far, far)));
            let face = profile.idle_at(Micros(time), 0, LookAt::AHEAD);
            assert!((0..=1000).contains(&face.blink.thousandths()));
        }
    }
    !profiles.is_empty()
}

/// Makes the queries of the face at a time.
pub(crate) fn of_face(clip: &Clip<'_>, profile: &FaceProfile<'_>, time: impl Time) {
    for (curve, name) in FaceCurve::ALL.iter().map(|curve| (curve, curve.name())) {
        assert_eq!(FaceCurve::from_name(name), Some(*curve));
    }
    let low = CurveValue::from_thousandths(i32::MIN);
    for profile in [*profile, profile.without_curves()] {
        black_box(clip.face_at(time, Who::Speaker, &profile, LookAt::person(low, low)));
        let named = [Who::from("amy"), Who::SpeakerNamed("amy")];
        black_box(named.map(|who| clip.face_at(time, who, &profile, LookAt::AHEAD)));
    }
}

/// Makes the queries of articulation profiles and rigs. Returns whether there are any.
pub(crate) fn of_articulations(bank: &Bank<'_>, limit: usize) -> bool {
    let profiles: Vec<ArticulationProfile<'_>> = bank.articulations().take(limit + 1).collect();
    let rigs: Vec<Rig<'_>> = bank.rigs().take(limit + 1).collect();
    assert!(profiles.len() <= limit && rigs.len() <= limit);
    for profile in &profiles {
        black_box((bank.articulation(profile.name()).is_some(), profile.gain_percent(), profile.jaw_percent()));
        black_box((profile.lead_ms(), profile.level_db()));
    }
    for rig in &rigs {
        assert!(rig.weight_names().count() == rig.weight_count() && rig.weight_count() <= limit);
        black_box((bank.rig(rig.name()).is_some(), rig.weight_name(usize::MAX)));
    }
    !profiles.is_empty() || !rigs.is_empty()
}

/// Makes the queries of the phones and of the articulation at a time.
pub(crate) fn of_articulation(bank: &Bank<'_>, clip: &Clip<'_>, time: impl Time, limit: usize) {
    let phones = clip.phones();
    let spans = phones.iter().take(limit + 1).map(|span| black_box((span.phone(), span.start_ms, span.end_ms)));
    let names = Phone::all().map(|phone| black_box((phone.ipa(), phone.arpabet(), phone.name(), phone.number())).3);
    assert!(names.eq(0..Phone::COUNT as u8));
    assert!(spans.count() <= limit && phones.is_empty() == (phones.count() == 0));
    black_box((phones.level_db(), phones.are_certain(), phones.get(u32::MAX), phones.to_string()));
    for profile in bank.articulations().chain([bank.default_articulation()]) {
        let mouth = clip.articulation_at(time, &profile);
        for (value, articulator) in mouth.values().iter().zip(Articulator::ALL) {
            // The shapes of an unverified profile may be out of range.
            assert!(*value <= 1000 || !bank.is_verified(), "{}", articulator.name());
            assert_eq!(*value, mouth.thousandths(articulator), "{}", articulator.name());
        }
        let emotions = clip.emotions_at(time, Who::Speaker);
        let face = clip.face_at(time, Who::Speaker, &bank.default_face_profile(), LookAt::AHEAD);
        let mut weights = [CurveValue::default(); 8];
        bank.rigs().for_each(|rig| rig.weights(&mouth, &emotions, &face, &mut weights));
        black_box(weights);
    }
}

/// Makes the queries of events.
pub(crate) fn of_events<'data>(events: impl Iterator<Item = Event<'data>>) {
    let mut state = lipz_bank::playback::CharacterState::default();
    for event in events.take(1000) {
        state.apply(event.command);
        black_box((event.command.verb(), event.command.object().map(EventName::as_str), event.command.amount()));
    }
    black_box((state, ClipId::from_key("a").get()));
}

/// Makes the queries of a bank's voices.
pub(crate) fn of_voices(bank: &Bank<'_>, limit: usize) -> Vec<Voice> {
    let voices: Vec<Voice> = bank.voices().take(limit + 1).collect();
    assert!(voices.len() <= limit);
    for voice in &voices {
        assert_eq!(Voice::from_words(voice.to_words()), *voice);
        black_box((bank.voice(bank.voice_tag(*voice)).is_some(), voice.is_original()));
    }
    voices
}

/// Makes the queries of a clip in each of these voices.
pub(crate) fn of_dubs(clip: &Clip<'_>, voices: &[Voice]) {
    black_box((clip.voice(), clip.original().map(|original| original.slot())));
    for voice in voices {
        let voiced = clip.in_voice(*voice);
        black_box((voiced.clip.frame_count(), voiced.spoken));
    }
}
