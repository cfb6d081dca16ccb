//! The part of docs/STYLE.md that a program can check: words of pages, the width of their lines, names of types.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Turns of phrase that no page has, with a rule of the guide. A blank at the start or the end is the border of a word.
const FORBIDDEN: &[(&str, &str)] = &[
    (" what is wrong ", "Use a noun, not a clause with *what*"),
    (" is none ", "Negate the verb, not the noun"),
    (" are none ", "Negate the verb, not the noun"),
    (" is no more ", "Negate the verb, not the noun"),
    (" are no more ", "Negate the verb, not the noun"),
    (" another one ", "Say *different*, *wrong*, *changed* or *missing*"),
    (" other ones ", "Say *different*, *wrong*, *changed* or *missing*"),
    (" lipz hears ", "Programs read, compare, report and store"),
    (" lipz believes ", "Programs read, compare, report and store"),
    (" lipz doubts ", "Programs read, compare, report and store"),
    (" lipz knows ", "Programs read, compare, report and store"),
    (" lipz tells ", "Programs read, compare, report and store"),
    (" lipz says ", "Programs read, compare, report and store"),
    (" somebody ", "Name the agent"),
    (" nobody ", "Name the agent"),
    (" whoever ", "Name the agent"),
    (" anew ", "Use the word of the trade"),
    (" once more ", "Use the word of the trade"),
    (" beside ", "Use the word of the trade"),
    (" lies over ", "Use the word of the trade"),
    (" mend ", "Use the word of the trade"),
    (" mended ", "Use the word of the trade"),
    (" per picture ", "Use the word of the trade"),
    (" too: ", "Put one idea in a sentence"),
];

/// Columns of a page.
const WIDTH: usize = 100;

/// How many types may share a name.
const MOST_TYPES: usize = 3;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned()
}

/// All files below a folder with this extension, but for those of builds.
fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut entries: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        match path.is_dir() {
            true if !matches!(name.as_str(), "target" | "node_modules" | ".git") => {
                found.extend(files(&path, extension));
            }
            false if path.extension().is_some_and(|of| of == extension) => found.push(path),
            _ => {}
        }
    }
    found
}

/// The pages that people read, by their paths.
fn pages() -> Vec<(String, String)> {
    let root = root();
    let folders = ["docs", "crates", "examples", "packages", "editors", "fixtures", "xtask", "fuzz"];
    let mut paths: Vec<PathBuf> = folders.iter().flat_map(|folder| files(&root.join(folder), "md")).collect();
    paths.extend(
        ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "RELEASING.md", "SECURITY.md"].map(|name| root.join(name)),
    );
    // The guide shows examples of what not to write.
    paths.retain(|path| !path.ends_with("docs/STYLE.md"));
    let name = |path: &Path| path.strip_prefix(&root).unwrap().to_string_lossy().replace('\\', "/");
    paths.iter().map(|path| (name(path), fs::read_to_string(path).unwrap())).collect()
}

/// The lines of a page with their numbers, without blocks of code.
fn prose(page: &str) -> Vec<(usize, &str)> {
    let mut is_code = false;
    let mut lines = Vec::new();
    for (number, line) in page.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            is_code = !is_code;
        } else if !is_code {
            lines.push((number + 1, line));
        }
    }
    lines
}

/// Words in lower case with a blank around each, without inline code, which is not prose.
fn words(line: &str) -> String {
    let without_code: String = line.split('`').step_by(2).collect::<Vec<_>>().join(" ");
    let separated: String = without_code.to_lowercase().replace(['(', ')', ',', '.', ';', '*', '_', '"', '|'], " ");
    format!(" {} ", separated.split_whitespace().collect::<Vec<_>>().join(" "))
}

#[test]
fn pages_have_no_forbidden_turns() {
    let mut found = Vec::new();
    for (path, page) in pages() {
        for (number, line) in prose(&page) {
            let words = words(line);
            for (turn, rule) in FORBIDDEN.iter().filter(|(turn, _)| words.contains(turn)) {
                found.push(format!("{path}:{number}: `{}` ({rule}): {}", turn.trim(), line.trim()));
            }
        }
    }
    assert!(found.is_empty(), "see docs/STYLE.md:\n{}", found.join("\n"));
}

#[test]
fn the_check_finds_what_it_looks_for() {
    assert!(words("An empty one is none: it never").contains(" is none: it "));
    assert!(words("It is *none*.").contains(" is none "));
    assert!(!words("`is none`").contains(" is none "));
    assert_eq!(prose("a\n```text\nb\n```\nc"), [(1, "a"), (5, "c")]);
}

