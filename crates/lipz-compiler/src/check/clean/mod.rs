//! One pass over clean files: from bytes to a clip, without a document in between.
//!
//! Nearly every file has no diagnostic, no escape, and only the elements that have been in files since the first version of the
//! format. Such a file becomes a clip here. Whatever else stands in a file, the pass refuses it, and the full parser and
//! [`check`](super::check) read the file anew: so all diagnostics are theirs. Where both read a file, they make the same clip;
//! a test holds them to that.

mod members;
mod strings;
#[cfg(test)]
mod tests;

use super::emotions::{self, Feeling};
use super::visemes;
use crate::clip::{ClipData, Locales};
use crate::options::GestureKeys;
use crate::source_record::Recorder;
use crate::{Options, TextLimits};
use lipz_bank::{Fps, VisemeType};
use lipz_file::{rate, text};
use lipz_layout::TEXT_MAX_BYTES;
use members::{Members, Unclean, Value, has_braces};
use strings::CleanStrings;

/// What a thread remembers from one clean file to the next.
pub(crate) struct CleanFiles<'o> {
    options: &'o Options,
    /// Whether files can be clean: nothing is asked for that needs a document.
    is_possible: bool,
    strings: CleanStrings,
    /// The rate that the last file spelled so.
    rate: Option<(String, Fps)>,
    /// For each locale its place in the order of the tags.
    ranks: Vec<u32>,
    /// The elements of a file, with places in it.
    elements: Vec<Element>,
    /// The emotions in the events of a file, with the numbers of their segments.
    feelings: Vec<(usize, Feeling)>,
}

/// An element of a clean file.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    Fps,
    VisemeType,
    Visemes,
    Events,
    /// The text of the locale with this number.
    Text(u32),
}

/// An element, and where its value stands.
struct Element {
    role: Role,
    start: usize,
    end: usize,
}

impl<'o> CleanFiles<'o> {
    pub(crate) fn new(options: &'o Options) -> CleanFiles<'o> {
        CleanFiles {
            options,
            is_possible: are_possible(options),
            strings: CleanStrings::new(),
            rate: None,
            ranks: Vec::new(),
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
        while let Some((name, value)) = members.next()? {
            let role = role(name, locales)?;
            let (string, found) = match (role, value) {
                (Role::Fps, Value::Number(number)) => {
                    only_once(fps.replace(self.rate(number)?).is_some())?;
                    (number, None)
                }
                (Role::VisemeType, Value::String(string)) => {
                    let named = string.parse::<VisemeType>().map_err(|_| Unclean)?;
                    only_once(viseme_type.replace(named).is_some())?;
                    (string, None)
                }
                (Role::Visemes, Value::String(string)) => {
                    only_once(std::mem::replace(&mut clip.has_visemes, true))?;
                    visemes::divide(string, clip);
                    (string, Some(clip.starts.len()))
                }
                (Role::Events, Value::String(string)) => {
                    only_once(std::mem::replace(&mut clip.has_events, true))?;
                    (string, Some(self.events(string, clip)?))
                }
                (Role::Text(locale), Value::String(string)) => {
                    self.displays(string, members.has_braces, clip)?;
                    has_blank |= clip.displays.iter().any(str::is_empty);
                    clip.add_displays(locale);
                    (string, Some(clip.displays.count()))
                }
                _ => return Err(Unclean),
            };
            if found.is_some_and(|found| *segment_count.get_or_insert(found) != found) {
                return Err(Unclean);
            }
            let start = string.as_ptr() as usize - file.as_ptr() as usize;
            self.elements.push(Element { role, start, end: start + string.len() });
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

    /// Adds the events of all segments, and counts these.
    fn events(&mut self, string: &str, clip: &mut ClipData) -> Result<usize, Unclean> {
        for (number, range) in text::segments(string).enumerate() {
            let segment = &string[range];
            let feelings = &mut self.feelings;
            let add = |feeling: &Feeling| feelings.push((number, feeling.clone()));
            if !self.strings.has_events(segment, self.options, add) {
                return Err(Unclean);
            }
            clip.events.push(text::trim(segment));
        }
        Ok(clip.events.count())
    }

    /// Makes the display texts of all segments.
    fn displays(&mut self, string: &str, may_have_braces: bool, clip: &mut ClipData) -> Result<(), Unclean> {
        clip.displays.clear();
        let has_meta = may_have_braces && !self.options.literal_braces && has_braces(string);
        for range in text::segments(string) {
            if has_meta {
                let segment = &string[range];
                let mut metas = text::meta_ranges(segment).into_iter();
                let are_clean = metas.all(|meta| self.strings.has_meta(&segment[meta], self.options));
                let display = text::display(segment);
                if !are_clean || !display.unbalanced.is_empty() || !display.nested.is_empty() {
                    return Err(Unclean);
                }
                clip.displays.push(&display.text);
            } else {
                clip.displays.push(text::trim(&string[range]));
            }
        }
        if clip.displays.text().is_empty() { Err(Unclean) } else { Ok(()) }
    }

    /// Puts the texts into the order of their tags. Those that are packed must be all there are, and there to be packed.
    fn order_texts(&mut self, locales: &Locales, clip: &mut ClipData) -> Result<(), Unclean> {
        let tags = locales.tags();
        if self.ranks.len() != tags.len() {
            let mut order: Vec<u32> = (0..tags.len() as u32).collect();
            order.sort_unstable_by_key(|&number| &tags[number as usize]);
            self.ranks.resize(tags.len(), 0);
            (0..).zip(order).for_each(|(rank, number)| self.ranks[number as usize] = rank);
        }
        clip.texts.sort_unstable_by_key(|text| self.ranks[text.locale as usize]);
        if clip.texts.array_windows().any(|[one, next]| one.locale == next.locale) {
            return Err(Unclean);
        }
        let Some(packed) = &self.options.locales else { return Ok(()) };
        let is_packed = |locale| packed.contains(locales.tag(locale));
        let are_the_same = clip.texts.len() == packed.len() && clip.texts.iter().all(|text| is_packed(text.locale));
        if are_the_same { Ok(()) } else { Err(Unclean) }
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
        let rank = |locale: u32| self.ranks[locale as usize];
        let buffer = std::mem::take(&mut clip.source);
        let mut record = Recorder::new(clip, buffer, self.elements.len());
        for Element { role, start, end } in &self.elements {
            let spelled = &file[*start..*end];
            match *role {
                Role::Fps => record.fps(spelled),
                Role::VisemeType => record.known("viseme_type", spelled),
                Role::Visemes => record.known("visemes", spelled),
                Role::Events => record.known("events", spelled),
                Role::Text(locale) => {
                    let place = clip.texts.binary_search_by_key(&rank(locale), |text| rank(text.locale));
                    record.text(place.unwrap_or_else(|place| place), spelled);
                }
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

/// The role of the element with this name; that of a text only if its locale is known to be clean.
fn role(name: &str, locales: &Locales) -> Result<Role, Unclean> {
    if let Some(locale) = name.strip_prefix("text_").and_then(|tag| locales.clean(tag)) {
        return Ok(Role::Text(locale));
    }
    match name {
        "fps" => Ok(Role::Fps),
        "viseme_type" => Ok(Role::VisemeType),
        "visemes" => Ok(Role::Visemes),
        "events" => Ok(Role::Events),
        _ => Err(Unclean),
    }
}

/// Refuses an element that appears again.
fn only_once(is_again: bool) -> Result<(), Unclean> {
    if is_again { Err(Unclean) } else { Ok(()) }
}
