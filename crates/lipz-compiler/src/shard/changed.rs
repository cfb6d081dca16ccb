//! Whether the files of a step are those of its plan.

use super::{ContentHash, ShardPlan};
use crate::{Input, parallel};
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::path::Path;

/// What to do then.
const HELP: &str = "make the plan again: lipz shard plan; steps run in the folder in which it was made";

impl ShardPlan {
    /// Reports each file that the step reads and that is not what it was when the plan was made: another step may have
    /// read the old one. Each is read on the way. `record` gives the hash of what the record of mouths says of a clip.
    pub fn changed(&self, record: impl Fn(&Input) -> Option<ContentHash>) -> Vec<Report> {
        let files: Vec<(&str, ContentHash)> = self.files().collect();
        let of_record =
            std::iter::zip(self.inputs(), &self.inputs).find(|(input, planned)| record(input) != planned.record);
        let of_record = of_record.map(|(input, _)| {
            let message = format!("the record says something else of `{}` than when the plan was made", input.name());
            Report::about(input.name(), Diagnostic::new(Code::PlanOutdated, message).help(HELP))
        });
        let reports: Vec<Option<Report>> = parallel::in_pool(None, || {
            parallel::map_init(&files, || (), |(), (path, hash): &(&str, ContentHash)| changed(path, *hash))
        });
        reports.into_iter().flatten().chain(of_record).collect()
    }
}

fn changed(path: &str, planned: ContentHash) -> Option<Report> {
    let message = match ContentHash::of_file(Path::new(path)) {
        Ok(hash) if hash == planned => return None,
        Ok(_) => format!("`{path}` is not what it was when the plan was made"),
        Err(error) => format!("`{path}` was there when the plan was made, and cannot be read: {error}"),
    };
    Some(Report::about(path, Diagnostic::new(Code::PlanOutdated, message).help(HELP)))
}
