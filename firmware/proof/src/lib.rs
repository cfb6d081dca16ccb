//! Every public function of the reader, asked with what the bank itself says: rates, indices and names of bytes that
//! were opened and not verified. No size is counted here; that it links is the proof that none of them can panic.
//!
//! It is not part of firmware/size, because a function that is called twice there is no longer inlined.
//! A test (`crates/lipz-testkit/tests/every_function.rs`) looks for the functions that are missing.

#![no_std]

use core::hash::{Hash, Hasher};
use core::mem::MaybeUninit;
use core::panic::PanicInfo;
use lipz_bank::babble::{Babble, VoiceLevel, Weight};
use lipz_bank::curve::{CurveCursor, CurveValue};
use lipz_bank::face::{Emotion, Face, FaceCurve, FaceProfile, LookAt, Who};
use lipz_bank::files::{DialogueError, DialogueFile, Files, Layer, SetIndex};
use lipz_bank::playback::{ConsonantHold, Lead};
use lipz_bank::{
    Bank, Clip, ClipId, Command, Cursor, Dialogue, Error, Event, EventName, Fps, Locale, Micros, Samples, Seconds,
    Segment, Spoken, Time, Viseme, VisemeType, Voice,
};

/// Takes what was answered, so that no question is left out as useless.
type See = fn(u64);

/// What clips are asked with.
#[derive(Clone, Copy)]
struct Asked<'a> {
    name: &'a str,
    number: u32,
    locale: Locale,
    voice: Voice,
    named: Option<EventName<'a>>,
    profile: FaceProfile<'a>,
}

fn see_bytes(see: See, bytes: &[u8]) {
    see(bytes.len() as u64);
    bytes.iter().for_each(|byte| see(u64::from(*byte)));
}

fn see_error(see: See, error: Error) {
    see_bytes(see, error.kind().message().as_bytes());
    see(u64::from(error.kind().number()) << 32 | u64::from(error.offset_bytes()));
}

fn see_dialogue_error(see: See, error: DialogueError) {
    let error = DialogueError::new(error.file(), error.error());
    see(error.file() as u64);
    see_error(see, error.error());
}

fn core_utf8(bytes: &[u8]) -> Option<&str> {
    core::str::from_utf8(bytes).ok()
}

/// Asks files everything, before and after they are verified: each as a bank and as the index of a set, two of them as a bank and
/// its texts, and all of them as a dialogue, of which any can be patches, text banks, or the banks of a set.
#[no_mangle]
fn proof_every_function(contents: &[&[u8]], name: &str, number: u32, see: See) {
    let mut before = None;
    for bytes in contents {
        index_asked(bytes, before, name, number, see);
        let bank = match Bank::open(bytes) {
            Ok(bank) => bank,
            Err(error) => {
                see_error(see, error);
                continue;
            }
        };
        bank_asked(&bank, name, number, see);
        texts_asked(bank, before.unwrap_or(bytes), name, number, see);
        before = Some(bytes);
        layers_asked(&bank, name, number, see);
        if let Err(error) = bank.verify_tables() {
            see_error(see, error);
        }
        match bank.verify_lines().and_then(Bank::verify).and_then(|bank| bank.verify_with(core_utf8)) {
            Ok(bank) => bank_asked(&bank, name, number, see),
            Err(error) => see_error(see, error),
        }
    }
    dialogues_asked(contents, name, number, see);
}

