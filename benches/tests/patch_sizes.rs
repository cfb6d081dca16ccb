//! The lengths of patches for several changes: the table of docs/guides/patches.md.
#![allow(clippy::expect_used, clippy::panic, reason = "tests")]

use lipz_benches::files;
use lipz_compiler::{Compiler, Input, Options, Stack, StackBelow};

const PAGE: &str = include_str!("../../docs/guides/patches.md");
const CLIPS: usize = 2_000;
const LOCALES: usize = 5;

/// A change to the first clips of a project.
type Change = fn(&str) -> Option<String>;

const CHANGES: [(&str, Change); 3] = [
    // One more frame.
    ("the mouth shapes of", |json| Some(json.replacen("\"visemes\": \"", "\"visemes\": \"-", 1))),
    ("a text of", |json| Some(json.replacen("\"text_en-us\": \"", "\"text_en-us\": \"So: ", 1))),
    ("removal of", |_| None),
];

#[test]
fn a_patch_is_as_long_as_its_change() {
    let compiler = Compiler::new(Options::new().strip(true));
    let files = files(CLIPS, LOCALES);
    let inputs = |change: Change, count: usize| -> Vec<Input> {
        let now = |(index, (key, json)): (usize, &(String, String))| {
            Some(Input::from_bytes(key, if index < count { change(json)? } else { json.clone() }))
        };
        files.iter().enumerate().filter_map(now).collect()
    };
    let bank = compiler.compile(&inputs(|_| None, 0)).into_bank().expect("files without errors");
    let length = |change: Change, count: usize| {
        let over = StackBelow::new(Stack::open([("base", bank.as_slice())]).expect("a bank"));
        compiler.compile_over(&inputs(change, count), &over).into_bank().expect("files without errors").len()
    };
    for (name, change) in CHANGES {
        let [one, ten, hundred, thousand] = [1, 10, 100, 1_000].map(|count| length(change, count));
        // The second ten clips cost as much as the first, and so on, except for differences in the lengths of the
        // clips.
        for (few, many) in [(ten - one, hundred - ten), (hundred - ten, thousand - hundred)] {
            assert!(many < 13 * few, "{name}: {one} {ten} {hundred} {thousand}");
        }
        let row = format!("| {name} so many clips | {one} | {ten} | {hundred} | {thousand} |");
        assert!(PAGE.contains(&row), "docs/guides/patches.md lacks\n{row}");
    }
    assert!(PAGE.contains(&format!("a bank of {} bytes", bank.len())), "docs/guides/patches.md: {} bytes", bank.len());
}
