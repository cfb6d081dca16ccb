//! Packs and unpacks files.

use crate::dialogue;
use crate::exercise::verified_is_whole;
use lipz_bank::Bank;
use lipz_compiler::{Compiler, Documents, Input, Options};
use lipz_diagnostics::{Code, Severity};

/// Separates files in the input, because no Lipz file contains this byte.
const SEPARATOR: u8 = 0;

/// Splits the bytes into up to four files, and packs those without errors. Unpacking restores each element, and packing
/// again makes the same bank.
pub fn round_trip(bytes: &[u8]) {
    let joined = [(Code::SegmentCount, Some(Severity::Warning))];
    let options = Options::new().default_locale("en-us").expect("a locale").levels(joined);
    let files = bytes.split(|byte| *byte == SEPARATOR).take(4);
    let input = |(number, file): (usize, &[u8])| Input::from_bytes(format!("clip-{number}"), file);
    let is_good = |file: &&[u8]| Compiler::new(options.clone()).compile(&[input((0, file))]).bank.is_some();
    let good: Vec<&[u8]> = files.filter(is_good).collect();

    let inputs: Vec<Input> = good.iter().copied().enumerate().map(input).collect();
    let packed = Compiler::new(options.clone()).compile(&inputs).bank.expect("files without errors");
    let bank = Bank::open(&packed).and_then(Bank::verify).expect("what the compiler made");
    verified_is_whole(&bank);

    dialogue!(dialogue = &packed);
    let documents = Documents::from_dialogue(&dialogue).expect("the sources are in the bank");
    let mut unpacked = Vec::new();
    for (file, document) in good.iter().zip(documents.iter()) {
        let (key, document) = document.expect("a source record of the compiler");
        assert_eq!(Some(&document), lipz_file::parse(file).document.as_ref(), "{key}");
        unpacked.push(Input::from_bytes(key, lipz_file::write(&document)));
    }
    assert_eq!(unpacked.len(), good.len());
    assert_eq!(Compiler::new(options.clone()).compile(&unpacked).bank.as_ref(), Some(&packed), "packed again");
}