fn bank_asked(bank: &Bank<'_>, name: &str, number: u32, see: See) {
    see(bank.clip_count() as u64 ^ bank.fingerprint() ^ bank.checksum() ^ bank.length_bytes() as u64);
    let (major, minor) = bank.format_version();
    see(u64::from(major) << 16 | u64::from(minor) | u64::from(bank.is_verified()) << 32);
    bank.sections().for_each(|(tag, contents)| see_bytes(see, if tag == *b"CLIP" { contents } else { &[] }));
    let mut asked = asked(name, number, bank.event_name(name));
    for locale in bank.locales().chain(bank.locale(name)).chain(bank.default_locale()) {
        see_bytes(see, bank.locale_tag(locale).as_bytes());
        asked.locale = locale;
    }
    for voice in bank.voices().chain(bank.voice(name)) {
        see(u64::from(voice.is_original()));
        see_bytes(see, bank.voice_tag(voice).as_bytes());
        asked.voice = voice;
    }
    for babble in bank.babbles().chain(bank.babble(name)).chain([bank.default_babble()]) {
        babble_asked(&babble, number, see);
    }
    for profile in bank.face_profiles().chain(bank.face_profile(name)).chain([bank.default_face_profile()]) {
        profile_asked(&profile, name, number, see);
        asked.profile = profile;
    }
    let id = ClipId::from_u64(u64::from(number) ^ ClipId::from_key(name).get());
    let found = [bank.clip(id), bank.clip_by_key(name), bank.clip_at(number)];
    for clip in bank.clips().chain(bank.clips_under(name)).chain(IntoIterator::into_iter(found).flatten()) {
        clip_asked(&clip, &asked, see);
    }
}

/// What clips are asked with: handles made of any number.
fn asked<'a>(name: &'a str, number: u32, named: Option<EventName<'a>>) -> Asked<'a> {
    let words = [number, number >> 3];
    let profile = FaceProfile::DEFAULT;
    Asked { name, number, locale: Locale::from_words(words), voice: Voice::from_words(words), named, profile }
}

fn texts_asked(bank: Bank<'_>, texts: &[u8], name: &str, number: u32, see: See) {
    let (mut unverified, mut verified) = (bank, bank);
    let opened = [unverified.open_texts_unverified(texts), verified.open_texts(texts)];
    for (bank, opened) in [unverified, verified].iter().zip(opened) {
        match opened {
            Ok(()) => bank_asked(bank, name, number, see),
            Err(error) => see_error(see, error),
        }
    }
}

fn layers_asked(bank: &Bank<'_>, name: &str, number: u32, see: See) {
    match bank.verified_layer() {
        Ok(layer) => layer.or_else(|| bank.layer()).iter().for_each(|layer| layer_asked(layer, name, number, see)),
        Err(error) => see_error(see, error),
    }
}

fn layer_asked(layer: &Layer<'_>, name: &str, number: u32, see: See) {
    let id = ClipId::from_key(name);
    layer.made_over().chain(layer.removed_clips().map(ClipId::get)).for_each(see);
    layer.removed_locales().chain(layer.voices()).for_each(|tag| see_bytes(see, tag.as_bytes()));
    let (has_clip, has_texts) = layer.parts(number);
    see(u64::from(has_clip) | u64::from(has_texts) << 1 | u64::from(layer.has_babble()) << 2);
    see(u64::from(layer.has_default_locale()) | u64::from(layer.removes_locale(name)) << 1);
    see(u64::from(layer.has_faces()) | u64::from(layer.has_voices()) << 1);
    see(u64::from(layer.has_texts_of_original(number)) | u64::from(layer.borrows(number, name.len())) << 1);
    see(layer.dub_count() as u64 ^ layer.stand_in(name.len()).unwrap_or(0) as u64);
    see(u64::from(layer.removes(id)) | u64::from(layer.may_have(id)) << 1);
}

/// Asks the bytes as the index of a set, of which the bank before them is one.
fn index_asked(bytes: &[u8], bank: Option<&[u8]>, name: &str, number: u32, see: See) {
    let index = match SetIndex::open(bytes).and_then(SetIndex::verify).or_else(|_| SetIndex::open(bytes)) {
        Ok(index) => index,
        Err(error) => return see_error(see, error),
    };
    see(index.fingerprint() ^ index.checksum() ^ index.clip_count() ^ index.length_bytes() as u64);
    see((index.bank_count() ^ index.moved_count() ^ index.bank_of(ClipId::from_key(name))) as u64);
    let bank = bank.and_then(|bytes| Bank::open(bytes).ok());
    for named in index.banks().chain(index.bank_at(number as usize)) {
        see_bytes(see, named.file_name.as_bytes());
        see(u64::from(bank.map_or(false, |bank| named.is_of(&bank))));
    }
    if let Some(bank) = bank {
        let number = number as usize;
        if let Err(error) = index.check_bank(number, &bank).and_then(|()| index.verify_bank(number, &bank)) {
            see_error(see, error);
        }
    }
}

