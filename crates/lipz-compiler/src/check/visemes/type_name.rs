//! The element `viseme_type`.

use lipz::diagnostic::{show, suggest};
use lipz::{Code, Diagnostic, JsonString};
use lipz_bank::VisemeType;

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
    if name.text.trim().is_empty() {
        return finding("viseme_type is empty".into()).help("name the viseme type, or leave the element out");
    }
    let finding = finding(format!("{} is not a viseme type", show::name(&name.text)));
    let known = VisemeType::ALL.map(VisemeType::name);
    // `preston blair`
    let part = || known.into_iter().find(|known| name.text.contains(known));
    match suggest::nearest(&name.text, known).or_else(part) {
        Some(known) if suggest::distance(&name.text, known) == Some(0) => {
            finding.help(format!("write \"{known}\"")).fix(name.span(), format!("\"{known}\""))
        }
        Some(known) => finding.help(format!("did you mean \"{known}\"?")),
        None => finding,
    }
}
