//! C ABI of the reader of lipz banks: what `include/lipz.h` declares.
//!
//! Every function takes plain structs by pointer, gives its answer through its last pointers and
//! returns a [`Status`]. `docs/C.md` shows how they are used.
//!
//! # Contract
//!
//! The caller guarantees, and nothing else:
//!
//! * a pointer is null or leads to a value of its type, or to as many bytes as the length beside it
//!   says; that holds for the pointers in a [`Bank`] and a [`Who`], too, for as long as the bank and the strings
//!   from it are used;
//! * nobody writes to those bytes meanwhile, and answers do not overlap arguments.
//!
//! Everything else is total. A null pointer is a status. The numbers in a struct are believed no
//! more than the bytes of a bank: a struct of another bank, or of random numbers, leads to
//! [`LIPZ_NONE`] or to other contents of the same bank, never out of it. That is why each query looks whether
//! the places in a [`Bank`] are those of its bytes, and lie in them.

#![no_std]
#![deny(unsafe_op_in_unsafe_fn)]
#![allow(unsafe_code)] // the pointers of C; see `pointer`
#![allow(clippy::missing_safety_doc)] // all functions have one contract: the one above
#![cfg_attr(not(test), deny(clippy::indexing_slicing, clippy::arithmetic_side_effects))]

mod babble;
mod bank;
mod character;
mod clip;
mod cursor;
mod cursor_time;
mod curve;
mod emotion;
mod event;
mod face;
mod layered_face;
mod layered_voice;
mod layers;
mod locale;
#[cfg(feature = "panic-handler")]
mod panic;
mod pointer;
mod segment;
mod set;
mod status;
mod string;
mod time;
mod version;
mod voice;
mod who;

