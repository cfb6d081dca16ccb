//! `lipz shard emit`: a plan as what a build engine reads.

mod hyperqueue;
mod make;
mod ninja;
mod slurm;

use crate::commands::Run;
use crate::reporter::{Ended, Reporter};
use crate::shared::{output_file, stdio};
use crate::{Abort, Outcome, console};
use clap::{Args, ValueEnum};
use lipz_compiler::shard::{Plan, Step as StepKind};
use std::path::{Path, PathBuf};

/// Write a plan as what a build engine reads.
///
/// Run it in the folder in which the plan was made: the steps run there, too. Objects are made beside the plan.
#[derive(Args, Debug)]
#[command(after_help = "Examples:
  lipz shard emit ninja build/plan.json -o build.ninja
  lipz shard emit hyperqueue build/plan.json -o build/job.toml
  lipz shard emit slurm build/plan.json -o build/submit.sh --store /shared/lipz")]
pub(super) struct Emit {
    /// The engine
    #[arg(value_name = "ENGINE")]
    engine: Engine,

    /// The plan, by `lipz shard plan`
    #[arg(value_name = "PLAN")]
    plan: PathBuf,

    /// The file to write; `-` writes it to standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// Folder of results by the hashes of what they are made of, which all machines see [default: `store` beside the plan]
    #[arg(long, value_name = "FOLDER")]
    store: Option<PathBuf>,

    /// How the engine calls lipz
    #[arg(long, value_name = "PROGRAM", default_value = "lipz")]
    lipz: String,

    /// Show no summary
    #[arg(short, long)]
    quiet: bool,
}

/// What runs the steps.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Engine {
    /// Ninja, on one machine or with a distributed executor: also makes the plan again when sources change
    Ninja,
    /// HyperQueue: a job of one task for each shard, and one that depends on them
    Hyperqueue,
    /// Slurm: a script that submits an array job, and a job that depends on it
    Slurm,
    /// GNU Make, on one machine: also makes the plan again when sources change
    Make,
}

/// The steps of a plan, with paths as shells take them.
struct Steps {
    lipz: String,
    plan: String,
    /// What the steps do.
    step: StepKind,
    /// The arguments that made the plan.
    made_by: Vec<String>,
    shards: Vec<Step>,
    bank: String,
    store: String,
}

/// The step that packs a shard.
struct Step {
    number: u16,
    /// The plan of the shard.
    plan: String,
    object: String,
}

impl Run for Emit {
    fn prints_result(&self) -> bool {
        stdio::is_meant(&self.output)
    }

    fn run(&self, reporter: &mut Reporter) -> Ended {
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
        if !self.quiet {
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
            shards.push(Step {
                number: shard.shard,
                plan: plain(&self.plan.with_file_name(&shard.needs))?,
                object: plain(&self.plan.with_file_name(&shard.makes))?,
            });
        }
        Ok(Steps {
            lipz: plain(Path::new(&self.lipz))?,
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
    /// The command that packs a shard, whose number and object the engine puts in.
    fn pack(&self, shard: &str, object: &str) -> String {
        let command = match self.step {
            StepKind::Pack => "pack",
            StepKind::Sync => "sync",
        };
        format!(
            "{} {command} --plan {} --shard {shard} -o {object} --store {} --quiet",
            self.lipz, self.plan, self.store
        )
    }

    /// The command that makes the plan again.
    fn plan_again(&self) -> String {
        let quoted = self.made_by.iter().map(|argument| quoted(argument));
        let words: Vec<String> = std::iter::once(self.lipz.clone()).chain(quoted).collect();
        words.join(" ")
    }

    /// The command that links the objects, or merges the mouths. A pattern stands for their names: thousands do not fit a command line.
    fn link(&self) -> String {
        let (lipz, objects, makes) = (&self.lipz, self.objects(), &self.bank);
        match self.step {
            StepKind::Pack => format!("{lipz} link '{objects}' -o {makes} --quiet"),
            StepKind::Sync => format!("{lipz} sync --from '{objects}' --quiet && touch {makes}"),
        }
    }

    /// The pattern of the objects of this plan, and of no other one.
    fn objects(&self) -> String {
        let name = format!("*-of-{}.{}", self.shards.len(), self.step.extension());
        Path::new(&self.plan).with_file_name(name).to_string_lossy().into_owned()
    }
}

/// A path that no engine and no shell takes for something else.
fn plain(path: &Path, reporter: &mut Reporter) -> Result<String, Abort> {
    let is_plain = |letter: char| letter.is_alphanumeric() || "/._+-@,=~".contains(letter);
    match path.to_str().filter(|path| !path.is_empty() && path.chars().all(is_plain) && !path.starts_with(['-', '~'])) {
        Some(path) => Ok(path.to_owned()),
        None => {
            let message = format!("`{}` has characters that build engines give a meaning", console::path(path));
            Err(reporter.usage(message, "choose a name of letters, digits, and `/._+-@,=`"))
        }
    }
}

/// A word of a command line for a shell.
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
