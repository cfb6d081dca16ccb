//! The program `lipz`.

use std::process::ExitCode;

fn main() -> ExitCode {
    lipz::main()
}
