//! `lipz shard`: packing on several machines.

mod emit;
mod plan;

use crate::Ended;
use crate::commands::Run;
use crate::reporter::Reporter;
use clap::{Args, Subcommand};

/// Plan the packing of a project on several machines.
///
/// A plan has the files of each shard. `lipz pack --shard` makes an object of one, `lipz link` the bank of all. Each is a
/// function of its files, so that any build engine may run them anywhere, in any order, and again.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz shard plan voices --shards 64 -o plan.json
  lipz pack --plan plan.json --shard 3 -o 3-of-64.lipzobj
  lipz link *.lipzobj -o dialogue.lipzbank")]
pub(crate) struct ShardArguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand, Debug)]
enum Task {
    Plan(plan::PlanArguments),
    Emit(emit::Emit),
}

impl Run for ShardArguments {
    fn prints_result(&self) -> bool {
        match &self.task {
            Task::Plan(plan) => plan.prints_result(),
            Task::Emit(emit) => emit.prints_result(),
        }
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
        match &self.task {
            Task::Plan(plan) => plan.run(reporter),
            Task::Emit(emit) => emit.run(reporter),
        }
    }
}
