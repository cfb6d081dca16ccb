//! The types of values: strings, the number `fps`, and objects.

use lipz_diagnostics::{Code, Diagnostic, escape};
use lipz_file::{Element, JsonString, RawJson, Value};

/// Returns the string of an element that requires one.
pub(super) fn string<'d>(element: &'d Element<'d>, diagnostics: &mut Vec<Diagnostic>) -> Option<&'d JsonString<'d>> {
    if let Value::String(string) = &element.value {
        return Some(string);
    }
    let help = match element.value.type_name() {
        "null" => "remove the element if it has no value",
        "a number" => "put the value into double quotes",
        "an array" if element.name.text != "viseme_type" => "write one string with `|` between the segments",
        _ => "write the value as one string",
    };
    diagnostics.push(wrong_type(element, "a string").help(help));
    None
}

/// Returns the number of an element that requires one.
pub(super) fn number<'d>(element: &'d Element<'d>, diagnostics: &mut Vec<Diagnostic>) -> Option<&'d RawJson<'d>> {
    match &element.value {
        Value::Number(number) => return Some(number),
        Value::String(string) if is_rate(&string.text) => diagnostics.push(
            wrong_type(element, "a number")
                .help(format!("remove the quotes: {}", string.text))
                .fix(string.span(), string.text.clone()),
        ),
        _ => diagnostics.push(wrong_type(element, "a number").help("write frames per second as a number: 24, 29.97")),
    }
    None
}

/// Returns the object of an element that requires one.
pub(super) fn object<'d>(element: &'d Element<'d>, diagnostics: &mut Vec<Diagnostic>) -> Option<&'d RawJson<'d>> {
    match &element.value {
        Value::Other(value) if value.text.starts_with('{') => return Some(value),
        _ => diagnostics.push(
            wrong_type(element, "an object")
                .help("write a name and keys for each curve: { \"jawOpen\": \"0:0 12:0.8\" }"),
        ),
    }
    None
}

/// Whether the text is a frame rate in the form of a JSON number: not `024`, not `24.`.
fn is_rate(text: &str) -> bool {
    let is_number = || lipz_file::parse(format!("{{\"fps\":{text}}}").as_bytes()).document.is_some();
    lipz_file::rate::parse(text).is_some() && is_number()
}

fn wrong_type(element: &Element<'_>, expected: &str) -> Diagnostic {
    let message = format!("{} is {}, not {expected}", escape::quoted(&element.name.text), element.value.type_name());
    Diagnostic::at(Code::WrongType, element.value.span(), message)
        .also(element.name.span(), format!("must be {expected}"))
}
