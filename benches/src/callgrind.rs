//! Instruction counts, which do not depend on the load of the machine.

use std::path::Path;
use std::process::Command;

/// Returns the instructions that a program executes, as counted by valgrind's callgrind.
///
/// # Errors
/// If valgrind is not installed, or the program fails.
pub fn instructions(program: &Command) -> Result<u64, String> {
    let messages = run(program, &["--callgrind-out-file=/dev/null"])?;
    let count = messages.split_once("Collected :").and_then(|(_, rest)| rest.split_whitespace().next()?.parse().ok());
    count.ok_or_else(|| format!("valgrind gave no count:\n{messages}"))
}

/// Returns the instructions of each of a program's `calls` calls of `function`, a path including the name of the crate.
/// Callgrind's files are written to `folder`.
///
/// # Errors
/// If valgrind is not installed, or the program fails, or makes fewer calls.
pub fn instructions_of_calls(
    program: &Command,
    function: &str,
    calls: usize,
    folder: &Path,
) -> Result<Vec<u64>, String> {
    let file = folder.join("callgrind");
    let messages = run(
        program,
        &[
            &format!("--toggle-collect={function}"),
            &format!("--dump-after={function}"),
            &format!("--callgrind-out-file={}", file.display()),
        ],
    )?;
    // The files of the calls have numbers. The rest, after the last call, is in a file without one.
    let count = |call: usize| {
        let dump = std::fs::read_to_string(file.with_extension(call.to_string())).ok()?;
        dump.lines().find_map(|line| line.strip_prefix("totals: ")?.parse().ok())
    };
    let counts: Option<Vec<u64>> = (1..=calls).map(count).collect();
    counts.ok_or_else(|| format!("valgrind gave no count for each call of `{function}`:\n{messages}"))
}

/// Runs a program under callgrind. Returns the output of valgrind.
fn run(program: &Command, options: &[&str]) -> Result<String, String> {
    let mut valgrind = Command::new("valgrind");
    valgrind.arg("--tool=callgrind").args(options).arg(program.get_program()).args(program.get_args());
    let output = valgrind.output().map_err(|error| format!("valgrind cannot be run: {error}"))?;
    let messages = String::from_utf8_lossy(&output.stderr).into_owned();
    if !output.status.success() {
        return Err(format!("valgrind ended with {}:\n{messages}", output.status));
    }
    Ok(messages)
}
