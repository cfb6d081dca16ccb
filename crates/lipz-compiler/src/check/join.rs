//! Elements whose number of segments differs from the clip's, where the project lowers LZ0601: they
//! are joined to one segment.

use lipz::event;
use std::borrow::Cow;

/// The display texts of a clip with `count` segments. If theirs is another number, they are joined
/// with blanks and displayed in the first segment.
pub(super) fn texts(segments: Vec<Cow<'_, str>>, count: usize) -> Vec<Cow<'_, str>> {
    if segments.len() == count { segments } else { in_first(&segments, " ", count) }
}

/// The event strings of a clip with `count` segments. If theirs is another number, they are joined in
/// the first segment: with `,` if all are Character Event Syntax, otherwise with blanks.
pub(super) fn events(segments: Vec<Box<str>>, count: usize) -> Vec<Box<str>> {
    if segments.len() == count {
        return segments;
    }
    let separator = if segments.iter().all(|segment| event::parse(segment).is_some()) { ", " } else { " " };
    in_first(&segments, separator, count)
}

/// What is not empty of `segments`, joined, as the first of `count` segments.
fn in_first<T: AsRef<str> + From<String> + Default + Clone>(segments: &[T], separator: &str, count: usize) -> Vec<T> {
    let parts: Vec<&str> = segments.iter().map(AsRef::as_ref).filter(|part| !part.is_empty()).collect();
    let mut joined = vec![T::default(); count];
    if let Some(first) = joined.first_mut() {
        *first = parts.join(separator).into();
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joined_in_the_first_segment() {
        let texts = |parts: &[&'static str], count| texts(parts.iter().map(|&part| part.into()).collect(), count);
        assert_eq!(texts(&["Hello,", "", "Amy."], 2), ["Hello, Amy.", ""]);
        assert_eq!(texts(&["Hello,", "", "Amy."], 3), ["Hello,", "", "Amy."]);
        assert_eq!(texts(&["Hello"], 3), ["Hello", "", ""]);
        assert_eq!(texts(&["", ""], 1), [""]);
    }

    #[test]
    fn joined_events_are_of_the_same_syntax() {
        let events = |parts: &[&str]| events(parts.iter().map(|&part| part.into()).collect(), 1);
        assert_eq!(*events(&["feels sad", "", "amy points door"])[0], *"feels sad, amy points door");
        assert_eq!(*events(&["feels sad", "bell(3, 4)"])[0], *"feels sad bell(3, 4)");
    }
}
