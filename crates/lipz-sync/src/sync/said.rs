//! When the words and phones of clips are said, as tiers of TextGrids.

use super::grid::tier_of;
use super::one::textgrid;
use super::{Job, SyncOptions, SyncRecord, jobs_of_clips};
use crate::lints::bytes_of;
use crate::{Recordings, record_place, spoken_text};
use lipz_compiler::settings::Settings;
use lipz_compiler::{Content, Input};
use lipz_diagnostics::Report;
use lipz_interop::textgrid::{TextGrid, Tier};
use std::collections::HashMap;
use std::path::Path;

/// Knows when the words and phones of the clips of a project are said.
#[derive(Debug)]
pub struct Said<'s> {
    settings: &'s Settings,
    options: SyncOptions,
    record: SyncRecord,
    recordings: Recordings,
    /// By key.
    jobs: HashMap<String, Job>,
}

/// The tiers that a TextGrid of a clip gets besides what its Lipz file says.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct SaidTiers {
    /// When its words are said, as the record knows.
    pub words: Option<Tier>,
    /// When its phones are: only if the recording makes the mouth that the clip has.
    pub phones: Option<Tier>,
}

impl<'s> Said<'s> {
    /// What is known of these clips; `None` if no mouth of the project was made of a recording.
    ///
    /// # Errors
    /// If the record, or a file that decides about mouths, cannot be read.
    pub fn new(settings: &'s Settings, inputs: &[Input]) -> Result<Option<Said<'s>>, Report> {
        let place = record_place(settings);
        if !place.is_file() {
            return Ok(None);
        }
        let record = SyncRecord::read(&place)?;
        // Problems of the lexicon, and folders that cannot be read, are for `check` and `SyncRun`.
        let (options, _) = SyncOptions::new_with_report(settings)?;
        let (recordings, _) = Recordings::discover_with_reports(settings);
        let jobs = jobs_of_clips(inputs, &recordings).into_iter().map(|job| (job.key.clone(), job)).collect();
        Ok(Some(Said { settings, options, record, recordings, jobs }))
    }

    /// What is known of a clip. For its phones, its recording is heard again.
    pub fn of(&self, input: &Input) -> SaidTiers {
        let grid = self.jobs.get(&input.key).and_then(|job| textgrid(job, &self.options, &self.record));
        let grid = grid.and_then(|grid| TextGrid::read(grid.as_bytes(), &mut Vec::new()));
        let Some(grid) = grid else {
            let words = match &input.content {
                Content::File(path) => self.words(input, path),
                Content::Bytes { .. } => None,
            };
            return SaidTiers { words, phones: None };
        };
        let mut tiers = SaidTiers::default();
        for tier in grid.tiers.into_iter().filter(|tier| tier.intervals.iter().any(|said| !said.label.is_empty())) {
            match tier.name.as_str() {
                "words" => tiers.words = Some(tier),
                "phones" => tiers.phones = Some(tier),
                _ => {}
            }
        }
        tiers
    }

    /// The words of a clip, as the record has them.
    fn words(&self, input: &Input, lipz_file: &Path) -> Option<Tier> {
        let bytes = bytes_of(input)?;
        let document = lipz_file::parse(&bytes).document?;
        let text = spoken_text(self.settings, self.recordings.locale(&input.key), &document)?;
        let lines = self.record.lines_for(lipz_file).iter().rev();
        let words = lines.filter_map(|line| line.words.as_ref()).map(|words| words.of_text(text));
        let words = words.into_iter().find(|words| !words.is_empty())?;
        let us = |ms: u32| u64::from(ms) * 1000;
        let said = words.iter().filter(|word| word.start_ms < word.end_ms);
        let said =
            said.map(|word| Some((us(word.start_ms), us(word.end_ms), text.get(word.range.clone())?.to_owned())));
        let said: Vec<_> = said.flatten().collect();
        let end = said.last().map_or(0, |(_, end, _)| *end);
        Some(tier_of("words", end, said))
    }
}
