//! A makefile of GNU Make.

use super::Steps;
use std::fmt::Write;

/// The makefile. The plans of shards have empty recipes: Make then looks whether their times have changed. That of the whole
/// gets the time of the run, or it would be made again in each of them after a file was only touched.
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
