//! `cargo xtask ports`: tests the readers in other languages, each with its own test script. With `--bench`, measures
//! them.

mod bench;
mod table;

use crate::Failure;
use crate::cargo;
use crate::paths::workspace_root;
use crate::tools::{has_program, skip_rest, succeed};
use bench::Bench;
use clap::{Args, ValueEnum};
use std::process::Command;

/// The ports to test.
#[derive(Args, Debug)]
pub(crate) struct Settings {
    /// Ports [default: all whose tests take seconds]
    #[arg(value_enum)]
    ports: Vec<Port>,
    /// Measure the readers instead, and print a table [default: all whose programs are installed]
    #[arg(long, value_enum, num_args = 0.., value_name = "READER", conflicts_with = "ports")]
    bench: Option<Vec<Bench>>,
}

/// A reader in its own language, or its integration in an engine, in `packages/`.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
enum Port {
    /// C#, and the package for Unity
    Unity,
    /// Lua and LÖVE
    Lua,
    /// Python; with its types, if mypy is installed
    Python,
    /// Ren'Py; in the engine, if Debian's package is installed
    Renpy,
    /// Bevy, which is built without its renderer
    Bevy,
    /// Unreal, with stubs of the engine and the libraries of `cargo xtask capi`
    Unreal,
    /// Blender, as the Python package `bpy`
    Blender,
    /// Godot, which npm fetches into target/godot
    Godot,
}

impl Port {
    /// The ports that every run tests.
    const EVERYDAY: [Port; 4] = [Port::Unity, Port::Lua, Port::Python, Port::Renpy];

    /// Returns the command that tests the port, in the root of the workspace.
    fn command(self) -> &'static [&'static str] {
        match self {
            Port::Unity => &["packages/lipz-unity/test~/run.sh"],
            Port::Lua => &["packages/lipz-lua/test/all.sh"],
            Port::Python => &["python3", "-m", "unittest", "discover", "-s", "packages/lipz-python/test"],
            Port::Renpy => &["python3", "-m", "unittest", "discover", "-s", "packages/lipz-renpy/test"],
            Port::Bevy => &["packages/bevy_lipz/test.sh"],
            Port::Unreal => &["packages/lipz-unreal/test/run.sh"],
            Port::Blender => &["python3", "-m", "unittest", "discover", "-s", "packages/lipz-blender/test"],
            Port::Godot => &["node", "packages/lipz-godot/test/run.js", "target/godot"],
        }
    }

    /// Returns the programs that the command needs.
    fn programs(self) -> &'static [&'static str] {
        match self {
            Port::Unity => &["mcs", "mono"],
            Port::Lua => &["luajit"],
            Port::Python | Port::Renpy | Port::Blender => &["python3"],
            Port::Bevy => &["bash"],
            Port::Unreal => &["g++", "clang++", "python3"],
            Port::Godot => &["npm", "chromium"],
        }
    }

    /// Whether `.ci/install` also brings what the tests would skip without, and not only `.ci/install --all`.
    fn has_everyday_tools(self) -> bool {
        matches!(self, Port::Unity | Port::Lua)
    }
}

pub(crate) fn run(settings: &Settings) -> Result<(), Failure> {
    if let Some(benches) = &settings.bench {
        return bench::run(benches);
    }
    let ports = if settings.ports.is_empty() { &Port::EVERYDAY[..] } else { &settings.ports };
    for port in ports {
        if let Some(missing) = port.programs().iter().find(|program| !is_there(program)) {
            skip_rest(missing)?;
            continue;
        }
        let [program, arguments @ ..] = port.command() else { continue };
        let mut test = Command::new(program);
        if std::env::var_os("PYTHONPATH").is_none() {
            test.env("PYTHONPATH", workspace_root().join("target/port-tools"));
        }
        let is_named = !settings.ports.is_empty();
        if std::env::var_os("CI").is_some() && (is_named || port.has_everyday_tools()) {
            test.env("LIPZ_TOOLS", "required");
        }
        if *port == Port::Python {
            // Its functions run the command.
            test.env("LIPZ_PROGRAM", cargo::lipz()?);
        }
        succeed(test.args(arguments).current_dir(workspace_root()), &port.command().join(" "))?;
    }
    Ok(())
}

/// Whether a program is installed. LuaJIT knows only `-v`.
fn is_there(program: &str) -> bool {
    has_program(program) || Command::new(program).arg("-v").output().is_ok_and(|output| output.status.success())
}
