//! Conversion of positions: bytes of UTF-8 here, lines and UTF-16 code units in the protocol.

use lipz_diagnostics::Span;
use lsp_types::{Position, Range};
use ropey::Rope;

/// Returns the position of a byte. Bytes past the end are clamped.
pub(crate) fn position(rope: &Rope, byte: usize) -> Position {
    let character = rope.byte_to_char(byte.min(rope.len_bytes()));
    let line = rope.char_to_line(character);
    let units = rope.char_to_utf16_cu(character) - rope.char_to_utf16_cu(rope.line_to_char(line));
    Position::new(number(line), number(units))
}

/// Converts ascending bytes to positions, each from the one before, because a string of a megabyte has thousands.
pub(crate) struct PositionWalk<'t> {
    rope: &'t Rope,
    text: &'t str,
    byte: usize,
    position: Position,
}

impl<'t> PositionWalk<'t> {
    /// Starts at a byte of a text, which is the same text as the rope.
    pub(crate) fn new(rope: &'t Rope, text: &'t str, byte: usize) -> PositionWalk<'t> {
        PositionWalk { rope, text, byte, position: position(rope, byte) }
    }

    /// Returns the position of a byte.
    pub(crate) fn position(&mut self, byte: usize) -> Position {
        let is_line_break = |c: char| matches!(c, '\n' | '\r' | '\u{b}' | '\u{c}' | '\u{85}' | '\u{2028}' | '\u{2029}');
        self.position = match self.text.get(self.byte..byte) {
            Some(between) if !between.contains(is_line_break) => {
                let Position { line, character } = self.position;
                Position::new(line, character.saturating_add(number(between.encode_utf16().count())))
            }
            _ => position(self.rope, byte),
        };
        self.byte = byte;
        self.position
    }
}

/// Returns the byte at a position. As the protocol requires, positions after the end of a line or of the text are
/// clamped.
pub(crate) fn byte(rope: &Rope, position: Position) -> usize {
    let line = position.line as usize;
    if line >= rope.len_lines() {
        return rope.len_bytes();
    }
    let start = rope.line_to_char(line);
    let units = rope.char_to_utf16_cu(start).saturating_add(position.character as usize);
    let end = line_end(rope, line);
    if units >= rope.char_to_utf16_cu(end) {
        return rope.char_to_byte(end);
    }
    rope.char_to_byte(rope.utf16_cu_to_char(units))
}

/// Whether a position is between the two UTF-16 units of a character.
pub(crate) fn is_within_character(rope: &Rope, position: Position) -> bool {
    let line = position.line as usize;
    if line >= rope.len_lines() {
        return false;
    }
    let units = rope.char_to_utf16_cu(rope.line_to_char(line)).saturating_add(position.character as usize);
    units < rope.char_to_utf16_cu(line_end(rope, line)) && rope.char_to_utf16_cu(rope.utf16_cu_to_char(units)) != units
}

/// Returns the first character of the line break at the end of a line, or the end of the text.
fn line_end(rope: &Rope, line: usize) -> usize {
    let start = rope.line_to_char(line);
    let mut length = rope.line(line).len_chars();
    while length > 0 && matches!(rope.line(line).char(length - 1), '\n' | '\r') {
        length -= 1;
    }
    start + length
}

/// Returns the range of a span.
pub(crate) fn range(rope: &Rope, span: Span) -> Range {
    Range::new(position(rope, span.start as usize), position(rope, span.end as usize))
}

/// Returns the bytes of a range. A reversed range is empty.
pub(crate) fn bytes(rope: &Rope, range: Range) -> std::ops::Range<usize> {
    let start = byte(rope, range.start);
    start..byte(rope, range.end).max(start)
}

fn number(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_utf16_units_and_lines_end_in_three_ways() {
        let rope = Rope::from_str("aü\r\n𝄞b\rc\u{2028}d\n");
        let places =
            [(0, 0, 0), (1, 0, 1), (3, 0, 2), (5, 1, 0), (9, 1, 2), (10, 1, 3), (11, 2, 0), (12, 2, 1), (15, 2, 2)];
        for (at, line, character) in places {
            let expected = Position::new(line, character);
            assert_eq!((position(&rope, at), byte(&rope, expected)), (expected, at));
        }
        assert_eq!(position(&rope, 99), Position::new(3, 0), "behind the last line break");
    }

    #[test]
    fn a_walk_finds_what_a_search_finds() {
        let text = "aü\r\n𝄞b\rc\u{2028}d\n𝄞𝄞";
        let rope = Rope::from_str(text);
        let places: Vec<usize> = text.char_indices().map(|(at, _)| at).chain([text.len()]).collect();
        for start in 0..places.len() {
            let mut walk = PositionWalk::new(&rope, text, places[start]);
            for &place in &places[start..] {
                assert_eq!(walk.position(place), position(&rope, place), "{place}");
            }
            assert_eq!(walk.position(0), Position::new(0, 0), "backwards, too");
        }
    }

    #[test]
    fn positions_that_are_no_places_are_the_nearest() {
        let rope = Rope::from_str("a𝄞\r\nb");
        assert_eq!(byte(&rope, Position::new(0, 2)), 1, "in the middle of a character");
        assert_eq!(byte(&rope, Position::new(0, u32::MAX)), 5, "before the line break");
        assert_eq!(byte(&rope, Position::new(9, 0)), 8);
        let backwards = Range::new(Position::new(1, 0), Position::new(0, 0));
        assert_eq!(bytes(&rope, backwards), 7..7);
        assert_eq!(byte(&Rope::from_str(""), Position::new(0, 1)), 0);
    }
}
