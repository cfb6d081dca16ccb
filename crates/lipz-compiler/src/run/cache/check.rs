//! Checking again after few files have changed, without reading unchanged files that have no diagnostics.

use super::cached_files::Cache;
use super::file;
use super::file_stamps::FileStamps;
use super::stamps::{CHECK_MAGIC, Stamps};
use crate::run::compile::{CheckResult, CompileRun, Lint};
use crate::run::{Compiled, Compiler};
use crate::sources::Input;
use lipz_diagnostics::Report;
use std::path::Path;

impl Compiler<'_> {
    /// Checks like [`check_with`](Compiler::check_with), and stores the files without diagnostics in the file `cache`,
    /// so that the next check reads only those that have changed. The result is the same. `beside` contains everything
    /// that the lint depends on besides the file and the options. If it changes, all files are read.
    ///
    /// The cache is safe to delete. A cache that is damaged, or belongs to different options or a different version of
    /// this library, is ignored and replaced. A file that is not such a cache is left alone and reported, as is one
    /// that cannot be written. Projects with voices are checked without a cache, because diagnostics about dubs concern
    /// pairs of clips.
    pub fn check_cached(&self, inputs: &[Input], lint: &Lint<'_>, cache: &Path, beside: &[u8]) -> CheckResult {
        if !self.options().voices.patterns.is_empty() {
            return self.check_with(inputs, lint);
        }
        let mut checked = CheckResult::default();
        let compiled = self.compile_in_pool(|options| {
            let before = match file::read(cache, CHECK_MAGIC) {
                Ok(before) => before.filter(|stamps| stamps.are_of_check(options, beside)),
                Err(report) => return Compiled::refused(report),
            };
            let known = Cache::of(before.as_ref().map(Stamps::lookup));
            let run = CompileRun::read_with(inputs, options, Some(&known), Some(lint), &self.progress);
            let FileStamps { files, unread, .. } = known.into_stamps();
            let is_known = |before: &Stamps| before.count() == files.len() && unread == files.len();
            let is_new = !before.as_ref().is_some_and(is_known);
            let mut compiled = checked.take(run);
            let write = || file::write(cache, CHECK_MAGIC, &Stamps::of_check(options, beside, files));
            let written = is_new.then(|| self.call_guarded(write)).flatten();
            compiled.reports.extend(written.and_then(Result::<(), Report>::err));
            compiled
        });
        CheckResult { compiled, ..checked }
    }
}
