//! Same input, same bytes: in any file order, with any number of threads, in any folder.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

mod support;

use lipz_compiler::{Compiler, Input, Options, discover};
use std::path::Path;

fn bank(inputs: &[Input], threads: usize) -> Vec<u8> {
    let options = Options::new().threads(threads).default_locale("en-us");
    Compiler::new(options.clone()).compile(inputs).bank.unwrap()
}

#[test]
fn shuffled_inputs_and_any_number_of_threads() {
    let (mut inputs, _) = discover(&[support::folder("drama")], None);
    let expected = bank(&inputs, 1);
    for threads in 1..=8 {
        // Deal the files like cards: another order each time.
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
    let expected = bank(&discover(&[support::folder("drama")], None).0, 2);
    let elsewhere = tempfile::tempdir().unwrap();
    let copy = elsewhere.path().join("a folder with blanks, ü and 日本");
    for (key, bytes) in support::files("drama") {
        let path = copy.join(format!("{key}.lipz"));
        std::fs::create_dir_all(path.parent().unwrap_or(Path::new(""))).unwrap();
        std::fs::write(path, bytes).unwrap();
    }
    assert!(bank(&discover(std::slice::from_ref(&copy), None).0, 2) == expected);
    // Through a pattern, and through files of two folders with a common root.
    let pattern = copy.join("**/*.lipz");
    assert!(bank(&discover(&[pattern], None).0, 2) == expected);
    let acts = ["act3", "act1", "act2"].map(|act| copy.join(act));
    assert!(bank(&discover(&acts, Some(&copy)).0, 2) == expected);
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
