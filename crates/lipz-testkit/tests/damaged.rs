//! The damaged banks of fixtures/banks/damaged.txt, opened by the reader in Rust. `LIPZ_BLESS=1` writes its answers.
//!
//! The readers in `packages/` open the same banks, and must find the same damage at the same byte.
#![allow(clippy::expect_used, clippy::panic)]

use lipz_bank::{Bank, Error};
use lipz_layout::Tag;
use lipz_testkit::exercise::{Effort, provoke};
use lipz_testkit::golden::{entry_of, put, reseal, section};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

fn banks() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/banks")
}

fn read(file: &str) -> Vec<u8> {
    fs::read(banks().join("v1").join(file)).expect("a golden bank")
}

/// An undamaged bank, and the commands that damage it.
#[derive(Default)]
struct Case {
    bank: Vec<u8>,
    damage: Vec<String>,
}

impl Case {
    /// The damaged copy of a file.
    fn damaged(&self, file: &[u8]) -> Vec<u8> {
        let mut bytes = file.to_vec();
        for line in &self.damage {
            let words: Vec<&str> = line.split(' ').collect();
            match words[..] {
                ["cut", length] => bytes.truncate(number(length)),
                ["append", hex] => bytes.extend(bytes_of(hex)),
                ["put", at, hex] => put(&mut bytes, number(at), bytes_of(hex)),
                ["section", tag, at, hex] => {
                    put(&mut bytes, section(file, tag_of(tag)).start + number(at), bytes_of(hex));
                }
                ["entry", tag, at, hex] => put(&mut bytes, entry_of(file, tag_of(tag)) + number(at), bytes_of(hex)),
                ["seal"] => reseal(&mut bytes),
                _ => panic!("`{line}` is not a command"),
            }
        }
        bytes
    }

    /// The answer of a command that opens, or `None` for one that damages.
    fn answer(&self, words: &[&str]) -> Option<String> {
        let bytes = self.damaged(&self.bank);
        match *words {
            ["open"] => {
                provoke(&bytes, Effort::All);
                Some(said(Bank::open(&bytes).map(|_| "opens")))
            }
            ["verify"] => Some(said(Bank::open(&bytes).and_then(Bank::verify).map(|_| "verified"))),
            ["texts", name] => {
                let texts = self.damaged(&read(&format!("{name}.lipztexts")));
                let mut bank = Bank::open(&self.bank).expect("an undamaged bank");
                Some(said(bank.open_texts_unverified(&texts).map(|()| "opens")))
            }
            ["each-byte"] => Some(each_byte(bytes)),
            _ => None,
        }
    }
}

fn number(word: &str) -> usize {
    word.parse().unwrap_or_else(|_| panic!("`{word}` is not a number"))
}

fn bytes_of(hex: &str) -> Vec<u8> {
    let pairs = (0..hex.len()).step_by(2).map(|at| u8::from_str_radix(&hex[at..at + 2], 16));
    pairs.map(|byte| byte.expect("hexadecimal digits")).collect()
}

fn tag_of(tag: &str) -> Tag {
    Tag(tag.as_bytes().try_into().expect("four letters"))
}

fn said(result: Result<&str, Error>) -> String {
    match result {
        Ok(fine) => fine.to_owned(),
        Err(error) => format!("{:?} at {}", error.kind(), error.offset_bytes()),
    }
}

/// Opens a bank with each of its bytes changed.
fn each_byte(mut bytes: Vec<u8>) -> String {
    let (mut opened, mut refused, mut lines) = (0, 0, String::new());
    for at in 0..bytes.len() {
        bytes[at] ^= 0xFF;
        provoke(&bytes, Effort::Few);
        match Bank::open(&bytes) {
            Ok(_) => opened += 1,
            refusal => {
                refused += 1;
                writeln!(lines, "{at}: {}", said(refusal.map(|_| ""))).expect("a string takes everything");
            }
        }
        bytes[at] ^= 0xFF;
    }
    let hash = lines
        .bytes()
        .fold(0xCBF2_9CE4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3));
    format!("{opened} open, {refused} refused, fnv {hash:016x}")
}

/// Returns the file with the answers of the reader.
fn answers(file: &str) -> String {
    let (mut case, mut answers) = (Case::default(), String::new());
    for line in file.lines().filter(|line| !line.starts_with("  ")) {
        writeln!(answers, "{line}").expect("a string takes everything");
        let words: Vec<&str> = line.split(' ').collect();
        match words[..] {
            [""] | ["#" | "##" | "needs", ..] => {}
            ["bank", name] => case = Case { bank: read(&format!("{name}.lipzbank")), damage: Vec::new() },
            _ => match case.answer(&words) {
                Some(answer) => writeln!(answers, "  {answer}").expect("a string takes everything"),
                None => case.damage.push(line.to_owned()),
            },
        }
    }
    answers
}

#[test]
fn the_reader_finds_the_damage() {
    let path = banks().join("damaged.txt");
    let expected = fs::read_to_string(&path).expect("the damaged banks");
    let answers = answers(&expected);
    if std::env::var_os("LIPZ_BLESS").is_some() {
        fs::write(&path, &answers).expect("the file can be written");
        return;
    }
    let different = answers.lines().zip(expected.lines()).position(|(found, said)| found != said);
    let lines = different.map(|at| (at + 1, answers.lines().nth(at), expected.lines().nth(at)));
    assert!(answers == expected, "damaged.txt: {lines:?}");
}
