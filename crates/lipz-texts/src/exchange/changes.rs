//! The differences between two versions of a text, word by word.

use super::difference::by_word;
use similar::ChangeTag;
use std::ops::Range;

/// The greatest length of texts that are compared word by word. Dividing longer ones takes long.
const LONGEST: usize = 10_000;

/// Words of the old text, and their replacement.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct WordChange<'o> {
    /// The old words without surrounding whitespace; empty for an insertion.
    pub(crate) old: &'o str,
    /// The bytes of the new text; empty for a deletion.
    pub(crate) new: Range<usize>,
}

/// Returns the changes from `old` to `new`, in order. Languages without spaces between words are divided by Unicode
/// rules.
pub(crate) fn changes<'o>(old: &'o str, new: &str) -> Vec<WordChange<'o>> {
    if old == new {
        return Vec::new();
    }
    if old.len() + new.len() > LONGEST {
        return vec![WordChange { old, new: 0..new.len() }];
    }
    let (mut old_at, mut new_at) = (0, 0);
    let mut open: Option<(Range<usize>, Range<usize>)> = None;
    let mut all = Vec::new();
    for change in by_word(old, new) {
        let length = change.value().len();
        let is_blank = change.value().trim().is_empty();
        match change.tag() {
            // A space between two changed words belongs to them.
            ChangeTag::Equal if !is_blank || open.is_none() => all.extend(open.take()),
            _ => {
                let (olds, news) = open.get_or_insert((old_at..old_at, new_at..new_at));
                let is = |tag| change.tag() == tag || change.tag() == ChangeTag::Equal;
                olds.end = old_at + if is(ChangeTag::Delete) { length } else { 0 };
                news.end = new_at + if is(ChangeTag::Insert) { length } else { 0 };
            }
        }
        old_at += if change.tag() == ChangeTag::Insert { 0 } else { length };
        new_at += if change.tag() == ChangeTag::Delete { 0 } else { length };
    }
    all.extend(open);
    let trimmed = |text: &str, range: Range<usize>| {
        let whole = text.get(range.clone()).unwrap_or_default();
        let start = range.start + (whole.len() - whole.trim_start().len());
        start..start + whole.trim().len()
    };
    all.into_iter()
        .map(|(olds, news)| WordChange { old: old.get(olds).unwrap_or_default().trim(), new: trimmed(new, news) })
        .filter(|change| !change.old.is_empty() || !change.new.is_empty())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(old: &str, new: &str) -> Vec<(String, String)> {
        changes(old, new).into_iter().map(|change| (change.old.to_owned(), new[change.new].to_owned())).collect()
    }

    fn pairs(pairs: &[(&str, &str)]) -> Vec<(String, String)> {
        pairs.iter().map(|(old, new)| ((*old).to_owned(), (*new).to_owned())).collect()
    }

    #[test]
    fn words_that_changed() {
        assert_eq!(seen("Good evening, Otto.", "Good morning, Otto."), pairs(&[("evening", "morning")]));
        assert_eq!(seen("Go now.", "Go away right now."), pairs(&[("", "away right")]));
        assert_eq!(seen("Go right now.", "Go now."), pairs(&[("right", "")]));
        assert_eq!(seen("a b c d", "a x y d"), pairs(&[("b c", "x y")]));
        assert_eq!(seen("灯台です", "灯台でした"), pairs(&[("す", "した")]));
        assert_eq!(seen("Hi.", "Hi!"), pairs(&[(".", "!")]));
        assert_eq!(seen("", "Hi!"), pairs(&[("", "Hi!")]));
        assert_eq!(seen("same", "same"), []);
    }
}
