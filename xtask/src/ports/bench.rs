//! `cargo xtask ports --bench`: measures all readers with the same questions, and prints a Markdown table.
//!
//! Each reader has a program that prints lines such as `bench viseme_ns 31.2 C#`. docs/inside/ports.md has the questions
//! and the table.

use super::{is_there, table::Table};
use crate::Failure;
use crate::paths::{target_folder, workspace_root};
use clap::ValueEnum;
use std::path::Path;
use std::process::{Command, Stdio};

/// A program that measures readers.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Bench {
    Rust,
    /// C and C++, with the libraries of `cargo xtask capi`
    C,
    /// C#, and the player for Unity
    Unity,
    /// JavaScript, with the package of `cargo xtask web`
    Web,
    Luajit,
    Lua,
    Python,
    /// GDScript in Godot, in `target/godot`
    Godot,
    /// Bevy, whose first build takes ten minutes
    Bevy,
    /// Unreal, with stubs of the engine and the libraries of `cargo xtask capi`
    Unreal,
}

impl Bench {
    /// Returns the folder below the root of the workspace in which the command runs, and the command.
    fn command(self) -> (&'static str, &'static str) {
        match self {
            Bench::Rust => (
                "",
                "cargo run --quiet --locked --release --package lipz-benches --no-default-features --bin ports -- \
                 fixtures/banks/v1",
            ),
            Bench::C => ("", "crates/lipz-capi/tests/bench.sh"),
            Bench::Unity => ("", "packages/lipz-unity/test~/run.sh"),
            Bench::Web => ("", "node --expose-gc --min-semi-space-size=128 TARGET/web/test/bench.js"),
            Bench::Luajit => ("packages/lipz-lua", "luajit test/bench.lua"),
            Bench::Lua => ("packages/lipz-lua", "lua5.4 test/bench.lua"),
            Bench::Python => ("", "python3 packages/lipz-python/test/bench.py"),
            Bench::Godot => ("", "node packages/lipz-godot/test/run.js target/godot"),
            Bench::Bevy => (
                "packages/bevy_lipz",
                "cargo test --quiet --locked --release --test plugin -- --ignored --nocapture speed",
            ),
            Bench::Unreal => ("", "packages/lipz-unreal/test/run.sh bench"),
        }
    }

    /// Returns the programs that the command needs.
    fn programs(self) -> &'static [&'static str] {
        match self {
            Bench::Rust | Bench::Bevy => &["cargo"],
            Bench::C => &["cc", "c++"],
            Bench::Unity => &["mcs", "mono"],
            Bench::Web => &["node"],
            Bench::Luajit => &["luajit"],
            Bench::Lua => &["lua5.4"],
            Bench::Python => &["python3"],
            Bench::Godot => &["npm", "chromium"],
            Bench::Unreal => &["g++", "python3"],
        }
    }

    /// Returns a missing program, or the task that builds a missing file.
    fn missing(self) -> Option<&'static str> {
        let target = target_folder();
        let capi = std::env::var_os("LIPZ_CAPI").map_or_else(|| target.join("capi"), Into::into);
        match self {
            Bench::Web if !target.join("web/test/bench.js").exists() => Some("`cargo xtask web`"),
            Bench::C | Bench::Unreal if !Path::new(&capi).join("lib/liblipz.a").exists() => Some("`cargo xtask capi`"),
            _ => self.programs().iter().find(|program| !is_there(program)).copied(),
        }
    }

    /// Runs the command, and returns its output.
    fn output(self) -> Result<String, Failure> {
        let (folder, command) = self.command();
        let target = std::path::absolute(target_folder()).map_err(|error| error.to_string())?;
        let mut words = command.split_whitespace().map(|word| word.replace("TARGET", &target.to_string_lossy()));
        let mut run = Command::new(words.next().unwrap_or_default());
        run.args(words).current_dir(workspace_root().join(folder)).stderr(Stdio::inherit());
        let output = run.output().map_err(|error| format!("`{command}` cannot be run: {error}"))?;
        if !output.status.success() {
            return Err(format!("`{command}` ended with {}", output.status));
        }
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    }
}

/// Runs the programs, or all of them, one after the other.
pub(super) fn run(chosen: &[Bench]) -> Result<(), Failure> {
    let benches = if chosen.is_empty() { Bench::value_variants() } else { chosen };
    let (mut table, mut missing) = (Table::default(), Vec::new());
    for bench in benches {
        let name = bench.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default();
        match bench.missing() {
            Some(needs) => missing.push(format!("not measured: {name} needs {needs}")),
            None => {
                eprintln!("measuring {name}");
                let count = table.add(&bench.output()?)?;
                if count == 0 {
                    return Err(format!("the program of {name} has printed no measurement"));
                }
            }
        }
    }
    print!("{table}");
    missing.iter().for_each(|line| println!("{line}"));
    Ok(())
}
