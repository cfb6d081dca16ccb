//! The binary `lipz`.

use std::process::ExitCode;

fn main() -> ExitCode {
    lipz_cli::run(std::env::args_os())
}
