//! The parts of the reader that programs use, as entry points of firmware/size.

/// Queries that a program uses together.
pub(super) struct Group {
    pub(super) name: &'static str,
    parts: &'static [&'static [&'static str]],
    /// The limit for the code on a Cortex-M4, in bytes: the measured size, plus three percent for other compilers.
    pub(super) budget_bytes: Option<u64>,
}

impl Group {
    /// Returns the entry points.
    pub(super) fn entries(&self) -> Vec<&'static str> {
        self.parts.concat()
    }
}

const OPEN: &[&str] = &["size_open"];
const FRAMES: &[&str] = &["size_clip", "size_viseme_at", "size_segment_at"];
const TEXT_BYTES: &[&str] = &["size_locale", "size_text_bytes"];
const TEXTS: &[&str] = &["size_text"];
const EVENT_STRINGS: &[&str] = &["size_event"];
const EVENTS: &[&str] = &["size_events", "size_event_name"];
const KEYS: &[&str] = &["size_clip_by_key"];
const TEXT_BANKS: &[&str] = &["size_open_texts"];
const PLAYBACK: &[&str] = &["size_play", "size_advance", "size_seek", "size_state"];
const BABBLE: &[&str] = &["size_babble"];
const CURVES: &[&str] = &["size_curve_cursor", "size_curves"];
const EMOTIONS: &[&str] = &["size_emotions"];
const FACE: &[&str] = &["size_face"];
const FACES: &[&str] = &["size_face", "size_face_of"];
const ARTICULATION: &[&str] = &["size_articulation", "size_weights"];
const RIGS: &[&str] = &["size_rig"];
const VERIFY_LINES: &[&str] = &["size_verify_lines"];
const VERIFY: &[&str] = &["size_verify"];
const VERIFY_TEXTS: &[&str] = &["size_verify_texts"];

/// Programs. Each includes all of the one before it.
pub(super) const PROGRAMS: [Group; 9] = [
    Group { name: "open", parts: &[OPEN], budget_bytes: Some(820) },
    Group { name: "+ find, frames and segments by time", parts: &[OPEN, FRAMES], budget_bytes: Some(1_645) },
    Group { name: "+ texts as bytes, locales", parts: &[OPEN, FRAMES, TEXT_BYTES], budget_bytes: Some(2_055) },
    Group { name: "+ typed events, names", parts: &[OPEN, FRAMES, TEXT_BYTES, EVENTS], budget_bytes: Some(3_250) },
    Group { name: "+ find by key", parts: &[OPEN, FRAMES, TEXT_BYTES, EVENTS, KEYS], budget_bytes: Some(3_500) },
    Group {
        name: "+ text banks",
        parts: &[OPEN, FRAMES, TEXT_BYTES, EVENTS, KEYS, TEXT_BANKS],
        budget_bytes: Some(4_100),
    },
    Group {
        name: "+ UTF-8 check: texts and event strings as strings",
        parts: &[OPEN, FRAMES, TEXT_BYTES, EVENTS, KEYS, TEXT_BANKS, TEXTS, EVENT_STRINGS],
        budget_bytes: Some(4_975),
    },
    Group {
        name: "+ verify of visemes, texts and events",
        parts: &[OPEN, FRAMES, TEXT_BYTES, EVENTS, KEYS, TEXT_BANKS, TEXTS, EVENT_STRINGS, VERIFY_LINES, VERIFY_TEXTS],
        budget_bytes: Some(9_715),
    },
    Group {
        name: "+ verify: everything",
        parts: &[OPEN, FRAMES, TEXT_BYTES, EVENTS, KEYS, TEXT_BANKS, TEXTS, EVENT_STRINGS, VERIFY, VERIFY_TEXTS],
        budget_bytes: Some(13_635),
    },
];

/// Single groups, each with all code that it calls: shared code counts in each.
pub(super) const SINGLE: [Group; 18] = [
    Group { name: "alone: find", parts: &[&["size_clip"]], budget_bytes: None },
    Group { name: "alone: frame by time", parts: &[&["size_viseme_at"]], budget_bytes: None },
    Group { name: "alone: segment by time", parts: &[&["size_segment_at"]], budget_bytes: None },
    Group { name: "alone: text as bytes", parts: &[&["size_text_bytes"]], budget_bytes: None },
    Group { name: "alone: text", parts: &[TEXTS], budget_bytes: None },
    Group { name: "alone: typed events", parts: &[&["size_events"]], budget_bytes: None },
    Group { name: "alone: playback with lead, hold, events and state", parts: &[PLAYBACK], budget_bytes: None },
    Group { name: "alone: babble", parts: &[BABBLE], budget_bytes: None },
    Group { name: "alone: curves, one with a cursor and all", parts: &[CURVES], budget_bytes: None },
    Group { name: "alone: emotions at a time", parts: &[EMOTIONS], budget_bytes: None },
    Group { name: "alone: the face at a time", parts: &[FACE], budget_bytes: None },
    Group { name: "alone: the face at a time, and those of others", parts: &[FACES], budget_bytes: None },
    Group {
        name: "alone: articulation at a time, and the weights of a rig",
        parts: &[ARTICULATION],
        budget_bytes: Some(5_760),
    },
    Group {
        name: "alone: face, articulation at a time, and the weights of a rig",
        parts: &[FACE, ARTICULATION],
        budget_bytes: None,
    },
    Group {
        name: "alone: articulation, weights, and finding profile and rig",
        parts: &[ARTICULATION, RIGS],
        budget_bytes: None,
    },
    Group { name: "alone: open a text bank", parts: &[&["size_open_texts"]], budget_bytes: None },
    Group { name: "alone: verify of visemes, texts and events", parts: &[VERIFY_LINES], budget_bytes: None },
    Group { name: "alone: verify", parts: &[VERIFY], budget_bytes: None },
];

