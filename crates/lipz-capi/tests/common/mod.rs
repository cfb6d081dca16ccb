//! Helpers to call functions of C from Rust.
#![allow(dead_code, reason = "each test uses some of it")]
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_bank::files::DialogueFile;
use lipz_capi::c_char;
use lipz_capi::*;
use std::mem::MaybeUninit;

macro_rules! golden {
    ($($name:ident = $file:literal;)+) => {
        $(pub(crate) const $name: &[u8] = include_bytes!(concat!("../../../../fixtures/banks/", $file));)+
    };
}

golden! {
    CURVES = "v1/curves.lipzbank";
    DRAMA = "v1/drama.lipzbank";
    DUBBED = "v1/dubbed.lipzbank";
    FACES = "v1/faces.lipzbank";
    LONG = "v1/long.lipzbank";
    PATCH = "v1/patch.lipzbank";
    PHONES = "v1/phones.lipzbank";
    RECORDED = "v1/recorded.lipzbank";
    REDUB = "v1/redub.lipzbank";
    SMALL = "v1/small.lipzbank";
    SPECIALS = "v1/specials.lipzbank";
    VARIANTS = "v1/variants.lipzbank";
    SPLIT = "v1/split.lipzbank";
    GERMAN = "v1/split.de-de.lipztexts";
    ENGLISH = "v1/split.en-us.lipztexts";
    SET = "sets/dubbed.lipzset";
    FIRST_OF_SET = "sets/dubbed.0-of-2.51e62ffc7e3d30e7.lipzbank";
    SECOND_OF_SET = "sets/dubbed.1-of-2.2372b0174a3e0e74.lipzbank";
}

/// Dialogues of one file and of several, of every kind.
pub(crate) const DIALOGUES: [&[&[u8]]; 13] = [
    &[CURVES],
    &[DRAMA],
    &[FACES],
    &[LONG],
    &[PHONES],
    &[RECORDED],
    &[SMALL],
    &[SPECIALS],
    &[VARIANTS],
    &[SPLIT, GERMAN, ENGLISH],
    &[SMALL, PATCH],
    &[DUBBED, REDUB],
    &[SET, FIRST_OF_SET, SECOND_OF_SET],
];

/// Returns the answer of a function, or its status. An empty answer is written as well.
#[track_caller]
pub(crate) fn ask<T: Default>(call: impl FnOnce(Option<&mut MaybeUninit<T>>) -> Status) -> Result<T, Status> {
    let mut out = MaybeUninit::uninit();
    let status = call(Some(&mut out));
    // SAFETY: functions always write to the place for their answer.
    let value = unsafe { out.assume_init() };
    if status == LIPZ_OK { Ok(value) } else { Err(status) }
}

/// A dialogue, opened by the functions and by the reader, for the duration of the test.
pub(crate) struct Opened {
    pub(crate) of_c: Dialogue,
    pub(crate) reader: lipz_bank::Dialogue<'static>,
}

pub(crate) fn bytes(contents: &[u8]) -> Bytes {
    Bytes { data: contents.as_ptr(), length_bytes: contents.len() }
}

pub(crate) fn places(count: usize) -> &'static mut [FilePlace] {
    vec![FilePlace { words: [0; LIPZ_FILE_WORDS] }; count].leak()
}

/// Opens files with the functions. Fails with the status and the problem if they do not form a dialogue.
pub(crate) fn opened(files: &[&[u8]], places: &mut [FilePlace], flags: u32) -> Result<Dialogue, (Status, Problem)> {
    let contents: Vec<Bytes> = files.iter().map(|file| bytes(file)).collect();
    let (mut dialogue, mut problem) = (MaybeUninit::uninit(), MaybeUninit::uninit());
    // SAFETY: there are as many places as contents; both structs are always written.
    unsafe {
        let (files, contents, count) = (places.as_mut_ptr(), contents.as_ptr(), contents.len());
        let status = lipz_dialogue_open(Some(&mut dialogue), files, contents, count, flags, Some(&mut problem));
        if status == LIPZ_OK { Ok(dialogue.assume_init()) } else { Err((status, problem.assume_init())) }
    }
}

pub(crate) fn dialogue(files: &[&'static [u8]]) -> Opened {
    let of_c = opened(files, places(files.len()), 0).unwrap();
    let of_reader = vec![DialogueFile::ABSENT; files.len()].leak();
    let reader = lipz_bank::Dialogue::open(of_reader, files.iter().copied()).unwrap();
    Opened { of_c, reader }
}

impl Opened {
    pub(crate) fn clip(&self, key: &str) -> Clip {
        let (key, length) = ptr(key);
        // SAFETY: the contract of the library.
        ask(|out| unsafe { lipz_dialogue_clip_by_key(Some(&self.of_c), key, length, out) }).unwrap()
    }

    pub(crate) fn name(&self, name: &str) -> Name {
        let (name, length) = ptr(name);
        // SAFETY: as above.
        ask(|out| unsafe { lipz_dialogue_event_name(Some(&self.of_c), name, length, out) }).unwrap()
    }

    pub(crate) fn locale(&self, tag: &str) -> Result<Locale, Status> {
        let (tag, length) = ptr(tag);
        // SAFETY: as above.
        ask(|out| unsafe { lipz_dialogue_locale(Some(&self.of_c), tag, length, out) })
    }
}

pub(crate) fn ptr(text: &str) -> (*const c_char, usize) {
    (text.as_ptr().cast(), text.len())
}

pub(crate) fn text_of(string: String) -> &'static str {
    // SAFETY: the strings are in files that live as long as the program.
    let bytes = unsafe { std::slice::from_raw_parts(string.data.cast(), string.length_bytes) };
    std::str::from_utf8(bytes).unwrap()
}

pub(crate) fn micros(us: i64) -> Time {
    Time { count: us, rate_hz: 0, reserved: 0 }
}

pub(crate) fn samples(position: i64, rate_hz: u32) -> Time {
    Time { count: position, rate_hz, ..micros(0) }
}

pub(crate) fn seconds(seconds: f64) -> Time {
    Time { count: seconds.to_bits() as i64, rate_hz: LIPZ_SECONDS, reserved: 0 }
}

pub(crate) fn seconds_f32(seconds: f32) -> Time {
    Time { count: seconds.to_bits().into(), rate_hz: LIPZ_SECONDS_F32, reserved: 0 }
}

/// Returns the name, unless it is missing.
pub(crate) fn name_of(name: Name) -> Option<&'static str> {
    (name.bank != LIPZ_NO_NAME).then(|| text_of(name.name))
}

/// Returns an event as written in Lipz files.
pub(crate) fn written(event: &Event) -> std::string::String {
    let of_specification = ["", "feels", "sees", "stares", "stops staring", "points", "stops pointing", "does"];
    let verbs = [&of_specification[..], &["nods", "shakes", "breathes", "blinks", "looks away"]].concat();
    let strength = lipz_bank::Strength::from_thousandths(event.strength_thousandths).to_string();
    let strength = Some(&*strength).filter(|_| event.strength_thousandths != LIPZ_NO_STRENGTH);
    let words = [name_of(event.character), verbs.get(event.verb as usize).copied(), name_of(event.object), strength];
    words.into_iter().flatten().collect::<Vec<_>>().join(" ")
}
