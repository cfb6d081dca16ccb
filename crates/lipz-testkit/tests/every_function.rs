//! Checks that every public function of the reader is called on damaged banks, and proven not to panic.
#![allow(clippy::expect_used)]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Exempt functions: constants are made with them, and invalid ones do not compile.
const EXEMPT: [&str; 1] = ["whole"];

/// The re-exports of `lipz-bank` from `lipz-types`.
const TYPES: [&str; 9] =
    ["command.rs", "curve_value.rs", "emotion.rs", "fps.rs", "id.rs", "phone.rs", "time.rs", "viseme.rs", "weight.rs"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).expect("a source")
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("the sources of the reader");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    paths.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] }).collect()
}

/// Returns the names of a file's public functions.
fn public_functions(source: &str) -> impl Iterator<Item = String> + '_ {
    let code = source.split("#[cfg(test)]").next().unwrap_or(source);
    code.lines().filter_map(|line| {
        let rest = line.trim_start().strip_prefix("pub ")?;
        let rest = rest.strip_prefix("const ").unwrap_or(rest).strip_prefix("fn ")?;
        Some(rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect())
    })
}

/// Whether `code` uses the function as a method or a path.
fn mentions(code: &str, function: &str) -> bool {
    [format!(".{function}("), format!("::{function}(")].iter().any(|call| code.contains(call.as_str()))
        || code.match_indices(&format!("::{function}")).any(|(at, found)| {
            code[at + found.len()..].chars().next().is_some_and(|next| !next.is_alphanumeric() && next != '_')
        })
}

fn missing_in(paths: &[&str]) -> Vec<String> {
    let types = TYPES.iter().map(|name| root().join("crates/lipz-types/src").join(name));
    let files: Vec<PathBuf> = sources(&root().join("crates/lipz-bank/src")).into_iter().chain(types).collect();
    let functions: BTreeSet<String> =
        files.iter().flat_map(|path| public_functions(&read(path)).collect::<Vec<_>>()).collect();
    assert!(functions.len() > 80, "{} public functions were found", functions.len());
    let code: String = paths.iter().map(|path| read(&root().join(path))).collect();
    functions.into_iter().filter(|name| !EXEMPT.contains(&name.as_str()) && !mentions(&code, name)).collect()
}

#[test]
fn the_exerciser_asks_everything() {
    let exerciser = ["exercise.rs", "said.rs", "stacked.rs"].map(|name| format!("crates/lipz-testkit/src/{name}"));
    assert_eq!(missing_in(&exerciser.each_ref().map(String::as_str)), [""; 0]);
}

#[test]
fn the_proof_of_no_panics_has_everything() {
    let proof =
        ["lib.rs", "articulation.rs", "clips.rs", "dialogues.rs"].map(|name| format!("firmware/proof/src/{name}"));
    assert_eq!(missing_in(&proof.each_ref().map(String::as_str)), [""; 0]);
}