/// Room for the files of a dialogue: the contents may be more.
const FILES: usize = 8;

/// Files as a program keeps them that opens them when they are asked for.
struct Given<'a>(&'a [DialogueFile<'a>]);

impl Files for Given<'_> {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn file(&self, number: usize) -> Option<&DialogueFile<'_>> {
        self.0.get(number)
    }
}

fn dialogues_asked(contents: &[&[u8]], name: &str, number: u32, see: See) {
    let see_opened = |opened: Result<Dialogue<'_>, DialogueError>| match opened {
        Ok(dialogue) => dialogue_asked(&dialogue, name, number, see),
        Err(error) => see_dialogue_error(see, error),
    };
    see_opened(Dialogue::open(&mut [DialogueFile::ABSENT; FILES], contents.iter().copied()));
    see_opened(Dialogue::open_with(&mut [DialogueFile::ABSENT; FILES], contents.iter().copied(), core_utf8));
    see_opened(Dialogue::open_unverified(&mut [DialogueFile::ABSENT; FILES], contents.iter().copied()));
    if let Some(bytes) = contents.first() {
        match Dialogue::open_bank(&mut MaybeUninit::uninit(), bytes) {
            Ok(dialogue) => dialogue_asked(&dialogue, name, number, see),
            Err(error) => see_error(see, error),
        }
    }
    let mut files = [DialogueFile::ABSENT; FILES];
    for at in 0..FILES.min(contents.len()) {
        let opened = contents.get(at).map(|bytes| DialogueFile::open(bytes, at));
        let file = match opened {
            Some(Ok(file)) => file,
            Some(Err(error)) => return see_error(see, error),
            None => DialogueFile::ABSENT,
        };
        let file = match file.verify_in(&files[..], at, core_utf8) {
            Ok(verified) => verified,
            Err(error) => {
                see_error(see, error);
                file
            }
        };
        if let Some(place) = files.get_mut(at) {
            *place = file;
        }
    }
    let files = files.get(..contents.len()).unwrap_or(&files);
    see_opened(Dialogue::new(files));
    see_opened(Dialogue::with_files(&Given(files)));
}

