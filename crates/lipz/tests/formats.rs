//! Diagnostics in the formats for programs: complete documents that are valid for any diagnostics, and the only output
//! on standard output.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use lipz_diagnostics::Code;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use support::{Scene, assert_sarif, lipz, repository, sarif_schema};

/// Returns the document that the command prints, and its exit code. Standard error stays empty.
fn document(scene: &Scene, arguments: &[&str]) -> (Value, i32) {
    let outcome = lipz(scene.path(), arguments);
    assert_eq!(outcome.stderr, "", "{arguments:?}");
    let value = serde_json::from_str(&outcome.stdout).unwrap_or_else(|error| unreachable!("{arguments:?}: {error}"));
    (value, outcome.code)
}

/// Returns the output of `lipz check` for all bad files of the repository.
fn bad_files(format: &str) -> String {
    let outcome = lipz(&repository(), ["check", "fixtures/bad", "fixtures/spec/as-printed", "--output-format", format]);
    assert_eq!((outcome.code, outcome.stderr.as_str()), (1, ""), "{format}");
    outcome.stdout
}

fn list<'v>(value: &'v Value, pointer: &str) -> &'v Vec<Value> {
    value.pointer(pointer).and_then(Value::as_array).unwrap()
}

#[test]
fn all_formats_have_all_diagnostics() {
    let json: Value = serde_json::from_str(&bad_files("json")).unwrap();
    let diagnostics = list(&json, "/diagnostics");
    assert!(diagnostics.len() > 200, "{} diagnostics", diagnostics.len());
    assert_eq!(json["errors"].as_u64().unwrap() + json["warnings"].as_u64().unwrap(), diagnostics.len() as u64);
    let codes: BTreeSet<&str> = diagnostics.iter().map(|found| found["code"].as_str().unwrap()).collect();
    assert!(codes.len() > 30, "{codes:?}");

    let sarif: Value = serde_json::from_str(&bad_files("sarif")).unwrap();
    assert_sarif(&sarif);
    let results = list(&sarif, "/runs/0/results");
    let rules = list(&sarif, "/runs/0/tool/driver/rules");
    assert_eq!(rules.len(), codes.len());
    assert_eq!(results.len(), diagnostics.len());
    for (result, found) in results.iter().zip(diagnostics) {
        let rule = &rules[usize::try_from(result["ruleIndex"].as_u64().unwrap()).unwrap()];
        assert_eq!((&rule["id"], &rule["name"]), (&found["code"], &found["name"]));
        assert_eq!((&result["ruleId"], &result["level"]), (&found["code"], &found["severity"]));
        let region = &result["locations"][0]["physicalLocation"]["region"];
        assert_eq!(region.get("startColumn"), found["span"]["start"].get("column"), "{found}");
        assert_eq!(region.get("endLine"), found["span"]["end"].get("line"), "{found}");
        assert_eq!(result.get("fixes").is_some(), !found["fix"].is_null(), "{found}");
    }

    let github = bad_files("github");
    let (annotations, rest): (Vec<&str>, Vec<&str>) =
        github.lines().partition(|line| line.starts_with("::error file=") || line.starts_with("::warning file="));
    assert_eq!((annotations.len(), rest.len()), (diagnostics.len(), 0), "{rest:?}");

    let gitlab: Value = serde_json::from_str(&bad_files("gitlab")).unwrap();
    let violations = list(&gitlab, "");
    assert_eq!(violations.len(), diagnostics.len());
    let fingerprints: BTreeSet<&str> = violations.iter().map(|one| one["fingerprint"].as_str().unwrap()).collect();
    assert_eq!(fingerprints.len(), violations.len(), "each has its own");

    let concise = bad_files("concise");
    assert_eq!(concise.lines().count(), diagnostics.len());
    let fixes: Vec<&str> = diagnostics.iter().filter_map(|found| found["fix"]["applicability"].as_str()).collect();
    let count = |applicability| fixes.iter().filter(|one| **one == applicability).count();
    let (fixable, offered) = (count("machine-applicable"), count("maybe-incorrect"));
    assert!(offered > 10 && fixable + offered == fixes.len(), "{fixable} and {offered} of {}", fixes.len());
    assert_eq!(concise.lines().filter(|line| line.ends_with(" [fixable]")).count(), fixable);

    let junit = bad_files("junit");
    let report = roxmltree::Document::parse(&junit).unwrap();
    let count = |name| report.descendants().filter(|node| node.has_tag_name(name)).count() as u64;
    assert_eq!(
        (Some(count("failure")), Some(count("system-out"))),
        (json["errors"].as_u64(), json["warnings"].as_u64())
    );
    assert_eq!(count("testcase"), diagnostics.len() as u64);
}

