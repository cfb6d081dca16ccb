//! A single pass over clean files, from bytes to a clip without a document in between.
//!
//! Most files do not have diagnostics or escapes, and contain only the elements of the first version of the format.
//! This pass turns such a file into a clip. It refuses all other files, and those on which one of the [`checks`] may
//! report something. The full parser and [`check`](super::check) then read the file again, so that all diagnostics come
//! from them. Both ways produce the same clip, which a test compares.

mod elements;
mod gaps;
mod members;
mod strings;
#[cfg(test)]
mod tests;

use super::checks;
use super::emotions::{self, Feeling};
use super::trigger::CleanFile;
use super::visemes;
use crate::clip::source_record::{self, Recorder};
use crate::clip::{ClipData, Locales};
use crate::project::Options;
use crate::project::options::GestureKeys;
use elements::{CleanRole, Element, role};
use gaps::Gaps;
use lipz_bank::{Fps, VisemeType};
use lipz_file::{rate, text};
use lipz_layout::TEXT_MAX_BYTES;
use members::{Members, UncleanFile};
use std::ops::Range;
use strings::CleanStrings;

/// The data that a thread keeps from one clean file to the next.
pub(crate) struct CleanFiles<'o> {
    options: &'o Options,
    /// Whether files can be clean, because no option needs a document.
    is_possible: bool,
    strings: CleanStrings,
    gaps: Gaps,
    /// The last frame rate with its spelling.
    rate: Option<(String, Fps)>,
    /// For each locale, its index in the sorted list of tags.
    ranks: Vec<u32>,
    /// For each locale of the last file's texts, the index of its text.
    places: Vec<usize>,
    /// The elements of a file with their byte ranges.
    elements: Vec<Element>,
    /// The emotions in the events of a file, each with the number of its segment.
    feelings: Vec<(usize, Feeling)>,
}

