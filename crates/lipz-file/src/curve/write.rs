//! Writing curves in their canonical layout: one a line, with the keys below each other's names.

use crate::literal;
use lipz_types::CurveValue;

/// What curves are indented by, below an element that is indented by half of it.
const INDENT: &str = "    ";

/// The value of the element `curves` that has these curves, as `lipz fmt` lays it out, with `\n` as line ends. Names must
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

/// The keys of a curve, one behind the other.
pub(super) fn keys(keys: impl IntoIterator<Item = (u32, CurveValue)>) -> String {
    let keys: Vec<String> = keys.into_iter().map(|(frame, value)| format!("{frame}:{value}")).collect();
    keys.join(" ")
}

/// Names and values, as they are spelled, one below the other.
fn laid_out(lines: &[(String, String)], line_ending: &str) -> String {
    if lines.is_empty() {
        return "{}".to_owned();
    }
    // Letters, not columns: names of curves are ASCII, and writers of banks do without a table of widths.
    let width = lines.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0);
    let lines: Vec<String> = lines.iter().map(|(name, value)| format!("{INDENT}{name:width$} : {value}")).collect();
    format!("{{{line_ending}{}{line_ending}  }}", lines.join(&format!(",{line_ending}")))
}

/// The value in its canonical layout, with names and keys as they are spelled; `None` if it is no object of strings.
#[cfg(feature = "format")]
pub(crate) fn tidy(value: &crate::Raw<'_>, line_ending: &str) -> Option<String> {
    let lines = value.members(&mut Vec::new())?.into_iter().map(|element| match &element.value {
        crate::Value::String(string) => {
            // Escapes have no blanks in them.
            let spelled = string.spelling();
            let inner = spelled.get(1..spelled.len().checked_sub(1)?)?;
            let words: Vec<&str> = super::key::words(inner).collect();
            Some((element.name.spelling().into_owned(), format!("\"{}\"", words.join(" "))))
        }
        _ => None,
    });
    Some(laid_out(&lines.collect::<Option<Vec<_>>>()?, line_ending))
}
