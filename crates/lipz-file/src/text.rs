//! Texts as players see them: segments, trimming, meta.

use std::borrow::Cow;
use std::ops::Range;

/// The segment delimiter.
pub const DELIMITER: char = '|';

/// Returns the segments of an element: the byte ranges between its delimiters. There is always at least one.
pub fn segments(text: &str) -> impl Iterator<Item = Range<usize>> + '_ {
    let mut start = 0;
    let ends = memchr::memchr_iter(DELIMITER as u8, text.as_bytes()).chain([text.len()]);
    ends.map(move |end| {
        let range = start..end;
        start = end + 1;
        range
    })
}

/// Returns the number of segments of an element.
pub fn segment_count(text: &str) -> usize {
    1 + memchr::memchr_iter(DELIMITER as u8, text.as_bytes()).count()
}

/// Returns a text without the whitespace of JSON at its ends: space, tab, CR, LF. Everything else (U+00A0, U+200B, …)
/// is content.
pub fn trim(text: &str) -> &str {
    let is_blank = |byte: &u8| is_white_space(char::from(*byte));
    if !text.as_bytes().first().is_some_and(is_blank) && !text.as_bytes().last().is_some_and(is_blank) {
        return text; // without decoding characters
    }
    text.trim_matches(is_white_space)
}

/// Whether a character is whitespace in JSON: space, tab, CR, LF.
pub fn is_white_space(c: char) -> bool {
    matches!(c, ' ' | '\t' | '\r' | '\n')
}

/// The display form of a segment, with problems of its braces.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Display<'t> {
    /// The text without `{meta}`, then trimmed.
    pub text: Cow<'t, str>,
    /// Offsets of braces without a partner, which are displayed unchanged.
    pub unbalanced: Vec<usize>,
    /// Offsets of the outer opening braces of meta that contains braces.
    pub nested: Vec<usize>,
}

/// Returns the display form of one segment (Lipz specification, element `text_ll-cc` and "Segmenting").
///
/// ```
/// let display = lipz_file::text::display("{smiling} Hello {to: amy} there ");
/// assert_eq!(display.text, "Hello there");
/// ```
pub fn display(segment: &str) -> Display<'_> {
    let mut display = Display { text: Cow::Borrowed(trim(segment)), unbalanced: Vec::new(), nested: Vec::new() };
    if memchr::memchr2(b'{', b'}', segment.as_bytes()).is_none() {
        return display;
    }
    let metas = metas(segment, &mut display.unbalanced, &mut display.nested);
    let mut kept = String::with_capacity(segment.len());
    let mut end = 0;
    for meta in metas {
        push_after_meta(&mut kept, &segment[end..meta.start]);
        end = meta.end;
    }
    push_after_meta(&mut kept, &segment[end..]);
    display.text = Cow::Owned(trim(&kept).to_owned());
    display
}

/// Appends the text after a removed meta. Writers put spaces on both sides of a meta, so if there is white space on both
/// sides, one character of it is dropped. A line break stays in preference to a space. Returns the offset of the text in
/// `kept`.
pub fn push_after_meta(kept: &mut String, text: &str) -> usize {
    let is_line_end = |byte: u8| matches!(byte, b'\n' | b'\r');
    let is_space = |byte: u8| matches!(byte, b' ' | b'\t');
    let dropped = match (kept.as_bytes().last(), text.as_bytes()) {
        (Some(&before), [b'\r', b'\n', ..]) if is_line_end(before) => 2,
        (Some(&before), [after, ..]) if is_line_end(before) && is_line_end(*after) => 1,
        (Some(&before), [after, ..]) if is_white_space(char::from(before)) && is_space(*after) => 1,
        (Some(&before), [after, ..]) if is_space(before) && is_line_end(*after) => {
            kept.pop();
            0
        }
        _ => 0,
    };
    let start = kept.len();
    kept.push_str(text.get(dropped..).unwrap_or_default());
    start
}

/// Returns the ranges of `{meta}` in a segment, including their braces: the outermost balanced pairs, in order.
///
/// ```
/// assert_eq!(lipz_file::text::meta_ranges("{smiling} Hello {to {amy}} {"), [0..9, 16..26]);
/// ```
pub fn meta_ranges(segment: &str) -> Vec<Range<usize>> {
    match memchr::memchr(b'{', segment.as_bytes()) {
        Some(_) => metas(segment, &mut Vec::new(), &mut Vec::new()),
        None => Vec::new(),
    }
}

/// The start of meta that names the speaker from there on.
const SPEAKER: &str = "{speaker:";

