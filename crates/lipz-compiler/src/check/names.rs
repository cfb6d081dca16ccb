//! Names that are not in the format, and suggestions for them.

use lipz_diagnostics::{Code, Diagnostic, escape, suggest};
use lipz_file::Element;
use lipz_file::locale::{self, TextName};

/// Names of elements in the format, except texts.
const NAMES: [&str; 6] = ["fps", "visemes", "viseme_type", "events", "curves", "phones"];

/// The form of the names of texts.
const ANY_TEXT: &str = "text_ll-cc";

/// Returns the diagnostic for a name that is not in the format.
pub(super) fn unknown(element: &Element<'_>) -> Diagnostic {
    let name = element.name.text.as_ref();
    let message = if name.is_empty() {
        "an element has an empty name".to_owned()
    } else {
        format!("{} is not an element of the format", escape::quoted(name))
    };
    let found = Diagnostic::at(Code::UnknownElement, element.name.span(), message)
        .note("it is kept for unpacking; games do not see it");
    match suggestion(name) {
        // Only the writer knows the locale.
        Some(known) if known == ANY_TEXT => found.help(format!("did you mean `{known}`?")),
        Some(known) => {
            found.help(format!("did you mean `{known}`?")).suggest(element.name.span(), lipz_file::literal(&known))
        }
        None => found.help("use one of fps, viseme_type, visemes, text_ll-cc, events, curves, phones"),
    }
}

/// Returns a text as it is written within a string of a file, without quotes.
pub(super) fn inside(text: &str) -> String {
    let literal = lipz_file::literal(text);
    literal.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).map(str::to_owned).unwrap_or(literal)
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
    suggest::nearest(name, NAMES.into_iter().chain([ANY_TEXT])).map(str::to_owned)
}
