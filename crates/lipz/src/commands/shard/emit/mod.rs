//! `lipz shard emit`: writes a plan as a file for a build engine.

mod hyperqueue;
mod make;
mod ninja;
mod slurm;

use crate::commands::Run;
use crate::reporter::{CommandResult, Reporter};
use crate::shared::run_flags::QuietFlag;
use crate::shared::{output_file, stdio};
use crate::{Abort, Outcome, console};
use clap::{Args, ValueEnum};
use lipz_compiler::shard::{Plan, Step};
use std::path::{Path, PathBuf};

/// Write a plan as the input of a build engine.
///
/// Run this command and the engine in the folder in which the plan was made. The steps call `lipz`, which must be in the
/// PATH of each machine. Objects are written next to the plan.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz shard emit ninja build/plan.json -o build.ninja
  lipz shard emit hyperqueue build/plan.json -o build/job.toml
  lipz shard emit slurm build/plan.json -o build/submit.sh --store /shared/lipz")]
pub(super) struct Emit {
    /// Build engine
    #[arg(value_name = "ENGINE")]
    engine: Engine,

    /// Plan, written by `lipz shard plan`
    #[arg(value_name = "PLAN")]
    plan: PathBuf,

    /// File to write; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// Folder that stores results by the hash of their inputs, shared by all machines [default: `store` next to the plan]
    #[arg(long, value_name = "FOLDER")]
    store: Option<PathBuf>,

    #[command(flatten)]
    quiet: QuietFlag,
}

/// The program that runs the steps.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Engine {
    /// Ninja, on one machine or with a distributed executor; updates the plan when sources change
    Ninja,
    /// HyperQueue, as a job with a task for each shard and a final task
    Hyperqueue,
    /// Slurm, as a script that submits an array job and a final job
    Slurm,
    /// GNU Make, on one machine; updates the plan when sources change
    Make,
}

/// The steps of a plan, with paths quoted for shells.
struct Steps {
    plan: String,
    /// The kind of work in the steps.
    step: Step,
    /// The arguments of the run that made the plan.
    made_by: Vec<String>,
    shards: Vec<ShardStep>,
    bank: String,
    store: String,
}

/// The step for a shard.
struct ShardStep {
    number: u16,
    /// The plan of the shard.
    plan: String,
    object: String,
}

impl Run for Emit {
    fn prints_result(&self) -> bool {
        stdio::is_meant(&self.output)
    }

    fn run(&self, reporter: &mut Reporter) -> CommandResult {
        output_file::refuse_source(&self.output, reporter)?;
        output_file::refuse_same(&[("the plan", &self.plan), ("the output", &self.output)], reporter)?;
        let plan = Plan::read(&self.plan).map_err(|report| reporter.refuse(vec![report]))?;
        let steps = self.steps(&plan, reporter)?;
        let text = match self.engine {
            Engine::Ninja => ninja::file(&steps),
            Engine::Hyperqueue => hyperqueue::file(&steps),
            Engine::Slurm => slurm::file(&steps),
            Engine::Make => make::file(&steps),
        };
        if stdio::is_meant(&self.output) {
            reporter.print(&text)?;
            return Ok(Outcome::Clean);
        }
        output_file::write(&self.output, text.as_bytes(), reporter)?;
        if !self.quiet.is_set() {
            let steps = console::counted(plan.shards.len() + 1, "step");
            reporter.summary(&format!("{steps} written to {}\n", console::path(&self.output)))?;
        }
        Ok(Outcome::Clean)
    }
}

impl Emit {
    fn steps(&self, plan: &Plan, reporter: &mut Reporter) -> Result<Steps, Abort> {
        let store = self.store.clone().unwrap_or_else(|| self.plan.with_file_name("store"));
        let mut plain = |path: &Path| plain(path, reporter);
        let mut shards = Vec::new();
        for shard in &plan.shards {
            shards.push(ShardStep {
                number: shard.shard,
                plan: plain(&self.plan.with_file_name(&shard.needs))?,
                object: plain(&self.plan.with_file_name(&shard.makes))?,
            });
        }
        Ok(Steps {
            plan: plain(&self.plan)?,
            step: plan.step,
            made_by: plan.made_by.clone(),
            bank: plain(Path::new(&plan.makes))?,
            store: plain(&store)?,
            shards,
        })
    }
}

impl Steps {
    /// Returns the command for a shard; the engine inserts its number and its object.
    fn pack(&self, shard: &str, object: &str) -> String {
        let command = match self.step {
            Step::Pack => "pack",
            Step::Sync => "sync",
        };
        format!("lipz shard {command} {} {shard} -o {object} --store {} --quiet", self.plan, self.store)
    }

    /// Returns the command that makes the plan again.
    fn plan_again(&self) -> String {
        let quoted = self.made_by.iter().map(|argument| quoted(argument));
        let words: Vec<String> = std::iter::once("lipz".to_owned()).chain(quoted).collect();
        words.join(" ")
    }

    /// Returns the command that links the objects or merges the visemes. It contains a pattern, because thousands of
    /// names do not fit into a command line.
    fn link(&self) -> String {
        let (objects, makes) = (self.objects(), &self.bank);
        match self.step {
            Step::Pack => format!("lipz shard link '{objects}' -o {makes} --quiet"),
            Step::Sync => format!("lipz shard merge '{objects}' --quiet && touch {makes}"),
        }
    }

    /// Returns a pattern that matches the objects of this plan only.
    fn objects(&self) -> String {
        let name = format!("*-of-{}.{}", self.shards.len(), self.step.extension());
        Path::new(&self.plan).with_file_name(name).to_string_lossy().into_owned()
    }
}

/// Returns a path without characters that are special to a build engine or a shell.
fn plain(path: &Path, reporter: &mut Reporter) -> Result<String, Abort> {
    let is_plain = |letter: char| letter.is_alphanumeric() || "/._+-@,=~".contains(letter);
    match path.to_str().filter(|path| !path.is_empty() && path.chars().all(is_plain) && !path.starts_with(['-', '~'])) {
        Some(path) => Ok(path.to_owned()),
        None => {
            let message = format!("`{}` contains special characters of build engines", console::path(path));
            Err(reporter.usage(message, "use only letters, digits, and `/._+-@,=`"))
        }
    }
}

/// Returns an argument, quoted for a shell.
fn quoted(word: &str) -> String {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "/._+-@,=".contains(letter);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_quoted_for_shells() {
        let words = ["voices", "it's", "a b", "", "$x"].map(quoted);
        assert_eq!(words, ["voices", r"'it'\''s'", "'a b'", "''", "'$x'"]);
    }
}
