//! The Lipz files below `fixtures/`: the output of `lipz check` about the bad ones is as expected, the good ones are
//! clean, and every diagnostic code is covered.
//!
//! `NAME.expected` next to a bad file contains standard error and the exit code. `LIPZ_BLESS=1` writes these files
//! again.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

mod support;

use lipz_diagnostics::Code;
use std::collections::BTreeSet;
use std::fs;
use support::{Comparison, files, is_blessing, lipz, repository};

/// Checks every Lipz file in `folder`, with the arguments in `NAME.flags` if that file exists.
fn compare_folder(folder: &str, at_least: usize) {
    let repository = repository();
    let mut comparison = Comparison::default();
    for file in files(folder, "lipz") {
        let base = file.strip_suffix(".lipz").unwrap();
        let flags = fs::read_to_string(repository.join(format!("{base}.flags"))).unwrap_or_default();
        let arguments = ["check", "--quiet"].into_iter().chain(flags.lines()).chain([file.as_str()]);
        let outcome = lipz(&repository, arguments);
        assert_eq!(outcome.stdout, "", "{file}: --quiet leaves standard output empty");
        comparison.compare(&format!("{base}.expected"), &outcome.expectation());
    }
    comparison.finish(at_least);
}

#[test]
fn bad_files() {
    compare_folder("fixtures/bad", 140);
}

#[test]
fn bad_files_with_flags() {
    compare_folder("fixtures/bad/with-flags", 11);
}

#[test]
fn bad_settings() {
    let repository = repository();
    let mut comparison = Comparison::default();
    for file in files("fixtures/bad/settings", "toml") {
        // Wrong settings end the run before any source is read.
        let outcome = lipz(&repository, ["check", "nowhere", "--config", &file]);
        assert_eq!(outcome.stdout, "", "{file}");
        comparison.compare(&file.replace(".toml", ".expected"), &outcome.expectation());
    }
    comparison.finish(10);
}

#[test]
fn bad_viewer_settings() {
    let repository = repository();
    let mut comparison = Comparison::default();
    for file in files("fixtures/bad/viewer", "xml") {
        let outcome = lipz(&repository, ["print", "babble", &file]);
        assert_eq!(outcome.stdout.is_empty(), outcome.code == 1, "{file}");
        comparison.compare(&file.replace(".xml", ".expected"), &outcome.expectation());
    }
    comparison.finish(6);
}

#[test]
fn examples_of_the_specification_as_printed() {
    compare_folder("fixtures/spec/as-printed", 8);
}

#[test]
fn good_files_have_no_diagnostics_but_two() {
    let repository = repository();
    let acts = ["act1", "act2", "act3"].map(|act| format!("fixtures/drama/{act}"));
    let count: usize = acts.iter().map(|act| files(act, "lipz").len()).sum();
    assert_eq!(count, 48, "the number in fixtures/drama/README.md");
    let drama = lipz(&repository, ["check", "fixtures/drama"]);
    assert_eq!((drama.code, drama.stdout.lines().next()), (0, Some("48 files checked")), "{}", drama.stderr);
    let diagnostics: Vec<&str> = drama.stderr.lines().filter(|line| line.contains("[LZ")).collect();
    assert_eq!(diagnostics.len(), 2, "{}", drama.stderr);
    assert!(diagnostics[0].starts_with("warning[LZ0203]"), "{}", drama.stderr);
    assert!(drama.stderr.contains("--> fixtures/drama/act2/otto-confession.lipz:"), "{}", drama.stderr);
    assert!(diagnostics[1].starts_with("warning[LZ0515]"), "{}", drama.stderr);
    assert!(drama.stderr.contains("--> fixtures/drama/act3/ivo-by-hand.lipz:"), "{}", drama.stderr);

    assert_eq!(files("fixtures/spec/repaired", "lipz").len(), 8);
    let examples = lipz(&repository, ["check", "fixtures/spec/repaired"]);
    // `nervous` is in two of the specification's own examples, but not in its list.
    let diagnostics: Vec<&str> = examples.stderr.lines().filter(|line| line.contains("[LZ")).collect();
    assert_eq!(diagnostics, ["warning[LZ0702]: `nervous` is not a known emotion"; 3]);
    assert_eq!((examples.code, examples.stdout.as_str()), (0, "8 files checked\n"));
}

