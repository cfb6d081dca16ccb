//! Execution of jobs on several threads.

use super::outcome::{JobOutcome, NewMouth};
use super::progress::Progress;
use super::run::run;
use super::store::ClipStore;
use super::{Job, SyncOptions};
use crate::record::SyncRecord;
use crate::threads;
use lipz_diagnostics::Report;
use lipz_speech::{Language, Reliance};

/// Does jobs with as many threads as the options state. Originals come first, because dubs borrow their texts.
pub(crate) fn work<'j>(
    jobs: &'j [Job],
    options: &SyncOptions,
    record: &SyncRecord,
    place: &dyn ClipStore,
    progress: &(dyn Fn(u32) + Sync),
) -> Vec<(&'j Job, JobOutcome, Vec<Report>)> {
    let (originals, dubs): (Vec<&Job>, Vec<&Job>) = jobs.iter().partition(|job| job.original.is_none());
    let make = |job: &&'j Job| {
        let (mut reports, progress) = (Vec::new(), Progress::new(progress));
        let mut step = match place.is_closed() {
            false => run(job, options, (record, place), &progress, &mut reports),
            true => JobOutcome::Refused,
        };
        if let JobOutcome::New(new) = &step
            && let Err(report) = place.put(job, new)
        {
            reports.extend(report);
            step = JobOutcome::Refused;
        }
        progress.finish();
        (*job, step, reports)
    };
    let mut done = threads::map(&originals, options.options.get_threads(), make);
    done.extend(threads::map(&dubs, options.options.get_threads(), make));
    done
}

/// Returns the locale of the words, if its language has no rules.
pub(crate) fn by_letters(job: &Job, options: &SyncOptions, new: &NewMouth) -> Option<String> {
    let is_read_by_letters =
        |locale: &&str| Language::from_locale(locale).is_some_and(|language| language.reliance() == Reliance::Letters);
    options.locale_of(job).filter(|_| new.line.words.is_some()).filter(is_read_by_letters).map(str::to_owned)
}
