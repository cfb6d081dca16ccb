//! The commands, each in its own file or folder, and their list. Code that several commands use is in `shared`.

/// Defines the commands below a command: the list of their names and arguments, and how the command runs one of them.
macro_rules! subcommands {
    ($command:ident.$field:ident: $list:ident { $($name:ident($arguments:path),)+ }) => {
        #[derive(clap::Subcommand, Debug)]
        enum $list {
            $($name(Box<$arguments>),)+
        }

        impl $command {
            fn task(&self) -> &dyn $crate::commands::Run {
                match &self.$field {
                    $($list::$name(arguments) => arguments.as_ref(),)+
                }
            }
        }

        impl $crate::commands::Run for $command {
            fn prints_result(&self) -> bool {
                self.task().prints_result()
            }

            fn run(&self, reporter: &mut $crate::reporter::Reporter) -> $crate::reporter::CommandResult {
                self.task().run(reporter)
            }
        }
    };
}

pub(crate) mod approve;
pub(crate) mod check;
pub(crate) mod convert;
pub(crate) mod coverage;
pub(crate) mod diff;
pub(crate) mod explain;
pub(crate) mod export;
pub(crate) mod fmt;
pub(crate) mod ids;
pub(crate) mod import;
pub(crate) mod init;
pub(crate) mod inspect;
pub(crate) mod lsp;
pub(crate) mod merge;
pub(crate) mod new;
pub(crate) mod pack;
pub(crate) mod preview;
pub(crate) mod print;
pub(crate) mod shard;
pub(crate) mod sync;
pub(crate) mod unpack;
pub(crate) mod verify;
pub(crate) mod watch;

use crate::reporter::{CommandResult, Reporter};
use clap::Subcommand;

/// The action of a command.
pub(crate) trait Run {
    /// Whether standard output carries a result other than diagnostics.
    fn prints_result(&self) -> bool;

    /// Runs the command, and reports the problems of its input.
    fn run(&self, reporter: &mut Reporter) -> CommandResult;
}

/// Defines the list of commands in the order of `lipz --help`: their users, then name and arguments of each.
macro_rules! commands {
    ($($group:literal { $($name:ident($arguments:path),)+ })+) => {
        #[derive(Subcommand, Debug)]
        pub(crate) enum Command {
            $($($name($arguments),)+)+
        }

        impl Command {
            /// Returns the action of the command.
            pub(crate) fn task(&self) -> &dyn Run {
                match self {
                    $($(Command::$name(arguments) => arguments,)+)+
                }
            }
        }

        /// The commands in the groups of the help, which ends with clap's own `help`.
        pub(crate) const GROUPS: &[(&str, &[&str])] = &[$(($group, &[$(stringify!($name)),+]),)+ ("Help", &["help"])];
    };
}

commands! {
    "Project" {
        Init(init::Init),
        New(new::NewClip),
        Check(check::Check),
        Fmt(fmt::Fmt),
        Watch(watch::Watch),
        Preview(preview::PreviewArguments),
    }
    "Content" {
        Sync(sync::SyncArguments),
        Import(import::Import),
        Export(export::Export),
        Convert(convert::Convert),
        Approve(approve::Approve),
        Coverage(coverage::CoverageArguments),
    }
    "Banks" {
        Pack(pack::Pack),
        Unpack(unpack::Unpack),
        Verify(verify::Verify),
        Inspect(inspect::Inspect),
        Diff(diff::Diff),
        Merge(merge::Merge),
        Ids(ids::Ids),
        Shard(shard::ShardArguments),
    }
    "Reference" {
        Explain(explain::Explain),
        Print(print::Print),
        Lsp(lsp::Lsp),
    }
}
