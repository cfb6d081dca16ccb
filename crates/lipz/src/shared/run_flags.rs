//! `--quiet` and `--jobs`, which have the same meaning in all commands.

use clap::Args;

/// Whether to print only results and diagnostics.
#[derive(Args, Clone, Copy, Debug)]
pub(crate) struct QuietFlag {
    /// Hide progress and summary, but not diagnostics
    #[arg(short, long)]
    quiet: bool,
}

impl QuietFlag {
    /// Whether the flag is used.
    pub(crate) fn is_set(self) -> bool {
        self.quiet
    }
}

/// The number of threads.
#[derive(Args, Clone, Copy, Debug)]
pub(crate) struct JobsFlag {
    /// Number of threads [default: one per core]
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
}

impl JobsFlag {
    /// Returns the number of threads, if the command line names one.
    pub(crate) fn threads(self) -> Option<usize> {
        self.jobs.map(usize::from)
    }
}
