//! Writes curves in their canonical layout: one per line, with aligned keys.

use crate::literal;
use lipz_types::CurveValue;

/// The indentation of curves, inside an element that is indented by half of it.
const INDENT: &str = "    ";

/// Returns the value of the element `curves`, in the layout of `lipz fmt`, with `\n` as line endings. Names must
/// differ.
///
/// ```
/// use lipz_file::curve;
/// use lipz_types::CurveValue;
/// let key = |frame, thousandths| (frame, CurveValue::from_thousandths(thousandths));
/// let written = curve::write([("joy", [key(0, 0), key(12, 2200)]), ("jawOpen", [key(0, 50), key(3, 0)])]);
/// assert_eq!(written, "{\n    \"joy\"     : \"0:0 12:2.2\",\n    \"jawOpen\" : \"0:0.05 3:0\"\n  }");
/// ```
pub fn write<'n>(curves: impl IntoIterator<Item = (&'n str, impl IntoIterator<Item = (u32, CurveValue)>)>) -> String {
    let lines = curves.into_iter().map(|(name, of_name)| (literal(name), format!("\"{}\"", keys(of_name))));
    laid_out(&lines.collect::<Vec<_>>(), "\n")
}

/// Returns the keys of a curve, separated by spaces.
pub(super) fn keys(keys: impl IntoIterator<Item = (u32, CurveValue)>) -> String {
    let keys: Vec<String> = keys.into_iter().map(|(frame, value)| format!("{frame}:{value}")).collect();
    keys.join(" ")
}

/// Lays out names and values, as spelled, one pair per line.
fn laid_out(lines: &[(String, String)], line_ending: &str) -> String {
    if lines.is_empty() {
        return "{}".to_owned();
    }
    // Counts characters, not columns: names of curves are ASCII, and programs that write banks then need no table of
    // widths.
    let width = lines.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0);
    let lines: Vec<String> = lines.iter().map(|(name, value)| format!("{INDENT}{name:width$} : {value}")).collect();
    format!("{{{line_ending}{}{line_ending}  }}", lines.join(&format!(",{line_ending}")))
}

/// Returns the value in its canonical layout, with names and keys as spelled; `None` if it is not an object of strings.
#[cfg(feature = "format")]
pub(crate) fn tidy(value: &crate::RawJson<'_>, line_ending: &str) -> Option<String> {
    let lines = value.members(&mut Vec::new())?.into_iter().map(|element| match &element.value {
        crate::Value::String(string) => {
            // Escapes contain no spaces.
            let spelled = string.spelling();
            let inner = spelled.get(1..spelled.len().checked_sub(1)?)?;
            let words: Vec<&str> = super::key::words(inner).collect();
            Some((element.name.spelling().into_owned(), format!("\"{}\"", words.join(" "))))
        }
        _ => None,
    });
    Some(laid_out(&lines.collect::<Option<Vec<_>>>()?, line_ending))
}
