//! Adds curves to an element, and keeps the existing ones as spelled.

use crate::text::is_white_space;
use crate::{RawJson, literal};
use lipz_types::CurveValue;

/// Returns the value of the element `curves` with more curves after its own, each formatted like the one above it.
/// `None` if the value is not an object. Names must differ, including from the existing ones.
///
/// ```
/// use lipz_file::{RawJson, curve};
/// use lipz_types::CurveValue;
/// let joy = [("joy", vec![(0, CurveValue::from_thousandths(2200))])];
/// assert_eq!(curve::add(&RawJson::new(r#"{ "nod":"0:5"}"#), joy).as_deref(), Some(r#"{ "nod":"0:5", "joy":"0:2.2"}"#));
/// assert_eq!(curve::add(&RawJson::new("[]"), [("joy", vec![])]), None);
/// ```
pub fn add<'n>(
    value: &RawJson<'_>,
    curves: impl IntoIterator<Item = (&'n str, impl IntoIterator<Item = (u32, CurveValue)>)>,
) -> Option<String> {
    let text: &str = &value.text;
    let members = value.members(&mut Vec::new())?;
    let Some(last) = members.last() else { return Some(super::write(curves)) };
    let in_text = |at: usize| at.checked_sub(value.span.range().start);
    let (name, last) = (last.name.span().range(), last.value.span().range());
    let before = text.get(..in_text(name.start)?)?;
    let blanks = before.get(before.trim_end_matches(is_white_space).len()..)?;
    let colon = text.get(in_text(name.end)?..in_text(last.start)?)?;
    let (head, tail) = text.split_at_checked(in_text(last.end)?)?;
    let mut added = head.to_owned();
    for (name, keys) in curves {
        added += &format!(",{blanks}{}{colon}\"{}\"", literal(name), super::write::keys(keys));
    }
    Some(added + tail)
}
