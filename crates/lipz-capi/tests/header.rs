//! The header is what the code and its documentation say: `LIPZ_BLESS=1` writes it.
#![allow(clippy::unwrap_used, reason = "tests")]

use cbindgen::{Builder, Config, DocumentationStyle, Language, Style};
use lipz_bank::ErrorKind;
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// The names of the structs in C: those of functions and constants are the same in Rust.
const NAMES: [(&str, &str); 32] = [
    ("Babble", "lipz_babble"),
    ("Bank", "lipz_bank"),
    ("BankInfo", "lipz_bank_info_t"),
    ("Character", "lipz_character"),
    ("Clip", "lipz_clip"),
    ("Cursor", "lipz_cursor"),
    ("Curve", "lipz_curve"),
    ("CurveCursor", "lipz_curve_cursor"),
    ("CurveKey", "lipz_curve_key"),
    ("Emotions", "lipz_emotions"),
    ("Event", "lipz_event"),
    ("EventName", "lipz_name"),
    ("Face", "lipz_face"),
    ("FaceProfile", "lipz_face_profile"),
    ("LayeredClip", "lipz_layered_clip"),
    ("LayeredVoicedClip", "lipz_layered_voiced_clip"),
    ("LayeredLocale", "lipz_layered_locale"),
    ("LayersInfo", "lipz_layers_info_t"),
    ("Locale", "lipz_locale"),
    ("LookAt", "lipz_look_at"),
    ("Recording", "lipz_recording"),
    ("Segment", "lipz_segment"),
    ("Set", "lipz_set"),
    ("SetBank", "lipz_set_bank"),
    ("SetInfo", "lipz_set_info_t"),
    ("Status", "lipz_status"),
    ("String", "lipz_string"),
    ("Text", "lipz_text"),
    ("Viseme", "lipz_viseme"),
    ("VoicedClip", "lipz_voiced_clip"),
    ("Weights", "lipz_weights"),
    ("Who", "lipz_who"),
];

/// The files with declarations, in the order of the header.
const FILES: [&str; 22] = [
    "version.rs",
    "status.rs",
    "string.rs",
    "bank.rs",
    "clip.rs",
    "time.rs",
    "segment.rs",
    "locale.rs",
    "event.rs",
    "cursor.rs",
    "cursor_time.rs",
    "character.rs",
    "babble.rs",
    "curve.rs",
    "who.rs",
    "emotion.rs",
    "face.rs",
    "voice.rs",
    "layers.rs",
    "layered_face.rs",
    "layered_voice.rs",
    "set.rs",
];

const INTRODUCTION: &str = "/*
 * lipz.h - reads lipz dialogue banks in place. https://github.com/lipz/lipz
 *
 * MIT OR Apache-2.0. Written by `LIPZ_BLESS=1 cargo test -p lipz-capi --test header` from the code.
 * docs/C.md shows how to use it.
 *
 * Contract: a pointer is null or leads to a value of its type, or to as many bytes as the length
 * beside it says; that holds for the pointers in a lipz_bank and a lipz_who, too, for as long as the bank and
 * strings from it are used. Nobody writes to those bytes meanwhile, and answers do not overlap arguments.
 *
 * Everything else is total: no function crashes, reads out of bounds or loops without end, whatever the
 * bytes of the bank and the numbers in the structs are. Each returns a status, and writes an
 * empty answer (zeros, null, the viseme at rest) unless that is LIPZ_OK. All may be called from several
 * threads at once.
 */";

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
    let is_of_rust = |line: &&str| line.starts_with("typedef struct ") && !line.starts_with("typedef struct lipz_");
    assert_eq!(header.lines().find(is_of_rust), None, "NAMES has the names of C");
    assert!(found == header, "include/lipz.h is not what the code says: LIPZ_BLESS=1 writes it");
}

/// The header as it should be.
fn header() -> String {
    let mut config = Config {
        language: Language::C,
        style: Style::Both,
        cpp_compat: true,
        header: Some(INTRODUCTION.into()),
        include_guard: Some("LIPZ_H".into()),
        after_includes: Some(damage()),
        no_includes: true,
        sys_includes: vec!["stddef.h".into(), "stdint.h".into()],
        usize_is_size_t: true,
        documentation_style: DocumentationStyle::C99,
        line_length: 100,
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

/// The kinds of damage as statuses. The reader lists them, with their numbers.
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
