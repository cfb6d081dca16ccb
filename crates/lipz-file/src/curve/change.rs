//! Changing the curves of a file that has others.

use super::{ELEMENT, parse, write};
use crate::{Document, Element, RawJson, Value};
use lipz_types::CurveValue;
use std::borrow::Cow;
use std::collections::HashSet;

/// Removes the curves for which `is_removed` holds from a file, and then adds others, which replace curves of the same
/// name. Each curve that is added is a name and its keys: frame and value. A file without curves loses the element.
///
/// Returns `false`, and changes nothing, if the element has errors, because invalid keys would be lost.
///
/// ```
/// use lipz_file::curve;
/// use lipz_types::CurveValue;
/// let file = br#"{ "curves": { "joy": "0:0 12:2.2", "opening": "0:1" } }"#;
/// let mut document = lipz_file::parse(file).document.ok_or("a valid file")?;
/// let keys = vec![(0, CurveValue::from_thousandths(500))];
/// assert!(curve::change(&mut document, |_| false, vec![("opening", keys)]));
/// let lipz_file::Value::Other(curves) = &document.elements[0].value else { return Err("an object") };
/// assert_eq!(curves.text, "{\n    \"joy\"     : \"0:0 12:2.2\",\n    \"opening\" : \"0:0.5\"\n  }");
/// # Ok::<(), &str>(())
/// ```
pub fn change(
    document: &mut Document<'_>,
    is_removed: impl Fn(&str) -> bool,
    added: Vec<(&str, Vec<(u32, CurveValue)>)>,
) -> bool {
    let place = document.elements.iter().position(|element| element.name.text == ELEMENT);
    let mut diagnostics = Vec::new();
    let before = match place.and_then(|place| document.elements.get(place)).map(|element| &element.value) {
        Some(Value::Other(value)) => parse(value, &mut diagnostics),
        Some(_) => None,
        None => Some(Vec::new()),
    };
    let (Some(before), []) = (before, diagnostics.as_slice()) else { return false };
    let replaced: HashSet<&str> = added.iter().map(|(name, _)| *name).collect();
    let named = before.iter().map(|curve| (curve.name.text.as_ref(), curve.frames_and_values()));
    let mut after: Vec<_> = named.filter(|(name, _)| !replaced.contains(name) && !is_removed(name)).collect();
    after.extend(added);
    let value = (!after.is_empty()).then(|| Value::Other(RawJson::new(write(after))));
    match (place, value) {
        (Some(place), Some(value)) => document.elements[place].value = value,
        (Some(place), None) => _ = document.elements.remove(place),
        (None, Some(value)) => document.elements.push(Element { name: Cow::Borrowed(ELEMENT).into(), value }),
        (None, None) => {}
    }
    true
}
