//! The decision how a run continues after examining all files.

use super::old_bank::OldBank;
use super::patch;
use super::previous_run::PreviousRun;
use super::recall::Recall;
use super::recall_all;
use super::stamped_run::{StampedRun, read_all};
use super::survey::Survey;
use super::task::Task;
use std::time::Instant;

/// The next step of a run that has examined all files.
pub(super) enum NextStep {
    /// Make nothing, because there are errors.
    Nothing(StampedRun),
    /// Keep the old bank if it can be proven. The flag states whether its stamps stay as well.
    Stay(StampedRun, OldBank, bool),
    /// The bank is the old one with some new clips in it.
    Patch(StampedRun, Vec<u8>),
    /// Make the bank from all clips.
    Make(StampedRun),
}

/// Examines the inputs, using those results of the run `before` that still apply. A patched bank is made in `room`,
/// which is freed if the clips need the memory.
pub(super) fn next(task: &Task<'_>, before: Option<PreviousRun>, room: &mut Vec<u8>) -> NextStep {
    let options = task.options;
    let before = before.filter(|before| before.stamps.are_of(options));
    let mut looked = Survey::at(task, before.as_ref());
    let old = before.map(|before| before.bank);
    if looked.stamped.run.has_errors() {
        // Without a bank, the clips of unchanged files are not recalled, but a dub may contradict one of them.
        let is_complete = options.voices.patterns.is_empty() || looked.found == 0;
        return NextStep::Nothing(if is_complete { looked.stamped.compare_dubs(task) } else { read_all(task) });
    }
    if looked.is_unchanged {
        return match old {
            Some(old) => NextStep::Stay(looked.stamped, old, looked.are_stamps_unchanged),
            None => NextStep::Make(read_all(task)),
        };
    }
    let start = Instant::now();
    let recall = old.as_ref().filter(|_| looked.found > 0).and_then(Recall::new);
    // Diagnostics about dubs concern all clips, not only the changed ones.
    let recall_few = recall.as_ref().filter(|_| looked.has_same_keys && options.voices.patterns.is_empty());
    let changed = looked.stamped.run.changed_clips();
    let room = std::mem::take(room);
    if let Some(bank) = recall_few.and_then(|recall| patch::patched(recall, &changed, room)) {
        drop(changed);
        looked.stamped.run.phases.lower = start.elapsed();
        return NextStep::Patch(looked.stamped, bank);
    }
    drop(changed);
    // Prove the bank before recalling everything else, and only then, so that a bank that stays or is patched is read
    // once.
    let clips = match recall.as_ref().filter(|recall| recall.old.is_proven()) {
        Some(recall) => recall_all::recalled(recall, task.inputs, &looked.stamped.stamps.recalled, options.threads),
        None => (looked.found == 0).then(Vec::new),
    };
    match clips {
        Some(clips) => looked.stamped.run.add(clips, start.elapsed()),
        // The old bank is damaged, or has been modified in the meantime.
        None => return NextStep::Make(read_all(task)),
    }
    NextStep::Make(looked.stamped.compare_dubs(task))
}