/// Returns the speakers that a text names, in order: `{speaker: Mara}`. An empty name ends the current one.
///
/// ```
/// let text = "{speaker: Mara} Hi. {smiling} {speaker:}|{speaker:Tom} Ho.";
/// assert!(lipz_file::text::speakers(text).eq(["Mara", "", "Tom"]));
/// ```
pub fn speakers(text: &str) -> impl Iterator<Item = &str> {
    let name = |range: Range<usize>| text.get(range)?.strip_prefix(SPEAKER)?.strip_suffix('}').map(str::trim);
    meta_ranges(text).into_iter().filter_map(name)
}

/// Whether [`speakers`] could find anything in these bytes, such as a bank with its files.
pub fn may_name_speakers(bytes: &[u8]) -> bool {
    memchr::memmem::find(bytes, SPEAKER.as_bytes()).is_some()
}

/// Returns the ranges of meta in a segment, including its braces, in order.
///
/// ```
/// let text = "{smiling} Hello {to: amy} there";
/// let metas: Vec<&str> = lipz_file::text::meta(text).into_iter().map(|place| &text[place]).collect();
/// assert_eq!(metas, ["{smiling}", "{to: amy}"]);
/// ```
pub fn meta(segment: &str) -> Vec<Range<usize>> {
    metas(segment, &mut Vec::new(), &mut Vec::new())
}

/// Returns the outermost balanced pairs of braces, in order.
fn metas(segment: &str, unbalanced: &mut Vec<usize>, nested: &mut Vec<usize>) -> Vec<Range<usize>> {
    let mut open: Vec<usize> = Vec::new();
    let mut pairs: Vec<Range<usize>> = Vec::new();
    for (at, byte) in segment.bytes().enumerate() {
        match (byte, open.last()) {
            (b'{', _) => open.push(at),
            (b'}', None) => unbalanced.push(at),
            (b'}', Some(&start)) => {
                open.pop();
                // Pairs inside this one belong to it.
                let inner = pairs.iter().rposition(|pair| pair.start < start).map_or(0, |outside| outside + 1);
                if inner < pairs.len() {
                    pairs.truncate(inner);
                    nested.retain(|&at| at < start);
                    nested.push(start);
                }
                pairs.push(start..at + 1);
            }
            _ => {}
        }
    }
    unbalanced.extend(open);
    unbalanced.sort_unstable();
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_of_every_shape() {
        let ranges = |text| segments(text).collect::<Vec<_>>();
        assert_eq!(ranges("").len(), 1);
        assert_eq!(ranges("|"), [0..0, 1..1]);
        assert_eq!(ranges("ü|b"), [0..2, 3..4]);
        for text in ["", "|", "ü|b", "a||b|"] {
            assert_eq!(ranges(text).len(), segment_count(text));
        }
    }

    #[test]
    fn only_json_white_space_is_trimmed() {
        assert_eq!(trim(" \t\r\n a\u{a0}b \n"), "a\u{a0}b");
        assert_eq!(trim("\u{a0}\u{200b}"), "\u{a0}\u{200b}");
    }

    #[test]
    fn meta_is_removed_and_odd_braces_stay() {
        let cases = [
            ("a {m} b", "a b", vec![], vec![]),
            ("a {m} {n}{o} b", "a b", vec![], vec![]),
            ("a{m} b {n}c", "a b c", vec![], vec![]),
            ("a  {m} b", "a  b", vec![], vec![]),
            ("a {m}\nb\n{n} c", "a\nb\nc", vec![], vec![]),
            ("a\n{m}\nb\r\n{n}\r\nc", "a\nb\r\nc", vec![], vec![]),
            ("a\u{a0}{m} b", "a\u{a0} b", vec![], vec![]),
            (" {m} a {n} ", "a", vec![], vec![]),
            ("{m}", "", vec![], vec![]),
            ("{a {b} c} d", "d", vec![], vec![0]),
            ("{a {b} {c {d}} e}f", "f", vec![], vec![0]),
            ("{a {b} c", "{a c", vec![0], vec![]),
            ("a } b { c", "a } b { c", vec![2, 6], vec![]),
            ("{{x}", "{", vec![0], vec![]),
            ("{a}{b{c}}", "", vec![], vec![3]),
        ];
        for (segment, text, unbalanced, nested) in cases {
            assert_eq!(display(segment), Display { text: text.into(), unbalanced, nested }, "{segment}");
        }
    }

    #[test]
    fn a_million_braces_take_linear_time() {
        let deep = "{".repeat(500_000) + &"}".repeat(500_000);
        assert_eq!(display(&deep).text, "");
        let wide = "{x}".repeat(500_000);
        assert_eq!(display(&wide).text, "");
        let open = "{x} {".repeat(200_000);
        assert_eq!(display(&open).unbalanced.len(), 200_000);
    }
}
