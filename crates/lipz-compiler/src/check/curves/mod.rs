//! Curves of a file: in order, inside the clip, and of names that programs ask for.

mod ranges;

use crate::KnownNames;
use crate::clip::ClipData;
use lipz_bank::face::{Emotion, FaceCurve};
use lipz_diagnostics::{Code, Diagnostic, Span, escape, suggest};
use lipz_file::{Raw, curve};

/// Letters that may differ where no curves are registered: who has many of their own has some that are like others.
const SLIPS: usize = 2;

/// Gives the clip, whose frames are known, the curves of an element with this value.
pub(super) fn curves(
    value: &Raw<'_>,
    known_names: &KnownNames,
    clip: &mut ClipData,
    diagnostics: &mut Vec<Diagnostic>,
) -> OfFile {
    let mut of_file = OfFile::default();
    let mut curves = curve::parse(value, diagnostics).unwrap_or_default();
    curves.sort_by(|a, b| a.name.text.cmp(&b.name.text));
    for curve in &curves {
        diagnostics.extend(unknown(curve, known_names));
        diagnostics.extend(outside(curve, clip));
        diagnostics.extend(ranges::outside(curve));
        clip.curves.push(&curve.name.text, curve.keys.iter().map(|key| (key.frame, key.value)));
        if Emotion::from_name(who_and_what(&curve.name.text).1).is_some() {
            of_file.emotions.push((curve.name.text.to_string(), curve.name.span()));
        }
    }
    of_file
}

/// What later checks need of the curves of a file.
#[derive(Default)]
pub(super) struct OfFile {
    /// The curves of emotions, and where they are.
    pub(super) emotions: Vec<(String, Span)>,
}

/// The character in front of the name of a curve, with the `.`, and the rest: `mara.`, `fear`.
fn who_and_what(name: &str) -> (&str, &str) {
    name.split_at(name.rfind('.').map_or(0, |dot| dot + 1))
}

/// What is wrong with the first key behind the clip.
fn outside(curve: &curve::Curve<'_>, clip: &ClipData) -> Option<Diagnostic> {
    let frame_count = clip.frames.len();
    let is_outside = |key: &&curve::Key| clip.has_visemes && key.frame as usize > frame_count;
    let key = curve.keys.iter().find(is_outside)?;
    let count = curve.keys.iter().filter(is_outside).count();
    let message = format!("a key at frame {}, but the clip has {frame_count} frames", key.frame);
    let diagnostic = Diagnostic::at(Code::CurveRange, key.span, message);
    let diagnostic = match count {
        1 => diagnostic,
        _ => diagnostic.note(format!("{} more keys of this curve lie behind the clip", count - 1)),
    };
    Some(diagnostic.help(format!("write frames from 0 to {frame_count}, which is the end of the clip")))
}

/// The diagnostic for a name that no program is likely to ask for.
fn unknown(curve: &curve::Curve<'_>, known_names: &KnownNames) -> Option<Diagnostic> {
    let name: &str = &curve.name.text;
    // Curves of others than the speaker have their name in front.
    let (who, what) = who_and_what(name);
    let of_somebody = |name: &str| Emotion::from_name(name).is_some() || FaceCurve::from_name(name).is_some();
    let registered = known_names.curves.as_ref();
    let is_known = registered.is_some_and(|names| names.contains(name))
        || (who != "." && of_somebody(what))
        || curve::is_arkit(name);
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
        (None, slip) => (format!("{} is nearly the name of a known curve", escape::quoted(name)), slip),
        (Some(_), _) => (format!("{} is not a registered curve", escape::quoted(name)), near),
    };
    let diagnostic = Diagnostic::at(Code::UnknownCurve, curve.name.span(), message);
    Some(diagnostic.note("known are the emotions, the curves of docs/guides/faces.md, the 52 blend shapes of ARKit and the registered curves").help(
        match near {
            Some(near) => format!(
                "did you mean {}? If it is a curve of your own, register it: `curves` in `[registry]`",
                escape::quoted(&format!("{who}{near}"))
            ),
            None => "if your rig has it, add it to `curves` in `[registry]` of lipz.toml".to_owned(),
        },
    ))
}
