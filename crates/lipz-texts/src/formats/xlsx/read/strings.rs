//! The strings of a file: shared ones, and those inside cells.

use super::parts::Refusal;
use super::xml::{PartReader, XmlStep};

/// The strings to which cells refer by number, concatenated.
#[derive(Default)]
pub(super) struct Strings {
    text: String,
    ends: Vec<usize>,
}

impl Strings {
    /// Reads the part with the shared strings.
    pub(super) fn read(part: &mut PartReader<'_, '_>) -> Result<Strings, Refusal> {
        let (mut strings, mut string) = (Strings::default(), String::new());
        while let Some(step) = part.next()? {
            if step == XmlStep::Start && part.name() == "si" {
                string.clear();
                add_string(part, &mut string)?;
                strings.text.push_str(&unescaped(&string));
                strings.ends.push(strings.text.len());
            }
        }
        Ok(strings)
    }

    /// Returns the string with this number, in the spelling of a cell.
    pub(super) fn get(&self, number: &str) -> Option<&str> {
        let number: usize = number.trim().parse().ok()?;
        let start = number.checked_sub(1).map_or(Some(0), |before| self.ends.get(before).copied())?;
        self.text.get(start..*self.ends.get(number)?)
    }
}

/// Appends the text of the element that has just begun: all its `t`, without phonetic readings.
pub(super) fn add_string(part: &mut PartReader<'_, '_>, out: &mut String) -> Result<(), Refusal> {
    // The number of open elements inside it.
    let mut depth = 0_usize;
    loop {
        match part.next()? {
            Some(XmlStep::Start) if part.name() == "t" => part.add_text(out)?,
            Some(XmlStep::Start) if part.name() == "rPh" => part.skip()?,
            Some(XmlStep::Start) => depth += 1,
            Some(XmlStep::End) if depth > 0 => depth -= 1,
            Some(XmlStep::End) | None => return Ok(()),
            Some(XmlStep::Text | XmlStep::Other) => {}
        }
    }
}

/// Decodes characters that XML does not allow, such as `_x000D_`, and the escape itself, such as `_x005F_x000D_`.
pub(super) fn unescaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find("_x") {
        let code = rest.get(at + 2..at + 6).filter(|_| rest.get(at + 6..at + 7) == Some("_"));
        let is_hex = |code: &&str| code.bytes().all(|digit| digit.is_ascii_hexdigit());
        let character =
            code.filter(is_hex).and_then(|code| u32::from_str_radix(code, 16).ok()).and_then(char::from_u32);
        let length = if character.is_some() { 7 } else { 1 };
        out.push_str(rest.get(..at).unwrap_or_default());
        out.push(character.unwrap_or('_'));
        rest = rest.get(at + length..).unwrap_or_default();
    }
    out + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_are_those_of_excel() {
        assert_eq!(unescaped("a_x000D_b_x005F_x000D__x00_"), "a\rb_x000D__x00_");
    }
}
