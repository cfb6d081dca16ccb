//! Merging of the visemes of all shards into the Lipz files.

use super::hash_for_sync;
use super::mouths::{KeptMouth, KeptWords, MadeMouth, Mouths};
use crate::job::SyncResults;
use crate::job::review_list::ReviewLists;
use crate::job::write::{WriteGuard, write};
use crate::record::{RecordLine, RecordedText, SyncRecord};
use crate::recordings::file_facts::hash_of;
use lipz_compiler::replace_file;
use lipz_compiler::shard::{ContentHash, WireReport};
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::fs;
use std::io;
use std::path::Path;

/// Writes the visemes of all shards into their Lipz files and the record, like a [`SyncRun`](crate::SyncRun). A file
/// stays unchanged, with a report, if it, its lines in the record or its recording have changed since the plan was
/// made. A file that already has its visemes is skipped, so that an interrupted merge can be repeated.
pub fn merge(mouths: Vec<Mouths>, record: &mut SyncRecord, whole: &WriteGuard<'_>) -> SyncResults {
    let (mut synced, mut listed, mut made) = (SyncResults::default(), ReviewLists::default(), Vec::new());
    let mut kept_words = Vec::new();
    for of_shard in mouths {
        synced.refused += of_shard.refused;
        synced.unchanged += of_shard.unchanged.len();
        for KeptMouth { key, reason, words } in of_shard.kept {
            synced.kept.push((key, reason));
            kept_words.extend(words);
        }
        synced.reports.extend(of_shard.reports.into_iter().filter_map(WireReport::into_report));
        of_shard.unchanged.into_iter().for_each(|(key, words)| listed.unchanged(&key, words));
        made.extend(of_shard.made);
    }
    synced.kept.sort_by(|one, other| one.0.cmp(&other.0));
    made.sort_by(|one, other| (one.is_dub, &one.lipz_file).cmp(&(other.is_dub, &other.lipz_file)));
    let mut lines = Vec::new();
    for mouth in made {
        match put(&mouth, record, whole) {
            Ok(of_record) => {
                synced.read_by_letters.extend(mouth.read_by_letters);
                synced.with_new_text.extend(mouth.has_new_text.then(|| mouth.key.clone()));
                listed.made(&mouth.key, mouth.listed);
                synced.made.push(mouth.key);
                lines.extend(of_record.map(|(line, spoken)| (mouth.lipz_file, line, spoken)));
            }
            Err(report) => {
                synced.refused += 1;
                synced.reports.push(report);
            }
        }
    }
    lines.into_iter().for_each(|(lipz_file, line, spoken)| record.set(Path::new(&lipz_file), line, spoken));
    for KeptWords { lipz_file, sound, words } in kept_words {
        // Times of a recording that has changed since are not taken over.
        if let Ok(words) = words.parse() {
            record.set_words(Path::new(&lipz_file), sound, words);
        }
    }
    synced.end(listed, record, whole)
}

/// Writes visemes into their file, and lines into the record. Returns the lines that are missing from the record.
fn put(
    mouth: &MadeMouth,
    record: &SyncRecord,
    whole: &WriteGuard<'_>,
) -> Result<Option<(RecordLine, Vec<RecordedText>)>, Report> {
    let path = Path::new(&mouth.lipz_file);
    let outdated = |message: String| {
        let help = "make the plan again with `lipz shard plan sync`, and then the visemes";
        Report::about(mouth.lipz_file.as_str(), Diagnostic::new(Code::PlanOutdated, message).help(help))
    };
    let line = RecordLine::parse(&mouth.line).filter(|(_, file)| *file == record.name(path)).map(|(line, _)| line);
    let line = line.ok_or_else(|| outdated("the path of the record has changed since the plan was made".to_owned()))?;
    let spoken = mouth.spoken.iter().filter_map(|spoken| Some(RecordedText::parse(spoken)?.0)).collect::<Vec<_>>();
    let now = match fs::read(path) {
        Ok(bytes) => Some(bytes),
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(crate::recordings::file_facts::unreadable(path, &error)),
    };
    let grid = mouth.grid.as_ref().map(|(place, text)| (Path::new(place), text.as_str()));
    let is_done = now.as_deref() == Some(mouth.after.as_bytes());
    if !is_done && now.as_deref().map(ContentHash::of) != mouth.before {
        return Err(outdated(format!("`{}` has changed since the plan was made", mouth.lipz_file)));
    }
    let known = record.lines_for(path);
    // The machine that merges may not have the recordings, and for finished clips they are not needed.
    let recording = Path::new(&mouth.recording);
    if !(is_done && known.contains(&line)) && recording.is_file() && hash_of(recording)? != line.made.sound {
        return Err(outdated(format!("`{}` has changed since the plan was made", mouth.recording)));
    }
    // An interrupted merge may have added the line to the existing ones.
    if !known.contains(&line) && hash_for_sync(record, path) != mouth.known {
        let message = format!("the record of `{}` has changed since the plan was made", mouth.lipz_file);
        return Err(outdated(message));
    }
    if is_done {
        // Texts approved since then stay.
        let is_in_record = known == std::slice::from_ref(&line);
        let grid = grid.filter(|(place, _)| !place.exists());
        let mut written = Ok(());
        whole(&mut || written = grid.map_or(Ok(()), |(place, text)| replace_file(place, text.as_bytes())));
        return written.map(|()| (!is_in_record).then_some((line, spoken)));
    }
    write(path, now.as_deref(), &mouth.after, (&line, &spoken, grid), record, whole).map_err(|fault| fault.report)?;
    Ok(Some((line, spoken)))
}