#[test]
fn rules_are_counted() {
    let json: Value = serde_json::from_str(&bad_files("json")).unwrap();
    let arguments = ["check", "fixtures/bad", "fixtures/spec/as-printed", "--show", "stats"];
    let counted = lipz(&repository(), arguments.iter().chain(&["--output-format", "json"]));
    assert!(counted.code == 1 && counted.stderr == bad_files("json"), "the document is complete");
    let rows: Value = serde_json::from_str(&counted.stdout).unwrap();
    let counts = list(&rows, "").iter().map(|row| row["count"].as_u64().unwrap());
    assert!(counts.clone().is_sorted_by(|a, b| a >= b), "{rows}");
    assert_eq!(Some(counts.sum()), json["errors"].as_u64().zip(json["warnings"].as_u64()).map(|(a, b)| a + b));
    let table = lipz(&repository(), arguments);
    assert_eq!(table.code, 1);
    assert_eq!(table.stdout.lines().count(), list(&rows, "").len() + 1);
    let junit = lipz(&repository(), arguments.iter().chain(&["--output-format", "junit"]));
    assert!(junit.stdout == table.stdout && junit.stderr == bad_files("junit"), "the report is complete");
    let clean = lipz(&repository(), ["check", "fixtures/drama/act1", "--show", "stats"]);
    assert_eq!((clean.stdout.as_str(), clean.code), ("no diagnostics\n", 0));
}

#[test]
fn every_field_of_the_json_is_documented() {
    let json: Value = serde_json::from_str(&bad_files("json")).unwrap();
    let page = fs::read_to_string(repository().join("docs/reference/diagnostics.md")).unwrap();
    let fixed =
        list(&json, "/diagnostics").iter().find(|found| !found["fix"].is_null() && !found["span"].is_null()).unwrap();
    for object in [&json, fixed, &fixed["fix"], &fixed["span"], &fixed["span"]["start"]] {
        for field in object.as_object().unwrap().keys() {
            assert!(page.contains(&format!("`{field}`")), "{field}");
        }
    }
}

#[test]
fn places_in_json_are_those_of_the_file() {
    let json: Value = serde_json::from_str(&bad_files("json")).unwrap();
    let mut compared = 0;
    for found in list(&json, "/diagnostics") {
        let Ok(text) = fs::read_to_string(repository().join(found["path"].as_str().unwrap())) else { continue };
        let text = text.trim_start_matches('\u{feff}');
        for place in ["/span/start", "/span/end", "/fix/span/start", "/labels/0/span/end"] {
            let Some(place) = found.pointer(place) else { continue };
            let before = &text[..usize::try_from(place["offset_bytes"].as_u64().unwrap()).unwrap()];
            let line = before.split('\n').count();
            let column = before.rsplit('\n').next().unwrap().chars().count() + 1;
            assert_eq!((place["line"].as_u64(), place["column"].as_u64()), (Some(line as u64), Some(column as u64)));
            compared += 1;
        }
    }
    assert!(compared > 300, "{compared} places");
}

#[test]
fn a_fix_can_be_applied_by_its_place() {
    let scene = Scene::new();
    let text = "{\n  \"text_ja-jp\": \"灯台\", \"text-en_US\": \"Aye.\"\n}";
    scene.write("aye.lipz", text);
    let (json, _) = document(&scene, &["check", "aye.lipz", "--output-format", "json"]);
    let fix = &json["diagnostics"][0]["fix"];
    let offset = |end: &str| usize::try_from(fix["span"][end]["offset_bytes"].as_u64().unwrap()).unwrap();
    let mut fixed = text.to_owned();
    fixed.replace_range(offset("start")..offset("end"), fix["replacement"].as_str().unwrap());
    assert_eq!(fixed, text.replace("text-en_US", "text_en-us"));
    let (sarif, _) = document(&scene, &["check", "aye.lipz", "--output-format", "sarif"]);
    let change = &sarif["runs"][0]["results"][0]["fixes"][0]["artifactChanges"][0];
    assert_eq!(change["artifactLocation"]["uri"], "aye.lipz");
    assert_eq!(change["replacements"][0]["insertedContent"]["text"], "\"text_en-us\"");
}

