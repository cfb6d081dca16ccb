//! A task whose tools are missing ends with an error that names them. Only `cargo xtask ci` skips it.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::process::{Command, Output};

/// Runs a task where no program can be found.
fn editors(variables: &[(&str, &str)]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_xtask"));
    command.arg("editors").env("PATH", "").env_remove("CI").env_remove("LIPZ_XTASK_STEP");
    command.envs(variables.iter().copied()).output().unwrap()
}

#[test]
fn named_tasks_do_not_end_well_with_nothing_done() {
    let alone = editors(&[]);
    assert!(!alone.status.success());
    let message = String::from_utf8(alone.stderr).unwrap();
    assert!(message.contains("nothing is done, because this needs nvim"), "{message}");
    let step = editors(&[("LIPZ_XTASK_STEP", "1")]);
    assert!(step.status.success() && step.stdout.starts_with(b"skipped: needs nvim"), "{step:?}");
    assert!(!editors(&[("LIPZ_XTASK_STEP", "1"), ("CI", "true")]).status.success());
}