pub use babble::{
    Babble, LIPZ_BUILT_IN, LIPZ_UNMEASURED, Weights, lipz_babble_at_samples, lipz_babble_at_seconds,
    lipz_babble_at_seconds_f32, lipz_babble_at_us, lipz_babble_at_us_level, lipz_babble_by_name, lipz_babble_default,
    lipz_hold_for_display, lipz_hold_readable, lipz_lead_one_frame, lipz_lead_two_frames, lipz_viseme_openness,
};
pub use bank::{
    Bank, BankInfo, LIPZ_PLACE_WORDS, lipz_bank_info, lipz_bank_open, lipz_bank_use_texts, lipz_bank_verify,
};
pub use character::{Character, lipz_cursor_character, lipz_cursor_character_at};
pub use clip::{
    Clip, LIPZ_BLAIR, LIPZ_RMS, LIPZ_TOONBOOM, Recording, Viseme, lipz_clip_at, lipz_clip_by_id, lipz_clip_by_key,
    lipz_clip_frames, lipz_clip_id_of_key, lipz_clip_key, lipz_clip_recording, lipz_clip_start_of_frame_us,
    lipz_clip_viseme,
};
pub use cursor::{
    Cursor, LIPZ_OVER, LIPZ_WAITING, lipz_cursor_finish, lipz_cursor_new, lipz_cursor_openness, lipz_cursor_segment,
    lipz_cursor_take_event, lipz_cursor_take_segment, lipz_cursor_viseme,
};
pub use cursor_time::{
    lipz_cursor_advance_samples, lipz_cursor_advance_seconds, lipz_cursor_advance_seconds_f32, lipz_cursor_advance_us,
    lipz_cursor_loop_samples, lipz_cursor_loop_seconds, lipz_cursor_loop_seconds_f32, lipz_cursor_loop_us,
    lipz_cursor_seek_samples, lipz_cursor_seek_seconds, lipz_cursor_seek_seconds_f32, lipz_cursor_seek_us,
};
pub use curve::{
    Curve, CurveCursor, CurveKey, lipz_clip_curve, lipz_clip_curve_at, lipz_clip_curve_key, lipz_clip_curve_value,
    lipz_clip_curve_value_at_samples, lipz_clip_curve_value_at_seconds, lipz_clip_curve_value_at_seconds_f32,
    lipz_clip_curve_value_at_us,
};
pub use emotion::{
    Emotions, LIPZ_ANGER, LIPZ_ASLEEP, LIPZ_DISGUST, LIPZ_EMOTION_COUNT, LIPZ_EXERTION, LIPZ_FEAR, LIPZ_JOY,
    LIPZ_NEUTRAL, LIPZ_PAIN, LIPZ_PERPLEXED, LIPZ_SADNESS, LIPZ_SHOCK, LIPZ_SHOUT, LIPZ_SURPRISE,
    lipz_clip_emotions_at_samples, lipz_clip_emotions_at_seconds, lipz_clip_emotions_at_seconds_f32,
    lipz_clip_emotions_at_us, lipz_clip_emotions_of_samples, lipz_clip_emotions_of_seconds,
    lipz_clip_emotions_of_seconds_f32, lipz_clip_emotions_of_us,
};
pub use event::{
    Event, EventName, LIPZ_BLINKS, LIPZ_BREATHES, LIPZ_DOES, LIPZ_FEELS, LIPZ_LOOKS_AWAY, LIPZ_NO_NAME, LIPZ_NODS,
    LIPZ_POINTS, LIPZ_SEES, LIPZ_SHAKES, LIPZ_STARES, LIPZ_STOPS_POINTING, LIPZ_STOPS_STARING, lipz_event_name,
    lipz_segment_event, lipz_segment_event_string,
};
pub use face::{
    Face, FaceProfile, LookAt, lipz_clip_face_at_samples, lipz_clip_face_at_seconds, lipz_clip_face_at_seconds_f32,
    lipz_clip_face_at_us, lipz_clip_face_of_samples, lipz_clip_face_of_seconds, lipz_clip_face_of_seconds_f32,
    lipz_clip_face_of_us, lipz_face_idle_at_samples, lipz_face_idle_at_seconds, lipz_face_idle_at_seconds_f32,
    lipz_face_idle_at_us, lipz_face_profile_by_name, lipz_face_profile_default,
};
pub use layered_face::{
    lipz_layers_face_at_samples, lipz_layers_face_at_seconds, lipz_layers_face_at_seconds_f32, lipz_layers_face_at_us,
    lipz_layers_face_of_samples, lipz_layers_face_of_seconds, lipz_layers_face_of_seconds_f32, lipz_layers_face_of_us,
};
pub use layered_voice::{LayeredVoicedClip, lipz_layers_clip_in_voice, lipz_layers_clip_voice, lipz_layers_voice_at};
pub use layers::{
    LIPZ_NO_LAYER, LayeredClip, LayeredLocale, LayersInfo, lipz_layers_check, lipz_layers_clip_by_id,
    lipz_layers_clip_by_key, lipz_layers_info, lipz_layers_locale, lipz_layers_text,
};
pub use locale::{Locale, lipz_locale_at, lipz_locale_by_tag, lipz_locale_default};
pub use segment::{Segment, Text, lipz_segment_at, lipz_segment_of_frame, lipz_segment_text};
pub use set::{
    Set, SetBank, SetInfo, lipz_set_bank_at, lipz_set_bank_of, lipz_set_check_bank, lipz_set_info, lipz_set_open,
};
pub use status::{
    LIPZ_NONE, LIPZ_NOT_OPENED, LIPZ_NOT_UTF8, LIPZ_NULL_POINTER, LIPZ_OK, LIPZ_OTHER_VERSION, Status,
    lipz_status_message,
};
pub use string::{String, c_char};
pub use time::{
    lipz_frame_at_samples, lipz_frame_at_seconds, lipz_frame_at_seconds_f32, lipz_frame_at_us, lipz_segment_at_samples,
    lipz_segment_at_seconds, lipz_segment_at_seconds_f32, lipz_segment_at_us, lipz_viseme_at_samples,
    lipz_viseme_at_seconds, lipz_viseme_at_seconds_f32, lipz_viseme_at_us,
};
pub use version::{LIPZ_VERSION_MAJOR, LIPZ_VERSION_MINOR, LIPZ_VERSION_PATCH, lipz_version};
pub use voice::{
    LIPZ_DUB, LIPZ_ORIGINAL, LIPZ_OTHER_DUB, VoicedClip, lipz_clip_in_voice, lipz_clip_voice, lipz_voice_at,
};
pub use who::Who;
