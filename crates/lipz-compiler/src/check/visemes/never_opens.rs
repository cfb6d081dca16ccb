//! A mouth that never opens, though something is said.

use crate::clip::ClipData;
use lipz_bank::babble::Weight;
use lipz_bank::{Viseme, VisemeType};
use lipz_diagnostics::{Code, Diagnostic};
use lipz_file::JsonString;

/// Letters that are said with closed lips, or nearly so: `Hm`, `Mm-hm`.
const HUMMED: [char; 6] = ['h', 'm', 'n', 'H', 'M', 'N'];

/// Reports a clip with a text whose frames are all rest or closed lips. The texts of `clip` are complete.
pub(in crate::check) fn never_opens(string: &JsonString<'_>, clip: &ClipData, diagnostics: &mut Vec<Diagnostic>) {
    if !stay_shut(clip) || !are_legal(clip) {
        return;
    }
    let is_at_rest = clip.frames.iter().all(|code| matches!(code, b'-' | b'0'));
    let texts = clip.texts.iter().map(|text| clip.text_of(text));
    let is_said = |text: &[u8]| match is_at_rest {
        true => !text.is_empty(),
        false => {
            std::str::from_utf8(text).is_ok_and(|text| text.chars().any(|c| c.is_alphabetic() && !HUMMED.contains(&c)))
        }
    };
    if texts.into_iter().any(is_said) {
        let shape = if is_at_rest { "rests in every frame" } else { "never opens" };
        diagnostics.push(
            Diagnostic::at(Code::MouthNeverOpens, string.span(), format!("something is said, but the mouth {shape}"))
                .help("make mouth shapes of the recording, or remove `visemes`"),
        );
    }
}

/// Whether all frames of the clip, if it has any, are rest or closed lips.
pub(in crate::check) fn stay_shut(clip: &ClipData) -> bool {
    let is_shut = |code: &u8| match clip.viseme_type {
        Some(viseme_type) => Viseme::from_code(*code).openness(viseme_type) == Weight::default(),
        // `M`, `A` and `0` are other shapes in each type; rest is `-` in all.
        None => VisemeType::ALL.iter().all(|kind| Viseme::from_code(*code).openness(*kind) == Weight::default()),
    };
    !clip.frames.is_empty() && clip.frames.iter().all(is_shut)
}

/// Whether the codes are of the clip's type; wrong ones are reported already, and may mean anything.
pub(in crate::check) fn are_legal(clip: &ClipData) -> bool {
    match clip.viseme_type {
        Some(viseme_type) => viseme_type.contains_all(&clip.frames),
        None => VisemeType::ALL.iter().any(|viseme_type| viseme_type.contains_all(&clip.frames)),
    }
}
