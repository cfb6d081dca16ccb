//! Compares the header with the code and its documentation: `LIPZ_BLESS=1` writes it.
#![allow(clippy::unwrap_used, reason = "tests")]

use cbindgen::{Builder, Config, DocumentationStyle, Language, Style};
use lipz_bank::ErrorKind;
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// The names of the structs in C. Names of functions and constants are the same in Rust.
const NAMES: [(&str, &str); 35] = [
    ("Articulation", "lipz_articulation"),
    ("ArticulationProfile", "lipz_articulation_profile"),
    ("Babble", "lipz_babble"),
    ("Bytes", "lipz_bytes"),
    ("Character", "lipz_character"),
    ("Clip", "lipz_clip"),
    ("Cursor", "lipz_cursor"),
    ("Curve", "lipz_curve"),
    ("CurveCursor", "lipz_curve_cursor"),
    ("CurveKey", "lipz_curve_key_t"),
    ("Dialogue", "lipz_dialogue"),
    ("DialogueInfo", "lipz_dialogue_info_t"),
    ("Emotions", "lipz_emotions"),
    ("Event", "lipz_event"),
    ("Face", "lipz_face"),
    ("FaceProfile", "lipz_face_profile"),
    ("FileInfo", "lipz_file_info"),
    ("FilePlace", "lipz_file"),
    ("Locale", "lipz_locale"),
    ("LookAt", "lipz_look_at"),
    ("Name", "lipz_name"),
    ("Problem", "lipz_problem"),
    ("Recording", "lipz_recording"),
    ("Rig", "lipz_rig"),
    ("Segment", "lipz_segment"),
    ("SetBank", "lipz_set_bank"),
    ("Status", "lipz_status"),
    ("String", "lipz_string"),
    ("Text", "lipz_text"),
    ("Time", "lipz_time"),
    ("Viseme", "lipz_viseme"),
    ("Voice", "lipz_voice"),
    ("VoicedClip", "lipz_voiced_clip"),
    ("Weights", "lipz_weights"),
    ("Who", "lipz_who"),
];

/// The files with declarations, in the order of the header.
const FILES: [&str; 18] = [
    "version.rs",
    "status.rs",
    "string.rs",
    "dialogue.rs",
    "open.rs",
    "time.rs",
    "clip.rs",
    "find.rs",
    "segment.rs",
    "handle.rs",
    "event.rs",
    "cursor.rs",
    "character.rs",
    "babble.rs",
    "curve.rs",
    "who.rs",
    "face.rs",
    "articulation.rs",
];

const INTRODUCTION: &str = "/*
 * lipz.h - reads lipz dialogue banks in place. https://github.com/lipz/lipz
 *
 * MIT OR Apache-2.0. Generated from the code by `LIPZ_BLESS=1 cargo test -p lipz-capi --test header`.
 * docs/guides/c.md has a first program, and lists the fields of each struct.
 *
 * Arguments come in one order: the dialogue, the queried value, the time, who, the profile, options, and the
 * answer last.
 *
 * Contract: the caller guarantees only the following.
 *
 * - Each pointer is null or leads to a value of its type, or to as many bytes as the length next to it. This
 *   includes the pointers in a lipz_bytes and a lipz_who.
 * - Only the library has written the words of a lipz_dialogue and of its files. The files stay at their
 *   addresses, and their contents stay valid, while the dialogue and strings from it are used.
 * - No thread writes to any of these during a call, and answers do not overlap arguments.
 *
 * Everything else is total: no function crashes, reads out of bounds or loops without end, whatever the bytes of
 * the files and the numbers in the other structs are. Each function returns a status. Unless that is LIPZ_OK, the
 * answer is empty: zeros, null, or the viseme at rest. All functions except lipz_dialogue_supply may be called
 * from several threads at once.
 */

#ifndef LIPZ_H
#define LIPZ_H";

/// Times by value: a few lines of C each, without a function of the library.
const TIMES: &str = "
// Returns a time in microseconds.
static inline lipz_time lipz_time_us(int64_t us) {
  lipz_time time = {us, 0, 0};
  return time;
}

// Returns a time in samples per channel, at a sample rate.
static inline lipz_time lipz_time_samples(int64_t position, uint32_t rate_hz) {
  // Without a valid rate, the time is before the start.
  int is_rate = rate_hz > 0 && rate_hz < LIPZ_SECONDS_F32;
  lipz_time time = {is_rate ? position : -1, is_rate ? rate_hz : 0, 0};
  return time;
}

