//! The mouths of all shards, merged into the Lipz files.

use super::hash_for_sync;
use super::mouths::{MadeMouth, Mouths};
use crate::sync::listed::Listings;
use crate::sync::{Line, Spoken, Whole, hash_of, write};
use crate::{SyncRecord, Synced};
use lipz_compiler::replace_file;
use lipz_compiler::shard::{ContentHash, WireReport};
use lipz_diagnostics::{Code, Diagnostic, Report};
use std::fs;
use std::io;
use std::path::Path;

/// Brings the mouths of all shards into their Lipz files and the record, as a [`SyncRun`](crate::SyncRun) does with those that it
/// makes. A file that is not what it was when the plan was made stays as it is, which is reported, and so does one of which the
/// record says something else, or that has another recording; one that has its mouth already is done. So a run that ended in
/// the middle can be done again.
pub fn merge(mouths: Vec<Mouths>, record: &mut SyncRecord, whole: &Whole<'_>) -> Synced {
    let (mut synced, mut listed, mut made) = (Synced::default(), Listings::default(), Vec::new());
    for of_shard in mouths {
        synced.refused += of_shard.refused;
        synced.unchanged += of_shard.unchanged.len();
        synced.kept.extend(of_shard.kept);
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
    synced.end(listed, record, whole)
}

/// Writes a mouth into its file, and its lines into the record; returns those that the record is to have, if it has not.
fn put(mouth: &MadeMouth, record: &SyncRecord, whole: &Whole<'_>) -> Result<Option<(Line, Vec<Spoken>)>, Report> {
    let path = Path::new(&mouth.lipz_file);
    let outdated = |message: String| {
        let help = "the file is kept; make the plan again, and the mouths: lipz shard plan --sync";
        Report::about(mouth.lipz_file.as_str(), Diagnostic::new(Code::PlanOutdated, message).help(help))
    };
    let line = Line::parse(&mouth.line).filter(|(_, file)| *file == record.name(path)).map(|(line, _)| line);
    let line = line.ok_or_else(|| outdated("the record is in another place than when the plan was made".to_owned()))?;
    let spoken = mouth.spoken.iter().filter_map(|spoken| Some(Spoken::parse(spoken)?.0)).collect::<Vec<_>>();
    let now = match fs::read(path) {
        Ok(bytes) => Some(bytes),
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(crate::facts::unreadable(path, &error)),
    };
    let grid = mouth.grid.as_ref().map(|(place, text)| (Path::new(place), text.as_str()));
    let is_done = now.as_deref() == Some(mouth.after.as_bytes());
    if !is_done && now.as_deref().map(ContentHash::of) != mouth.before {
        return Err(outdated(format!("`{}` is not what it was when the plan was made", mouth.lipz_file)));
    }
    let known = record.lines_for(path);
    // A machine that merges need not have the recordings, and of what is done nobody asks.
    let recording = Path::new(&mouth.recording);
    if !(is_done && known.contains(&line)) && recording.is_file() && hash_of(recording)? != line.made.sound {
        return Err(outdated(format!("`{}` is not what it was when the plan was made", mouth.recording)));
    }
    // A merge that was stopped may have added the line to those that were there.
    if !known.contains(&line) && hash_for_sync(record, path) != mouth.known {
        let message = format!("the record says something else of `{}` than when the plan was made", mouth.lipz_file);
        return Err(outdated(message));
    }
    if is_done {
        // What was accepted since then stays.
        let is_in_record = known == std::slice::from_ref(&line);
        let grid = grid.filter(|(place, _)| !place.exists());
        let mut written = Ok(());
        whole(&mut || written = grid.map_or(Ok(()), |(place, text)| replace_file(place, text.as_bytes())));
        return written.map(|()| (!is_in_record).then_some((line, spoken)));
    }
    write(path, now.as_deref(), &mouth.after, (&line, &spoken, grid), record, whole).map_err(|fault| fault.report)?;
    Ok(Some((line, spoken)))
}
