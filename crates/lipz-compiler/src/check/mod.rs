//! Checks a file on the way from elements to a clip, and collects all diagnostics.

mod bank_limits;
mod blank;
mod checks;
mod clean;
mod clip_speech;
mod closed_lips;
pub(crate) mod convert;
mod curves;
mod elements;
mod emotions;
mod events;
mod fps;
mod gestures;
mod join;
pub(crate) mod locales;
mod names;
mod phones;
mod readability;
mod segment_table;
mod segments;
mod texts;
mod trigger;
mod types;
mod variants;
mod visemes;
mod word_clock;

pub(crate) use clean::CleanFiles;
pub(crate) use clip_speech::ClipSpeech;

use crate::clip::{ClipData, Locales};
use crate::locales::pseudo;
use crate::project::Options;
use elements::Roles;
use lipz_diagnostics::{Diagnostic, bound};
use lipz_file::{Document, Fragment, text};
use trigger::{CheckedClip, CheckedText};
use visemes::ExpectedCodes;

/// Fills `clip` with the clip that `document` describes. Its texts refer to `locales`. `spoken` has the times of the
/// words in one of the texts. Reports all diagnostics. If one of them is an error at the project's levels, the clip is
/// unusable.
///
/// The source record of the clip stays empty.
pub(crate) fn check(
    document: &Document<'_>,
    options: &Options,
    spoken: ClipSpeech<'_>,
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
        (Some(named), _) => ExpectedCodes::Named(named),
        // A wrong viseme_type has been reported already, so the codes are not checked against it.
        (None, _) if roles.viseme_type.is_some() => ExpectedCodes::Unknown,
        (None, Some(default)) => ExpectedCodes::Default(default),
        (None, None) => ExpectedCodes::Any,
    };
    if let Some(string) = roles.visemes {
        clip.has_visemes = true;
        visemes::frames(string, expected, clip, diagnostics);
    }
    let curves = roles.curves.map(|value| curves::curves(value, options, clip, diagnostics));
    if let Some(string) = roles.phones {
        phones::phones(string, clip, diagnostics);
    }
    // One element determines the number of segments. Elements with a different number are joined if that is allowed.
    let segment_count = match roles.reference(options, locales) {
        _ if clip.has_visemes => clip.starts.len(),
        reference => reference.map_or(1, |string| text::segment_count(&string.text)),
    };
    let mut counts_differ = false;
    let mut expected_count = |found: usize| {
        counts_differ |= segment_count != found;
        segment_count
    };
    for text in &roles.texts {
        bound::limit_many(diagnostics);
        texts::display_texts(text.string, options, &mut clip.displays, diagnostics);
        let count = expected_count(clip.displays.count());
        let (is_divided, locale) = (clip.displays.count() == count, locales.tag(text.locale));
        checks::run_on_text(
            &CheckedText { string: text.string, locale, displays: &clip.displays, clip, is_divided, options },
            diagnostics,
        );
        join::texts(&mut clip.displays, count);
        bank_limits::for_texts(text.string, &clip.displays, diagnostics);
        clip.add_displays(text.locale);
        let pseudo = options.pseudo_locale_of(locales.tag(text.locale)).map(|tag| locales.number(&tag, false));
        // A text in that locale in the file itself takes precedence.
        if let Some(pseudo) = pseudo.filter(|pseudo| roles.texts.iter().all(|text| text.locale != *pseudo)) {
            pseudo::translate(&mut clip.displays);
            bank_limits::for_texts(text.string, &clip.displays, diagnostics);
            clip.add_displays(pseudo);
        }
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
    variants::fill_blanks(locales, clip);
    emotions::curves(&roles, options, spoken, locales, clip, diagnostics);
    emotions::sums(&curves.unwrap_or_default(), clip, diagnostics);
    gestures::curves(&roles, options, spoken, locales, clip, diagnostics);
    checks::run_on_clip(&CheckedClip { roles: &roles, clip, locales, options }, diagnostics);
    bound::limit(diagnostics);
    bank_limits::for_segments(&roles, clip.starts.len(), diagnostics);
}

/// Checks a file that already has errors. If elements are missing, each element is checked separately, without fixes,
/// because they would not be certain.
pub(crate) fn fragment(fragment: &Fragment<'_>, options: &Options, diagnostics: &mut Vec<Diagnostic>) {
    let (document, mut found) = (&fragment.document, Vec::new());
    let (mut locales, mut clip) = (Locales::default(), ClipData::default());
    if fragment.is_complete {
        check(document, options, ClipSpeech::default(), &mut locales, &mut clip, diagnostics);
        return;
    }
    let roles = Roles::assign(document, options, &mut locales, &mut found);
    roles.fps.and_then(|number| fps::rate(number, &mut found));
    let viseme_type = roles.viseme_type.and_then(|name| visemes::viseme_type(name, &mut found));
    // Without a valid type, any code may be correct.
    if let (Some(string), Some(named)) = (roles.visemes, viseme_type) {
        visemes::frames(string, ExpectedCodes::Named(named), &mut clip, &mut found);
    }
    for text in &roles.texts {
        bound::limit_many(&mut found);
        texts::display_texts(text.string, options, &mut clip.displays, &mut found);
        let (displays, is_divided) = (&clip.displays, false);
        checks::run_on_text(
            &CheckedText {
                string: text.string,
                locale: locales.tag(text.locale),
                displays,
                clip: &clip,
                is_divided,
                options,
            },
            &mut found,
        );
        bank_limits::for_texts(text.string, &clip.displays, &mut found);
    }
    roles.curves.into_iter().for_each(|value| drop(curves::curves(value, options, &mut clip, &mut found)));
    roles.phones.into_iter().for_each(|string| phones::phones(string, &mut clip, &mut found));
    roles.events.into_iter().for_each(|string| drop(events::trimmed(string, options, &mut found)));
    found.iter_mut().for_each(|diagnostic| diagnostic.retain_fixes(|_| false));
    diagnostics.append(&mut found);
    bound::limit(diagnostics);
}
