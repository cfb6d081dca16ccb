//! The times of words and phones in clips, as tiers of TextGrids.

use crate::job::grid::tier_of;
use crate::job::run::textgrid;
use crate::job::{Job, SyncOptions, jobs_of_clips};
use crate::record::{SyncRecord, record_place};
use crate::recordings::Recordings;
use crate::recordings::inputs::bytes_of;
use crate::recordings::transcript::spoken_text;
use lipz_compiler::settings::Settings;
use lipz_compiler::{Content, Input};
use lipz_diagnostics::Report;
use lipz_interop::textgrid::{TextGrid, Tier};
use std::collections::HashMap;
use std::path::Path;

/// Provides the times of words and phones for the clips of a project.
#[derive(Debug)]
pub struct GridExport<'s> {
    settings: &'s Settings,
    options: SyncOptions,
    record: SyncRecord,
    recordings: Recordings,
    /// The jobs by key.
    jobs: HashMap<String, Job>,
}

/// The additional tiers of a clip's TextGrid, which are not in its Lipz file.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
#[non_exhaustive]
pub struct GridTiers {
    /// The times of its words, from the record.
    pub words: Option<Tier>,
    /// The times of its phones, if its visemes are those of the recording.
    pub phones: Option<Tier>,
}

impl<'s> GridExport<'s> {
    /// Returns the export for these clips, or `None` if no visemes of the project were made from a recording.
    ///
    /// # Errors
    /// If the record, or a file that affects visemes, cannot be read.
    pub fn new(settings: &'s Settings, inputs: &[Input]) -> Result<Option<GridExport<'s>>, Report> {
        let place = record_place(settings);
        if !place.is_file() {
            return Ok(None);
        }
        let record = SyncRecord::read(&place)?;
        // `check` and `SyncRun` report problems of the lexicon and unreadable folders.
        let (options, _) = SyncOptions::new_with_report(settings)?;
        let (recordings, _) = Recordings::discover_with_reports(settings);
        let jobs = jobs_of_clips(inputs, &recordings).into_iter().map(|job| (job.key.clone(), job)).collect();
        Ok(Some(GridExport { settings, options, record, recordings, jobs }))
    }

    /// Returns the tiers of a clip. For its phones, its recording is analysed again.
    pub fn of(&self, input: &Input) -> GridTiers {
        let grid = self.jobs.get(&input.key).and_then(|job| textgrid(job, &self.options, &self.record));
        let grid = grid.and_then(|grid| TextGrid::read(grid.as_bytes(), &mut Vec::new()));
        let Some(grid) = grid else {
            let words = match &input.content {
                Content::File(path) => self.words(input, path),
                Content::Bytes { .. } => None,
            };
            return GridTiers { words, phones: None };
        };
        let mut tiers = GridTiers::default();
        for tier in grid.tiers.into_iter().filter(|tier| tier.intervals.iter().any(|said| !said.label.is_empty())) {
            match tier.name.as_str() {
                "words" => tiers.words = Some(tier),
                "phones" => tiers.phones = Some(tier),
                _ => {}
            }
        }
        tiers
    }

    /// Returns the words of a clip, from the record.
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
