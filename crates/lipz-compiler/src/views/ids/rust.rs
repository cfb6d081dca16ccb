//! Ids as a Rust module.

use super::source_text::NOTICE;
use super::tree::{IdFolder, Leaf};
use super::words::{snake, upper_snake, words};
use lipz_bank::ClipId;
use lipz_diagnostics::escape;
use std::fmt::Write;

/// The module of the locales, next to those of the folders.
const LOCALES: &str = "locales";

/// Words that cannot name a module (The Rust Reference, "Keywords", edition 2024).
const KEYWORDS: [&str; 51] = [
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do", "dyn", "else",
    "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop", "macro", "match", "mod",
    "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static", "struct", "super", "trait", "true",
    "try", "type", "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
];

/// Returns `act1::MARA_HELLO` for `act1/mara-hello`.
pub(super) fn identifiers(key: &str) -> Vec<String> {
    let mut parts = key.split('/');
    let clip = parts.next_back().map(|part| upper_snake(&words(part)));
    let folders = parts.enumerate().map(|(depth, part)| {
        let name = snake(&words(part));
        let is_taken = KEYWORDS.contains(&name.as_str()) || depth == 0 && name == LOCALES;
        if is_taken { format!("{name}_") } else { name }
    });
    folders.chain(clip).collect()
}

/// Returns the file.
pub(super) fn module(root: &IdFolder<'_>, locales: &[&str]) -> String {
    let mut out = format!("// {NOTICE}\n");
    if !root.clips.is_empty() {
        out.push('\n');
    }
    members(&mut out, root, 0);
    head(&mut out, "The locales of the bank.", LOCALES, 0);
    for locale in locales {
        let name = upper_snake(&words(locale));
        let _ = writeln!(out, "    /// {}\n    pub const {name}: &str = {locale:?};", code_span(locale));
    }
    out.push_str("}\n");
    out
}

fn members(out: &mut String, folder: &IdFolder<'_>, depth: usize) {
    for (name, clip) in &folder.clips {
        constant(out, name, clip, depth);
    }
    for (name, folder) in &folder.folders {
        head(out, &format!("Clips of the folder `{name}`."), name, depth);
        members(out, folder, depth + 1);
        let _ = writeln!(out, "{}}}", indent(depth));
    }
}

/// Adds the start of a module.
fn head(out: &mut String, about: &str, name: &str, depth: usize) {
    let blank_line = if depth == 0 { "\n" } else { "" };
    let (indent, attribute) = (indent(depth), unused_is_fine(depth));
    let _ = writeln!(out, "{blank_line}{indent}/// {about}\n{attribute}{indent}pub mod {name} {{");
}

/// Adds the id as a number: `ClipId::from_key` would have the same value, but the compiler would take more than twice
/// as long for 100,000 clips.
fn constant(out: &mut String, name: &str, clip: &Leaf<'_>, depth: usize) {
    let (indent, id) = (indent(depth), ClipId::from_u64(clip.id));
    let _ = write!(out, "{indent}/// {}", code_span(&escape::text(clip.key)));
    if !clip.text.is_empty() {
        let _ = write!(out, ": {}", code_span(&clip.text));
    }
    let _ = write!(out, "\n{}{indent}pub const {name}: ::lipz_bank::ClipId = ", unused_is_fine(depth));
    let _ = writeln!(out, "::lipz_bank::ClipId::from_u64(0x{id});");
}

/// Returns an attribute that suppresses warnings about unused ids, only for the outermost items.
fn unused_is_fine(depth: usize) -> &'static str {
    if depth == 0 { "#[allow(dead_code, unreachable_pub)]\n" } else { "" }
}

fn indent(depth: usize) -> String {
    "    ".repeat(depth)
}

/// Returns the text in enough backquotes for Markdown to leave it unchanged.
fn code_span(text: &str) -> String {
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat(longest + 1);
    let blank = if text.starts_with('`') || text.ends_with('`') { " " } else { "" };
    format!("{fence}{blank}{text}{blank}{fence}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_follow_rust() {
        let path = |key| identifiers(key).join("::");
        assert_eq!(path("act1/mara-good-evening"), "act1::MARA_GOOD_EVENING");
        assert_eq!(path("type/self/loop"), "type_::self_::LOOP");
        assert_eq!(path("locales/locales/x"), "locales_::locales::X");
        assert_eq!(path("1/2"), "_1::_2");
    }

    #[test]
    fn markdown_shows_texts_as_they_are() {
        assert_eq!(code_span("<b> [otto] *"), "`<b> [otto] *`");
        assert_eq!(code_span("a `` b `"), "``` a `` b ` ```");
    }
}
