//! Mouths that never open although the clip has a text.

use crate::check::trigger::{Check, CheckedClip, Run, Trigger};
use crate::clip::ClipData;
use lipz_bank::babble::Weight;
use lipz_bank::{Viseme, VisemeType};
use lipz_diagnostics::{Code, Diagnostic};

/// Letters that are spoken with closed or nearly closed lips: `Hm`, `Mm-hm`.
const HUMMED: [char; 6] = ['h', 'm', 'n', 'H', 'M', 'N'];

/// The check for clips with a text whose frames are all rest or closed lips.
pub(in crate::check) const CHECKS: &[Check] = &[Check {
    trigger: Trigger::File(|file| !file.clip.texts.is_empty() && stay_shut(file.clip)),
    run: Run::Clip(never_opens),
}];

fn never_opens(file: &CheckedClip<'_>, diagnostics: &mut Vec<Diagnostic>) {
    let (Some(string), clip) = (file.roles.visemes, file.clip) else { return };
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
            Diagnostic::at(Code::MouthNeverOpens, string.span(), format!("the clip has a text, but the mouth {shape}"))
                .help("make visemes from the recording with `lipz sync`, or remove `visemes`"),
        );
    }
}

/// Whether the clip has frames, and all of them are rest or closed lips.
fn stay_shut(clip: &ClipData) -> bool {
    let is_shut = |code: &u8| match clip.viseme_type {
        Some(viseme_type) => Viseme::from_code(*code).openness(viseme_type) == Weight::default(),
        // `M`, `A` and `0` show different shapes in different types, but `-` is always rest.
        None => VisemeType::ALL.iter().all(|kind| Viseme::from_code(*code).openness(*kind) == Weight::default()),
    };
    !clip.frames.is_empty() && clip.frames.iter().all(is_shut)
}

/// Whether the codes belong to the clip's type. Wrong codes have been reported already, and their shapes are unknown.
pub(in crate::check) fn are_legal(clip: &ClipData) -> bool {
    match clip.viseme_type {
        Some(viseme_type) => viseme_type.contains_all(&clip.frames),
        None => VisemeType::ALL.iter().any(|viseme_type| viseme_type.contains_all(&clip.frames)),
    }
}
