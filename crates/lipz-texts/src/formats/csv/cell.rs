//! Cells that spreadsheets would treat as formulas.
//!
//! A spreadsheet treats a cell that starts with `=`, `+`, `-`, `@`, a tab or CR as a formula, which may send the
//! content of the sheet to anyone (OWASP, "CSV Injection"). An apostrophe before it marks it as text.

use std::borrow::Cow;

/// Marks a cell as text.
const APOSTROPHE: char = '\'';

/// Whether a cell is a formula, possibly after apostrophes.
fn is_formula(cell: &str) -> bool {
    cell.trim_start_matches(APOSTROPHE).starts_with(['=', '+', '-', '@', '\t', '\r'])
}

/// Returns a text as a cell that spreadsheets do not treat as a formula: with an apostrophe before it, if it looks like
/// one.
pub fn defused(text: &str) -> Cow<'_, str> {
    if is_formula(text) { Cow::Owned(format!("{APOSTROPHE}{text}")) } else { Cow::Borrowed(text) }
}

/// Returns the text of a cell. Spreadsheets may have removed the apostrophe.
pub(super) fn text(cell: &str) -> &str {
    match cell.strip_prefix(APOSTROPHE) {
        Some(text) if is_formula(text) => text,
        _ => cell,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn formulas_are_texts() {
        for formula in ["=1+1", "+1", "-1", "@x", "\tx", "\r=x", "- What?", "'=1"] {
            assert_eq!(defused(formula), format!("'{formula}"));
        }
        assert_eq!(defused("'Tis so."), "'Tis so.");
        assert_eq!(text("-1"), "-1", "a spreadsheet has taken the apostrophe");
    }

    proptest! {
        #[test]
        fn every_text_comes_back(cell in ".{0,8}|['=+@\t\r-]{0,5}") {
            let written = defused(&cell);
            prop_assert!(!written.starts_with(['=', '+', '-', '@', '\t', '\r']));
            prop_assert_eq!(text(&written), cell.as_str());
        }
    }
}
