//! The number formats of a file: which cells show a number as a date.

use super::parts::Refusal;
use super::xml::{PartReader, XmlStep};
use std::collections::HashMap;

/// The formats of dates and times that every file has, by number (ECMA-376, part 1, 18.8.30).
const DATES: [std::ops::RangeInclusive<usize>; 5] = [14..=22, 27..=36, 45..=47, 50..=58, 71..=81];

/// By style of a cell: whether it shows a date or a time.
#[derive(Default)]
pub(super) struct Styles(Vec<bool>);

impl Styles {
    /// Reads the part with the styles.
    pub(super) fn read(part: &mut PartReader<'_, '_>) -> Result<Styles, Refusal> {
        let (mut own, mut styles, mut is_of_cells) = (HashMap::new(), Styles::default(), false);
        while let Some(step) = part.next()? {
            if step != XmlStep::Start {
                continue;
            }
            let number = |attribute: Option<String>| attribute.and_then(|number| number.parse::<usize>().ok());
            match part.name() {
                "numFmt" => {
                    let code = part.attribute("formatCode").unwrap_or_default();
                    own.extend(number(part.attribute("numFmtId")).map(|number| (number, is_date(&code))));
                }
                name @ ("cellXfs" | "cellStyleXfs" | "dxfs") => is_of_cells = name == "cellXfs",
                "xf" if is_of_cells => {
                    let format = number(part.attribute("numFmtId")).unwrap_or(0);
                    let is_known = || DATES.iter().any(|dates| dates.contains(&format));
                    styles.0.push(own.get(&format).copied().unwrap_or_else(is_known));
                }
                _ => {}
            }
        }
        Ok(styles)
    }

    /// Whether a cell with this style shows a date or a time.
    pub(super) fn is_date(&self, style: Option<&str>) -> bool {
        style.and_then(|style| self.0.get(style.parse::<usize>().ok()?)).copied().unwrap_or_default()
    }
}

/// Whether a format has a part of a date or a time outside of quotes, brackets and escapes.
fn is_date(code: &str) -> bool {
    let (mut quoted, mut bracketed, mut is_escaped) = (false, false, false);
    code.chars().any(|character| {
        if std::mem::take(&mut is_escaped) {
            return false;
        }
        match character {
            '"' => quoted = !quoted,
            _ if quoted => {}
            '\\' | '_' | '*' => is_escaped = true,
            // Elapsed time, `[h]`, has its unit in brackets, and other parts outside.
            '[' => bracketed = true,
            ']' => bracketed = false,
            _ if bracketed => {}
            other => return !code.eq_ignore_ascii_case("general") && "dmyhs".contains(other.to_ascii_lowercase()),
        }
        false
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_of_dates_have_parts_of_a_date() {
        for code in ["dd/mm/yyyy", "[$-407]d. mmmm", "h:mm", "[h]:mm:ss"] {
            assert!(is_date(code), "{code}");
        }
        for code in ["General", "0.00", "@", "#,##0 \"days\"", "0\\d", "[Red]0"] {
            assert!(!is_date(code), "{code}");
        }
    }
}
