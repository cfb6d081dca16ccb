//! Every public function of the reader, asked with what the bank itself says: rates, indices and names of bytes that
//! were opened and not verified. No size is counted here; that it links is the proof that none of them can panic.
//!
//! It is not part of firmware/size, because a function that is called twice there is no longer inlined.
//! A test (`crates/lipz-testkit/tests/every_function.rs`) looks for the functions that are missing.

#![no_std]

use core::panic::PanicInfo;
use lipz_bank::{
    Babble, Bank, BankSet, BankSetError, Clip, ClipId, Command, ConsonantHold, Cursor, CurveCursor, CurveValue, Emotion, Error, Event, EventName,
    Face, FaceCurve, FaceProfile, Fps, Layers, LayersError, Lead, Locale, LookAt, Micros, Places, Samples, Seconds, Segment,
    SetIndex, Spoken, TextBank, Time, Viseme, VisemeType, VoiceLevel, Weight, Who,
};

/// Takes what was answered, so that no question is left out as useless.
type See = fn(u64);

fn see_bytes(see: See, bytes: &[u8]) {
    see(bytes.len() as u64);
    bytes.iter().for_each(|byte| see(u64::from(*byte)));
}

fn see_error(see: See, error: Error) {
    see_bytes(see, error.kind().message().as_bytes());
    see(u64::from(error.kind().number()) << 32 | u64::from(error.offset_bytes()));
}

/// Asks two files everything, before and after they are verified.
#[no_mangle]
fn proof_every_function(bytes: &[u8], texts: &[u8], name: &str, number: u32, see: See) {
    let bank = match Bank::open(bytes) {
        Ok(bank) => bank,
        Err(error) => return see_error(see, error),
    };
    bank_asked(&bank, name, number, see);
    if let Ok(places) = Places::find(bytes) {
        let mut words = places.to_words();
        words[2] ^= number;
        if let Some(bank) = Bank::open_at(bytes, &Places::from_words(words)) {
            bank_asked(&bank, name, number, see);
        }
    }
    if let Ok(above) = Bank::open(texts) {
        layers_asked([bank, above], name, see);
        banks_asked(&[bank, above], name, see);
        index_asked(texts, &[bank, above], name, see);
    }
    match bank.open_texts(texts) {
        Ok(texts) => texts_asked(&bank, &texts, name, see),
        Err(error) => see_error(see, error),
    }
    if let Err(error) = bank.verify_tables() {
        see_error(see, error);
    }
    match bank.verify_lines().and_then(Bank::verify).and_then(|bank| bank.verify_with(|bytes| core::str::from_utf8(bytes).ok())) {
        Ok(bank) => bank_asked(&bank, name, number, see),
        Err(error) => see_error(see, error),
    }
}

fn bank_asked(bank: &Bank<'_>, name: &str, number: u32, see: See) {
    see(bank.clip_count() as u64 ^ bank.fingerprint() ^ bank.checksum() ^ bank.length_bytes() as u64);
    let (major, minor) = bank.format_version();
    see(u64::from(major) << 16 | u64::from(minor) | u64::from(bank.is_verified()) << 32);
    bank.sections().for_each(|(tag, contents)| see_bytes(see, if tag == *b"CLIP" { contents } else { &[] }));
    for locale in bank.locales().chain(bank.locale(name)).chain(bank.default_locale()) {
        see(u64::from(locale.is_default()) | u64::from(locale.is_of(bank)) << 1);
        see_bytes(see, locale.tag().as_bytes());
    }
    for voice in bank.voices().chain(bank.voice(name)) {
        see(u64::from(voice.is_original()) | u64::from(voice.is_of(bank)) << 1);
        see_bytes(see, voice.tag().as_bytes());
    }
    for babble in bank.babbles().chain(bank.babble(name)).chain([bank.default_babble()]) {
        babble_asked(&babble, number, see);
    }
    for profile in bank.face_profiles().chain(bank.face_profile(name)).chain([bank.default_face_profile()]) {
        profile_asked(&profile, name, number, see);
    }
    let named = bank.event_name(name).or(bank.event_name_at(number));
    let id = ClipId::from_u64(u64::from(number) ^ ClipId::from_key(name).get());
    let found = [bank.clip(id), bank.clip_by_key(name), bank.clip_at(number)];
    for clip in bank.clips().chain(bank.clips_under(name)).chain(IntoIterator::into_iter(found).flatten()) {
        clip_asked(bank, &clip, number, see);
        see_face(see, clip.face_at(Micros(i64::from(number)), &bank.default_face_profile(), look(number)));
        see_face(see, clip.generated_at(Micros(i64::from(number)), &bank.default_face_profile(), look(number)));
        see_face(see, clip.generated_of(name, Micros(i64::from(number)), &bank.default_face_profile(), look(number)));
        for who in [Who::from("amy"), Who::SpeakerNamed("amy")] {
            let now = Micros(i64::from(number));
            see_face(see, clip.face_of(who, now, &bank.default_face_profile(), look(number)));
        }
        play(&clip, named, number, see);
        // A rate of the program's own.
        if let Some(fps) = Fps::new(number, number >> 5) {
            play(&clip.or_fps(fps).or_viseme_type(VisemeType::Blair), named, number, see);
        }
    }
}

