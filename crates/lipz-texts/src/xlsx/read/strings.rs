//! The strings of a file: those that cells share, and those in cells.

use super::parts::Refusal;
use super::xml::{Part, Step};

/// The strings that cells refer to by their numbers, one after another.
#[derive(Default)]
pub(super) struct Strings {
    text: String,
    ends: Vec<usize>,
}

impl Strings {
    /// Those of the part with shared strings.
    pub(super) fn read(part: &mut Part<'_, '_>) -> Result<Strings, Refusal> {
        let (mut strings, mut string) = (Strings::default(), String::new());
        while let Some(step) = part.next()? {
            if step == Step::Start && part.name() == "si" {
                string.clear();
                add_string(part, &mut string)?;
                strings.text.push_str(&unescaped(&string));
                strings.ends.push(strings.text.len());
            }
        }
        Ok(strings)
    }

    /// The string with this number, as a cell writes it.
    pub(super) fn get(&self, number: &str) -> Option<&str> {
        let number: usize = number.trim().parse().ok()?;
        let start = number.checked_sub(1).map_or(Some(0), |before| self.ends.get(before).copied())?;
        self.text.get(start..*self.ends.get(number)?)
    }
}

/// Adds what is written in the element that has just begun, up to its end: all its `t`, without phonetic readings.
pub(super) fn add_string(part: &mut Part<'_, '_>, out: &mut String) -> Result<(), Refusal> {
    // Elements in it that have begun.
    let mut depth = 0_usize;
    loop {
        match part.next()? {
            Some(Step::Start) if part.name() == "t" => part.add_text(out)?,
            Some(Step::Start) if part.name() == "rPh" => part.skip()?,
            Some(Step::Start) => depth += 1,
            Some(Step::End) if depth > 0 => depth -= 1,
            Some(Step::End) | None => return Ok(()),
            Some(Step::Text | Step::Other) => {}
        }
    }
}

/// Characters that XML does not have, as `_x000D_`, and this itself, as `_x005F_x000D_`.
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
