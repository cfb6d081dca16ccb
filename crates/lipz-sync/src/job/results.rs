//! The results of a lip-sync run.

use super::outcome::KeepReason;
use super::review_list::ReviewLists;
use super::write::WriteGuard;
use crate::record::{DoubtfulWord, SyncRecord};
use lipz_diagnostics::Report;
use std::collections::BTreeSet;

/// The results of a run, clip by clip in the order of the jobs, originals before dubs.
#[derive(Debug, Default)]
#[non_exhaustive]
pub struct SyncResults {
    /// The keys of the clips with new visemes.
    pub made: Vec<String>,
    /// The number of clips whose visemes are up to date.
    pub unchanged: usize,
    /// The keys of the clips whose visemes stay, because they were made or edited by hand.
    pub kept: Vec<(String, KeepReason)>,
    /// The paths of renamed Lipz files, which keep their lines in the record: the old and the new ones, relative to its
    /// folder.
    pub renamed: Vec<(String, String)>,
    /// The number of clips with errors.
    pub refused: usize,
    /// The keys of clips with new visemes for a changed text, but with the same recording. The new text may have to be
    /// recorded.
    pub with_new_text: Vec<String>,
    /// The locales of these texts for which lipz has no rules, so that words are read letter by letter.
    pub read_by_letters: BTreeSet<String>,
    /// Words to check by ear.
    pub doubtful: Vec<DoubtfulWord>,
    /// The words with a guessed pronunciation, as lines of a lexicon, each once, in alphabetical order.
    pub guessed: Vec<String>,
    /// The doubtful words of the clips whose visemes are up to date.
    pub doubtful_before: Vec<DoubtfulWord>,
    /// The additional guesses of these clips.
    pub guessed_before: Vec<String>,
    /// All reports.
    pub reports: Vec<Report>,
}

impl SyncResults {
    /// Ends a run, and rewrites the record.
    pub(crate) fn end(mut self, listed: ReviewLists, record: &SyncRecord, whole: &WriteGuard<'_>) -> SyncResults {
        listed.tell(&mut self);
        let mut written = Ok(());
        whole(&mut || written = record.write());
        self.reports.extend(written.err());
        lipz_diagnostics::reports::sort(&mut self.reports);
        self
    }
}
