//! Same input, same bytes: for any order of files, number of threads, and folder.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

mod support;

use lipz_compiler::{Compiler, Input, Options, Voices, discover};
use std::path::Path;

fn bank(inputs: &[Input], threads: usize) -> Vec<u8> {
    let options = Options::new().threads(threads).default_locale("en-us").unwrap();
    Compiler::new(options.clone()).compile(inputs).bank.unwrap()
}

#[test]
fn shuffled_inputs_and_any_number_of_threads() {
    let mut inputs = discover(&[support::folder("drama")], None).unwrap();
    let expected = bank(&inputs, 1);
    for threads in 1..=8 {
        // Deal the files like cards, in a different order each time.
        let middle = inputs.split_off(inputs.len() / 2);
        inputs = middle.into_iter().zip(inputs).flat_map(|(a, b)| [a, b]).collect();
        assert_eq!(inputs.len(), 48);
        assert!(bank(&inputs, threads) == expected, "{threads} threads");
    }
    inputs.reverse();
    assert!(bank(&inputs, 3) == expected);
}

#[test]
fn another_folder() {
    let expected = bank(&discover(&[support::folder("drama")], None).unwrap(), 2);
    let elsewhere = tempfile::tempdir().unwrap();
    let copy = elsewhere.path().join("a folder with blanks, ü and 日本");
    for (key, bytes) in support::files("drama") {
        let path = copy.join(format!("{key}.lipz"));
        std::fs::create_dir_all(path.parent().unwrap_or(Path::new(""))).unwrap();
        std::fs::write(path, bytes).unwrap();
    }
    assert!(bank(&discover(std::slice::from_ref(&copy), None).unwrap(), 2) == expected);
    // Through a pattern, and through files of two folders with a common root.
    let pattern = copy.join("**/*.lipz");
    assert!(bank(&discover(&[pattern], None).unwrap(), 2) == expected);
    let acts = ["act3", "act1", "act2"].map(|act| copy.join(act));
    assert!(bank(&discover(&acts, Some(&copy)).unwrap(), 2) == expected);
}

#[test]
fn one_changed_character_changes_the_bank() {
    let mut files = support::files("drama");
    let pack = |files: &[(String, Vec<u8>)]| {
        let inputs: Vec<_> = files.iter().map(|(key, bytes)| Input::from_bytes(key, bytes.clone())).collect();
        bank(&inputs, 2)
    };
    let before = pack(&files);
    let text = String::from_utf8(files[3].1.clone()).unwrap();
    files[3].1 = text.replacen('.', "!", 1).into_bytes();
    assert!(pack(&files) != before);
}

/// Returns files of every kind that a bank treats differently: dubs, fallbacks, equal and empty texts, with and without
/// events.
fn all_kinds() -> Vec<Input> {
    let file = |number: usize| {
        let mut elements = vec![r#""viseme_type":"blair""#.to_owned()];
        if !number.is_multiple_of(11) {
            elements.push(format!(r#""fps":{},"visemes":"{}|E-""#, 24 + number % 2, "MA".repeat(number % 40)));
        }
        if number.is_multiple_of(2) {
            elements.push(format!(r#""events":"feels joy {}|""#, number % 9));
        }
        for (at, tag) in ["en-us", "de-de", "pt-br", "pt-pt"].iter().enumerate() {
            let text = match (number + at) % 5 {
                0 => continue,
                1 => "Aye. |".to_owned(),
                2 => "|ü".to_owned(),
                _ => format!("{tag} {}|日本 {number}", "word ".repeat(number % 70)),
            };
            elements.push(format!(r#""text_{tag}":"{text}""#));
        }
        format!("{{{}}}", elements.join(","))
    };
    let key = |number: usize| match number % 10 {
        7 => format!("{}.de", number - 1),
        _ => number.to_string(),
    };
    (0..600).map(|number| Input::from_bytes(key(number), file(number))).collect()
}

#[test]
fn a_bank_is_the_same_in_memory_and_in_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("b.lipzbank");
    let voices = Voices::new("en-us").unwrap().dub("en-us", "{key}").unwrap().dub("de-de", "{key}.de").unwrap();
    for inputs in [all_kinds(), Vec::new()] {
        for (threads, strip) in [1, 2, 8].into_iter().flat_map(|threads| [(threads, false), (threads, true)]) {
            let options =
                Options::new().threads(threads).strip(strip).default_locale("en-us").unwrap().voices(voices.clone());
            let compiler = Compiler::new(options);
            let compiled = compiler.compile(&inputs);
            let packed = compiler.pack(&inputs, &path);
            let texts =
                |reports: &[lipz_diagnostics::Report]| -> Vec<_> { reports.iter().map(ToString::to_string).collect() };
            assert_eq!(texts(&packed.reports), texts(&compiled.reports));
            let (bank, file) = (compiled.bank.unwrap(), packed.bank.unwrap());
            assert!(file.length_bytes == bank.len() && std::fs::read(&path).unwrap() == bank, "{threads} threads");
            assert!(
                lipz_bank::Bank::open(&bank).unwrap().verify().unwrap().voices().next().is_some() || inputs.is_empty()
            );
        }
    }
}
