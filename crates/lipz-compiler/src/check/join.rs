//! Joins elements to one segment if their number of segments differs from the clip's, and the project lowers LZ0601.

use crate::util::strings::Strings;
use lipz_file::event;

/// Joins the display texts of an element in the first segment, separated by spaces, unless it has `count` segments like
/// the clip.
pub(super) fn texts(segments: &mut Strings, count: usize) {
    if segments.count() != count {
        into_first(segments, " ", count);
    }
}

/// Joins the event strings of an element in the first segment, unless it has `count` segments like the clip. The
/// separator is `,` if all of them are Character Event Syntax, and a space otherwise.
pub(super) fn events(segments: &mut Strings, count: usize) {
    if segments.count() != count {
        let separator = if segments.iter().all(|segment| event::parse(segment).is_some()) { ", " } else { " " };
        into_first(segments, separator, count);
    }
}

/// Replaces `segments` with `count` segments: the non-empty ones joined, then empty ones.
fn into_first(segments: &mut Strings, separator: &str, count: usize) {
    let joined = segments.iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(separator);
    segments.clear();
    segments.push(&joined);
    for _ in 1..count {
        segments.push("");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joined(parts: &[&str], count: usize, join: fn(&mut Strings, usize)) -> Vec<String> {
        let mut segments = Strings::default();
        parts.iter().for_each(|part| segments.push(part));
        join(&mut segments, count);
        segments.iter().map(str::to_owned).collect()
    }

    #[test]
    fn joined_in_the_first_segment() {
        assert_eq!(joined(&["Hello,", "", "Amy."], 2, texts), ["Hello, Amy.", ""]);
        assert_eq!(joined(&["Hello,", "", "Amy."], 3, texts), ["Hello,", "", "Amy."]);
        assert_eq!(joined(&["Hello"], 3, texts), ["Hello", "", ""]);
        assert_eq!(joined(&["", ""], 1, texts), [""]);
    }

    #[test]
    fn joined_events_are_of_the_same_syntax() {
        assert_eq!(joined(&["feels sad", "", "amy points door"], 1, events), ["feels sad, amy points door"]);
        assert_eq!(joined(&["feels sad", "bell(3, 4)"], 1, events), ["feels sad bell(3, 4)"]);
    }
}
