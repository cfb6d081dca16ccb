//! Strings in a single buffer, one after the other, so that many cost as little as one.

use std::ops::Range;

/// A list of strings.
#[derive(Debug, Default)]
pub(crate) struct Strings {
    text: String,
    /// The end of each string in `text`.
    ends: Vec<usize>,
}

impl Strings {
    /// Adds a string.
    pub(crate) fn push(&mut self, string: &str) {
        self.text.push_str(string);
        self.ends.push(self.text.len());
    }

    /// Adds all strings of a list.
    pub(crate) fn append(&mut self, strings: &Strings) {
        let start = self.text.len();
        self.text.push_str(&strings.text);
        self.ends.extend(strings.ends.iter().map(|end| start + end));
    }

    /// Removes all strings and keeps the allocation.
    pub(crate) fn clear(&mut self) {
        self.text.clear();
        self.ends.clear();
    }

    /// Frees the space reserved for more strings.
    #[cfg(feature = "shards")]
    pub(crate) fn shrink(&mut self) {
        self.text.shrink_to_fit();
        self.ends.shrink_to_fit();
    }

    /// Returns the number of strings.
    pub(crate) fn count(&self) -> usize {
        self.ends.len()
    }

    /// Returns all strings, one after the other.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }

    fn start(&self, number: usize) -> usize {
        number.checked_sub(1).map_or(0, |before| self.ends[before])
    }

    /// Returns the string with this number.
    pub(crate) fn get(&self, number: usize) -> &str {
        &self.text[self.start(number)..self.ends[number]]
    }

    /// Returns the strings with these numbers.
    pub(crate) fn range(&self, numbers: Range<usize>) -> impl Iterator<Item = &str> {
        let mut start = self.start(numbers.start);
        self.ends[numbers].iter().map(move |&end| {
            let string = &self.text[start..end];
            start = end;
            string
        })
    }

    /// Returns all strings.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &str> {
        self.range(0..self.count())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strings_keep_their_ends() {
        let mut strings = Strings::default();
        for string in ["", "ab", "", "ü"] {
            strings.push(string);
        }
        assert_eq!(strings.iter().collect::<Vec<_>>(), ["", "ab", "", "ü"]);
        assert_eq!(strings.range(1..3).collect::<Vec<_>>(), ["ab", ""]);
        assert_eq!((strings.get(0), strings.get(3), strings.count()), ("", "ü", 4));
        let mut others = Strings::default();
        others.push("é");
        others.append(&strings);
        assert_eq!(others.iter().collect::<Vec<_>>(), ["é", "", "ab", "", "ü"]);
        strings.clear();
        assert_eq!(strings.iter().next(), None);
    }
}