fn dialogue_asked(dialogue: &Dialogue<'_>, name: &str, number: u32, see: See) {
    see(dialogue.clip_count() as u64 ^ u64::from(dialogue.version()));
    see(dialogue.set_index().map_or(0, |index| index.checksum()));
    see(u64::from(dialogue.has_bank()) | dialogue.missing_bank(ClipId::from_key(name)).map_or(0, |at| at as u64) << 1);
    for at in (0..dialogue.file_count()).chain([number as usize]) {
        if let Some(file) = dialogue.file(at) {
            see(file.length_bytes() as u64 ^ file.checksum() ^ file.kind() as u64);
            see(u64::from(file.bank().is_some()) | u64::from(file.set_index().is_some()) << 1);
        }
        if let Some(bank) = dialogue.bank(at) {
            see(bank.checksum());
        }
    }
    let named = dialogue.event_name(name).or_else(|| dialogue.event_name_of_words([number, number >> 3]));
    let mut asked = asked(name, number, named);
    for locale in dialogue.locales().chain(dialogue.locale(name)).chain(dialogue.default_locale()).chain([asked.locale])
    {
        see_bytes(see, dialogue.locale_tag(locale).as_bytes());
        locale.to_words().iter().for_each(|word| see(u64::from(*word)));
        asked.locale = locale;
    }
    for voice in dialogue.voices().chain(dialogue.voice(name)).chain([asked.voice]) {
        see_bytes(see, dialogue.voice_tag(voice).as_bytes());
        voice.to_words().iter().for_each(|word| see(u64::from(*word)));
        asked.voice = voice;
    }
    for babble in dialogue.babbles().chain(dialogue.babble(name)).chain([dialogue.default_babble()]) {
        see_bytes(see, babble.name().as_bytes());
    }
    let profiles = dialogue.face_profiles().chain(dialogue.face_profile(name));
    for profile in profiles.chain([dialogue.default_face_profile()]) {
        see_bytes(see, profile.name().as_bytes());
        asked.profile = profile;
    }
    let id = ClipId::from_key(name);
    see(dialogue.slot_of_texts(id).map_or(0, |(file, slot)| u64::from(file) << 32 | u64::from(slot)));
    let behind = dialogue.clip_behind(u64::from(number) << 32 | u64::from(number >> 3), name);
    let behind = behind.map(|(clip, position)| {
        see(position);
        clip
    });
    let found = [dialogue.clip(id), dialogue.clip_by_key(name), dialogue.clip_at(number, number >> 3), behind];
    for clip in dialogue.clips().chain(dialogue.clips_under(name)).chain(IntoIterator::into_iter(found).flatten()) {
        clip_asked(&clip, &asked, see);
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
    for profile in [*profile, profile.without_curves()] {
        see_face(see, profile.idle_at(Micros(i64::from(number)), u64::from(number), look(number)));
    }
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

fn clip_asked(clip: &Clip<'_>, asked: &Asked<'_>, see: See) {
    let number = asked.number;
    see_bytes(see, clip.key().as_bytes());
    see_bytes(see, clip.frames());
    see(clip.id().get() ^ u64::from(clip.slot()) ^ clip.duration_us().unwrap_or(0));
    see(u64::from(clip.has_visemes()) | u64::from(clip.has_events()) << 1 | u64::from(clip.file()) << 32);
    if let Some(kind) = clip.viseme_type() {
        see(u64::from(kind.contains_all(clip.frames())) | u64::from(kind.contains(number as u8)) << 1);
        see_bytes(see, kind.name().as_bytes());
        see_bytes(see, kind.codes().as_bytes());
    }
    curves_asked(clip, asked, see);
    faces_asked(clip, asked, see);
    if let Some(original) = clip.original() {
        see(u64::from(original.slot()) << 1 | u64::from(original == *clip));
    }
    for voice in [Some(asked.voice), clip.voice()].iter().flatten() {
        let voiced = clip.in_voice(*voice);
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
        segment_asked(&segment, asked, see);
    }
    play(clip, asked.named, number, see);
    // A rate of the program's own.
    if let Some(fps) = Fps::new(number, number >> 5) {
        play(&clip.or_fps(fps).or_viseme_type(VisemeType::Blair), asked.named, number, see);
    }
}

fn faces_asked(clip: &Clip<'_>, asked: &Asked<'_>, see: See) {
    let Asked { name, number, .. } = *asked;
    for profile in [asked.profile, asked.profile.without_curves()] {
        for who in [Who::Speaker, Who::SpeakerNamed(name), Who::from(name)] {
            see_face(see, clip.face_at(Micros(i64::from(number)), who, &profile, look(number)));
            see_face(see, clip.face_at(Seconds(number as f32), who, &profile, look(number)));
        }
    }
}

fn curves_asked(clip: &Clip<'_>, asked: &Asked<'_>, see: See) {
    let Asked { name, number, named, .. } = *asked;
    let mut cursor = CurveCursor::new();
    let emotions = clip.emotions_at(Micros(i64::from(number)), Who::Speaker);
    let strongest = emotions.strongest().map(|(emotion, _)| emotion);
    for emotion in strongest.into_iter().chain(Emotion::from_name(name)) {
        see_bytes(see, emotion.name().as_bytes());
        see(emotions.get(emotion).thousandths() as u64);
    }
    see(emotions.sum().thousandths() as u64 ^ emotions.iter().count() as u64);
    for who in [Who::from(name), Who::SpeakerNamed(name)] {
        see(clip.emotions_at(Micros(i64::from(number)), who).sum().thousandths() as u64);
    }
    let named = named.and_then(|name| clip.curve(name));
    for curve in clip.curves().chain(clip.curve(name)).chain(named) {
        see_bytes(see, curve.name().as_str().as_bytes());
        cursor = CurveCursor::from_word(cursor.to_word() ^ number);
        see(clip
            .curve_in_place(curve.place())
            .map_or(0, |same| u64::from(same.key_count()) << 1 | u64::from(same == curve)));
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

fn viseme_asked(clip: &Clip<'_>, viseme: Viseme, see: See) {
    let weight = clip.viseme_type().map(|kind| Viseme::from_code(viseme.code()).openness(kind));
    see(u64::from(viseme.to_char()) | u64::from(viseme.is_rest()) << 32);
    let weights =
        [weight.unwrap_or_default(), Weight::from_digit(viseme.code()), Weight::from_digits(b'9', viseme.code())];
    weights.iter().for_each(|weight| see(u64::from(weight.ten_thousandths())));
}

fn time_asked(clip: &Clip<'_>, time: impl Time, see: See) {
    viseme_asked(clip, clip.viseme_at(time), see);
    see(u64::from(clip.frame_at(time).unwrap_or(0)));
    see(clip.segment_at(time).map_or(0, |segment| u64::from(segment.clip().slot())));
    let open = clip.openness_at(time).map_or(0, |weight| weight.ten_thousandths());
    let babbled = clip.openness_or_babble(time, &Babble::DEFAULT, VoiceLevel::UNMEASURED);
    see(u64::from(open ^ babbled.ten_thousandths()));
}

fn segment_asked(segment: &Segment<'_>, asked: &Asked<'_>, see: See) {
    see(u64::from(segment.start_frame()) << 32 | u64::from(segment.end_frame()));
    see(segment.start_us().unwrap_or(0) ^ segment.end_us().unwrap_or(0));
    see(u64::from(segment.clip().segment(asked.number).map_or(false, |other| other == *segment)));
    see_bytes(see, segment.frames());
    see_bytes(see, segment.event().unwrap_or("").as_bytes());
    segment.events().for_each(|event| event_asked(event, asked, see));
    for locale in [asked.locale, Locale::from_words([asked.number; 2])] {
        see_bytes(see, segment.text_bytes(locale).unwrap_or(&[]));
        see(segment.has_own_text(locale).into());
        if let Some(text) = segment.text(locale) {
            see_bytes(see, text.as_str().as_bytes());
            see(u64::from(text.is_fallback()));
        }
    }
}

fn event_asked(event: Event<'_>, asked: &Asked<'_>, see: See) {
    let command: Command<EventName<'_>, _> = event.command;
    see_bytes(see, command.verb().as_bytes());
    see(command.amount().map_or(0, |strength| strength.thousandths() as u64));
    for name in [event.character, command.object()].iter().flatten() {
        let [origin, id] = name.to_words();
        see(u64::from(origin) << 32 | u64::from(id));
        see_bytes(see, name.as_str().as_bytes());
        see(u64::from(*name == asked.name) | u64::from(*name == *asked.name) << 1);
        if let Some(named) = asked.named {
            see(u64::from(*name == named) | u64::from(*name < named) << 1);
        }
        name.hash(&mut Sum(see));
    }
}

/// Sees what is hashed.
struct Sum(See);

impl Hasher for Sum {
    fn finish(&self) -> u64 {
        0
    }

    fn write(&mut self, bytes: &[u8]) {
        see_bytes(self.0, bytes);
    }
}

fn play(clip: &Clip<'_>, speaker: Option<EventName<'_>>, number: u32, see: See) {
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
            characters ^= state.emotion.map_or(0, |name| name.to_words()[1]);
        }
        for (_, state) in cursor.characters(clip) {
            characters ^= state.stares_at.map_or(0, |name| name.to_words()[1]);
        }
        viseme_asked(clip, cursor.viseme(clip), see);
        see(u64::from(cursor.openness(clip).map_or(0, |weight| weight.ten_thousandths())));
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