fn layers_asked(banks: [Bank<'_>; 2], name: &str, see: See) {
    if let Ok(Some(layer)) = banks[1].verified_layer().map(|layer| layer.or_else(|| banks[0].layer())) {
        layer.made_over().chain(layer.removed_clips().map(ClipId::get)).for_each(see);
        layer.removed_locales().for_each(|tag| see_bytes(see, tag.as_bytes()));
        let number = name.len() as u32;
        let (has_clip, has_texts) = layer.parts(number);
        see(u64::from(has_clip) | u64::from(has_texts) << 1 | u64::from(layer.has_babble()) << 2);
        see(u64::from(layer.has_default_locale()) | u64::from(layer.removes_locale(name)) << 1);
        see(u64::from(layer.may_have(ClipId::from_key(name))));
        see(u64::from(layer.has_faces()) | u64::from(layer.has_voices()) << 1);
        see(u64::from(layer.has_texts_of_original(number)) | u64::from(layer.borrows(number, name.len())) << 1);
        see(layer.dub_count() as u64);
        see(u64::from(layer.removes(ClipId::from_key(name))) | layer.stand_in(name.len()).unwrap_or(0) as u64);
    }
    let layers = match Layers::new(banks).or_else(|_| Layers::<2>::from_slice(&banks[..1])) {
        Ok(layers) => layers,
        Err(error) => {
            let error = LayersError::new(error.layer(), error.error());
            see(error.layer() as u64);
            return see_error(see, error.error());
        }
    };
    see(layers.layer_count() as u64 ^ layers.bank(1).map_or(0, Bank::checksum));
    layers.locale_tags().chain(layers.default_locale()).for_each(|tag| see_bytes(see, tag.as_bytes()));
    for babble in layers.babble(name).iter().chain([&layers.default_babble()]) {
        see_bytes(see, babble.name().as_bytes());
    }
    for profile in layers.face_profile(name).iter().chain([&layers.default_face_profile()]) {
        see_bytes(see, profile.name().as_bytes());
    }
    see(layers.of_babble().map_or(0, Bank::checksum) ^ layers.of_faces().map_or(0, Bank::checksum));
    lipz_bank::voice_tags(&layers).for_each(|tag| see_bytes(see, tag.as_bytes()));
    see(lipz_bank::original_of(&layers, ClipId::from_key(name)).map_or(0, |(tag, id)| id.get() ^ tag.len() as u64));
    see(lipz_bank::played_in(&layers, ClipId::from_key(name), name).map_or(0, |(id, _)| id.get()));
    let locale = layers.locale(name).or_else(|| layers.locale_in(name, &[]));
    let named = layers.event_name(name);
    let found = [layers.clip(ClipId::from_key(name)), layers.clip_by_key(name)];
    for clip in layers.clips().chain(layers.clips_under(name)).chain(IntoIterator::into_iter(found).flatten()) {
        see_bytes(see, clip.clip().key().as_bytes());
        see(clip.layer() as u64 ^ clip.texts_layer().unwrap_or(0) as u64);
        see(clip.texts().map_or(0, |texts| u64::from(texts.slot())));
        see(named.and_then(|name| name.of(&clip)).map_or(0, |name| u64::from(name.id())));
        if let Some(locale) = &locale {
            see_bytes(see, locale.tag().as_bytes());
            see_bytes(see, locale.tag_in(clip.layer()).unwrap_or("").as_bytes());
            see_bytes(see, clip.text_bytes(0, locale).unwrap_or(&[]));
            see_bytes(see, clip.text(0, locale).map_or("", |text| text.as_str()).as_bytes());
        }
    }
}

fn index_asked<'data>(bytes: &'data [u8], banks: &[Bank<'data>], name: &str, see: See) {
    let index = match SetIndex::open(bytes).and_then(SetIndex::verify).or_else(|_| SetIndex::open(bytes)) {
        Ok(index) => index,
        Err(error) => return see_error(see, error),
    };
    see(index.fingerprint() ^ index.checksum() ^ index.clip_count() ^ index.length_bytes() as u64);
    see((index.bank_count() ^ index.moved_count() ^ index.bank_of(ClipId::from_key(name))) as u64);
    for bank in index.banks().chain(index.bank_at(name.len())) {
        see_bytes(see, bank.file_name.as_bytes());
    }
    match BankSet::with_index(banks, &index) {
        Ok(set) => set_asked(set, name, see),
        Err(_) => see(0),
    }
}

fn banks_asked(banks: &[Bank<'_>], name: &str, see: See) {
    let set = match BankSet::new(banks).and_then(BankSet::verify).or_else(|_| BankSet::new(banks)) {
        Ok(set) => set,
        Err(BankSetError::OtherShard { bank }) => return see(bank as u64),
        Err(_) => return,
    };
    set_asked(set, name, see);
}

fn set_asked(set: BankSet<'_, '_>, name: &str, see: See) {
    let id = ClipId::from_key(name);
    see(set.clip_count() as u64 ^ set.banks().len() as u64 ^ set.bank_of(id).map_or(0, Bank::checksum));
    let locale = set.locale(name).or_else(|| set.default_locale());
    let named = set.event_name(name);
    let found = [set.clip(id), set.clip_by_key(name)];
    for clip in set.clips().chain(set.clips_under(name)).chain(IntoIterator::into_iter(found).flatten()) {
        see_bytes(see, clip.key().as_bytes());
        see(named.and_then(|name| name.of(&clip)).map_or(0, |name| u64::from(name.id())));
        if let Some(voice) = set.voice(name) {
            see_bytes(see, voice.tag().as_bytes());
            see(u64::from(voice.of(&clip).is_some()));
        }
        if let Some(locale) = locale {
            see_bytes(see, locale.tag().as_bytes());
            see(u64::from(locale.of(&clip).is_some()));
        }
    }
}

fn texts_asked(bank: &Bank<'_>, texts: &TextBank<'_>, name: &str, see: See) {
    see(texts.length_bytes() as u64 ^ texts.checksum());
    texts.sections().for_each(|(_, contents)| see_bytes(see, contents));
    for locale in texts.locales().chain(texts.locale(name)) {
        see_bytes(see, locale.tag().as_bytes());
    }
    let verified = texts.verify(bank);
    let verified = verified.and_then(|texts| texts.verify_with(bank, |bytes| core::str::from_utf8(bytes).ok()));
    if let Err(error) = verified {
        see_error(see, error);
    }
}

fn babble_asked(babble: &Babble<'_>, number: u32, see: See) {
    see_bytes(see, babble.name().as_bytes());
    for digits in [babble.ooh(), babble.aah(), babble.ooh_power_transfer(), babble.aah_power_transfer()] {
        see_bytes(see, digits);
    }
    fps_asked(babble.rate(), number, see);
    let time = Micros(i64::from(number));
    let weights = [
        babble.at(time, VoiceLevel(number as u16)),
        babble.at(time, number as f32),
        babble.at(time, || VoiceLevel::UNMEASURED),
    ];
    for weights in weights {
        see(u64::from(weights.ooh.ten_thousandths()) ^ u64::from(weights.aah.to_f32().to_bits()));
    }
}

fn profile_asked(profile: &FaceProfile<'_>, name: &str, number: u32, see: See) {
    see_bytes(see, profile.name().as_bytes());
    let leads = Emotion::from_name(name);
    see(u64::from(profile.blink_interval_ms(leads)) ^ u64::from(profile.blink_length_ms()));
    see(u64::from(profile.double_blink_percent()) ^ u64::from(profile.glance_percent()));
    see(u64::from(profile.head_motion_thousandths()) ^ u64::from(profile.head_follows_thousandths()));
    see(u64::from(profile.pose_ms()) ^ u64::from(profile.fixation_ms()));
    see_bytes(see, FaceCurve::from_name(name).map_or("", FaceCurve::name).as_bytes());
    see_face(see, profile.idle_at(Micros(i64::from(number)), u64::from(number), look(number)));
}

/// Somebody, or something, in a direction of which nothing is known.
fn look(number: u32) -> LookAt {
    let angle = CurveValue::from_thousandths(number as i32);
    if number & 1 == 0 { LookAt::person(angle, angle) } else { LookAt::point(angle, angle) }
}

fn see_face(see: See, face: Face) {
    let angles = [face.head_pitch, face.head_yaw, face.head_roll, face.eye_pitch, face.eye_yaw];
    let others = [face.blink, face.brows, face.shrug, face.breath];
    angles.iter().chain(&others).for_each(|value| see(value.thousandths() as u64));
}

fn fps_asked(fps: Fps, number: u32, see: See) {
    see(u64::from(fps.numerator()) << 32 | u64::from(fps.denominator()));
    see(fps.frames_per_micro_q64() ^ fps.to_f64().to_bits() ^ fps.start_of_frame_us(number));
    see(u64::from(fps.frame_at(Micros(i64::from(number))).unwrap_or(0)));
    for lead in [Lead::one_frame(fps), Lead::two_frames(fps), Lead::micros(number)] {
        see(u64::from(lead.us()));
    }
    let holds =
        [ConsonantHold::readable(fps), ConsonantHold::for_display(number, fps), ConsonantHold::frames(number as u8)];
    see(u64::from(holds[0] == holds[1]) | u64::from(holds[1] < holds[2]) | u64::from(holds[0].frame_count()) << 8);
}

fn clip_asked(bank: &Bank<'_>, clip: &Clip<'_, '_>, number: u32, see: See) {
    see_bytes(see, clip.key().as_bytes());
    see_bytes(see, clip.frames());
    see(clip.id().get() ^ u64::from(clip.slot()) ^ clip.duration_us().unwrap_or(0));
    see(u64::from(clip.has_visemes()) | u64::from(clip.has_events()) << 1);
    if let Some(kind) = clip.viseme_type() {
        see(u64::from(kind.contains_all(clip.frames())) | u64::from(kind.contains(number as u8)) << 1);
        see_bytes(see, kind.name().as_bytes());
        see_bytes(see, kind.codes().as_bytes());
    }
    curves_asked(bank, clip, number, see);
    see(clip.original().map_or(0, |original| u64::from(original.slot())));
    for voice in bank.voices().chain(clip.voice()) {
        let voiced = clip.in_voice(voice);
        see(u64::from(voiced.clip.slot()) << 1 | u64::from(voiced.spoken == Spoken::Dub));
    }
    see(clip.recording().map_or(0, |recording| recording.length_us() ^ recording.content_hash()));
    see(VisemeType::from_number(number as u8).map_or(0, |kind| kind as u64));
    if let Some(fps) = clip.fps() {
        fps_asked(fps, number, see);
    }
    for frame in [0, clip.frame_count(), number] {
        viseme_asked(clip, clip.viseme(frame), see);
        see(clip.segment_of_frame(frame).map_or(0, |segment| u64::from(segment.index())));
    }
    let seconds = number as f32;
    time_asked(clip, Micros(i64::from(number)), see);
    time_asked(clip, Samples { position: i64::from(number), rate_hz: number }, see);
    time_asked(clip, core::time::Duration::from_micros(u64::from(number)), see);
    time_asked(clip, Seconds(seconds), see);
    time_asked(clip, Seconds(f64::from(seconds)), see);
    for segment in clip.segments().chain(clip.segment(clip.segment_count().wrapping_sub(1))) {
        segment_asked(bank, &segment, see);
    }
}

fn curves_asked(bank: &Bank<'_>, clip: &Clip<'_, '_>, number: u32, see: See) {
    let mut cursor = CurveCursor::new();
    let emotions = clip.emotions_at(Micros(i64::from(number)));
    let strongest = emotions.strongest().map(|(emotion, _)| emotion);
    for emotion in strongest.into_iter().chain(Emotion::from_name("joy")) {
        see_bytes(see, emotion.name().as_bytes());
        see(emotions.get(emotion).thousandths() as u64);
    }
    see(emotions.sum().thousandths() as u64 ^ emotions.iter().count() as u64);
    for who in [Who::from("amy"), Who::SpeakerNamed("amy")] {
        see(clip.emotions_of(who, Micros(i64::from(number))).sum().thousandths() as u64);
    }
    let named = bank.event_name("joy").and_then(|name| clip.curve_named(name));
    for curve in clip.curves().chain(clip.curve("anger")).chain(named) {
        see_bytes(see, curve.name().as_str().as_bytes());
        cursor = CurveCursor::from_word(cursor.to_word() ^ number);
        see(clip.curve_in_place(curve.place()).map_or(0, |same| u64::from(same.key_count())));
        see(u64::from(curve.key_count()) | curve.key(number).map_or(0, |key| u64::from(key.frame)));
        let value_see = |value: CurveValue| see(value.thousandths() as u64 ^ u64::from(value.to_f32().to_bits()));
        curve.keys().for_each(|key| value_see(key.value));
        value_see(curve.value(number).towards(CurveValue::from_thousandths(number as i32), u64::from(number), 1 << 33));
        value_see(cursor.value(&curve, number));
        let seconds = Seconds(number as f32);
        let times =
            [curve.value_at(Micros(i64::from(number))), curve.value_at(seconds), cursor.value_at(&curve, seconds)];
        times.iter().flatten().for_each(|value| value_see(*value));
        let samples = Samples { position: i64::from(number), rate_hz: number };
        curve.value_at(samples).into_iter().for_each(value_see);
        curve.value_at(core::time::Duration::from_micros(u64::from(number))).into_iter().for_each(value_see);
    }
}

fn viseme_asked(clip: &Clip<'_, '_>, viseme: Viseme, see: See) {
    let weight = clip.viseme_type().map(|kind| Viseme::from_code(viseme.code()).openness(kind));
    see(u64::from(viseme.to_char()) | u64::from(viseme.is_rest()) << 32);
    let weights =
        [weight.unwrap_or_default(), Weight::from_digit(viseme.code()), Weight::from_digits(b'9', viseme.code())];
    weights.iter().for_each(|weight| see(u64::from(weight.ten_thousandths())));
}

fn time_asked(clip: &Clip<'_, '_>, time: impl Time, see: See) {
    viseme_asked(clip, clip.viseme_at(time), see);
    see(u64::from(clip.frame_at(time).unwrap_or(0)));
    see(clip.segment_at(time).map_or(0, |segment| u64::from(segment.clip().slot())));
    let open = clip.openness_at(time).map_or(0, |weight| weight.ten_thousandths());
    let babbled = clip.openness_or_babble(time, &Babble::DEFAULT, VoiceLevel::UNMEASURED);
    see(u64::from(open ^ babbled.ten_thousandths()));
}

fn segment_asked(bank: &Bank<'_>, segment: &Segment<'_, '_>, see: See) {
    see(u64::from(segment.start_frame()) << 32 | u64::from(segment.end_frame()));
    see(segment.start_us().unwrap_or(0) ^ segment.end_us().unwrap_or(0));
    see_bytes(see, segment.frames());
    see_bytes(see, segment.event().unwrap_or("").as_bytes());
    segment.events().for_each(|event| event_asked(bank, event, see));
    bank.locales().for_each(|locale: Locale<'_>| {
        see_bytes(see, segment.text_bytes(locale).unwrap_or(&[]));
        see(segment.has_own_text(locale).into());
        if let Some(text) = segment.text(locale) {
            see_bytes(see, text.as_str().as_bytes());
            see(u64::from(text.is_fallback()));
        }
    });
}

fn event_asked(bank: &Bank<'_>, event: Event<'_>, see: See) {
    let command: Command<EventName<'_>> = event.command;
    see_bytes(see, command.verb().as_bytes());
    for name in [event.character, command.object()].iter().flatten() {
        see(u64::from(name.id()) | u64::from(name.is_of(bank)) << 32);
        see_bytes(see, name.as_str().as_bytes());
    }
}

fn play(clip: &Clip<'_, '_>, speaker: Option<EventName<'_>>, number: u32, see: See) {
    let (cursor, fps) = match (Cursor::new(clip), clip.fps()) {
        (Some(cursor), Some(fps)) => (cursor, fps),
        _ => return,
    };
    let mut cursor = cursor.with_speaker(speaker).with_lead(Lead::two_frames(fps)).with_words([number; 4]);
    cursor = cursor.with_hold(ConsonantHold::readable(fps));
    let time = Micros(i64::from(number));
    for step in 0..4 {
        let due = match step {
            0 => cursor.advance_to(clip, time),
            1 => cursor.loop_to(clip, time),
            2 => cursor.finish(clip),
            _ => {
                cursor.seek(clip, time);
                cursor.advance_to(clip, time)
            }
        };
        let mut characters = 0;
        for event in due.events() {
            let mut state = cursor.state(clip, event.character);
            state.apply(event.command);
            characters ^= state.emotion.map_or(0, EventName::id);
        }
        for (_, state) in cursor.characters(clip) {
            characters ^= state.stares_at.map_or(0, EventName::id);
        }
        viseme_asked(clip, cursor.viseme(clip), see);
        cursor.to_words().iter().for_each(|word| see(u64::from(*word)));
        see(u64::from(characters) | u64::from(cursor.is_over()) << 32);
        see(u64::from(cursor.frame().unwrap_or(0)) ^ cursor.segment(clip).map_or(0, |segment| segment.index().into()));
    }
}

extern "C" {
    /// Nobody defines it: what reaches it does not link.
    fn panic_is_reachable() -> !;
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    // SAFETY: it is never linked.
    unsafe { panic_is_reachable() }
}
