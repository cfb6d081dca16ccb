//! Check that the files of a step match its plan.

use super::{ContentHash, ShardPlan};
use crate::sources::Input;
use crate::util::parallel;
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::path::Path;

/// The help in case of a mismatch.
const HELP: &str = "make the plan again with `lipz shard plan`, and run its steps in the same folder";

impl ShardPlan {
    /// Reports each file of the step that has changed since the plan was made, because another step may have read the
    /// old version. Reads each of them. `record` returns the hash of a clip's entry in the sync record.
    pub fn changed(&self, record: impl Fn(&Input) -> Option<ContentHash>) -> Vec<Report> {
        let files: Vec<(&str, ContentHash)> = self.files().collect();
        let of_record =
            std::iter::zip(self.inputs(), &self.inputs).find(|(input, planned)| record(input) != planned.record);
        let of_record = of_record.map(|(input, _)| {
            let message = format!("the record of `{}` has changed since the plan was made", input.name());
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
        Ok(_) => format!("`{path}` has changed since the plan was made"),
        Err(error) => format!("`{path}` was part of the plan, but cannot be read: {error}"),
    };
    Some(Report::about(path, Diagnostic::new(Code::PlanOutdated, message).help(HELP)))
}
