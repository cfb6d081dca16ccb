//! The JSON Schema of Lipz files, with which editors complete elements, explain them and mark errors.
//!
//! A schema covers less than the checks of the compiler: it cannot count segments or include the rules of a game. For
//! its rules, it uses the same constants as the checks.

use crate::locale::LONGEST_KEY;
use crate::text::DELIMITER;
use lipz_types::VisemeType;
use serde_json::{Map, Value, json};

/// The published address of the schema.
pub const ID: &str = concat!(env!("CARGO_PKG_REPOSITORY"), "/blob/main/docs/lipz.schema.json");

/// `ll-cc`, as in [`has_lipz_shape`](crate::locale::has_lipz_shape).
const LIPZ_LOCALE: &str = "[a-z]{2}-[a-z]{2}";
/// Language, script, region and variants of BCP 47 (RFC 5646, section 2.1), in lower case.
const EXTENDED_LOCALE: &str = "[a-z]{2,3}(-[a-z]{4})?(-([a-z]{2}|[0-9]{3}))?(-([a-z0-9]{5,8}|[0-9][a-z0-9]{3}))*";

/// A variant: names of at most eight letters and digits, as in [`is_variant_key`](crate::locale::is_variant_key).
const VARIANT: &str = "(-x(-([a-wyz0-9]|[a-z0-9]{2,8}))+)?";

/// Returns the schema (draft 2020-12) as indented JSON text.
///
/// With `extended_locales`, it accepts any BCP 47 language tag in the names of texts, in lower case.
///
/// ```
/// let schema = lipz_file::schema::json_schema(false);
/// assert!(schema.contains("\"viseme_type\""));
/// ```
pub fn json_schema(extended_locales: bool) -> String {
    let locale = if extended_locales { EXTENDED_LOCALE } else { LIPZ_LOCALE };
    let text_name = format!("^text_{locale}{VARIANT}$");
    let mut text_names = json!({ "pattern": text_name });
    if !extended_locales {
        // Other locales vary in length, so the length of the name says nothing about that of the key.
        text_names["maxLength"] = json!("text_ll-cc-x-".len() + LONGEST_KEY);
    }
    let schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": ID,
        "title": "Lipz file",
        "description": "One voice clip: a mouth shape per frame, subtitles per locale, events per segment.",
        "type": "object",
        "properties": {
            "fps": fps(),
            "viseme_type": viseme_type(),
            "visemes": {
                "title": "Mouth shapes",
                "description": "One code is one frame. `|` starts a new segment and is not a frame. `-` is rest.",
                "type": "string",
                "examples": ["MAAAEO----|MAAAAEEO--"],
            },
            "events": {
                "title": "Events",
                "description": "Events at the start of each segment, such as `feels happy` or `mara points door`. `|` \
                    separates segments, as many as in `visemes`.",
                "type": "string",
                "examples": ["feels happy|points door"],
            },
            "curves": curves(),
            "phones": phones(),
        },
        "patternProperties": {
            text_name.as_str(): {
                "title": "Subtitle",
                "description": "The text in one language and country. `|` separates segments, as many as in \
                                `visemes`; `{…}` is meta, which is not displayed. After `-x-`, the name has the key \
                                of a variant: `text_pl-pl-x-few`.",
                "type": "string",
                "examples": ["Mayor?|{louder} Mayor!"],
            },
        },
        "propertyNames": { "if": { "pattern": "^text($|[_-])" }, "then": text_names },
        "allOf": codes_per_type(),
    });
    format!("{schema:#}\n")
}

fn fps() -> Value {
    json!({
        "title": "Frame rate",
        "description": "Frames per second, from 1 to 1000. Fractions are kept exactly: 23.976, 29.97.",
        "type": "number",
        "minimum": 1,
        "maximum": 1000,
        "examples": [24, 23.976, 29.97, 30],
    })
}

fn curves() -> Value {
    let key = r"\d+:-?\d+(\.\d+)?";
    json!({
        "title": "Curves",
        "description": "Named numbers that change while the clip plays, such as blend shapes and emotions. A key is \
            `frame:value`; keys are separated by spaces and sorted by frame. Values have at most three decimal places.",
        "type": "object",
        "propertyNames": { "minLength": 1 },
        "additionalProperties": { "type": "string", "pattern": format!(r"^\s*{key}(\s+{key})*\s*$") },
        "examples": [{ "anger": "0:0 12:2.2", "jawOpen": "0:0.1 3:0.8" }],
    })
}

fn phones() -> Value {
    let phone = r"[^\s@]+@\d+";
    json!({
        "title": "Phones",
        "description": "The sounds of the recording, each with its start in milliseconds, from which faces compute \
            their mouths: ARPAbet, IPA, or `sil` for silence. `guessed` and the level of the speech may come first.",
        "type": "string",
        "pattern": format!(r"^\s*(guessed\s+)?(-?\d+dB\s+)?{phone}(\s+{phone})*\s*$"),
        "examples": ["-21dB sil@0 DH@191 AH@232 sil@410"],
    })
}

fn viseme_type() -> Value {
    let description = |kind: VisemeType| match kind {
        VisemeType::Blair => "Preston Blair's chart",
        VisemeType::ToonBoom => "Toon Boom's chart",
        VisemeType::Rms => "Loudness of the frame: ten levels of openness",
    };
    let codes = |kind: VisemeType| kind.codes().chars().map(String::from).collect::<Vec<_>>().join(" ");
    let descriptions = VisemeType::ALL.map(|kind| format!("{}: {}", description(kind), codes(kind)));
    json!({
        "title": "Viseme type",
        "description": format!("The set of codes in `visemes`.\n\n{}", descriptions.join("\n\n")),
        "enum": VisemeType::ALL.map(VisemeType::name),
        // Visual Studio Code shows these next to the names.
        "enumDescriptions": descriptions,
    })
}

/// Returns the valid codes of `visemes` for each viseme type, and without one.
fn codes_per_type() -> Vec<Value> {
    let pattern = |kind: VisemeType| json!({ "pattern": format!("^[{}{DELIMITER}]*$", kind.codes()) });
    let rule =
        |condition: Value, visemes: Value| json!({ "if": condition, "then": { "properties": { "visemes": visemes } } });
    let mut rules: Vec<Value> = VisemeType::ALL
        .into_iter()
        .map(|kind| {
            let mut properties = Map::new();
            properties.insert("viseme_type".into(), json!({ "const": kind.name() }));
            rule(json!({ "required": ["viseme_type"], "properties": properties }), pattern(kind))
        })
        .collect();
    let any = VisemeType::ALL.map(pattern);
    rules.push(rule(json!({ "not": { "required": ["viseme_type"] } }), json!({ "anyOf": any })));
    rules
}
