//! The diagnostics about conversions that lose shapes or are refused.

use super::Conversion;
use super::chart::MERGED;
use lipz_bank::VisemeType;
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::{Document, Element, Value};

/// Returns the warning about frames whose shape is missing in the new type.
pub(crate) fn loss(document: &Document<'_>, conversion: &Conversion) -> Option<Diagnostic> {
    let (VisemeType::Blair, VisemeType::ToonBoom) = (conversion.from, conversion.to) else { return None };
    let Value::String(visemes) = &document.get("visemes")?.value else { return None };
    let is_merged = |code: char| MERGED.iter().any(|(blair, _)| char::from(*blair) == code);
    let first = visemes.text.find(is_merged)?;
    let count = visemes.text.matches(is_merged).count();
    let frames = |count: usize| if count == 1 { "1 frame".to_owned() } else { format!("{count} frames") };
    let loses = if count == 1 { "loses its" } else { "lose their" };
    let message = format!("{} {loses} own mouth shape because toonboom has no `L` or `U`", frames(count));
    let diagnostic = Diagnostic::at(Code::ConversionLoss, visemes.span_of(first..first + 1), message);
    let diagnostic = MERGED.iter().fold(diagnostic, |diagnostic, &(blair, toonboom)| {
        let (blair, toonboom) = (char::from(blair), char::from(toonboom));
        match visemes.text.matches(blair).count() {
            0 => diagnostic,
            count => diagnostic.note(format!("`{blair}` becomes `{toonboom}` in {}", frames(count))),
        }
    });
    Some(diagnostic.help("keep the blair file; converting back writes `S` and `W` instead"))
}

/// Returns the error for codes without counterparts.
pub(super) fn refused(document: &Document<'_>, from: VisemeType, to: VisemeType) -> Diagnostic {
    let diagnostic = about_type(document, format!("{from} codes cannot be converted to {to}"))
        .note("rms codes state the loudness of a frame, blair and toonboom codes its mouth shape");
    match to {
        VisemeType::Rms => diagnostic.help("make the rms codes from the recording"),
        _ => diagnostic.help(format!("make the {to} codes from the recording, or animate them by hand")),
    }
}

/// Returns the error for codes that show different shapes in the types that they may belong to.
pub(super) fn ambiguous(document: &Document<'_>, candidates: &[VisemeType]) -> Diagnostic {
    let names: Vec<&str> = candidates.iter().map(|known| known.name()).collect();
    let message = format!("these codes cannot be converted because they may be {}", names.join(" or "));
    let example = names.first().copied().unwrap_or_default();
    about_type(document, message).help(format!(
        "name the viseme type: \"viseme_type\": \"{example}\" in the file, or default-viseme-type = \"{example}\" in \
            lipz.toml"
    ))
}

/// Returns a diagnostic at the viseme type, or at the codes if the file does not name their type.
fn about_type(document: &Document<'_>, message: String) -> Diagnostic {
    let element = document.get("viseme_type").or_else(|| document.get("visemes"));
    match element {
        Some(Element { value, .. }) => Diagnostic::at(Code::NotConvertible, value.span(), message),
        None => Diagnostic::new(Code::NotConvertible, message),
    }
}
