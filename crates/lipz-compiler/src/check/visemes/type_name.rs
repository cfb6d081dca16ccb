//! The element `viseme_type`.

use lipz_bank::VisemeType;
use lipz_diagnostics::{Code, Diagnostic, escape, suggest};
use lipz_file::JsonString;

/// Returns the type in the element `viseme_type`.
pub(in crate::check) fn viseme_type(name: &JsonString<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<VisemeType> {
    let found = name.text.parse::<VisemeType>().ok();
    if found.is_none() {
        diagnostics.push(unknown(name));
    }
    found
}

fn unknown(name: &JsonString<'_>) -> Diagnostic {
    let diagnostic =
        |message| Diagnostic::at(Code::UnknownVisemeType, name.span(), message).note("write blair, toonboom or rms");
    if name.text.trim().is_empty() {
        return diagnostic("viseme_type is empty".into()).help("name the viseme type, or leave the element out");
    }
    let diagnostic = diagnostic(format!("{} is not a viseme type", escape::quoted(&name.text)));
    let known = VisemeType::ALL.map(VisemeType::name);
    // `preston blair`
    let part = || known.into_iter().find(|known| name.text.contains(known));
    match suggest::nearest(&name.text, known).or_else(part) {
        Some(known) if suggest::distance(&name.text, known) == Some(0) => {
            diagnostic.help(format!("write \"{known}\"")).fix(name.span(), format!("\"{known}\""))
        }
        Some(known) => {
            diagnostic.help(format!("did you mean \"{known}\"?")).suggest(name.span(), format!("\"{known}\""))
        }
        None => diagnostic,
    }
}
