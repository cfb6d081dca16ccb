//! `lipz shard`: packing and lip sync on several machines.

mod emit;
mod link;
mod merge;
mod pack;
mod plan;
mod step;
mod sync;

use clap::Args;

/// Pack or sync a project in parts, on several machines.
///
/// A plan lists the files of each shard. `lipz shard pack` makes the object of a shard, and `lipz shard link` the bank of all
/// objects. The result of each step depends only on its files, so any build engine may run the steps anywhere, in any order,
/// and again.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz shard plan pack voices --shards 64 -o plan.json
  lipz shard pack plan.json 3 -o 3-of-64.lipzobj
  lipz shard link *.lipzobj -o dialogue.lipzbank")]
pub(crate) struct ShardArguments {
    #[command(subcommand)]
    task: ShardTask,
}

subcommands! {
    ShardArguments.task: ShardTask {
        Plan(plan::PlanArguments),
        Emit(emit::Emit),
        Pack(pack::PackShard),
        Link(link::LinkArguments),
        Sync(sync::SyncShard),
        Merge(merge::MergeShards),
    }
}
