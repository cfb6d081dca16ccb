//! Checking one file: from elements to a clip, with every diagnostic on the way.

mod bank_limits;
mod blank;
mod clean;
mod curves;
mod elements;
mod emotions;
mod events;
mod fps;
mod gestures;
mod join;
pub(crate) mod locales;
mod names;
mod readability;
mod segment_table;
mod segments;
mod share;
mod texts;
mod types;
mod visemes;

pub(crate) use clean::CleanFiles;

use crate::clip::{ClipData, Locales};
use crate::{Options, TextLimits, WordTimes, pseudo};
use elements::Roles;
use lipz_diagnostics::{Diagnostic, bound};
use lipz_file::{Document, Fragment, text};
use readability::Times;
use visemes::Expected;

/// How a clip is spoken, as far as that is known.
#[derive(Clone, Copy, Default)]
pub(crate) struct Spoken<'o> {
    /// The locale of its voice; without one, the default locale counts.
    locale: Option<&'o str>,
    /// When its words are said.
    times: Option<&'o WordTimes>,
}

impl<'o> Spoken<'o> {
    /// How the clip with this key is spoken.
    pub(crate) fn of(key: &str, options: &'o Options) -> Spoken<'o> {
        Spoken { locale: options.voices.locale_of(key), times: options.word_times.get(key) }
    }
}

/// Makes `clip` the one that `document` describes; its texts refer to `locales`. The words of one of them
/// are said at times of `spoken`. All diagnostics are
/// reported; if one of them is an error at the project's levels, the clip is of no use.
///
/// The source record of the clip is left empty.
pub(crate) fn check(
    document: &Document<'_>,
    options: &Options,
    spoken: Spoken<'_>,
    locales: &mut Locales,
    clip: &mut ClipData,
    diagnostics: &mut Vec<Diagnostic>,
) {
    clip.clear();
    let roles = Roles::assign(document, options, locales, diagnostics);
    clip.fps = roles.fps.and_then(|number| fps::rate(number, diagnostics)).or(options.default_fps);
    let viseme_type = roles.viseme_type.and_then(|name| visemes::viseme_type(name, diagnostics));
    clip.viseme_type = viseme_type.or(options.default_viseme_type);
    let expected = match (viseme_type, options.default_viseme_type) {
        (Some(named), _) => Expected::Named(named),
        // A wrong viseme_type is reported already: do not blame the codes for it.
        (None, _) if roles.viseme_type.is_some() => Expected::Unknown,
        (None, Some(default)) => Expected::Default(default),
        (None, None) => Expected::Any,
    };
    if let Some(string) = roles.visemes {
        clip.has_visemes = true;
        visemes::frames(string, expected, clip, diagnostics);
    }
    let curves = roles.curves.map(|value| curves::curves(value, &options.known_names, clip, diagnostics));
    // One element says how many segments there are; others are joined if that is allowed.
    let segment_count = match roles.reference(options, locales) {
        _ if clip.has_visemes => clip.starts.len(),
        reference => reference.map_or(1, |string| text::segment_count(&string.text)),
    };
    let mut counts_differ = false;
    let mut expected_count = |found: usize| {
        counts_differ |= segment_count != found;
        segment_count
    };
    let limits = (options.text_limits != TextLimits::default()).then_some(&options.text_limits);
    for text in &roles.texts {
        bound::limit_many(diagnostics);
        texts::display_texts(text.string, options, &mut clip.displays, diagnostics);
        let count = expected_count(clip.displays.count());
        if let Some(limits) = limits.filter(|_| clip.displays.count() == count) {
            readability::check(text.string, clip.displays.iter(), Times::new(clip).as_ref(), limits, diagnostics);
        }
        join::texts(&mut clip.displays, count);
        bank_limits::for_texts(text.string, &clip.displays, diagnostics);
        clip.add_displays(text.locale);
        let pseudo = options.pseudo_locale_of(locales.tag(text.locale)).map(|tag| locales.number(&tag, false));
        // A text that the file itself has in that locale stays the only one.
        if let Some(pseudo) = pseudo.filter(|pseudo| roles.texts.iter().all(|text| text.locale != *pseudo)) {
            pseudo::translate(&mut clip.displays);
            bank_limits::for_texts(text.string, &clip.displays, diagnostics);
            clip.add_displays(pseudo);
        }
    }
    if let Some(string) = roles.visemes {
        visemes::never_opens(string, clip, diagnostics);
    }
    clip.texts.sort_by(|a, b| locales.tag(a.locale).cmp(locales.tag(b.locale)));
    if let Some(string) = roles.events {
        clip.has_events = true;
        events::trimmed(string, options, diagnostics).into_iter().for_each(|event| clip.events.push(event));
        let count = expected_count(clip.events.count());
        join::events(&mut clip.events, count);
    }
    clip.has_joined = counts_differ;
    if counts_differ {
        segments::report_differing(&roles, options, locales, diagnostics);
    }
    if !clip.has_visemes {
        clip.starts.resize(segment_count, 0);
    }
    emotions::curves(&roles, options, spoken, locales, clip, diagnostics);
    emotions::sums(&curves.unwrap_or_default(), clip, diagnostics);
    gestures::curves(&roles, options, spoken, locales, clip, diagnostics);
    blank::report(&roles, clip, options, locales, diagnostics);
    bound::limit(diagnostics);
    bank_limits::for_segments(&roles, clip.starts.len(), diagnostics);
}

/// Looks for further mistakes in a file that has some already. Where elements are missing, each is checked by itself,
/// and no fix is certain.
pub(crate) fn fragment(fragment: &Fragment<'_>, options: &Options, diagnostics: &mut Vec<Diagnostic>) {
    let (document, mut found) = (&fragment.document, Vec::new());
    let (mut locales, mut clip) = (Locales::default(), ClipData::default());
    if fragment.is_complete {
        check(document, options, Spoken::default(), &mut locales, &mut clip, diagnostics);
        return;
    }
    let roles = Roles::assign(document, options, &mut locales, &mut found);
    roles.fps.and_then(|number| fps::rate(number, &mut found));
    let viseme_type = roles.viseme_type.and_then(|name| visemes::viseme_type(name, &mut found));
    // A type that cannot be read may be any.
    if let (Some(string), Some(named)) = (roles.visemes, viseme_type) {
        visemes::frames(string, Expected::Named(named), &mut clip, &mut found);
    }
    for text in &roles.texts {
        bound::limit_many(&mut found);
        texts::display_texts(text.string, options, &mut clip.displays, &mut found);
        bank_limits::for_texts(text.string, &clip.displays, &mut found);
    }
    roles.curves.into_iter().for_each(|value| drop(curves::curves(value, &options.known_names, &mut clip, &mut found)));
    roles.events.into_iter().for_each(|string| drop(events::trimmed(string, options, &mut found)));
    found.iter_mut().for_each(|diagnostic| diagnostic.retain_fixes(|_| false));
    diagnostics.append(&mut found);
    bound::limit(diagnostics);
}
