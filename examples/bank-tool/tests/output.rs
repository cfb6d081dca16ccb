//! The output of the example, compared with `expected.txt`.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::path::Path;
use std::process::{Command, Output};

fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_bank-tool")).args(arguments).output().unwrap()
}

#[test]
fn output_is_as_expected() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/drama");
    let bank = path("drama.lipzbank");
    let mut printed = String::new();
    for arguments in [
        &["pack", fixtures.to_str().unwrap(), "-o", &bank][..],
        &["verify", &bank],
        &["inspect", &bank, "act1/mara-good-evening"],
    ] {
        let output = run(arguments);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        printed.push_str(&String::from_utf8(output.stdout).unwrap());
    }
    let printed = printed.replace(folder.path().to_str().unwrap(), "…");
    assert_eq!(printed.replace('\\', "/"), include_str!("../expected.txt"));
    let missing = run(&["inspect", &bank, "act1/nobody"]);
    assert_eq!(missing.status.code(), Some(1));
    assert!(String::from_utf8(missing.stderr).unwrap().contains("no clip `act1/nobody`"));
    assert_eq!(run(&["pack"]).status.code(), Some(2));
}
