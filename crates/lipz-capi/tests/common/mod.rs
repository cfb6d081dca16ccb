//! Calling functions of C from Rust.
#![allow(dead_code, reason = "each test uses some of it")]
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_capi::c_char;
use lipz_capi::*;
use std::mem::MaybeUninit;

pub(crate) const CURVES: &[u8] = include_bytes!("../../../../fixtures/banks/v1/curves.lipzbank");
pub(crate) const DRAMA: &[u8] = include_bytes!("../../../../fixtures/banks/v1/drama.lipzbank");
pub(crate) const SMALL: &[u8] = include_bytes!("../../../../fixtures/banks/v1/small.lipzbank");
pub(crate) const SPECIALS: &[u8] = include_bytes!("../../../../fixtures/banks/v1/specials.lipzbank");
pub(crate) const SPLIT: &[u8] = include_bytes!("../../../../fixtures/banks/v1/split.lipzbank");
pub(crate) const GERMAN: &[u8] = include_bytes!("../../../../fixtures/banks/v1/split.de-de.lipztexts");
pub(crate) const ENGLISH: &[u8] = include_bytes!("../../../../fixtures/banks/v1/split.en-us.lipztexts");

/// A status, and what was written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Answer<T> {
    pub(crate) status: Status,
    value: T,
}

impl<T> Answer<T> {
    /// Calls a function. It writes an answer whatever its status is.
    pub(crate) fn from_call(call: impl FnOnce(Option<&mut MaybeUninit<T>>) -> Status) -> Answer<T> {
        let mut out = MaybeUninit::uninit();
        let status = call(Some(&mut out));
        // SAFETY: functions that are given a place for their answer write to it.
        Answer { status, value: unsafe { out.assume_init() } }
    }

    /// The answer, which there must be.
    #[track_caller]
    pub(crate) fn ok(self) -> T {
        assert_eq!(self.status, LIPZ_OK);
        self.value
    }

    /// The answer, or `None` if that is the status.
    #[track_caller]
    pub(crate) fn some(self) -> Option<T> {
        if self.status == LIPZ_NONE { None } else { Some(self.ok()) }
    }

    /// What was written, whatever the status is.
    pub(crate) fn written(self) -> T {
        self.value
    }
}

/// A bank, opened by the reader and by the functions.
pub(crate) fn bank(bytes: &'static [u8]) -> (lipz_bank::Bank<'static>, Bank) {
    let bank = Answer::from_call(|out| unsafe { lipz_bank_open(bytes.as_ptr(), bytes.len(), out, None) }).ok();
    assert_eq!(unsafe { lipz_bank_verify(Some(&bank), None) }, LIPZ_OK);
    (lipz_bank::Bank::open(bytes).unwrap().verify().unwrap(), bank)
}

pub(crate) fn ptr(text: &str) -> (*const c_char, usize) {
    (text.as_ptr().cast(), text.len())
}

pub(crate) fn text_of(string: String) -> &'static str {
    // SAFETY: strings of a bank that lives as long as the program.
    let bytes = unsafe { std::slice::from_raw_parts(string.data.cast(), string.length_bytes) };
    std::str::from_utf8(bytes).unwrap()
}

/// An event as it is written in Lipz files.
pub(crate) fn written(event: &Event) -> std::string::String {
    let of_specification = ["", "feels", "sees", "stares", "stops staring", "points", "stops pointing", "does"];
    let verbs = [&of_specification[..], &["nods", "shakes", "breathes", "blinks", "looks away"]].concat();
    let name = |name: EventName| (name.id != LIPZ_NO_NAME).then(|| text_of(name.name));
    let words = [name(event.character), verbs.get(event.verb as usize).copied(), name(event.object)];
    words.into_iter().flatten().collect::<Vec<_>>().join(" ")
}
