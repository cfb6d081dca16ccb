//! Entry points for measurements of size. A linker that drops unused code keeps the code that one of them needs. Each
//! calls one function of the reader, with as little code as possible.
//!
//! A reachable panic or allocation leaves an undefined symbol, so that linking fails. `control_panic` and
//! `control_allocator` show that this works.

#![no_std]

mod controls;

use core::mem::MaybeUninit;
use core::panic::PanicInfo;
use lipz_bank::articulation::{Articulation, ArticulationProfile, Rig};
use lipz_bank::babble::{Babble, VoiceLevel};
use lipz_bank::curve::{CurveCursor, CurveValue};
use lipz_bank::face::{Emotions, Face, LookAt, Who};
use lipz_bank::playback::{ConsonantHold, Lead};
use lipz_bank::{Bank, Clip, ClipId, Cursor, Error, Event, EventName, Locale, Micros};

/// A bank as an entry point returns it: in its caller's memory.
type Place<T> = MaybeUninit<T>;

fn status<T>(result: Result<T, Error>, place: &mut Place<T>) -> u32 {
    match result {
        Ok(value) => {
            place.write(value);
            0
        }
        Err(error) => number(error),
    }
}

/// Returns a nonzero number for an error.
fn number(error: Error) -> u32 {
    error.kind() as u32 | error.offset_bytes() << 8
}

fn answer<T>(value: Option<T>, place: &mut Place<T>) -> bool {
    value.map(|value| place.write(value)).is_some()
}

#[no_mangle]
fn size_open<'a>(bytes: &'a [u8], place: &mut Place<Bank<'a>>) -> u32 {
    status(Bank::open(bytes), place)
}

#[no_mangle]
fn size_verify(bank: &mut Bank<'_>) -> u32 {
    match bank.verify() {
        Ok(verified) => {
            *bank = verified;
            0
        }
        Err(error) => number(error),
    }
}

#[no_mangle]
fn size_verify_lines(bank: &mut Bank<'_>) -> u32 {
    match bank.verify_lines() {
        Ok(verified) => {
            *bank = verified;
            0
        }
        Err(error) => number(error),
    }
}

#[no_mangle]
fn size_clip(bank: &Bank<'_>, id: ClipId) -> u32 {
    bank.clip(id).map_or(u32::MAX, |clip| clip.slot())
}

#[no_mangle]
fn size_clip_by_key(bank: &Bank<'_>, key: &str) -> u32 {
    bank.clip_by_key(key).map_or(u32::MAX, |clip| clip.slot())
}

#[no_mangle]
fn size_viseme_at(bank: &Bank<'_>, slot: u32, time_us: i64) -> u8 {
    bank.clip_at(slot).map_or(0, |clip| clip.viseme_at(Micros(time_us)).code())
}

#[no_mangle]
fn size_segment_at(bank: &Bank<'_>, slot: u32, time_us: i64) -> u32 {
    let segment = bank.clip_at(slot).and_then(|clip| clip.segment_at(Micros(time_us)));
    segment.map_or(u32::MAX, |segment| segment.index())
}

#[no_mangle]
fn size_locale(bank: &Bank<'_>, tag: &str, place: &mut Place<Locale>) -> bool {
    answer(bank.locale(tag), place)
}

#[no_mangle]
fn size_text_bytes<'a>(bank: &'a Bank<'a>, slot: u32, index: u32, of: &Locale, place: &mut Place<&'a [u8]>) -> bool {
    let segment = bank.clip_at(slot).and_then(|clip| clip.segment(index));
    answer(segment.and_then(|segment| segment.text_bytes(*of)), place)
}

#[no_mangle]
fn size_text<'a>(bank: &'a Bank<'a>, slot: u32, index: u32, of: &Locale, place: &mut Place<&'a str>) -> bool {
    let segment = bank.clip_at(slot).and_then(|clip| clip.segment(index));
    answer(segment.and_then(|segment| segment.text(*of)).map(|text| text.as_str()), place)
}

#[no_mangle]
fn size_event<'a>(bank: &'a Bank<'a>, slot: u32, index: u32, place: &mut Place<&'a str>) -> bool {
    let segment = bank.clip_at(slot).and_then(|clip| clip.segment(index));
    answer(segment.and_then(|segment| segment.event()), place)
}

