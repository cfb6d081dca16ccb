//! IDs of placeholders. In a target, placeholders have the same IDs as in its source.

/// The placeholders of a unit.
#[derive(Default)]
pub(super) struct Ids {
    /// The number of IDs.
    count: usize,
    /// The placeholders of the source: ID, text, and whether the target already contains it.
    sources: Vec<(usize, String, bool)>,
}

impl Ids {
    /// Returns the ID of the next placeholder of a source.
    pub(super) fn of_source(&mut self, placeholder: &str) -> usize {
        self.count += 1;
        self.sources.push((self.count, placeholder.to_owned(), false));
        self.count
    }

    /// Returns the ID of the next placeholder of a target: the one in the source, or a new one.
    pub(super) fn of_target(&mut self, placeholder: &str) -> usize {
        let same = self.sources.iter_mut().find(|(_, text, is_used)| !is_used && text == placeholder);
        if let Some((id, _, is_used)) = same {
            *is_used = true;
            return *id;
        }
        self.count += 1;
        self.count
    }

    /// Ends a segment. Later targets do not belong to its source.
    pub(super) fn end_segment(&mut self) {
        self.sources.clear();
    }
}
