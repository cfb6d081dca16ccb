//! The reader's public API names no type of the binary layout, so the layout can change without changing the API.
// Tests run with the workspace's compiler, not with the oldest one that the reader supports.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::incompatible_msrv)]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Crates whose types must not be public.
const PRIVATE: [&str; 2] = ["lipz_layout", "zerocopy"];

/// Returns all files of the reader.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("the sources of the reader");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    paths.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] }).collect()
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty())
}

/// Returns the names that `use` imports from private crates: `use lipz_layout::{A, B};`.
fn private_names(source: &str) -> BTreeSet<&str> {
    let imports = source.split("use ").skip(1).filter_map(|rest| rest.split(';').next());
    let of_private = imports.filter(|import| words(import).next().map_or(false, |name| PRIVATE.contains(&name)));
    of_private.flat_map(words).collect()
}

/// Returns the public items of a file: each `pub` up to its body or end, and the names of implemented traits.
fn signatures(source: &str) -> Vec<&str> {
    let code = source.split("#[cfg(test)]").next().unwrap_or(source);
    let mut found = Vec::new();
    for (at, _) in code.match_indices("pub ") {
        let is_start = code[..at].lines().last().map_or(true, |line| line.trim_start().is_empty());
        if is_start {
            let rest = &code[at..];
            // The public fields of a struct are found separately.
            found.push(&rest[..rest.find(['{', ';']).unwrap_or(rest.len())]);
        }
    }
    for (at, _) in code.match_indices("\nimpl") {
        let rest = &code[at + 1..];
        found.push(&rest[..rest.find('{').unwrap_or(rest.len())]);
    }
    found
}

/// Whether a signature belongs to a type that is not public.
fn is_private(signature: &str, private_types: &BTreeSet<String>) -> bool {
    signature.starts_with("impl") && words(signature).any(|word| private_types.contains(word))
}

#[test]
fn no_signature_names_the_layout() {
    let files: Vec<String> = sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"))
        .iter()
        .map(|path| std::fs::read_to_string(path).expect("a source"))
        .collect();
    let private_types: BTreeSet<String> = files
        .iter()
        .flat_map(|source| source.match_indices("pub(crate) ").map(move |(at, mark)| &source[at + mark.len()..]))
        .filter_map(|rest| rest.strip_prefix("struct ").or(rest.strip_prefix("enum ")))
        .filter_map(|rest| words(rest).next().map(String::from))
        .collect();
    let mut checked = 0;
    for source in &files {
        let names = private_names(source);
        for signature in signatures(source) {
            checked += 1;
            let named = words(signature).find(|word| names.contains(word) || PRIVATE.contains(word));
            assert!(named.is_none() || is_private(signature, &private_types), "{named:?} in `{}`", signature.trim());
        }
    }
    assert!(checked > 150, "{checked} signatures");
}

/// The check finds a violation.
#[test]
fn a_layout_type_in_a_signature_is_found() {
    let source = "use lipz_layout::{Header, Tag};\nuse core::fmt;\nimpl Bank {\n    pub fn tag(\n        &self,\n    ) -> Tag {}\n    pub(crate) fn header(&self) -> Header {}\n}\n";
    assert!(private_names(source).is_superset(&BTreeSet::from(["Header", "Tag"])));
    let signatures = signatures(source);
    assert!(signatures.iter().any(|signature| words(signature).any(|word| word == "Tag")));
    assert!(!signatures.iter().any(|signature| words(signature).any(|word| word == "Header")));
}
