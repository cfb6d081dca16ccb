//! The element `curves`: numbers that change while a clip plays, each by its name.
//!
//! ```json
//! "curves" : {
//!   "anger"   : "0:0 12:2.2 40:0",
//!   "jawOpen" : "0:0.1 3:0.8"
//! }
//! ```
//!
//! A key is one word, `frame:value`, so that people can type a curve, and a word diff shows the changed keys.

mod add;
mod change;
mod key;
mod names;
mod sampled;
mod write;

pub use add::add;
pub use change::change;
pub use key::Key;
pub(crate) use key::thousandths;
pub use names::{ARKIT, LIVE_LINK_ANGLES, is_arkit};
pub use sampled::sampled;
#[cfg(feature = "format")]
pub(crate) use write::tidy;
pub use write::write;

use crate::{Element, JsonString, RawJson, Value};
use lipz_diagnostics::{Code, Diagnostic, bound, escape};
use lipz_types::CurveValue;
use std::collections::HashMap;

/// The name of the element.
pub const ELEMENT: &str = "curves";

/// A curve in a file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Curve<'r> {
    /// Its name.
    pub name: JsonString<'r>,
    /// Its keys, ordered by frame.
    pub keys: Vec<Key>,
}

impl Curve<'_> {
    /// Returns the keys as frames and values.
    pub fn frames_and_values(&self) -> Vec<(u32, CurveValue)> {
        self.keys.iter().map(|key| (key.frame, key.value)).collect()
    }
}

/// Returns the curves of an element with this value, and adds diagnostics. Invalid keys are omitted, as are curves
/// without keys. `None` if the value is not an object.
///
/// ```
/// use lipz_file::{Value, curve};
/// let document = lipz_file::parse(br#"{ "curves": { "joy": "0:0 12:2.2" } }"#).document.ok_or("a valid file")?;
/// let Value::Other(value) = &document.elements[0].value else { return Err("an object") };
/// let mut diagnostics = Vec::new();
/// let curves = curve::parse(value, &mut diagnostics).ok_or("an object")?;
/// assert_eq!((curves[0].keys[1].frame, curves[0].keys[1].value.thousandths()), (12, 2200));
/// assert!(diagnostics.is_empty());
/// # Ok::<(), &str>(())
/// ```
pub fn parse<'r>(value: &'r RawJson<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<Vec<Curve<'r>>> {
    let mut first = HashMap::new();
    let mut curves = Vec::new();
    for element in value.members(diagnostics)? {
        bound::limit_many(diagnostics);
        let Some(string) = string_of(&element, diagnostics) else { continue };
        let name = element.name.text.clone();
        if let Some(before) = first.insert(name, element.name.span()) {
            let message = format!("the curve {} is defined twice", escape::quoted(&element.name.text));
            diagnostics.push(
                Diagnostic::at(Code::SameCurveTwice, element.name.span(), message)
                    .also(before, "first definition")
                    .help("remove or rename one of the two"),
            );
            continue;
        }
        let keys = key::keys(&element.name, string, diagnostics);
        if !keys.is_empty() {
            curves.push(Curve { name: element.name, keys });
        }
    }
    Some(curves)
}

/// Returns the string of keys of an entry, which is required after a name.
fn string_of<'e>(element: &'e Element<'_>, diagnostics: &mut Vec<Diagnostic>) -> Option<&'e JsonString<'e>> {
    let diagnostic = match &element.value {
        Value::String(string) if !element.name.text.is_empty() => return Some(string),
        Value::String(_) => Diagnostic::at(Code::CurveSyntax, element.name.span(), "a curve has an empty name")
            .help("write a name, such as \"jawOpen\""),
        value => {
            let message = format!(
                "the curve {} is {}, not a string of keys",
                escape::quoted(&element.name.text),
                value.type_name()
            );
            Diagnostic::at(Code::CurveSyntax, value.span(), message)
                .help("write each key as frame:value: \"0:0 12:0.8\"")
        }
    };
    diagnostics.push(diagnostic);
    None
}