#[test]
fn repaired_examples_are_those_that_were_printed() {
    let names = |folder| files(folder, "lipz").iter().map(|path| path.rsplit('/').next().unwrap().to_owned()).collect();
    let printed: Vec<String> = names("fixtures/spec/as-printed");
    let repaired: Vec<String> = names("fixtures/spec/repaired");
    assert_eq!(printed, repaired);
}

/// Returns the text of every `.expected` file with its path.
fn expectations() -> Vec<(String, String)> {
    let folders = [
        "fixtures/bad",
        "fixtures/bad/with-flags",
        "fixtures/bad/generated",
        "fixtures/bad/settings",
        "fixtures/bad/viewer",
        "fixtures/spec/as-printed",
    ];
    let paths = folders.into_iter().flat_map(|folder| files(folder, "expected"));
    paths
        .map(|path| (fs::read_to_string(repository().join(&path)).unwrap(), path))
        .map(|(text, path)| (path, text))
        .collect()
}

/// Returns the codes in a text: `LZ0401` for `error[LZ0401]: …`.
fn codes(text: &str) -> BTreeSet<&str> {
    let after = text.lines().filter_map(|line| {
        let rest = line.strip_prefix("error[").or_else(|| line.strip_prefix("warning["))?;
        rest.split_once(']')
    });
    after.map(|(code, _)| code).collect()
}

#[test]
fn every_code_is_expected_somewhere() {
    if is_blessing() {
        return; // the files are being written
    }
    let expectations = expectations();
    let seen: BTreeSet<&str> = expectations.iter().flat_map(|(_, text)| codes(text)).collect();
    let missing: Vec<String> = Code::ALL
        .iter()
        .filter(|code| !seen.contains(code.number()))
        .map(|code| format!("{code} {}: {}", code.name(), code.summary()))
        .collect();
    assert!(missing.is_empty(), "no bad fixture shows\n{}", missing.join("\n"));
    let known: BTreeSet<&str> = Code::ALL.iter().map(|code| code.number()).collect();
    let unknown: Vec<_> = seen.difference(&known).collect();
    assert!(unknown.is_empty(), "codes that are not registered: {unknown:?}");
}

#[test]
fn every_bad_file_shows_the_code_that_it_is_named_after() {
    if is_blessing() {
        return; // the files are being written
    }
    let mut wrong = Vec::new();
    for (path, text) in expectations() {
        let name = path.rsplit('/').next().unwrap();
        let Some(number) = name.get(..6).filter(|number| number.starts_with("LZ")) else { continue };
        if !codes(&text).contains(number) {
            wrong.push(format!("{path} shows {:?}", codes(&text)));
        }
        let known = Code::ALL.iter().find(|code| code.number() == number);
        let known = known.unwrap_or_else(|| panic!("{path}: {number} is not a code"));
        let slug = &name[7..];
        assert!(slug.starts_with(known.name()), "{path} is not named {number}-{}", known.name());
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_expectation_has_its_file() {
    let folders =
        ["fixtures/bad", "fixtures/bad/with-flags", "fixtures/spec/as-printed"].map(|folder| (folder, "lipz"));
    for (folder, kind) in folders.into_iter().chain([("fixtures/bad/settings", "toml"), ("fixtures/bad/viewer", "xml")])
    {
        for extension in ["expected", "flags"] {
            for path in files(folder, extension) {
                let source = format!("{}.{kind}", path.strip_suffix(&format!(".{extension}")).unwrap());
                assert!(repository().join(&source).is_file(), "{path} belongs to {source}, which does not exist");
            }
        }
    }
}
