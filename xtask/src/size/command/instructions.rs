//! The instructions of `sync` and `pack`, compared with those of the profile `release`, which is not optimised for size.

use crate::Failure;
use crate::paths::{temporary_folder, workspace_root};
use std::fs;
use std::path::Path;
use std::process::Command;

/// Instructions of the profile `release` on x86-64 with Rust 1.95. After changes to the code, measure both profiles.
const RELEASE: [(&str, u64); 2] = [("sync", 143_251_104), ("pack", 12_195_066)];

/// The most instructions, in percent of those of `release`.
const MOST_PERCENT: u64 = 103;

/// The recording with its transcript, and the dialogue to pack.
const RECORDING: &str = "fixtures/speech/bobby.wav";
const TRANSCRIPT: &str = "Bobby ripped the ledger.";
const DIALOGUE: &str = "fixtures/drama";

/// Counts the instructions of a program, and holds them to their limits.
pub(super) fn check(program: &Path) -> Result<(), Failure> {
    let folder = temporary_folder()?;
    let folder = folder.path();
    let root = std::path::absolute(workspace_root()).map_err(|error| error.to_string())?;
    let lipz = |arguments: &[&str]| {
        let mut command = Command::new(program);
        command.args(arguments).current_dir(folder);
        command
    };
    let failed = |error: std::io::Error| format!("`{}`: {error}", folder.display());
    fs::create_dir(folder.join("recordings")).map_err(failed)?;
    fs::copy(root.join(RECORDING), folder.join("recordings/bobby.wav")).map_err(failed)?;
    output(&mut lipz(&["init", ".", "--audio", "recordings"]))?;
    output(&mut lipz(&["new", "bobby", TRANSCRIPT]))?;
    let dialogue = root.join(DIALOGUE);
    let dialogue = dialogue.to_string_lossy();
    println!("| command | instructions | of `release` |\n|---|--:|--:|");
    let mut above = Vec::new();
    for ((name, release), arguments) in
        RELEASE.iter().zip([&["sync"][..], &["pack", &*dialogue, "--output", "packed.lipzbank"]])
    {
        let count = count(&lipz(arguments))?;
        let percent = count * 100 / release;
        println!("| `{name}` | {count} | {percent} % |");
        if count * 100 > release * MOST_PERCENT {
            above.push(format!(
                "`{name}` takes {percent} % of the instructions that `release` took: at most {MOST_PERCENT} %"
            ));
        }
    }
    if above.is_empty() { Ok(()) } else { Err(above.join("\n")) }
}

/// Returns the instructions of a command, as counted by valgrind's callgrind.
fn count(command: &Command) -> Result<u64, Failure> {
    let mut valgrind = Command::new("valgrind");
    valgrind.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]);
    valgrind.arg(command.get_program()).args(command.get_args());
    if let Some(folder) = command.get_current_dir() {
        valgrind.current_dir(folder);
    }
    let messages = output(&mut valgrind)?;
    let count = messages.split_once("Collected :").and_then(|(_, rest)| rest.split_whitespace().next()?.parse().ok());
    count.ok_or_else(|| format!("valgrind printed no count: {messages}"))
}

/// Returns the messages of a command that must succeed.
fn output(command: &mut Command) -> Result<String, Failure> {
    let output = command.output().map_err(|error| format!("{command:?} cannot be run: {error}"))?;
    let messages = String::from_utf8_lossy(&output.stderr).into_owned();
    match output.status.success() {
        true => Ok(messages),
        false => Err(format!("{command:?} ended with {}: {messages}", output.status)),
    }
}