// Returns a time in seconds.
static inline lipz_time lipz_time_seconds(double seconds) {
  lipz_time time = {0, LIPZ_SECONDS, 0};
  memcpy(&time.count, &seconds, sizeof seconds);
  return time;
}

// Returns a time in seconds, from a clock without `double`.
static inline lipz_time lipz_time_seconds_f32(float seconds) {
  uint32_t bits;
  lipz_time time = {0, LIPZ_SECONDS_F32, 0};
  memcpy(&bits, &seconds, sizeof bits);
  time.count = bits;
  return time;
}

#endif  // LIPZ_H
";

#[test]
fn the_header_has_every_function() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for file in fs::read_dir(&source).unwrap() {
        let path = file.unwrap().path();
        if fs::read_to_string(&path).unwrap().contains("#[no_mangle]") {
            let name = path.file_name().unwrap().to_str().unwrap();
            assert!(FILES.contains(&name), "FILES has no {name}");
        }
    }
}

#[test]
fn the_header_is_current() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("include/lipz.h");
    let header = header();
    if std::env::var_os("LIPZ_BLESS").is_some() {
        fs::write(&path, &header).unwrap();
    }
    let found = fs::read_to_string(&path).unwrap();
    assert!(!header.contains("LIPZ_ID_"), "these names are for the ids of clips (`lipz ids --lang c`)");
    let is_of_rust = |line: &&str| line.starts_with("} ") && line.ends_with(";") && !line.starts_with("} lipz_");
    assert_eq!(header.lines().find(is_of_rust), None, "NAMES has the names of C");
    assert!(found == header, "include/lipz.h is out of date: LIPZ_BLESS=1 writes it");
}

/// Opaque structs, which programs only pass on.
const OPAQUE: [&str; 3] = ["lipz_dialogue", "lipz_file", "lipz_time"];

#[test]
fn the_page_names_every_field() {
    let page = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/guides/c.md")).unwrap();
    let header = header();
    let (mut fields, mut count) = (Vec::new(), 0);
    for line in header.lines() {
        if let Some(name) = line.strip_prefix("} ").and_then(|rest| rest.strip_suffix(';')) {
            let row = format!("| `{name}` | {} |", fields.join(", "));
            assert!(OPAQUE.contains(&name) || page.contains(&row), "docs/guides/c.md has no {row}");
            count += 1;
        } else if line.starts_with("typedef struct {") {
            fields.clear();
        } else if let Some(field) = line.strip_prefix("  ").and_then(|field| field.strip_suffix(';')) {
            let name = field.rsplit([' ', '*']).next().unwrap();
            fields.extend(Some(format!("`{name}`")).filter(|_| name != "reserved"));
        }
    }
    assert!(count > OPAQUE.len() && count + 2 == NAMES.len(), "{count}");
}

/// Returns the expected header.
fn header() -> String {
    let mut config = Config {
        language: Language::C,
        style: Style::Type,
        cpp_compat: true,
        header: Some(INTRODUCTION.into()),
        after_includes: Some(damage()),
        trailer: Some(TIMES.into()),
        no_includes: true,
        sys_includes: vec!["stddef.h".into(), "stdint.h".into(), "string.h".into()],
        usize_is_size_t: true,
        documentation_style: DocumentationStyle::C99,
        line_length: 132,
        ..Config::default()
    };
    config.export.rename = NAMES.iter().map(|(rust, c)| ((*rust).into(), (*c).into())).collect();
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let builder = FILES.iter().fold(Builder::new(), |builder, file| builder.with_src(sources.join(file)));
    let bindings = builder.with_config(config).generate().unwrap();
    let mut text = Vec::new();
    bindings.write(&mut text);
    String::from_utf8(text).unwrap()
}

/// Returns the kinds of damage as statuses, from the reader's list with their numbers.
fn damage() -> String {
    let mut text = String::from("\n");
    for kind in ErrorKind::ALL {
        let mut name = String::from("LIPZ");
        for letter in format!("{kind:?}").chars() {
            if letter.is_ascii_uppercase() {
                name.push('_');
            }
            name.push(letter.to_ascii_uppercase());
        }
        let _ = writeln!(text, "// Damage: {}.\n#define {name} {}\n", kind.message(), kind.number());
    }
    text
}
