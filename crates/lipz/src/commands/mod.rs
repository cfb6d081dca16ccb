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
pub(crate) mod fallout;
pub(crate) mod fmt;
pub(crate) mod ids;
pub(crate) mod import;
pub(crate) mod init;
pub(crate) mod inspect;
pub(crate) mod man;
pub(crate) mod maps;
pub(crate) mod merge;
pub(crate) mod new;
pub(crate) mod pack;
pub(crate) mod recogniser;
pub(crate) mod schema;
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

/// Makes the list of commands, in the order of `lipz --help`: name and arguments of each.
macro_rules! commands {
    ($($name:ident($arguments:path),)+) => {
        #[derive(Subcommand, Debug)]
        pub(crate) enum Command {
            $($name($arguments),)+
        }

        impl Command {
            /// What the command does.
            pub(crate) fn task(&self) -> &dyn Run {
                match self {
                    $(Command::$name(arguments) => arguments,)+
                }
            }
        }
    };
}

commands! {
    Pack(pack::Pack),
    Watch(watch::Watch),
    Check(check::Check),
    Init(init::Init),
    New(new::New),
    Fmt(fmt::Fmt),
    Convert(convert::Convert),
    Sync(sync::SyncArguments),
    Recogniser(recogniser::RecogniserArguments),
    Import(import::Import),
    Export(export::Export),
    Subtitles(subtitles::Subtitles),
    Texts(texts::Texts),
    Accept(accept::Accept),
    Maps(maps::Maps),
    Unpack(unpack::Unpack),
    Merge(merge::Merge),
    Verify(verify::Verify),
    Inspect(inspect::Inspect),
    Diff(diff::Diff),
    Coverage(coverage::CoverageArguments),
    Stats(stats::Stats),
    Ids(ids::Ids),
    Babble(babble::BabbleArguments),
    Fallout(fallout::Fallout),
    Explain(explain::Explain),
    Schema(schema::Schema),
    Completions(completions::Completions),
    Man(man::ManPages),
}
