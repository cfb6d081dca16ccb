//! A makefile of GNU Make.

use super::Steps;
use std::fmt::Write;

/// Returns the makefile. The plans of shards have empty recipes, so that Make compares their times again. The recipe of
/// the whole plan sets its time to that of the run. Otherwise, each run after a mere touch of a file would make it
/// again.
pub(super) fn file(steps: &Steps) -> String {
    let escaped = |command: String| command.replace('$', "$$");
    let objects: Vec<&str> = steps.shards.iter().map(|step| step.object.as_str()).collect();
    let mut text = format!(
        "# Made by lipz shard emit make. Run it in the folder in which the plan was made.\n\
         .DELETE_ON_ERROR:\n\n{}: {}\n\t{}\n\n{}:\n\t{}\n\t@touch {}\n\n",
        steps.bank,
        objects.join(" "),
        escaped(steps.link()),
        steps.plan,
        escaped(steps.plan_again()),
        steps.plan,
    );
    for step in &steps.shards {
        let (object, plan) = (&step.object, &step.plan);
        let pack = steps.pack(&step.number.to_string(), "$@");
        let _ = writeln!(text, "{plan}: {} ;\n{object}: {plan}\n\t{pack} --depfile $@.d", steps.plan);
    }
    let _ = writeln!(text, "\n-include {}.d", steps.plan);
    text
}
