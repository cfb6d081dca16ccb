//! Names that are not in the format, and suggestions for them.

use lipz_diagnostics::{Code, Diagnostic, escape, suggest};
use lipz_file::Element;
use lipz_file::locale::{self, TextName};

/// Names of elements in the format, except texts.
const NAMES: [&str; 5] = ["fps", "visemes", "viseme_type", "events", "curves"];

/// Returns the diagnostic for a name that is not in the format.
pub(super) fn unknown(element: &Element<'_>) -> Diagnostic {
    let name = element.name.text.as_ref();
    let message = if name.is_empty() {
        "an element has an empty name".to_owned()
    } else {
        format!("{} is not an element of the format", escape::quoted(name))
    };
    Diagnostic::at(Code::UnknownElement, element.name.span(), message)
        .note("it is kept for unpacking; games do not see it")
        .help(match suggestion(name) {
            Some(known) => format!("did you mean `{known}`?"),
            None => "use one of fps, viseme_type, visemes, text_ll-cc, events, curves".to_owned(),
        })
}

/// Returns the element that was probably meant by `name`.
fn suggestion(name: &str) -> Option<String> {
    let written = name.to_lowercase();
    // `Text_en-us`, `texten-us`
    let locale = written.strip_prefix("text").map(|rest| rest.trim_start_matches(['_', '-', ' ']));
    let text = locale.and_then(|locale| locale::text_name(&format!("text_{locale}")));
    if let Some(TextName::Canonical(tag) | TextName::Misspelt(tag)) = text {
        return Some(format!("text_{tag}"));
    }
    suggest::nearest(name, NAMES.into_iter().chain(["text_ll-cc"])).map(str::to_owned)
}
