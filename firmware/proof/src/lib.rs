//! Calls every public function of the reader with values from the bank: rates, indices and names in bytes that were
//! opened and not verified. Sizes are not measured here. Successful linking proves that no function can panic.
//!
//! It is separate from firmware/size, because a function that is called twice there would not be inlined. A test
//! (`crates/lipz-testkit/tests/every_function.rs`) finds missing functions.

#![no_std]

mod articulation;
mod clips;
mod dialogues;

use articulation::bank_articulation_asked;
use clips::{clip_asked, fps_asked};
use core::panic::PanicInfo;
use dialogues::dialogues_asked;
use lipz_bank::babble::{Babble, VoiceLevel};
use lipz_bank::curve::CurveValue;
use lipz_bank::face::{Emotion, Face, FaceCurve, FaceProfile, LookAt};
use lipz_bank::files::{DialogueError, Layer, SetIndex};
use lipz_bank::{Bank, ClipId, Error, EventName, Locale, Micros, Voice};

/// Receives answers, so that the compiler does not remove queries.
type See = fn(u64);

/// Arguments for the queries of clips.
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

/// Makes every query of files, before and after verification: each as a bank and as the index of a set, two of them as
/// a bank and its texts, and all of them as a dialogue, in which any can be patches, text banks, or the banks of a set.
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
        see_bytes(see, bank.locale_tag(bank.variant(locale, name)).as_bytes());
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
    bank_articulation_asked(bank, name, number, see);
    let id = ClipId::from_u64(u64::from(number) ^ ClipId::from_key(name).get());
    let found = [bank.clip(id), bank.clip_by_key(name), bank.clip_at(number)];
    for clip in bank.clips().chain(bank.clips_under(name)).chain(IntoIterator::into_iter(found).flatten()) {
        clip_asked(&clip, &asked, see);
    }
}

/// Returns arguments for the queries of clips: handles made of any number.
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
    see(u64::from(layer.has_articulation()) | u64::from(layer.has_rigs()) << 1);
    see(u64::from(layer.has_texts_of_original(number)) | u64::from(layer.borrows(number, name.len())) << 1);
    see(layer.dub_count() as u64 ^ layer.stand_in(name.len()).unwrap_or(0) as u64);
    see(u64::from(layer.removes(id)) | u64::from(layer.may_have(id)) << 1);
}

/// Queries the bytes as the index of a set that contains the bank before them.
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

/// Returns a person or a target in an unknown direction.
fn look(number: u32) -> LookAt {
    let angle = CurveValue::from_thousandths(number as i32);
    if number & 1 == 0 { LookAt::person(angle, angle) } else { LookAt::point(angle, angle) }
}

fn see_face(see: See, face: Face) {
    let angles = [face.head_pitch, face.head_yaw, face.head_roll, face.eye_pitch, face.eye_yaw];
    let others = [face.blink, face.brows, face.shrug, face.breath];
    angles.iter().chain(&others).for_each(|value| see(value.thousandths() as u64));
}

extern "C" {
    /// Not defined anywhere, so that code that reaches it does not link.
    fn panic_is_reachable() -> !;
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    // SAFETY: it is never linked.
    unsafe { panic_is_reachable() }
}
