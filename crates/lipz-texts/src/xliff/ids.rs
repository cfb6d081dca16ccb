//! Ids of placeholders: in a target, those that the same ones have in its source.

/// The placeholders of a unit.
#[derive(Default)]
pub(super) struct Ids {
    /// How many ids there are.
    count: usize,
    /// Those of the source: id, text, and whether the target has it, too.
    sources: Vec<(usize, String, bool)>,
}

impl Ids {
    /// The id of the next placeholder of a source.
    pub(super) fn of_source(&mut self, placeholder: &str) -> usize {
        self.count += 1;
        self.sources.push((self.count, placeholder.to_owned(), false));
        self.count
    }

    /// The id of the next placeholder of a target: that of the source, or a new one if the source does not have it.
    pub(super) fn of_target(&mut self, placeholder: &str) -> usize {
        let same = self.sources.iter_mut().find(|(_, text, is_used)| !is_used && text == placeholder);
        if let Some((id, _, is_used)) = same {
            *is_used = true;
            return *id;
        }
        self.count += 1;
        self.count
    }

    /// What follows has no targets of the sources before.
    pub(super) fn end_segment(&mut self) {
        self.sources.clear();
    }
}