impl<'o> CleanFiles<'o> {
    pub(crate) fn new(options: &'o Options) -> CleanFiles<'o> {
        CleanFiles {
            options,
            is_possible: are_possible(options),
            strings: CleanStrings::new(),
            gaps: Gaps::default(),
            rate: None,
            ranks: Vec::new(),
            places: Vec::new(),
            elements: Vec::new(),
            feelings: Vec::new(),
        }
    }

    /// Fills `clip` with the clip of a file and its source record. Returns false if the full parser has to read the
    /// file, and `clip` is then unusable.
    pub(crate) fn clip(&mut self, bytes: &[u8], locales: &Locales, clip: &mut ClipData) -> bool {
        // A file this short cannot contain a text or a number of segments that is too large for a bank.
        if !self.is_possible || bytes.len() > TEXT_MAX_BYTES {
            return false;
        }
        let Ok(text) = simdutf8::basic::from_utf8(bytes) else { return false };
        self.read(text, locales, clip).is_ok()
    }

    fn read(&mut self, file: &str, locales: &Locales, clip: &mut ClipData) -> Result<(), UncleanFile> {
        clip.clear();
        self.elements.clear();
        self.feelings.clear();
        let mut members = Members::of(file)?;
        // The number of segments of the first element. All elements must have the same number.
        let mut segment_count = None;
        let (mut has_blank, mut fps, mut viseme_type) = (false, None, None);
        while let Some(role) = self.gaps.next(self.elements.len(), &mut members, |name| role(name, locales))? {
            let (place, held, found) = match role {
                CleanRole::Fps => {
                    let place = members.number()?;
                    only_once(fps.replace(self.rate(&file[place.clone()])?).is_some())?;
                    (place, 0, None)
                }
                CleanRole::VisemeType => {
                    let (place, _) = members.string(|_| Ok(()))?;
                    let named = file[place.clone()].parse::<VisemeType>().map_err(|_| UncleanFile)?;
                    only_once(viseme_type.replace(named).is_some())?;
                    let held = place.len();
                    (place, held, None)
                }
                CleanRole::Visemes => {
                    only_once(std::mem::replace(&mut clip.has_visemes, true))?;
                    let (place, count) = members.string(|codes| {
                        visemes::add_segment(codes, clip);
                        Ok(())
                    })?;
                    (place, clip.frames.len(), Some(count))
                }
                CleanRole::Events => {
                    only_once(std::mem::replace(&mut clip.has_events, true))?;
                    let (place, count) = self.events(&mut members, clip)?;
                    (place, clip.events.text().len(), Some(count))
                }
                CleanRole::Text(locale) => {
                    let (place, count) = self.displays(&mut members, clip, &mut has_blank)?;
                    let held = clip.runs.text_bytes();
                    clip.end_run(locale, false);
                    (place, held, Some(count))
                }
            };
            only_if(found.is_none_or(|found| *segment_count.get_or_insert(found) == found))?;
            self.elements.push(Element { role, place, held });
        }
        clip.fps = fps.or(self.options.default_fps);
        clip.viseme_type = viseme_type.or(self.options.default_viseme_type);
        only_if(visemes::are_legal(clip))?;
        if !clip.has_visemes {
            clip.starts.resize(segment_count.unwrap_or(1), 0);
        }
        if !self.feelings.is_empty() && !emotions::of_clean_events(clip, &self.feelings, self.options) {
            return Err(UncleanFile);
        }
        self.order_texts(locales, clip)?;
        only_if(!checks::may_report(&CleanFile { clip, locales, options: self.options, has_blank }))?;
        self.record(file, clip);
        Ok(())
    }

    fn rate(&mut self, number: &str) -> Result<Fps, UncleanFile> {
        if let Some((_, fps)) = self.rate.as_ref().filter(|(known, _)| known == number) {
            return Ok(*fps);
        }
        let rate = rate::parse(number).filter(|rate| rate.is_exact).ok_or(UncleanFile)?;
        let fps = Fps::new(rate.numerator, rate.denominator).ok_or(UncleanFile)?;
        self.rate = Some((number.to_owned(), fps));
        Ok(fps)
    }

    /// Adds the events in all segments of a string. Returns its range and the number of segments.
    fn events(&mut self, members: &mut Members<'_>, clip: &mut ClipData) -> Result<(Range<usize>, usize), UncleanFile> {
        members.string(|segment| {
            let number = clip.events.count();
            let add = |feeling: &Feeling| self.feelings.push((number, feeling.clone()));
            clip.events.push(text::trim(segment));
            only_if(self.strings.has_events(segment, self.options, add))
        })
    }

    /// Adds the display texts of all segments of a string as a run. Returns the range of the string and the number of
    /// segments.
    fn displays(
        &mut self,
        members: &mut Members<'_>,
        clip: &mut ClipData,
        has_blank: &mut bool,
    ) -> Result<(Range<usize>, usize), UncleanFile> {
        let may_have_meta = members.has_braces && !self.options.literal_braces;
        members.string(|segment| {
            let shown = match may_have_meta {
                true => self.strings.without_meta(segment, self.options).ok_or(UncleanFile)?,
                false => text::trim(segment),
            };
            *has_blank |= shown.is_empty();
            clip.runs.push(shown.as_bytes());
            Ok(())
        })
    }

    /// Sorts the texts by tag. If the options list locales, the file must have a text for each of them, and no other
    /// texts.
    fn order_texts(&mut self, locales: &Locales, clip: &mut ClipData) -> Result<(), UncleanFile> {
        let tags = locales.tags();
        if self.ranks.len() != tags.len() {
            let mut order: Vec<u32> = (0..tags.len() as u32).collect();
            order.sort_unstable_by_key(|&number| &tags[number as usize]);
            self.ranks.resize(tags.len(), 0);
            self.places.resize(tags.len(), 0);
            (0..).zip(order).for_each(|(rank, number)| self.ranks[number as usize] = rank);
        }
        clip.texts.sort_unstable_by_key(|text| self.ranks[text.locale as usize]);
        if clip.texts.array_windows().any(|[one, next]| one.locale == next.locale) {
            return Err(UncleanFile);
        }
        clip.texts.iter().enumerate().for_each(|(place, text)| self.places[text.locale as usize] = place);
        let Some(packed) = &self.options.locales else { return Ok(()) };
        let is_packed = |locale| packed.contains(locales.tag(locale));
        let are_the_same = clip.texts.len() == packed.len() && clip.texts.iter().all(|text| is_packed(text.locale));
        only_if(are_the_same)
    }

    /// Makes the source record of the clip.
    fn record(&self, file: &str, clip: &mut ClipData) {
        if self.options.strip {
            return;
        }
        let buffer = std::mem::take(&mut clip.source);
        let mut record = Recorder::new(file, self.elements.len(), clip.starts.len(), buffer);
        for Element { role, place, held } in &self.elements {
            let name = match *role {
                CleanRole::Fps => source_record::FPS,
                CleanRole::VisemeType => source_record::VISEME_TYPE,
                CleanRole::Visemes => source_record::VISEMES,
                CleanRole::Events => source_record::EVENTS,
                CleanRole::Text(locale) => source_record::FIRST_TEXT + self.places[locale as usize] as u64,
            };
            match role {
                CleanRole::Fps => record.number(name, place.clone()),
                _ => record.string(name, place.clone(), *held),
            }
        }
        clip.source = record.finish();
    }
}

/// Whether no option of the project needs a document. The pattern names all options, so that each new option needs a
/// decision here.
fn are_possible(options: &Options) -> bool {
    let Options {
        viseme_type,
        pseudo,
        gestures,
        baked_rig,
        // A check covers these.
        text_limits: _,
        locale_limits: _,
        // The pass follows these.
        default_fps: _,
        default_viseme_type: _,
        default_locale: _,
        strip: _,
        locales: _,
        literal_braces: _,
        known_names: _,
        emotions: _,
        // These concern names from earlier files, the bank, or diagnostics and curves, which clean files do not have.
        extended_locales: _,
        levels: _,
        files_levels: _,
        word_times: _,
        voices: _,
        threads: _,
        fallbacks: _,
        min_coverage: _,
        babble: _,
        faces: _,
        articulation: _,
        rigs: _,
        recordings: _,
    } = options;
    let adds_curves = gestures.keys == GestureKeys::Words || baked_rig.is_some();
    viseme_type.is_none() && !pseudo && !adds_curves && !checks::may_report_all(options)
}

/// Refuses an element that appears again.
fn only_once(is_again: bool) -> Result<(), UncleanFile> {
    only_if(!is_again)
}

/// Refuses a file that is not clean.
fn only_if(is_clean: bool) -> Result<(), UncleanFile> {
    if is_clean { Ok(()) } else { Err(UncleanFile) }
}
