//! Whether the files of a step are those of its plan.

use super::{ContentHash, ShardPlan};
use crate::parallel;
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::path::Path;

impl ShardPlan {
    /// Reports each file that the step reads and that is not what it was when the plan was made: another step may have
    /// read the old one. Each is read on the way.
    pub fn changed(&self) -> Vec<Report> {
        let common = self.settings.iter().chain(&self.common).map(|file| (file.path.as_str(), file.hash));
        let recordings = self.inputs.iter().filter_map(|input| input.recording.as_ref());
        let own = self.inputs.iter().map(|input| (input.path.as_str(), input.hash));
        let files: Vec<(&str, ContentHash)> =
            common.chain(own).chain(recordings.map(|file| (file.path.as_str(), file.hash))).collect();
        let reports: Vec<Option<Report>> = parallel::in_pool(None, || {
            parallel::map_init(&files, || (), |(), (path, hash): &(&str, ContentHash)| changed(path, *hash))
        });
        reports.into_iter().flatten().collect()
    }
}

fn changed(path: &str, planned: ContentHash) -> Option<Report> {
    let message = match ContentHash::of_file(Path::new(path)) {
        Ok(hash) if hash == planned => return None,
        Ok(_) => format!("`{path}` is not what it was when the plan was made"),
        Err(error) => format!("`{path}` was there when the plan was made, and cannot be read: {error}"),
    };
    let help = "make the plan again: lipz shard plan; steps run in the folder in which it was made";
    Some(Report::about(path, Diagnostic::new(Code::PlanOutdated, message).help(help)))
}
