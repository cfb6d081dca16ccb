//! The JSON Schema is valid, accepts every good Lipz file, and rejects the bad ones as far as a schema can.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use jsonschema::Validator;
use lipz_diagnostics::Code;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use support::{Comparison, files, lipz, repository, tree};

/// Files for rules beyond a schema, with a second fault that the schema finds.
const WITH_SECOND_FAULT: &[&str] = &[
    "LZ0203-unknown-element-nested-deep",
    "LZ0504-unknown-locale-misspelt",
    "LZ0601-segment-count-visemes-damage-and-more",
];

/// The start of the line in which a rule's page states why a schema cannot express the rule.
const BEYOND_A_SCHEMA: &str = "**Editors.** The JSON Schema does not report this: ";

fn is_beyond_a_schema(code: &str) -> bool {
    code.parse::<Code>().is_ok_and(|code| code.page().contains(BEYOND_A_SCHEMA))
}

fn schema(flags: &[&str]) -> Value {
    let printed = lipz(&repository(), ["print", "schema"].iter().chain(flags));
    assert_eq!((printed.code, printed.stderr.as_str()), (0, ""));
    serde_json::from_str(&printed.stdout).unwrap()
}

fn validator(flags: &[&str]) -> Validator {
    let schema = schema(flags);
    jsonschema::draft202012::meta::validate(&schema).unwrap();
    jsonschema::draft202012::new(&schema).unwrap()
}

/// Returns the error of the schema about a file, if there is one.
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
    for path in files("fixtures/bad", "lipz") {
        let name = PathBuf::from(&path).file_stem().unwrap().to_str().unwrap().to_owned();
        let is_beyond = is_beyond_a_schema(&name[..6]) && !WITH_SECOND_FAULT.contains(&name.as_str());
        match (fault(&validator, &repository().join(path)), is_beyond) {
            (None, false) => {
                surprises.push(format!("{name} passes, but its rule page has no line `{BEYOND_A_SCHEMA}`"));
            }
            (Some(fault), true) => surprises.push(format!("{name} fails, despite its rule page: {fault}")),
            _ => {}
        }
    }
    assert_eq!(surprises, Vec::<String>::new());
}

#[test]
fn extended_locales_pass_with_their_setting() {
    let (plain, extended) = (validator(&[]), validator(&["--config", "extended-locales=true"]));
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

/// Names of any length would let editors accept what `check` refuses.
#[test]
fn keys_of_variants_are_limited() {
    let plain = validator(&[]);
    let is_valid = |key: String| plain.is_valid(&serde_json::json!({ format!("text_en-us-x-{key}"): "" }));
    for count in 1..12 {
        let key = ["fem"; 12][..count].join("-");
        assert_eq!(is_valid(key.clone()), lipz_file::locale::is_variant_key(&key), "{key}");
    }
    for key in ["x", "masculine", "one-x-fem", "Few", "", "1", "a-", "few--fem"] {
        assert_eq!(is_valid(key.to_owned()), lipz_file::locale::is_variant_key(key), "{key}");
    }
}

#[test]
fn the_published_copy_is_current() {
    let mut comparison = Comparison::default();
    comparison.compare("docs/lipz.schema.json", &lipz(&repository(), ["print", "schema"]).stdout);
    comparison.finish(1);
    assert_eq!(schema(&[])["$id"], lipz_file::schema::ID);
}
