//! The commands, a file or folder each, and the one list of them. What several commands use is in `shared`.

pub(crate) mod accept;
pub(crate) mod babble;
pub(crate) mod check;
pub(crate) mod completions;
pub(crate) mod convert;
pub(crate) mod coverage;
pub(crate) mod diff;
pub(crate) mod explain;
pub(crate) mod export;
pub(crate) mod face;
pub(crate) mod fallout;
pub(crate) mod fmt;
pub(crate) mod ids;
pub(crate) mod import;
pub(crate) mod init;
pub(crate) mod inspect;
pub(crate) mod link;
pub(crate) mod lsp;
pub(crate) mod man;
pub(crate) mod maps;
pub(crate) mod merge;
pub(crate) mod new;
pub(crate) mod pack;
pub(crate) mod preview;
pub(crate) mod recogniser;
pub(crate) mod schema;
pub(crate) mod shard;
pub(crate) mod stats;
pub(crate) mod subtitles;
pub(crate) mod sync;
pub(crate) mod texts;
pub(crate) mod unpack;
pub(crate) mod verify;
pub(crate) mod watch;

use crate::reporter::{Ended, Reporter};
use clap::Subcommand;

/// What a command does with its arguments.
pub(crate) trait Run {
    /// Whether standard output is for a result other than diagnostics.
    fn prints_result(&self) -> bool;

    /// Does the work, and reports what is wrong with what it works on.
    fn run(&self, reporter: &mut Reporter) -> Ended;
}

/// Makes the list of commands, in the order of `lipz --help`: who uses them, then name and arguments of each.
macro_rules! commands {
    ($($group:literal { $($name:ident($arguments:path),)+ })+) => {
        #[derive(Subcommand, Debug)]
        pub(crate) enum Command {
            $($($name($arguments),)+)+
        }

        impl Command {
            /// What the command does.
            pub(crate) fn task(&self) -> &dyn Run {
                match self {
                    $($(Command::$name(arguments) => arguments,)+)+
                }
            }
        }

        /// The commands by who uses them, as help lists them. clap's own `help` closes the list.
        pub(crate) const GROUPS: &[(&str, &[&str])] = &[$(($group, &[$(stringify!($name)),+]),)+ ("Help", &["help"])];
    };
}

commands! {
    "Begin a project" {
        Init(init::Init),
        New(new::New),
    }
    "For writers and animators" {
        Check(check::Check),
        Fmt(fmt::Fmt),
        Preview(preview::PreviewArguments),
        Inspect(inspect::Inspect),
        Face(face::Face),
        Convert(convert::Convert),
        Explain(explain::Explain),
    }
    "From recordings and other tools" {
        Sync(sync::SyncArguments),
        Import(import::Import),
        Export(export::Export),
        Maps(maps::Maps),
        Recogniser(recogniser::RecogniserArguments),
        Babble(babble::BabbleArguments),
        Fallout(fallout::Fallout),
    }
    "For translators" {
        Texts(texts::Texts),
        Subtitles(subtitles::Subtitles),
        Coverage(coverage::CoverageArguments),
        Accept(accept::Accept),
    }
    "For programmers and builds" {
        Pack(pack::Pack),
        Watch(watch::Watch),
        Ids(ids::Ids),
        Verify(verify::Verify),
        Diff(diff::Diff),
        Stats(stats::Stats),
        Merge(merge::Merge),
        Shard(shard::ShardArguments),
        Link(link::LinkArguments),
        Unpack(unpack::Unpack),
    }
    "For editors and shells" {
        Lsp(lsp::Lsp),
        Schema(schema::Schema),
        Completions(completions::Completions),
        Man(man::ManPages),
    }
}
