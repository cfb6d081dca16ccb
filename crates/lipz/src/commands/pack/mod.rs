//! `lipz pack`: packs source files into a bank.

mod destination;
mod layer;
mod plan;

pub(crate) use plan::{PackMemory, PackResult, Plan};

use crate::Abort;
use crate::CommandResult;
use crate::commands::Run;
use crate::console;
use crate::reporter::Reporter;
use crate::shared::audio_flag::AudioFlag;
use crate::shared::sources::Sources;
use crate::shared::stdin_file::StdinFile;
use crate::shared::stdio;
use clap::{ArgAction, Args};
use lipz_compiler::settings::Settings;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Check Lipz files and pack them into a bank.
///
/// The old bank stays unchanged until the new one is complete and verified. If there are errors, or if you interrupt the run,
/// lipz writes nothing.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz pack
  lipz pack voices -o dialogue.lipzbank
  lipz pack voices --config split-locales=true --config text.lines=2
  lipz pack 'voices/**/mara-*.lipz' -o mara.lipzbank --config strip=true
  lipz pack voices --over shipped.lipzbank -o patch.lipzbank
  lipz pack mod --over shipped.lipzbank --keep-others -o mod.lipzbank")]
pub(crate) struct Pack {
    #[command(flatten)]
    arguments: PackArguments,

    #[command(flatten)]
    stdin: StdinFile,
}

/// The arguments of a packing run, which `lipz watch` has as well.
#[derive(Args, Debug)]
pub(crate) struct PackArguments {
    #[command(flatten)]
    pub(crate) sources: Sources,

    #[command(flatten)]
    audio: AudioFlag,

    /// Bank to write; `-` is standard output [default: `output` of lipz.toml]
    #[arg(short, long, value_name = "BANK")]
    output: Option<PathBuf>,

    /// Pack a patch for this bank, with only new, changed and removed clips
    ///
    /// Give the option once for each bank of the stack, the base first.
    #[arg(long, value_name = "BANK", action = ArgAction::Append)]
    over: Vec<PathBuf>,

    /// Keep clips that the sources do not have, for mods and other additions
    #[arg(long, requires = "over")]
    keep_others: bool,

    /// Add the weights of a rig as curves, for programs that do not compute them
    #[arg(long, value_name = "RIG")]
    bake: Option<String>,

    /// Write the dependencies of the bank to FILE, for Make, Ninja and CMake
    #[arg(long, value_name = "FILE")]
    depfile: Option<PathBuf>,

    /// Cache in FILE, so that the next run reads only changed files [default: `cache` of lipz.toml]
    ///
    /// The file is safe to delete. Text banks and standard output have no cache.
    #[arg(long, value_name = "FILE")]
    cache: Option<PathBuf>,

    /// Print the time of each phase
    #[arg(long)]
    timings: bool,
}

impl PackArguments {
    /// Returns the cache to use.
    fn cache<'a>(&'a self, settings: &'a Settings) -> Option<&'a Path> {
        self.cache.as_deref().or(settings.cache.as_deref())
    }

    /// Returns the input of a run at this time. Reports its problems.
    pub(crate) fn plan(&self, reporter: &mut Reporter) -> Result<Plan, Abort> {
        Plan::new(self, reporter)
    }

    /// Returns the time of each phase in milliseconds and the savings of a cache, if requested.
    pub(crate) fn timings(&self, packed: &PackResult) -> String {
        if !self.timings {
            return String::new();
        }
        let phases = &packed.phases;
        let line = |name: &str, time: Duration| format!("  {name:<22} {:>9.1} ms\n", time.as_secs_f64() * 1000.0);
        [
            line("discover", packed.discover),
            line("cache", phases.cache),
            line("files", phases.files),
            line("  recall (all threads)", phases.recall),
            line("  read (all threads)", phases.read),
            line("  parse (all threads)", phases.parse),
            line("  check (all threads)", phases.check),
            line("localise", phases.localise),
            line("lower", phases.lower),
            line("verify and write", phases.finish),
            format!(
                "  {} of {} recalled from the bank\n",
                console::grouped(packed.recalled),
                console::counted(packed.clip_count, "clip")
            ),
        ]
        .concat()
    }
}

impl Run for Pack {
    fn prints_result(&self) -> bool {
        self.arguments.output.as_ref().is_some_and(|output| stdio::is_meant(output))
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        self.stdin.apply(self.arguments.sources.paths(), reporter)?;
        let quiet = self.arguments.sources.is_quiet();
        let plan = self.arguments.plan(reporter)?;
        let packed = plan.run(quiet, reporter)?;
        let mut text = String::new();
        if !quiet {
            text = packed.summary();
            if let Some(file) = plan.project.found() {
                text.push_str(&format!("with the settings of {}\n", console::path(file)));
            }
        }
        text.push_str(&self.arguments.timings(&packed));
        reporter.summary(&text)?;
        Ok(packed.outcome)
    }
}
