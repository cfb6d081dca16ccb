//! String literals, and the positions of their decoded characters.

/// A walk through the inner part of a literal. For ascending positions, it reads each character once.
pub(crate) struct LiteralWalk<'s> {
    inner: &'s str,
    at_source: usize,
    at_decoded: usize,
    /// The number of characters that were read.
    #[cfg(test)]
    steps: usize,
}

impl<'s> LiteralWalk<'s> {
    pub(crate) fn new(inner: &'s str) -> LiteralWalk<'s> {
        LiteralWalk {
            inner,
            at_source: 0,
            at_decoded: 0,
            #[cfg(test)]
            steps: 0,
        }
    }

    /// Returns the offset in the literal's inner part of the character that starts at byte `decoded` of the text.
    pub(crate) fn to(&mut self, decoded: usize) -> usize {
        if decoded < self.at_decoded {
            (self.at_source, self.at_decoded) = (0, 0);
        }
        while self.at_decoded < decoded && self.at_source < self.inner.len() {
            let (source_bytes, decoded_bytes) = first_character(&self.inner[self.at_source..]);
            self.at_source += source_bytes;
            self.at_decoded += decoded_bytes;
            #[cfg(test)]
            {
                self.steps += 1;
            }
        }
        self.at_source
    }
}

/// Returns the lengths of the first character of a valid literal: as spelled, and decoded.
pub(crate) fn first_character(inner: &str) -> (usize, usize) {
    let mut bytes = inner.bytes();
    match (bytes.next(), bytes.next()) {
        (Some(b'\\'), Some(b'u')) => {
            let unit = |at: usize| {
                let digits = inner.get(at..at + 4)?;
                u32::from_str_radix(digits, 16).ok()
            };
            match unit(2) {
                Some(0xD800..=0xDBFF) => (12, 4), // a surrogate pair
                Some(unit) => (6, char::from_u32(unit).map_or(3, char::len_utf8)),
                None => (6, 1),
            }
        }
        (Some(b'\\'), _) => (2, 1),
        _ => {
            let length = inner.chars().next().map_or(1, char::len_utf8);
            (length, length)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_that_ascend_are_found_in_one_walk() {
        let inner = r"a\n\u00e9\ud834\udd1eé".repeat(500);
        let mut walk = LiteralWalk::new(&inner);
        let (source, decoded) = (inner.len() / 500, 10);
        for round in 0..500 {
            for (inside, spelled) in [(0, 0), (1, 1), (2, 3), (4, 9), (8, 21)] {
                assert_eq!(walk.to(round * decoded + inside), round * source + spelled);
            }
        }
        assert_eq!(walk.steps, 500 * 5 - 1, "each character before the last is read once");
        assert_eq!(walk.to(1), 1, "a place that was passed");
    }
}
