//! Instruction counts, which do not depend on how busy the machine is.

use std::process::Command;

/// The instructions that a program executes, as valgrind's callgrind counts them.
///
/// # Errors
/// If valgrind is not installed, or the program fails.
pub fn instructions(program: &Command) -> Result<u64, String> {
    let mut valgrind = Command::new("valgrind");
    valgrind.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]);
    let output = valgrind
        .arg(program.get_program())
        .args(program.get_args())
        .output()
        .map_err(|error| format!("valgrind cannot be run: {error}"))?;
    let messages = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        return Err(format!("valgrind ended with {}:\n{messages}", output.status));
    }
    let count = messages.split_once("Collected :").and_then(|(_, rest)| rest.split_whitespace().next()?.parse().ok());
    count.ok_or_else(|| format!("valgrind gave no count:\n{messages}"))
}
