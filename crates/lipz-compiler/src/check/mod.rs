//! Checking one file: from elements to a clip, with every finding on the way.

mod elements;
mod events;
mod fps;
mod limits;
mod locales;
mod names;
mod segments;
mod texts;
mod types;
mod visemes;

use crate::clip::ClipData;
use crate::{Options, TextLimits};
use elements::Roles;
use limits::Times;
use lipz::{Diagnostic, Document, Level};
use visemes::Expected;

/// The clip that `document` describes, or `None` if it has errors. All findings are reported.
///
/// `key` and `source` of the clip are left empty.
pub(crate) fn check(document: &Document<'_>, options: &Options, diagnostics: &mut Vec<Diagnostic>) -> Option<ClipData> {
    let first = diagnostics.len();
    let roles = Roles::assign(document, options, diagnostics);
    let fps = roles.fps.and_then(|number| fps::rate(number, diagnostics));
    let viseme_type = roles.viseme_type.and_then(|name| visemes::viseme_type(name, diagnostics));
    let expected = match (viseme_type, options.default_viseme_type) {
        (Some(named), _) => Expected::Named(named),
        // A wrong viseme_type is reported already: do not blame the codes for it.
        (None, _) if roles.viseme_type.is_some() => Expected::Unknown,
        (None, Some(default)) => Expected::Default(default),
        (None, None) => Expected::Any,
    };
    let frames = roles.visemes.map(|string| visemes::frames(string, expected, diagnostics));
    let texts: Vec<_> =
        roles.texts.iter().map(|text| texts::display_texts(text.string, options, diagnostics)).collect();
    let events = roles.events.map(|string| events::trimmed(string, diagnostics));
    let segment_count = segments::common_count(&roles, diagnostics);
    let fps = fps.or(options.default_fps);
    if options.text_limits != TextLimits::default() {
        let times = frames.as_ref().zip(fps).map(|((frames, starts), fps)| Times {
            starts,
            frame_count: frames.len() as u32,
            fps,
        });
        for (text, displays) in std::iter::zip(&roles.texts, &texts) {
            let displays = displays.iter().map(AsRef::as_ref);
            limits::check(text.string, displays, times.as_ref(), &options.text_limits, diagnostics);
        }
    }
    if diagnostics[first..].iter().any(|diagnostic| diagnostic.level == Level::Error) {
        return None;
    }
    let has_visemes = frames.is_some();
    let (frames, starts) = frames.unwrap_or_else(|| (Vec::new(), vec![0; segment_count]));
    let mut clip = ClipData {
        fps,
        viseme_type: viseme_type.or(options.default_viseme_type),
        has_visemes,
        frames,
        starts,
        events,
        ..ClipData::default()
    };
    let mut texts: Vec<_> = std::iter::zip(roles.texts, texts).collect();
    texts.sort_by(|(a, _), (b, _)| a.locale.cmp(&b.locale));
    let bytes = texts.iter().flat_map(|(_, displays)| displays).map(|display| display.len() + 4).sum();
    clip.reserve_texts(texts.len(), bytes);
    for (text, displays) in texts {
        clip.add_texts(text.locale, &displays);
    }
    Some(clip)
}
