//! The element `viseme_type`.

use lipz::diagnostic::show;
use lipz::{Code, Diagnostic, JsonString};
use lipz_bank::VisemeType;

/// Characters of a name that are compared with the known ones.
const COMPARED: usize = 40;

/// The type that the element `viseme_type` names.
pub(in crate::check) fn viseme_type(name: &JsonString<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<VisemeType> {
    let found = VisemeType::from_name(&name.text);
    if found.is_none() {
        diagnostics.push(unknown(name));
    }
    found
}

fn unknown(name: &JsonString<'_>) -> Diagnostic {
    let finding = |headline| {
        Diagnostic::at(Code::UnknownVisemeType, name.span(), headline)
            .note("the viseme types are blair, toonboom and rms")
    };
    let written: String = name.text.to_lowercase().chars().filter(|c| c.is_alphanumeric()).take(COMPARED).collect();
    if written.is_empty() && name.text.trim().is_empty() {
        return finding("viseme_type is empty".into()).help("name the viseme type, or leave the element out");
    }
    let finding = finding(format!("{} is not a viseme type", show::name(&name.text)));
    let known = VisemeType::ALL.into_iter();
    let nearest = known.map(|known| (distance(&written, known.name()), known)).min_by_key(|&(distance, _)| distance);
    match nearest {
        Some((0, known)) => finding.help(format!("write \"{known}\"")).fix(name.span(), format!("\"{known}\"")),
        Some((1..=2, known)) => finding.help(format!("did you mean \"{known}\"?")),
        _ => finding,
    }
}

/// Letters to change; few if the known name is a part of what is written, `preston blair`.
fn distance(written: &str, known: &str) -> usize {
    let distance = strsim::damerau_levenshtein(written, known);
    if distance > 2 && written.contains(known) { 2 } else { distance }
}