const C_OPEN: &[&str] = &["lipz_dialogue_open_bank"];
const C_OPEN_ANY: &[&str] = &["lipz_dialogue_open", "lipz_dialogue_supply"];
const C_MOUTHS: &[&str] = &["lipz_dialogue_clip", "lipz_clip_viseme_at"];
const C_TEXTS: &[&str] = &["lipz_dialogue_locale", "lipz_clip_segment_at", "lipz_segment_text"];
const C_EVENTS: &[&str] = &["lipz_segment_event", "lipz_dialogue_event_name"];
const C_CURSOR: &[&str] = &[
    "lipz_cursor_new",
    "lipz_cursor_advance",
    "lipz_cursor_seek",
    "lipz_cursor_finish",
    "lipz_cursor_take_event",
    "lipz_cursor_viseme",
    "lipz_cursor_segment",
    "lipz_cursor_character",
];
const C_BABBLE: &[&str] = &["lipz_dialogue_babble", "lipz_babble_at_level"];
const C_CURVES: &[&str] = &["lipz_clip_curve", "lipz_clip_curve_by_index", "lipz_curve_value_at"];
const C_EMOTIONS: &[&str] = &["lipz_clip_emotions_at"];
const C_FACE: &[&str] = &["lipz_dialogue_face_profile", "lipz_clip_face_at"];
const C_ARTICULATION: &[&str] =
    &["lipz_dialogue_articulation_profile", "lipz_clip_articulation_at", "lipz_dialogue_rig", "lipz_rig_weights"];

/// Programs in C, with the library that `cargo xtask capi` builds. Emotions and faces of other characters need no
/// further functions.
pub(super) const C_PROGRAMS: [Group; 11] = [
    Group { name: "C: open", parts: &[C_OPEN], budget_bytes: Some(1_605) },
    Group { name: "C: + find, visemes by time", parts: &[C_OPEN, C_MOUTHS], budget_bytes: Some(4_480) },
    Group { name: "C: + locales, segments, texts", parts: &[C_OPEN, C_MOUTHS, C_TEXTS], budget_bytes: Some(7_130) },
    Group {
        name: "C: + typed events, names",
        parts: &[C_OPEN, C_MOUTHS, C_TEXTS, C_EVENTS],
        budget_bytes: Some(8_990),
    },
    Group { name: "C: + cursor", parts: &[C_OPEN, C_MOUTHS, C_TEXTS, C_EVENTS, C_CURSOR], budget_bytes: Some(15_740) },
    Group {
        name: "C: + babble",
        parts: &[C_OPEN, C_MOUTHS, C_TEXTS, C_EVENTS, C_CURSOR, C_BABBLE],
        budget_bytes: Some(17_365),
    },
    Group {
        name: "C: + curves",
        parts: &[C_OPEN, C_MOUTHS, C_TEXTS, C_EVENTS, C_CURSOR, C_BABBLE, C_CURVES],
        budget_bytes: Some(20_535),
    },
    Group {
        name: "C: + emotions",
        parts: &[C_OPEN, C_MOUTHS, C_TEXTS, C_EVENTS, C_CURSOR, C_BABBLE, C_CURVES, C_EMOTIONS],
        budget_bytes: Some(21_475),
    },
    Group {
        name: "C: + the face at a time",
        parts: &[C_OPEN, C_MOUTHS, C_TEXTS, C_EVENTS, C_CURSOR, C_BABBLE, C_CURVES, C_EMOTIONS, C_FACE],
        budget_bytes: Some(29_365),
    },
    Group {
        name: "C: + articulation at a time, and the weights of a rig",
        parts: &[C_OPEN, C_MOUTHS, C_TEXTS, C_EVENTS, C_CURSOR, C_BABBLE, C_CURVES, C_EMOTIONS, C_FACE, C_ARTICULATION],
        budget_bytes: Some(35_365),
    },
    Group {
        name: "C: + open any files, verified, and supply banks",
        parts: &[
            C_OPEN,
            C_MOUTHS,
            C_TEXTS,
            C_EVENTS,
            C_CURSOR,
            C_BABBLE,
            C_CURVES,
            C_EMOTIONS,
            C_FACE,
            C_ARTICULATION,
            C_OPEN_ANY,
        ],
        budget_bytes: Some(64_155),
    },
];
