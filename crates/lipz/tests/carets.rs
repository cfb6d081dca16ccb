//! Carets are under the exact character at line and column, also after wide characters, right-to-left text, escapes and
//! tabs. The test reads them from the expected output, and counts columns independently of the renderer.
#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

mod support;

use std::fs;
use support::{files, is_blessing, repository};
use unicode_width::UnicodeWidthChar;

/// Returns a source line as the renderer shows it, with replacements for characters that a terminal would not show in
/// place.
fn shown(source: &str) -> String {
    let mut shown = String::new();
    for character in source.chars() {
        match character {
            '\t' => shown.push_str("    "),
            '\u{80}'..='\u{9F}' => shown.push_str(&format!("\\u{:04X}", u32::from(character))),
            '\0'..='\u{1F}' => shown.extend(char::from_u32(0x2400 + u32::from(character))),
            _ => shown.push(character),
        }
    }
    shown
}

/// Returns the start of `line` that takes up `columns` of a terminal.
fn prefix(line: &str, columns: usize) -> &str {
    let mut width = 0;
    let end = line.char_indices().find(|(_, character)| {
        let at = width;
        width += character.width().unwrap_or(0);
        // A combining mark belongs to the character before it.
        at >= columns && character.width() != Some(0)
    });
    end.map_or(line, |(at, _)| &line[..at])
}

/// Returns a rendered line without the margin `12 | `.
fn behind_margin(line: &str) -> &str {
    line.split_once("| ").map_or("", |(_, rest)| rest)
}

/// Checks the diagnostics of one expected output. Returns the number of checked carets.
fn check_carets(expected: &str, source: &str, path: &str) -> usize {
    let lines: Vec<&str> = expected.lines().collect();
    let mut count = 0;
    for (index, line) in lines.iter().enumerate() {
        let Some((_, place)) = line.split_once("--> ") else { continue };
        let mut parts = place.rsplit(':');
        let (Some(Ok(column)), Some(Ok(number))) =
            (parts.next().map(str::parse::<usize>), parts.next().map(str::parse::<usize>))
        else {
            continue; // about the file as a whole
        };
        let margin = format!("{number} |");
        let at = index + lines[index..].iter().position(|line| line.trim_start().starts_with(&margin)).unwrap();
        let (text, carets) = (behind_margin(lines[at]), behind_margin(lines[at + 1]));
        if text.starts_with("...") || carets.starts_with("|_") || text.starts_with('/') {
            continue; // the line is cut at its start, or the diagnostic has several lines
        }
        let caret_column = carets.find('^').unwrap_or_else(|| panic!("{path}:{number}: no caret"));
        let source = source.split('\n').nth(number - 1).unwrap();
        // A combining mark does not have a column, so the caret follows the marked character.
        let is_mark = source.chars().nth(column - 1).is_some_and(|character| character.width() == Some(0));
        let before: String = source.chars().take(column - 1 + usize::from(is_mark)).collect();
        assert_eq!(prefix(text, caret_column), shown(&before), "{path}:{number}:{column}");
        count += 1;
    }
    count
}

#[test]
fn carets_stand_under_their_characters() {
    if is_blessing() {
        return; // the files are being written
    }
    let mut count = 0;
    for folder in ["fixtures/bad", "fixtures/bad/with-flags", "fixtures/spec/as-printed"] {
        for path in files(folder, "expected") {
            let base = path.strip_suffix(".expected").unwrap();
            let source = fs::read(repository().join(format!("{base}.lipz"))).unwrap();
            let source = source.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(&source);
            let expected = fs::read_to_string(repository().join(&path)).unwrap();
            count += check_carets(&expected, &String::from_utf8_lossy(source), &path);
        }
    }
    assert!(count > 150, "only {count} carets were checked");
}

#[test]
fn a_caret_in_the_wrong_place_is_seen() {
    let output = |caret: &str| format!("error[LZ0401]: x\n --> a.lipz:1:4\n  |\n1 | 灯台 Z\n  | {caret}\n");
    assert_eq!(check_carets(&output("     ^"), "灯台 Z", "a.lipz"), 1);
    for caret in ["    ^", "      ^", "   ^"] {
        let wrong = output(caret);
        assert!(std::panic::catch_unwind(|| check_carets(&wrong, "灯台 Z", "a.lipz")).is_err(), "{caret:?}");
    }
}