#[test]
fn prose_is_wrapped() {
    let mut long = Vec::new();
    for (path, page) in pages() {
        for (number, line) in prose(&page) {
            let may_be_long = ["|", "#", "<!--", "!["].iter().any(|start| line.trim_start().starts_with(start));
            if line.chars().count() > WIDTH && !may_be_long && !line.contains("](") {
                long.push(format!("{path}:{number}: {} columns", line.chars().count()));
            }
        }
    }
    assert!(long.is_empty(), "longer than {WIDTH} columns:\n{}", long.join("\n"));
}

/// Names that more types share, with the reason.
const SHARED: &[(&str, &str)] = &[("Readme", "the doctests of each crate's README")];

/// Words that do not say what a type is: participles, adjectives and prepositions alone.
const NOT_NOUNS: &str = "\
    Applied Around Beside Bounded By Changed Checked Confirmed Converted Counted Decoded Delivered Doubtful Ended \
    Escaped Existing Expected Exported Felt Few Fixed Found Generated Heard Imported Incoming Interned Kept Keyed \
    Known Linted Listed Localised Loose Made Merged Now Opened Over Owned Packed Parsed Placed Plain Quoted Ran \
    Raw Received Recorded Refused Related Remembered Renamed Repeated Said Seen Segmented Shared Shown Spelled \
    Spoken Stamped Streamed Then Timed Told Trimmed Unclean Unknown Visible Waiting Wanted Where Whose With Worked \
    Written Wrong";

/// What a line declares: the word of Rust for it, and the name of the type.
fn declaration(line: &str) -> Option<(&str, String)> {
    let line = line.trim_start();
    let line = match line.strip_prefix("pub(") {
        Some(visibility) => visibility.split_once(')')?.1,
        None => line.strip_prefix("pub ").unwrap_or(line),
    };
    let (kind, name) = line.trim_start().split_once(' ')?;
    matches!(kind, "struct" | "enum" | "trait" | "union" | "type")
        .then(|| (kind, name.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()))
}

/// The types of all crates: word of Rust, name and file.
fn types() -> Vec<(String, String, String)> {
    let is_source = |path: &&PathBuf| path.components().any(|part| part.as_os_str() == "src");
    let mut types = Vec::new();
    for path in files(&root().join("crates"), "rs").iter().filter(is_source) {
        let text = fs::read_to_string(path).unwrap();
        let path = path.strip_prefix(root()).unwrap().to_string_lossy();
        let declared = text.lines().filter_map(declaration);
        types.extend(declared.map(|(kind, name)| (kind.to_owned(), name, path.replace('\\', "/"))));
    }
    types
}

#[test]
fn at_most_three_types_share_a_name() {
    let mut by_name: BTreeMap<String, Vec<String>> = BTreeMap::new();
    // A name of a trait's type, such as `Item`, is the same wherever the trait is implemented.
    for (_, name, path) in types().into_iter().filter(|(kind, ..)| kind != "type") {
        by_name.entry(name).or_default().push(path);
    }
    let mut shared: Vec<_> = by_name.into_iter().filter(|(_, paths)| paths.len() > MOST_TYPES).collect();
    shared.retain(|(name, _)| !SHARED.iter().any(|(allowed, _)| allowed == name));
    let shown: Vec<String> = shared.iter().map(|(name, paths)| format!("`{name}`: {}", paths.join(", "))).collect();
    assert!(shown.is_empty(), "more than {MOST_TYPES} types share a name:\n{}", shown.join("\n"));
}

#[test]
fn names_of_types_are_nouns() {
    let not_nouns = types().into_iter().filter(|(_, name, _)| NOT_NOUNS.split_whitespace().any(|word| word == name));
    let found: Vec<String> = not_nouns.map(|(kind, name, path)| format!("{path}: {kind} {name}")).collect();
    assert!(
        found.is_empty(),
        "a participle alone does not say what a type is, see docs/STYLE.md:\n{}",
        found.join("\n")
    );
}

#[test]
fn declarations_are_found() {
    let of = |line| declaration(line).map(|(kind, name)| format!("{kind} {name}"));
    assert_eq!(of("pub struct Clip<'a> {").as_deref(), Some("struct Clip"));
    assert_eq!(of("    pub(in crate::parse) enum Made {").as_deref(), Some("enum Made"));
    assert_eq!(of("struct Unclean;").as_deref(), Some("struct Unclean"));
    assert_eq!(of("type Known<'p> = Box<dyn Fn(&str) -> bool + 'p>;").as_deref(), Some("type Known"));
    assert_eq!(of("/// A struct of bytes"), None);
    assert_eq!(of("pub(crate) fn made() {"), None);
}
