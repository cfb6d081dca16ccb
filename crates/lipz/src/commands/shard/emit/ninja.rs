//! A build file of Ninja. With `restat`, Ninja skips the dependents of a step whose output did not change.

use super::Steps;
use std::fmt::Write;

/// Returns the build file.
pub(super) fn file(steps: &Steps) -> String {
    let escaped = |command: String| command.replace('$', "$$");
    let mut text = format!(
        "# Made by lipz shard emit ninja. Run it in the folder in which the plan was made.\n\
         ninja_required_version = 1.8\n\n\
         rule plan\n  command = {}\n  description = plan\n  depfile = {}.d\n  restat = 1\n\n\
         rule pack\n  command = {} --depfile $out.d\n  description = shard $shard\n  depfile = $out.d\n  deps = gcc\n  restat = 1\n\n\
         rule link\n  command = {}\n  description = link $out\n\n",
        escaped(steps.plan_again()),
        steps.plan,
        steps.pack("$shard", "$out"),
        escaped(steps.link()),
    );
    let plans: Vec<&str> = steps.shards.iter().map(|step| step.plan.as_str()).collect();
    let objects: Vec<&str> = steps.shards.iter().map(|step| step.object.as_str()).collect();
    let _ = writeln!(text, "build {} | {}: plan\n", steps.plan, plans.join(" "));
    for step in &steps.shards {
        let (object, plan, number) = (&step.object, &step.plan, step.number);
        let _ = writeln!(text, "build {object}: pack {plan} || {}\n  shard = {number}", steps.plan);
    }
    let _ = writeln!(text, "\nbuild {}: link {}\n\ndefault {}", steps.bank, objects.join(" "), steps.bank);
    text
}
