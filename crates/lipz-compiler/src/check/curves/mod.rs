//! Checks the curves of a file: their order, their range in the clip, and their names.

mod ranges;

use crate::clip::ClipData;
use crate::project::{Options, rigs};
use lipz_bank::face::{Emotion, FaceCurve};
use lipz_diagnostics::{Code, Diagnostic, Span, escape, suggest};
use lipz_file::{RawJson, curve};

/// The maximum number of wrong letters in a misspelt name if the project does not register curves. A project with many
/// curves of its own has some with similar names.
const SLIPS: usize = 2;

/// Adds the curves of an element with this value to the clip, whose frames are known.
pub(super) fn curves(
    value: &RawJson<'_>,
    options: &Options,
    clip: &mut ClipData,
    diagnostics: &mut Vec<Diagnostic>,
) -> OfFile {
    let mut of_file = OfFile::default();
    let mut curves = curve::parse(value, diagnostics).unwrap_or_default();
    curves.sort_by(|a, b| a.name.text.cmp(&b.name.text));
    for curve in &curves {
        diagnostics.extend(unknown(curve, options));
        diagnostics.extend(outside(curve, clip));
        diagnostics.extend(ranges::outside(curve));
        clip.curves.push(&curve.name.text, curve.keys.iter().map(|key| (key.frame, key.value)));
        if Emotion::from_name(who_and_what(&curve.name.text).1).is_some() {
            of_file.emotions.push((curve.name.text.to_string(), curve.name.span()));
        }
    }
    of_file
}

/// The data about a file's curves that later checks need.
#[derive(Default)]
pub(super) struct OfFile {
    /// The names and positions of the curves of emotions.
    pub(super) emotions: Vec<(String, Span)>,
}

/// Splits the name of a curve into the character with its `.`, and the rest: `mara.`, `fear`.
fn who_and_what(name: &str) -> (&str, &str) {
    name.split_at(name.rfind('.').map_or(0, |dot| dot + 1))
}

/// Returns the diagnostic for the first key after the end of the clip.
fn outside(curve: &curve::Curve<'_>, clip: &ClipData) -> Option<Diagnostic> {
    let frame_count = clip.frames.len();
    let is_outside = |key: &&curve::Key| clip.has_visemes && key.frame as usize > frame_count;
    let key = curve.keys.iter().find(is_outside)?;
    let count = curve.keys.iter().filter(is_outside).count();
    let message = format!("the key is at frame {}, but the clip has {frame_count} frames", key.frame);
    let diagnostic = Diagnostic::at(Code::CurveRange, key.span, message);
    let diagnostic = match count {
        1 => diagnostic,
        _ => diagnostic.note(format!("{} more keys of this curve are after the end of the clip", count - 1)),
    };
    Some(diagnostic.help(format!("write a frame from 0 to {frame_count}, the end of the clip")))
}

/// Returns the diagnostic for a name that programs are unlikely to read.
fn unknown(curve: &curve::Curve<'_>, options: &Options) -> Option<Diagnostic> {
    let name: &str = &curve.name.text;
    // The curves of characters other than the speaker start with the name of the character.
    let (who, what) = who_and_what(name);
    let of_somebody = |name: &str| Emotion::from_name(name).is_some() || FaceCurve::from_name(name).is_some();
    let registered = options.known_names.curves.as_ref();
    let is_known = registered.is_some_and(|names| names.contains(name))
        || (who != "." && of_somebody(what))
        || curve::is_arkit(name)
        || curve::LIVE_LINK_ANGLES.contains(&name)
        || rigs::has_curve(name, &options.rigs);
    if is_known {
        return None;
    }
    let names = || {
        let own = registered.into_iter().flatten().map(String::as_str);
        own.chain(Emotion::ALL.map(Emotion::name)).chain(FaceCurve::ALL.map(FaceCurve::name)).chain(curve::ARKIT)
    };
    let (who, near) = match suggest::nearest(name, names()) {
        None => (
            who,
            suggest::nearest(
                what,
                Emotion::ALL.map(Emotion::name).into_iter().chain(FaceCurve::ALL.map(FaceCurve::name)),
            ),
        ),
        near => ("", near),
    };
    let written = name.strip_prefix(who).unwrap_or(name);
    let is_slip = |near: &str| suggest::distance(written, near).is_some_and(|distance| distance <= SLIPS);
    let (message, near) = match (registered, near.filter(|near| is_slip(near))) {
        (None, None) => return None,
        (None, slip) => (format!("{} is similar to the name of a known curve", escape::quoted(name)), slip),
        (Some(_), _) => (format!("{} is not a registered curve", escape::quoted(name)), near),
    };
    let diagnostic = Diagnostic::at(Code::UnknownCurve, curve.name.span(), message);
    let diagnostic = diagnostic.note(
        "the known curves are the emotions, the curves of docs/guides/faces.md, the articulators, the weights of \
         rigs, the 52 blend shapes of ARKit and the registered curves",
    );
    let Some(near) = near.map(|near| format!("{who}{near}")) else {
        return Some(diagnostic.help("add it to `curves` in `[registry]` of lipz.toml if your rig has it"));
    };
    let quoted = escape::quoted(&near);
    let help = format!("did you mean {quoted}? If not, add the curve to `curves` in `[registry]` of lipz.toml");
    Some(diagnostic.help(help).suggest(curve.name.span(), lipz_file::literal(&near)))
}
