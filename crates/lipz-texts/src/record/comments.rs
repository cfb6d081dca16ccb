//! Comments of translators: questions and remarks about their translations of a clip.

use super::TextRecord;
use super::line::{escaped, unescaped};
use crate::exchange::Mark;
use std::collections::BTreeMap;
use std::fmt;

/// The third part of a line with a comment.
const COMMENT: &str = "comment";

/// The comments of a clip, by locale, in their order.
pub(super) type Comments = BTreeMap<String, Vec<String>>;

/// A line of the record: path, locale, `comment` and its text, with tabs between them.
pub(super) struct CommentLine {
    pub(super) file: String,
    locale: String,
    text: String,
}

impl CommentLine {
    /// Parses a line; `None` if it is not a comment.
    pub(super) fn parse(line: &str) -> Option<CommentLine> {
        let mut parts = line.splitn(4, '\t');
        let (file, locale, kind, text) = (parts.next()?, parts.next()?, parts.next()?, parts.next()?);
        let is_whole = kind == COMMENT && !file.is_empty() && !locale.is_empty() && !text.is_empty();
        is_whole.then_some(CommentLine { file: unescaped(file)?, locale: locale.to_owned(), text: unescaped(text)? })
    }

    /// Adds the comment to those of its clip. Merged branches may both have it.
    pub(super) fn add_to(self, comments: &mut Comments) {
        let known = comments.entry(self.locale).or_default();
        if !known.contains(&self.text) {
            known.push(self.text);
        }
    }
}

/// Writes the lines of a clip's comments.
pub(super) fn write(f: &mut fmt::Formatter<'_>, file: &str, comments: &Comments) -> fmt::Result {
    for (locale, comments) in comments {
        for comment in comments {
            escaped(f, file)?;
            write!(f, "\t{locale}\t{COMMENT}\t")?;
            escaped(f, comment)?;
            f.write_str("\n")?;
        }
    }
    Ok(())
}

impl TextRecord {
    /// Returns the comments on a clip's translations into a locale.
    pub fn comments(&self, file: &str, locale: &str) -> &[String] {
        self.comments.get(file).and_then(|of_file| of_file.get(locale)).map_or(&[], Vec::as_slice)
    }

    /// Stores the comments in a translator's file, whose export had the comments with the mark `exported`. If the record
    /// has others since, they stay. Returns whether the record has changed.
    pub fn take_comments(&mut self, file: &str, locale: &str, incoming: &[String], exported: Option<Mark>) -> bool {
        let known = self.comments(file, locale);
        let is_as_exported = exported.unwrap_or(Mark::of_comments(&[])) == Mark::of_comments(known);
        let mut all = if is_as_exported { Vec::new() } else { known.to_vec() };
        for comment in incoming {
            if !all.contains(comment) {
                all.push(comment.clone());
            }
        }
        if all == known {
            return false;
        }
        let of_file = self.comments.entry(file.to_owned()).or_default();
        match all.is_empty() {
            true => _ = of_file.remove(locale),
            false => _ = of_file.insert(locale.to_owned(), all),
        }
        if of_file.is_empty() {
            self.comments.remove(file);
            self.untranslated.remove(file);
        }
        true
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn lines(lines: &[&str]) -> Vec<String> {
        lines.iter().map(|line| (*line).to_owned()).collect()
    }

    #[test]
    fn comments_are_written_and_read_back() {
        let mut record = TextRecord::default();
        assert!(record.take_comments("a.lipz", "de-de", &lines(&["Formal?\tOr not", "Who speaks?"]), None));
        let text = record.to_string();
        assert!(
            text.ends_with("a.lipz\tde-de\tcomment\tFormal?\\tOr not\na.lipz\tde-de\tcomment\tWho speaks?\n"),
            "{text}"
        );
        // A merge of two branches keeps the lines of both.
        let twice = format!("{text}a.lipz\tde-de\tcomment\tWho speaks?\na.lipz\tde-de\tcomment\tYou?\n");
        let (again, odd) = TextRecord::parse(&twice).unwrap();
        assert_eq!((again.comments("a.lipz", "de-de").len(), odd.len()), (3, 0));
    }

    #[test]
    fn comments_of_an_older_file_remove_no_newer_ones() {
        let mut record = TextRecord::default();
        let mut take = |incoming: &[&str], exported: &[&str]| {
            record.take_comments("a", "de-de", &lines(incoming), Some(Mark::of_comments(&lines(exported))));
            record.comments("a", "de-de").to_vec()
        };
        assert_eq!(take(&["Formal?"], &[]), ["Formal?"]);
        assert_eq!(take(&["Formal? Yes."], &["Formal?"]), ["Formal? Yes."], "edited");
        assert_eq!(take(&["Too long"], &[]), ["Formal? Yes.", "Too long"], "by a second translator");
        assert_eq!(take(&[], &["Formal? Yes."]), ["Formal? Yes.", "Too long"], "deleted in an older file");
        assert_eq!(take(&[], &["Formal? Yes.", "Too long"]), [""; 0], "deleted");
    }
}
