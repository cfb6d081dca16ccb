//! The differences between two texts, by line or by word.
//!
//! `similar::TextDiff` compiles each of its algorithms for each kind of text, which takes half a megabyte of the
//! command. This module uses only the default algorithm.

use similar::algorithms::{Capture, Compact, Replace, myers};
use similar::udiff::UnifiedHunkHeader;
use similar::{Change, DiffOp, DiffTag, DiffableStr, group_diff_ops};
use std::fmt::Write;

/// Unchanged lines before and after a change, as in `diff -u`.
const CONTEXT_LINES: usize = 3;

/// Returns the words that two texts share and those that only one of them has, in order.
pub fn by_word<'t>(old: &'t str, new: &'t str) -> Vec<Change<&'t str>> {
    let (old, new) = (old.tokenize_unicode_words(), new.tokenize_unicode_words());
    operations(&old, &new).iter().flat_map(|operation| operation.iter_changes(&old[..], &new[..])).collect()
}

/// Returns the differences between two texts in the format of `diff -u`, or nothing if they are equal. `name` is the
/// name of both files.
pub fn unified(name: &str, old: &str, new: &str) -> String {
    let (old, new) = (old.tokenize_lines(), new.tokenize_lines());
    let mut text = String::new();
    for hunk in group_diff_ops(operations(&old, &new), CONTEXT_LINES).iter().filter(|hunk| !hunk.is_empty()) {
        if text.is_empty() {
            let _ = write!(text, "--- {name}\n+++ {name}\n");
        }
        let _ = writeln!(text, "{}", UnifiedHunkHeader::new(hunk));
        for change in hunk.iter().flat_map(|operation| operation.iter_changes(&old[..], &new[..])) {
            let _ = write!(text, "{}{}", change.tag(), change.value());
            if change.missing_newline() {
                text.push_str("\n\\ No newline at end of file\n");
            }
        }
    }
    text
}

/// Returns the number of words that two texts have in common, in the same order.
pub(crate) fn common_words(one: &[&str], other: &[&str]) -> usize {
    let same = operations(one, other).into_iter().filter(|operation| operation.tag() == DiffTag::Equal);
    same.map(|operation| operation.new_range().len()).sum()
}

/// Returns the operations that lead from the old parts to the new ones.
fn operations(old: &[&str], new: &[&str]) -> Vec<DiffOp> {
    let mut found = Compact::new(Replace::new(Capture::new()), old, new);
    match myers::diff(&mut found, old, 0..old.len(), new, 0..new.len()) {
        Ok(()) => found.into_inner().into_inner().into_ops(),
        Err(never) => match never {},
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use similar::TextDiff;

    #[test]
    fn differences_are_those_of_the_whole_library() {
        let long: String = (0..40).map(|number| format!("line {number}\n")).collect();
        let changed = long.replace("line 3\n", "").replace("line 20\n", "line twenty\nand a half\n") + "last";
        for (old, new) in [
            ("", ""),
            ("a\n", ""),
            ("", "a"),
            ("same\n", "same\n"),
            ("a\nb\nc\n", "a\nx\nc"),
            ("a b c\nd", "c b a\nd"),
            (&*long, &*changed),
            (&*changed, &*long),
        ] {
            let lines = TextDiff::from_lines(old, new).unified_diff().header("n", "n").to_string();
            assert_eq!(unified("n", old, new), lines, "{old:?}");
            let words = TextDiff::from_unicode_words(old, new);
            assert_eq!(by_word(old, new), words.iter_all_changes().collect::<Vec<_>>(), "{old:?}");
        }
    }
}
