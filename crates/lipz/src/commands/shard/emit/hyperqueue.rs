//! A job file of HyperQueue, for `hq job submit-file`.

use super::Steps;
use std::fmt::Write;

/// Returns the job file: a task for each shard, and one that depends on all of them.
pub(super) fn file(steps: &Steps) -> String {
    let mut text =
        "# Made by lipz shard emit hyperqueue: hq job submit-file FILE, in the folder in which the plan was made.\n\
                    name = \"lipz\"\n"
            .to_owned();
    let task = |text: &mut String, id: usize, command: &str, dependencies: &str| {
        // Paths do not contain quotation marks.
        let _ = writeln!(text, "\n[[task]]\nid = {id}\ncommand = [\"sh\", \"-c\", \"{command}\"]{dependencies}");
    };
    for step in &steps.shards {
        task(&mut text, usize::from(step.number), &steps.pack(&step.number.to_string(), &step.object), "");
    }
    let ids: Vec<String> = steps.shards.iter().map(|step| step.number.to_string()).collect();
    task(&mut text, steps.shards.len(), &steps.link(), &format!("\ndeps = [{}]", ids.join(", ")));
    text
}
