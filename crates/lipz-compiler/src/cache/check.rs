//! Checking again after few files changed: what nothing was said about is not read again.

use super::stamps::{CHECK_MAGIC, Stamps};
use super::{Cache, file};
use crate::compile::{Checked, Lint, Run};
use crate::{Compiled, Compiler, Input};
use lipz_diagnostics::Report;
use std::path::Path;
use std::time::SystemTime;

impl Compiler<'_> {
    /// Does what [`check_with`](Compiler::check_with) does, and remembers in the file `cache` the files about which there
    /// was nothing to say, so that the next check reads only those that changed. It finds the same. `beside` is all that
    /// the lint depends on besides the file and the options: with another one, all files are read.
    ///
    /// The cache is safe to delete. One that is damaged, or belongs to other options or to another version of this
    /// library, is ignored and replaced. A file that is no such cache is left alone and reported, as is one that cannot be
    /// written. What is said about dubs is about pairs of clips: a project with voices is checked without a cache.
    pub fn check_cached(&self, inputs: &[Input], lint: &Lint<'_>, cache: &Path, beside: &[u8]) -> Checked {
        if !self.options().voices.patterns.is_empty() {
            return self.check_with(inputs, lint);
        }
        let mut checked = Checked::default();
        let compiled = self.run(|options| {
            let before = match file::read(cache, CHECK_MAGIC) {
                Ok(before) => before.filter(|stamps| stamps.are_of_check(options, beside)),
                Err(report) => return Compiled::refused(report),
            };
            let known = Cache { before: before.as_ref().map(Stamps::lookup), start: SystemTime::now() };
            let mut run = Run::read_with(inputs, options, Some(&known), Some(lint), &self.progress);
            drop(known);
            let files = std::mem::take(&mut run.stamped.files);
            let is_known = |before: &Stamps| before.count() == files.len() && run.stamped.unread == files.len();
            let is_new = !before.as_ref().is_some_and(is_known);
            let mut compiled = checked.take(run);
            let write = || file::write(cache, CHECK_MAGIC, &Stamps::of_check(options, beside, files));
            let written = is_new.then(|| self.guarded(write)).flatten();
            compiled.reports.extend(written.and_then(Result::<(), Report>::err));
            compiled
        });
        Checked { compiled, ..checked }
    }
}
