//! Comments of translators in files that other programs have saved.
#![allow(clippy::unwrap_used, reason = "tests")]

use lipz_texts::{Format, IncomingFile, ReadOptions, State, read};

const HEADER: &str = "msgid \"\"\nmsgstr \"Language: de_DE\\n\"\n\n";

fn po(entries: &str) -> IncomingFile {
    read(Format::Po, format!("{HEADER}{entries}").as_bytes(), &ReadOptions::new("en-us"))
}

#[test]
fn comments_of_obsolete_entries_are_not_those_of_the_next_entry() {
    let incoming = po("# Current.\nmsgctxt \"a\"\nmsgid \"A\"\nmsgstr \"Ah\"\n\n\
        # Old.\n#, fuzzy\n#~ msgctxt \"x\"\n#~ msgid \"X\"\n#~ msgstr \"Y\"\n\n\
        # New.\nmsgctxt \"b\"\nmsgid \"B\"\nmsgstr \"Be\"\n");
    let comments: Vec<_> =
        incoming.entries.iter().map(|entry| (entry.comments.clone(), entry.state == State::Translated)).collect();
    assert_eq!(comments, [(vec!["Current.".to_owned()], true), (vec!["New.".to_owned()], true)]);
}

/// Some editors delete comments, but keep the marks of lipz.
#[test]
fn comments_that_a_program_removed_are_kept() {
    let entry = |key: &str, comment: &str| {
        format!("{comment}#. comments as exported: 01234567\nmsgctxt \"{key}\"\nmsgid \"A\"\nmsgstr \"B\"\n\n")
    };
    let marks = |incoming: &IncomingFile| incoming.entries.iter().filter(|one| one.comments_mark.is_some()).count();
    let removed = po(&(entry("a", "") + &entry("b", "")));
    assert_eq!(marks(&removed), 0);
    assert_eq!(removed.diagnostics.len(), 1);
    assert_eq!(removed.diagnostics[0].message, "the comments of translators on 2 clips are missing, and are kept");
    // A person deletes single comments.
    let deleted = po(&(entry("a", "") + &entry("b", "# Formal?\n")));
    assert_eq!((marks(&deleted), deleted.diagnostics.len()), (2, 0));
    let only = po(&entry("a", ""));
    assert_eq!((marks(&only), only.diagnostics.len()), (1, 0));
}