#[no_mangle]
fn size_events(bank: &Bank<'_>, slot: u32, index: u32, each: fn(Event<'_>)) {
    if let Some(segment) = bank.clip_at(slot).and_then(|clip| clip.segment(index)) {
        segment.events().for_each(each);
    }
}

#[no_mangle]
fn size_event_name(bank: &Bank<'_>, name: &str) -> u32 {
    bank.event_name(name).map_or(u32::MAX, |name| name.to_words()[1])
}

#[no_mangle]
fn size_open_texts<'a>(bank: &mut Bank<'a>, bytes: &'a [u8]) -> u32 {
    bank.open_texts_unverified(bytes).map_or_else(number, |()| 0)
}

#[no_mangle]
fn size_verify_texts<'a>(bank: &mut Bank<'a>, bytes: &'a [u8]) -> u32 {
    bank.open_texts(bytes).map_or_else(number, |()| 0)
}

#[no_mangle]
fn size_play(bank: &Bank<'_>, slot: u32, place: &mut Place<Cursor>) -> bool {
    let cursor = bank.clip_at(slot).and_then(|clip| Cursor::new(&clip));
    answer(cursor.map(|cursor| cursor.with_lead(Lead::micros(40_000)).with_hold(ConsonantHold::frames(2))), place)
}

#[no_mangle]
fn size_advance(clip: &Clip<'_>, cursor: &mut Cursor, time_us: i64, each: fn(Event<'_>)) -> u8 {
    cursor.advance_to(clip, Micros(time_us)).events().for_each(each);
    cursor.viseme(clip).code()
}

#[no_mangle]
fn size_seek(clip: &Clip<'_>, cursor: &mut Cursor, time_us: i64) {
    cursor.seek(clip, Micros(time_us));
}

#[no_mangle]
fn size_state(clip: &Clip<'_>, cursor: &Cursor, of: &EventName<'_>) -> u32 {
    cursor.state(clip, Some(*of)).emotion.map_or(u32::MAX, |name| name.to_words()[1])
}

#[no_mangle]
fn size_babble(bank: &Bank<'_>, name: &str, time_us: i64) -> u16 {
    bank.babble(name).unwrap_or(Babble::DEFAULT).at(Micros(time_us), VoiceLevel::UNMEASURED).ooh.ten_thousandths()
}

#[no_mangle]
fn size_curve_cursor(clip: &Clip<'_>, name: &EventName<'_>, cursor: &mut CurveCursor, time_us: i64) -> i32 {
    let value = clip.curve(*name).and_then(|curve| cursor.value_at(&curve, Micros(time_us)));
    value.map_or(0, CurveValue::thousandths)
}

#[no_mangle]
fn size_curves(clip: &Clip<'_>, time_us: i64, each: fn(EventName<'_>, i32)) {
    for curve in clip.curves() {
        each(curve.name(), curve.value_at(Micros(time_us)).map_or(0, CurveValue::thousandths));
    }
}

#[no_mangle]
fn size_face(bank: &Bank<'_>, clip: &Clip<'_>, time_us: i64, face: &mut Face) {
    *face = clip.face_at(Micros(time_us), Who::Speaker, &bank.default_face_profile(), LookAt::AHEAD);
}

#[no_mangle]
fn size_emotions(clip: &Clip<'_>, time_us: i64) -> i32 {
    clip.emotions_at(Micros(time_us), Who::Speaker).strongest().map_or(0, |(_, value)| value.thousandths())
}

#[no_mangle]
fn size_face_of(bank: &Bank<'_>, clip: &Clip<'_>, name: &str, time_us: i64, face: &mut Face) {
    *face = clip.face_at(Micros(time_us), name, &bank.default_face_profile(), LookAt::AHEAD);
}

#[no_mangle]
fn size_articulation(clip: &Clip<'_>, profile: &ArticulationProfile<'_>, time_us: i64, place: &mut Articulation) {
    *place = clip.articulation_at(Micros(time_us), profile);
}

#[no_mangle]
fn size_weights(rig: &Rig<'_>, mouth: &Articulation, emotions: &Emotions, face: &Face, out: &mut [CurveValue]) {
    rig.weights(mouth, emotions, face, out);
}

#[no_mangle]
fn size_rig<'a>(
    bank: &Bank<'a>,
    name: &str,
    rig: &mut Place<Rig<'a>>,
    to: &mut Place<ArticulationProfile<'a>>,
) -> bool {
    answer(bank.rig(name), rig) && answer(bank.articulation(name), to)
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