#[test]
fn every_command_prints_a_document_and_nothing_else() {
    let scene = Scene::new();
    scene.write("good/aye.lipz", r#"{ "fps": 24, "viseme_type": "blair", "visemes": "AE-" }"#);
    scene.write("bad/aye.lipz", r#"{ "viseme_type": "blair", "visemes": "x" }"#);
    scene.write("bad.lipzbank", "bad");
    scene.prepare(&["pack", "good", "-o", "good.lipzbank"]);
    let runs: [(&[&str], i32, &[Code]); 10] = [
        (&["check", "good"], 0, &[]),
        (&["check", "good", "--quiet"], 0, &[]),
        (&["check", "bad"], 1, &[Code::ForeignCode]),
        (&["check", "nowhere"], 2, &[Code::UnreadableFile]),
        (&["pack", "good", "-o", "new.lipzbank"], 0, &[]),
        (&["pack", "good", "-o", "bad.lipzbank/x"], 2, &[Code::OutputFailed]),
        (&["verify", "good.lipzbank", "--quiet"], 0, &[]),
        (&["verify", "bad.lipzbank", "good.lipzbank", "nowhere"], 2, &[Code::BankRefused, Code::BankRefused]),
        (&["unpack", "good.lipzbank", "-o", "out", "--quiet"], 0, &[]),
        (&["unpack", "good.lipzbank", "-o", "out"], 1, &[Code::WouldOverwrite]),
    ];
    let github = lipz(scene.path(), ["check", "good", "--output-format", "github"]);
    assert_eq!((github.code, github.stdout.as_str(), github.stderr.as_str()), (0, "", ""));
    for format in ["json", "sarif"] {
        // Files may remain from the previous format.
        let _ = fs::remove_dir_all(scene.path().join("out"));
        for (arguments, code, codes) in runs {
            let arguments = [arguments, &["--output-format", format]].concat();
            let (value, exit_code) = document(&scene, &arguments);
            assert_eq!(exit_code, code, "{arguments:?}");
            let (pointer, field) =
                if format == "json" { ("/diagnostics", "code") } else { ("/runs/0/results", "ruleId") };
            let found: Vec<&str> = list(&value, pointer).iter().map(|found| found[field].as_str().unwrap()).collect();
            assert_eq!(found, codes.iter().map(|code| code.number()).collect::<Vec<_>>(), "{arguments:?}");
            if format == "sarif" {
                assert_sarif(&value);
                assert_eq!(value["runs"][0]["invocations"][0]["executionSuccessful"], code != 2, "{arguments:?}");
            }
        }
    }
}

#[test]
fn results_keep_standard_output_for_themselves() {
    let scene = Scene::new();
    scene.write("good/aye.lipz", r#"{ "fps": 24, "visemes": "AE-", "text-en_us": "Aye." }"#);
    scene.write("bad.lipzbank", "bad");
    scene.prepare(&["pack", "good", "-o", "good.lipzbank"]);
    let runs: [(&[&str], &str, i32, &[Code]); 2] =
        [(&["inspect", "good.lipzbank"], "{", 0, &[]), (&["inspect", "bad.lipzbank"], "", 1, &[Code::BankRefused])];
    for (arguments, starts_with, code, codes) in runs {
        let outcome = lipz(scene.path(), [arguments, &["--output-format", "json"]].concat());
        assert_eq!(outcome.code, code, "{arguments:?}");
        assert!(outcome.stdout.starts_with(starts_with), "{arguments:?}: {}", outcome.stdout);
        assert_eq!(outcome.stdout.is_empty(), starts_with.is_empty(), "{arguments:?}");
        let json: Value = serde_json::from_str(&outcome.stderr).unwrap();
        let found: Vec<&str> =
            list(&json, "/diagnostics").iter().map(|found| found["code"].as_str().unwrap()).collect();
        assert_eq!(found, codes.iter().map(|code| code.number()).collect::<Vec<_>>(), "{arguments:?}");
    }
    let explained = lipz(scene.path(), ["explain", "LZ0401", "--output-format", "json"]);
    assert!(explained.stdout.starts_with("LZ0401 "), "{explained:?}");
    let json: Value = serde_json::from_str(&explained.stderr).unwrap();
    assert_eq!(list(&json, "/diagnostics").len(), 0, "{explained:?}");
}

#[test]
fn ten_thousand_equal_diagnostics_are_counted_for_people_only() {
    const FILES: usize = 10_000;
    let scene = Scene::new();
    for number in 0..FILES {
        scene.write(&format!("voices/{number:05}.lipz"), r#"{ "viseme_type": "blair", "visemes": "x" }"#);
    }
    let human = lipz(scene.path(), ["check", "voices"]);
    assert_eq!(human.stderr.matches("error[LZ0401]").count(), 100);
    assert!(human.stderr.contains("--> voices/00099.lipz:1:39\n"), "the first ones, in order");
    let closing: Vec<&str> = human.stderr.lines().rev().take(2).collect();
    assert_eq!(
        closing,
        [
            "10,000 errors in 10,000 files",
            "9,900 more LZ0401 (a viseme code is not valid in the clip's viseme type) in 9,900 files are not shown",
        ]
    );
    let (json, _) = document(&scene, &["check", "voices", "--output-format", "json"]);
    assert_eq!(list(&json, "/diagnostics").len(), FILES);
}

#[test]
fn the_schema_rejects_what_is_not_sarif() {
    let mut sarif: Value = serde_json::from_str(&bad_files("sarif")).unwrap();
    sarif["runs"][0]["results"][0]["severity"] = "fatal".into();
    assert!(!sarif_schema().is_valid(&sarif));
}
