//! The output of the example, compared with `expected.txt`.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::process::Command;

#[test]
fn output_is_as_expected() {
    let output = Command::new(env!("CARGO_BIN_EXE_patch-and-text-bank")).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(String::from_utf8(output.stdout).unwrap(), include_str!("../expected.txt"));
}
