//! `lipz pack`: source files to a bank.

mod destination;
mod layer;
mod object;
mod plan;

pub(crate) use destination::Split;
pub(crate) use plan::{Packed, Plan, Remembered};

use crate::Abort;
use crate::Ended;
use crate::commands::Run;
use crate::console;
use crate::reporter::Reporter;
use crate::shared::audio_flags::AudioFlags;
use crate::shared::sources::Sources;
use crate::shared::stdio;
use clap::{ArgAction, Args};
use lipz_compiler::settings::Settings;
use std::path::{Path, PathBuf};
use std::time::Duration;

const SHARDS: &str = "Shards";

/// What a plan decides, or what an object has not.
const OF_PLAN: [&str; 17] = [
    "sources",
    "root",
    "hidden",
    "over",
    "strip",
    "split_locales",
    "split_voices",
    "cache",
    "no_cache",
    "timings",
    "ProjectFlags",
    "allow",
    "warn",
    "deny",
    "config",
    "no_config",
    "AudioFlags",
];

/// Check Lipz files and pack them into a bank.
///
/// The old bank stays as it is until the new one is complete and verified. Nothing is written if there
/// are errors, or if the run is interrupted.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz pack
  lipz pack voices -o dialogue.lipzbank
  lipz pack voices/act1 voices/act2 --root voices -o acts.lipzbank --default-locale en-us
  lipz pack 'voices/**/mara-*.lipz' -o mara.lipzbank --strip
  lipz pack voices --over shipped.lipzbank -o patch.lipzbank
  lipz pack mod --over shipped.lipzbank --keep-others -o mod.lipzbank")]
pub(crate) struct Pack {
    #[command(flatten)]
    pub(crate) sources: Sources,

    #[command(flatten)]
    audio: AudioFlags,

    /// The bank to write; `-` writes it to standard output [default: `output` of lipz.toml]
    #[arg(short, long, value_name = "BANK")]
    output: Option<PathBuf>,

    /// Leave out the source section: the bank is smaller, but unpacking recovers only the displayed text
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    strip: Option<bool>,

    /// Write the texts of each locale to a text bank: BANK with the extension .LOCALE.lipztexts. The
    /// bank itself has everything else
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    split_locales: Option<bool>,

    /// Write the dubs of each voice to a bank of its own: BANK with the extension .LOCALE.lipzbank, a layer over the bank. The
    /// bank itself has the originals
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    split_voices: Option<bool>,

    /// Pack a layer over this bank: only what is new, changed or removed. Give the option once for each bank below, the base
    /// first
    #[arg(long, value_name = "BANK", action = ArgAction::Append)]
    over: Vec<PathBuf>,

    /// Keep clips of the banks below that the sources do not have: for sources that are only an addition, such as a mod's
    #[arg(long, requires = "over")]
    keep_others: bool,

    /// Pack this shard of --plan into an object, for `lipz link`
    #[arg(long, value_name = "NUMBER", requires = "plan", conflicts_with_all = OF_PLAN)]
    #[arg(help_heading = SHARDS)]
    shard: Option<u16>,

    /// The plan of the shards, by `lipz shard plan`. It names sources and settings
    #[arg(long, value_name = "PLAN", requires = "shard", help_heading = SHARDS)]
    plan: Option<PathBuf>,

    /// Folder of results by the hashes of what they are made of: an object that is in it is not made again
    #[arg(long, value_name = "FOLDER", requires = "shard", help_heading = SHARDS)]
    store: Option<PathBuf>,

    /// Also write the dependencies of the bank, for Make, Ninja and CMake
    #[arg(long, value_name = "FILE")]
    depfile: Option<PathBuf>,

    /// Cache what is known of the Lipz files in FILE, so that the next run reads only those that changed
    /// [default: `cache` of lipz.toml]. It is safe to delete. Text banks and standard output have none
    #[arg(long, value_name = "FILE")]
    cache: Option<PathBuf>,

    /// Use no cache: read all files
    #[arg(long, conflicts_with = "cache")]
    no_cache: bool,

    /// Print where the time went
    #[arg(long)]
    timings: bool,
}

impl Pack {
    /// Whether files that did not change may be left unread.
    pub(crate) fn may_remember(&self) -> bool {
        !self.no_cache
    }

    /// The cache to use.
    fn cache<'a>(&'a self, settings: &'a Settings) -> Option<&'a Path> {
        let cache = self.cache.as_deref().or(settings.cache.as_deref());
        cache.filter(|_| self.may_remember())
    }

    /// What a run works with now. What is wrong with it is printed, and how the run ends is returned.
    pub(crate) fn plan(&self, reporter: &mut Reporter) -> Result<Plan, Abort> {
        Plan::new(self, reporter)
    }

    /// The time of each phase, in milliseconds, and what a cache spared, if that was asked for.
    pub(crate) fn timings(&self, packed: &Packed) -> String {
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
        self.output.as_ref().is_some_and(|output| stdio::is_meant(output))
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        if let (Some(shard), Some(plan)) = (self.shard, &self.plan) {
            return object::run(self, shard, plan, reporter);
        }
        let quiet = self.sources.is_quiet();
        let plan = self.plan(reporter)?;
        let packed = plan.run(quiet, reporter)?;
        let mut text = String::new();
        if !quiet {
            text = packed.summary();
            if let Some(file) = plan.project.found() {
                text.push_str(&format!("with the settings of {}\n", console::path(file)));
            }
        }
        text.push_str(&self.timings(&packed));
        reporter.summary(&text)?;
        Ok(packed.outcome)
    }
}
