//! `cargo xtask ports`: tests the readers in other languages, each with its own test script.

use crate::Failure;
use crate::paths::workspace_root;
use crate::tools::{has_program, skip_rest, succeed};
use std::process::Command;

/// A reader in its own language, in `packages/`.
struct Port {
    /// The command that tests it, in the root of the workspace.
    command: &'static [&'static str],
    /// A program of each language that it needs.
    programs: &'static [&'static str],
}

/// The ports whose tests take seconds.
const PORTS: [Port; 2] = [
    Port { command: &["packages/lipz-unity/test~/run.sh"], programs: &["mcs", "mono"] },
    Port { command: &["packages/lipz-lua/test/all.sh"], programs: &["luajit"] },
];

/// The addon for Godot, in the engine that npm fetches into `target/godot`.
const GODOT: [Port; 1] =
    [Port { command: &["node", "packages/lipz-godot/test/run.js", "target/godot"], programs: &["npm", "chromium"] }];

pub(crate) fn run() -> Result<(), Failure> {
    test(&PORTS)
}

/// Tests the addon for Godot.
pub(crate) fn godot() -> Result<(), Failure> {
    test(&GODOT)
}

fn test(ports: &[Port]) -> Result<(), Failure> {
    for Port { command, programs } in ports {
        if let Some(missing) = programs.iter().find(|program| !is_there(program)) {
            skip_rest(missing)?;
            continue;
        }
        let [program, arguments @ ..] = command else { continue };
        let mut test = Command::new(program);
        succeed(test.args(arguments).current_dir(workspace_root()), &command.join(" "))?;
    }
    Ok(())
}

/// Whether a program is installed. LuaJIT knows only `-v`.
fn is_there(program: &str) -> bool {
    has_program(program) || Command::new(program).arg("-v").output().is_ok_and(|output| output.status.success())
}
