//! One pass over clean files: from bytes to a clip, without a document in between.
//!
//! Nearly every file has no diagnostic, no escape, and only the elements that have been in files since the first version of the
//! format. Such a file becomes a clip here. Whatever else stands in a file, the pass refuses it, and the full parser and
//! [`check`](super::check) read the file anew: so all diagnostics are theirs. Where both read a file, they make the same clip;
//! a test holds them to that.

mod elements;
mod gaps;
mod members;
mod strings;
#[cfg(test)]
mod tests;

use super::emotions::{self, Feeling};
use super::visemes;
use crate::clip::{ClipData, Locales};
use crate::options::GestureKeys;
use crate::source_record::{self, Recorder};
use crate::{Options, TextLimits};
use elements::{Element, Role, role};
use gaps::Gaps;
use lipz_bank::{Fps, VisemeType};
use lipz_file::{rate, text};
use lipz_layout::TEXT_MAX_BYTES;
use members::{Members, Unclean};
use std::ops::Range;
use strings::CleanStrings;

/// What a thread remembers from one clean file to the next.
pub(crate) struct CleanFiles<'o> {
    options: &'o Options,
    /// Whether files can be clean: nothing is asked for that needs a document.
    is_possible: bool,
    strings: CleanStrings,
    gaps: Gaps,
    /// The rate that the last file spelled so.
    rate: Option<(String, Fps)>,
    /// For each locale its place in the order of the tags.
    ranks: Vec<u32>,
    /// For each locale of a text of the last file the place of that.
    places: Vec<usize>,
    /// The elements of a file, with places in it.
    elements: Vec<Element>,
    /// The emotions in the events of a file, with the numbers of their segments.
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

    /// Makes `clip` the one of a file, with its source record; false if the full parser has to do that, and `clip` is then of
    /// no use.
    pub(crate) fn clip(&mut self, bytes: &[u8], locales: &Locales, clip: &mut ClipData) -> bool {
        // In so short a file, no text and no number of segments is too large for a bank.
        if !self.is_possible || bytes.len() > TEXT_MAX_BYTES {
            return false;
        }
        let Ok(text) = simdutf8::basic::from_utf8(bytes) else { return false };
        self.read(text, locales, clip).is_ok()
    }

    fn read(&mut self, file: &str, locales: &Locales, clip: &mut ClipData) -> Result<(), Unclean> {
        clip.clear();
        self.elements.clear();
        self.feelings.clear();
        let mut members = Members::of(file)?;
        // Of all elements, which must have as many.
        let mut segment_count = None;
        let (mut has_blank, mut fps, mut viseme_type) = (false, None, None);
        while let Some(role) = self.gaps.next(self.elements.len(), &mut members, |name| role(name, locales))? {
            let (place, held, found) = match role {
                Role::Fps => {
                    let place = members.number()?;
                    only_once(fps.replace(self.rate(&file[place.clone()])?).is_some())?;
                    (place, 0, None)
                }
                Role::VisemeType => {
                    let (place, _) = members.string(|_| Ok(()))?;
                    let named = file[place.clone()].parse::<VisemeType>().map_err(|_| Unclean)?;
                    only_once(viseme_type.replace(named).is_some())?;
                    let held = place.len();
                    (place, held, None)
                }
                Role::Visemes => {
                    only_once(std::mem::replace(&mut clip.has_visemes, true))?;
                    let (place, count) = members.string(|codes| {
                        visemes::add_segment(codes, clip);
                        Ok(())
                    })?;
                    (place, clip.frames.len(), Some(count))
                }
                Role::Events => {
                    only_once(std::mem::replace(&mut clip.has_events, true))?;
                    let (place, count) = self.events(&mut members, clip)?;
                    (place, clip.events.text().len(), Some(count))
                }
                Role::Text(locale) => {
                    let (place, count) = self.displays(&mut members, clip, &mut has_blank)?;
                    let held = clip.runs.text_bytes();
                    only_if(held > 0)?;
                    clip.end_run(locale, false);
                    (place, held, Some(count))
                }
            };
            only_if(found.is_none_or(|found| *segment_count.get_or_insert(found) == found))?;
            self.elements.push(Element { role, place, held });
        }
        clip.fps = fps.or(self.options.default_fps);
        clip.viseme_type = viseme_type.or(self.options.default_viseme_type);
        if !visemes::are_legal(clip) || !clip.texts.is_empty() && visemes::stay_shut(clip) {
            return Err(Unclean);
        }
        if !clip.has_visemes {
            clip.starts.resize(segment_count.unwrap_or(1), 0);
        }
        if !self.feelings.is_empty() && !emotions::of_clean_events(clip, &self.feelings, self.options) {
            return Err(Unclean);
        }
        self.order_texts(locales, clip)?;
        if has_blank {
            self.compare_blanks(locales, clip)?;
        }
        self.record(file, clip);
        Ok(())
    }

    fn rate(&mut self, number: &str) -> Result<Fps, Unclean> {
        if let Some((_, fps)) = self.rate.as_ref().filter(|(known, _)| known == number) {
            return Ok(*fps);
        }
        let rate = rate::parse(number).filter(|rate| rate.is_exact).ok_or(Unclean)?;
        let fps = Fps::new(rate.numerator, rate.denominator).ok_or(Unclean)?;
        self.rate = Some((number.to_owned(), fps));
        Ok(fps)
    }

    /// Adds the events of all segments of a string; where that is, and how many they are.
    fn events(&mut self, members: &mut Members<'_>, clip: &mut ClipData) -> Result<(Range<usize>, usize), Unclean> {
        members.string(|segment| {
            let number = clip.events.count();
            let add = |feeling: &Feeling| self.feelings.push((number, feeling.clone()));
            clip.events.push(text::trim(segment));
            only_if(self.strings.has_events(segment, self.options, add))
        })
    }

    /// Makes a run of the display texts of all segments of a string; where that is, and how many they are.
    fn displays(
        &mut self,
        members: &mut Members<'_>,
        clip: &mut ClipData,
        has_blank: &mut bool,
    ) -> Result<(Range<usize>, usize), Unclean> {
        let may_have_meta = members.has_braces && !self.options.literal_braces;
        members.string(|segment| {
            let shown = match may_have_meta {
                true => self.strings.without_meta(segment, self.options).ok_or(Unclean)?,
                false => text::trim(segment),
            };
            *has_blank |= shown.is_empty();
            clip.runs.push(shown.as_bytes());
            Ok(())
        })
    }

    /// Puts the texts into the order of their tags. Those that are packed must be all there are, and there to be packed.
    fn order_texts(&mut self, locales: &Locales, clip: &mut ClipData) -> Result<(), Unclean> {
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
            return Err(Unclean);
        }
        clip.texts.iter().enumerate().for_each(|(place, text)| self.places[text.locale as usize] = place);
        let Some(packed) = &self.options.locales else { return Ok(()) };
        let is_packed = |locale| packed.contains(locales.tag(locale));
        let are_the_same = clip.texts.len() == packed.len() && clip.texts.iter().all(|text| is_packed(text.locale));
        only_if(are_the_same)
    }

    /// Refuses a clip that shows nothing in a segment in which the default locale shows something.
    fn compare_blanks(&self, locales: &Locales, clip: &ClipData) -> Result<(), Unclean> {
        let default = self.options.default_locale.as_deref().and_then(|tag| locales.get(tag));
        let Some(spoken) = clip.texts.iter().find(|text| Some(text.locale) == default) else { return Ok(()) };
        let is_silent = |text, segment| clip.is_blank(text, segment) && !clip.is_blank(spoken, segment);
        let has_silent = |text| (0..clip.starts.len()).any(|segment| is_silent(text, segment));
        if clip.texts.iter().any(has_silent) { Err(Unclean) } else { Ok(()) }
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
                Role::Fps => source_record::FPS,
                Role::VisemeType => source_record::VISEME_TYPE,
                Role::Visemes => source_record::VISEMES,
                Role::Events => source_record::EVENTS,
                Role::Text(locale) => source_record::FIRST_TEXT + self.places[locale as usize] as u64,
            };
            match role {
                Role::Fps => record.number(name, place.clone()),
                _ => record.string(name, place.clone(), *held),
            }
        }
        clip.source = record.finish();
    }
}

/// Whether the project asks for nothing that needs a document. All options are named, so that a new one is thought of here.
fn are_possible(options: &Options) -> bool {
    let Options {
        text_limits,
        viseme_type,
        pseudo,
        gestures,
        // These the pass goes by.
        default_fps: _,
        default_viseme_type: _,
        default_locale: _,
        strip: _,
        locales: _,
        literal_braces: _,
        known_names: _,
        emotions: _,
        // These are about names that were seen before, about diagnostics and curves that clean files do not have, or about the bank.
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
        recordings: _,
    } = options;
    *text_limits == TextLimits::default() && viseme_type.is_none() && !pseudo && gestures.keys != GestureKeys::Words
}

/// Refuses an element that appears again.
fn only_once(is_again: bool) -> Result<(), Unclean> {
    only_if(!is_again)
}

/// Refuses a file that is not clean.
fn only_if(is_clean: bool) -> Result<(), Unclean> {
    if is_clean { Ok(()) } else { Err(Unclean) }
}
