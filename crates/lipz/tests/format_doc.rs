//! The examples of docs/reference/bank-format.md: the bytes on the page are the output of `lipz pack`.
//! (`crates/lipz-bank/tests/format_doc.rs` compares its tables.)
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test stops at the first surprise")]

mod support;

use std::fs;
use std::ops::Range;
use support::{Scene, lipz, repository};

/// Returns the contents of the fenced block with this info string.
fn block(page: &str, info: &str) -> String {
    let (_, rest) = page.split_once(&format!("\n```{info}\n")).unwrap_or_else(|| panic!("no block {info}"));
    rest.split_once("```").unwrap().0.to_owned()
}

/// Returns the bytes in a line: all words of two hexadecimal digits before the first two blanks.
fn bytes(line: &str) -> Vec<u8> {
    let listed = line.split("  ").next().unwrap_or_default();
    listed.split_whitespace().map(|byte| u8::from_str_radix(byte, 16).unwrap_or_else(|_| panic!("{line}"))).collect()
}

/// Returns the bank of a Lipz file `hi.lipz`.
fn pack(file: &str, flags: &[&str]) -> Vec<u8> {
    let scene = Scene::new();
    scene.write("hi.lipz", file);
    // As stated on the page, because a bank without curves is shorter.
    scene.write("lipz.toml", "[emotions]\ncurves = \"values\"\n");
    let run = lipz(scene.path(), ["pack", "hi.lipz", "-o", "hi.lipzbank"].iter().chain(flags));
    assert_eq!(run.code, 0, "{}", run.stderr);
    fs::read(scene.path().join("hi.lipzbank")).unwrap()
}

/// Returns the range of a section.
fn section(bank: &[u8], tag: &[u8; 4]) -> Range<usize> {
    let entry = bank[64..].chunks(16).find(|entry| entry.starts_with(tag)).unwrap();
    let number = |at: usize| u32::from_le_bytes(entry[at..at + 4].try_into().unwrap()) as usize;
    number(4)..number(4) + number(8)
}

#[test]
fn the_bank_that_the_page_walks_through() {
    let page = fs::read_to_string(repository().join("docs/reference/bank-format.md")).unwrap();
    let bank = pack(&block(&page, "json bank"), &["--config", "strip=true"]);
    let mut end = 0;
    for line in block(&page, "text bank").lines().filter(|line| !line.starts_with('#')) {
        let (offset, rest) = line.split_once("  ").unwrap();
        let start = usize::from_str_radix(offset, 16).unwrap();
        assert!(start >= end, "{line}: in order");
        assert!(bank[end..start].iter().all(|&byte| byte == 0), "{line}: a byte before it is not zero");
        let shown = bytes(rest);
        end = start + shown.len();
        assert_eq!(bank.get(start..end), Some(shown.as_slice()), "{line}");
    }
    assert_eq!(end, bank.len());
    assert!(page.contains(&format!("becomes a bank of {},{:03} bytes", end / 1000, end % 1000)));
}

#[test]
fn the_source_record_that_the_page_shows() {
    let page = fs::read_to_string(repository().join("docs/reference/bank-format.md")).unwrap();
    let bank = pack(&block(&page, "json source"), &["--quiet"]);
    let shown: Vec<u8> = block(&page, "text source").lines().flat_map(bytes).collect();
    assert_eq!(&bank[section(&bank, b"SRCE")], shown);
    assert_eq!(bank[section(&bank, b"SRCX")], [0; 4]);
}
