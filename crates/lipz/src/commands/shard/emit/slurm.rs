//! A script that submits the steps to Slurm.

use super::Steps;
use std::path::Path;

/// Returns the script: an array job, and a job that starts when all of its tasks have succeeded.
pub(super) fn file(steps: &Steps) -> String {
    let count = steps.shards.len();
    let object =
        Path::new(&steps.plan).with_file_name(format!("$SLURM_ARRAY_TASK_ID-of-{count}.{}", steps.step.extension()));
    let object = format!("\"{}\"", object.to_string_lossy());
    let pack = steps.pack("\"$SLURM_ARRAY_TASK_ID\"", &object);
    format!(
        "#!/bin/sh\n\
         # Made by lipz shard emit slurm. Run it in the folder in which the plan was made, which all nodes see.\n\
         # Arguments are passed on to sbatch: --partition, --account, --time.\n\
         set -eu\n\
         pack=$(sbatch --parsable --requeue --job-name=lipz-pack --array=0-{} \"$@\" --wrap '{pack}')\n\
         sbatch --parsable --requeue --job-name=lipz-link --dependency=\"afterok:${{pack%%;*}}\" --kill-on-invalid-dep=yes \"$@\" --wrap {}\n",
        count - 1,
        super::quoted(&steps.link()),
    )
}
