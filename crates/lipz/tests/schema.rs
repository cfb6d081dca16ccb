//! The JSON Schema: it is one, accepts every good Lipz file, and refuses the bad ones as far as a
//! schema can tell.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use jsonschema::Validator;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use support::{Comparison, files, lipz, repository, tree};

/// Faults that no schema can express, by the start of the fixture's name. Each must pass.
const BEYOND_A_SCHEMA: &[(&str, &str)] = &[
    ("LZ0201", "of two equal elements a JSON parser keeps one"),
    ("LZ0203", "elements of other tools are kept: games do not see them"),
    ("LZ0204", "a clip without elements is legal"),
    ("LZ0302", "the digits of a number are no rule of JSON"),
    ("LZ0406", "what a mouth does is no rule of JSON"),
    ("LZ0504", "the lists of languages and countries are too long"),
    ("LZ0505", "braces are counted"),
    ("LZ0506", "braces are counted"),
    ("LZ0507", "an empty text is legal"),
    ("LZ0508", "U+0000 is legal"),
    ("LZ0601", "segments of several elements are counted"),
    ("LZ0701", "U+0000 is legal"),
    ("LZ0702", "events may be any text"),
    ("LZ0706", "events may be any text"),
    ("LZ1802", "the order of numbers in a string is no rule of JSON"),
    ("LZ1803", "frames of several elements are counted"),
    ("LZ1804", "digits behind a point are trailing zeros or not"),
    ("LZ1805", "of two equal names a JSON parser keeps one"),
    ("LZ1806", "a curve may have any name"),
    ("LZ1807", "meta may be any text"),
    ("LZ1808", "meta may be any text"),
    ("LZ1809", "the meta of several texts is compared"),
    ("LZ1810", "events may be any text"),
    ("LZ1811", "events and curves are compared"),
    ("LZ1812", "meta may be any text"),
    ("LZ1813", "a curve may have any value"),
    ("LZ1814", "events and curves are compared"),
];
/// Bad files of those names that have a second fault, which the schema finds.
const FOUND_ALL_THE_SAME: &[&str] = &[
    "LZ0203-unknown-element-nested-deep",
    "LZ0504-unknown-locale-misspelt",
    "LZ0601-segment-count-visemes-damage-and-more",
];

fn schema(flags: &[&str]) -> Value {
    let printed = lipz(&repository(), ["schema"].iter().chain(flags));
    assert_eq!((printed.code, printed.stderr.as_str()), (0, ""));
    serde_json::from_str(&printed.stdout).unwrap()
}

fn validator(flags: &[&str]) -> Validator {
    let schema = schema(flags);
    jsonschema::draft202012::meta::validate(&schema).unwrap();
    jsonschema::draft202012::new(&schema).unwrap()
}

/// What the schema has against a file; `None` for nothing.
fn fault(validator: &Validator, path: &Path) -> Option<String> {
    match serde_json::from_slice(&fs::read(path).unwrap()) {
        Ok(file) => validator.iter_errors(&file).next().map(|error| error.to_string()),
        Err(error) => Some(format!("not JSON: {error}")),
    }
}

#[test]
fn good_files_pass() {
    let validator = validator(&[]);
    let mut passed = 0;
    for folder in ["fixtures/drama", "fixtures/banks/sources", "fixtures/spec/repaired"] {
        let folder = repository().join(folder);
        for file in tree(&folder).iter().filter(|file| file.ends_with(".lipz")) {
            assert_eq!(fault(&validator, &folder.join(file)), None, "{file}");
            passed += 1;
        }
    }
    assert!(passed >= 70, "only {passed} files");
}

#[test]
fn bad_files_fail_as_far_as_a_schema_can_tell() {
    let validator = validator(&[]);
    let mut surprises = Vec::new();
    let mut unused: Vec<&str> = BEYOND_A_SCHEMA.iter().map(|(start, _)| *start).collect();
    let bad = files("fixtures/bad", "lipz");
    for path in &bad {
        let name = PathBuf::from(path).file_stem().unwrap().to_str().unwrap().to_owned();
        let exempt = BEYOND_A_SCHEMA.iter().find(|(start, _)| name.starts_with(start));
        unused.retain(|start| exempt.is_none_or(|(used, _)| start != used));
        let exempt = exempt.filter(|_| !FOUND_ALL_THE_SAME.contains(&name.as_str()));
        match (fault(&validator, &repository().join(path)), exempt) {
            (None, None) => {
                surprises.push(format!("{name} passes: if no schema can see why it is bad, BEYOND_A_SCHEMA says so"));
            }
            (Some(fault), Some((_, why))) => surprises.push(format!("{name} fails, although {why}: {fault}")),
            _ => {}
        }
    }
    assert_eq!(surprises, Vec::<String>::new());
    assert_eq!(unused, Vec::<&str>::new(), "no fixture has this name any more");
}

#[test]
fn extended_locales_pass_with_their_flag() {
    let (plain, extended) = (validator(&[]), validator(&["--extended-locales"]));
    for tag in ["es-419", "zh-hant", "zh-hant-tw", "de", "sl-rozaj-biske"] {
        let file = serde_json::json!({ format!("text_{tag}"): "" });
        assert_eq!((plain.is_valid(&file), extended.is_valid(&file)), (false, true), "{tag}");
        let also = lipz_file::locale::canonical_tag(tag, true);
        assert_eq!(also.as_deref(), Some(tag), "the checks accept it, too");
    }
    for name in ["text_en-US", "text-en-us", "text_", "text", "text_e", "text_deutsch-de"] {
        assert!(!extended.is_valid(&serde_json::json!({ name: "" })), "{name}");
    }
}

#[test]
fn the_published_copy_is_current() {
    let mut comparison = Comparison::default();
    comparison.compare("docs/lipz.schema.json", &lipz(&repository(), ["schema"]).stdout);
    comparison.finish(1);
    assert_eq!(schema(&[])["$id"], lipz_file::schema::ID);
}
