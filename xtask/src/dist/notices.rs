//! The licences and notices of all crates in the program, as one text.

use crate::Failure;
use crate::cargo;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// How the names of licence files start, in lower case.
const NAMES: [&str; 6] = ["license", "licence", "copying", "copyright", "notice", "unlicense"];

/// The folders of our own crates with notices of embedded data.
const DATA: [&str; 4] = ["model", "data/english", "data/numbers", "data/pinyin"];

const HEADING: &str = "\
Licences and notices of the crates in this program

Where a crate offers several licences, lipz takes any but the GPL. The sources of each crate, including those under
MPL-2.0, are at https://crates.io/crates/NAME/VERSION. The standard library of Rust is under MIT or Apache-2.0, with
the notices at https://www.rust-lang.org/policies/licenses.
";

/// The required parts of the output of `cargo metadata`.
#[derive(Deserialize)]
struct Metadata {
    packages: Vec<Package>,
    resolve: Resolve,
}

#[derive(Deserialize)]
struct Package {
    id: String,
    name: String,
    version: String,
    license: Option<String>,
    manifest_path: PathBuf,
}

#[derive(Deserialize)]
struct Resolve {
    nodes: Vec<Node>,
}

#[derive(Deserialize)]
struct Node {
    id: String,
    deps: Vec<Edge>,
}

#[derive(Deserialize)]
struct Edge {
    pkg: String,
    dep_kinds: Vec<Kind>,
}

#[derive(Deserialize)]
struct Kind {
    /// `None` for a normal dependency.
    kind: Option<String>,
}

/// Returns the notices of a program, `lipz` or `lipz-capi`, for a target. Fails for a crate without a licence file.
pub(super) fn notices(package: &str, target: &str) -> Result<String, Failure> {
    let printed = cargo::output(&["metadata", "--format-version", "1", "--locked", "--filter-platform", target])?;
    let metadata: Metadata =
        serde_json::from_str(&printed).map_err(|error| format!("`cargo metadata` printed something else: {error}"))?;
    let ids = linked(&metadata, package);
    let mut packages: Vec<&Package> = metadata.packages.iter().filter(|package| ids.contains(&*package.id)).collect();
    packages.sort_by_key(|package| (&package.name, &package.version));
    let mut text = HEADING.to_owned();
    // Each text with the crates that have it, in the order of their first crate.
    let mut texts: BTreeMap<String, (usize, String, Vec<String>)> = BTreeMap::new();
    for package in packages {
        let name = format!("{} {}", package.name, package.version);
        text.push_str(&format!("\n{name}: {}", package.license.as_deref().unwrap_or("see below")));
        let files = files(package).map_err(|error| format!("`{name}`: {error}"))?;
        if files.is_empty() {
            return Err(format!(
                "the package of `{name}` has no licence file: find the text, and add it to its notices"
            ));
        }
        for contents in files {
            let words = contents.split_whitespace().collect::<Vec<_>>().join(" ");
            let place = texts.len();
            let (_, _, crates) = texts.entry(words).or_insert((place, contents, Vec::new()));
            if crates.last() != Some(&name) {
                crates.push(name.clone());
            }
        }
    }
    let mut texts: Vec<_> = texts.into_values().collect();
    texts.sort_by_key(|(place, ..)| *place);
    for (_, contents, crates) in texts {
        let line = "-".repeat(80);
        text.push_str(&format!("\n\n{line}\n{}\n{line}\n\n{}", crates.join(", "), contents.trim_end()));
    }
    text.push('\n');
    Ok(text)
}

/// Returns the ids of the packages that are linked into a program.
fn linked<'a>(metadata: &'a Metadata, root: &str) -> BTreeSet<&'a str> {
    let nodes: BTreeMap<&str, &Node> = metadata.resolve.nodes.iter().map(|node| (&*node.id, node)).collect();
    let root = metadata.packages.iter().filter(|package| package.name == root).map(|package| &*package.id);
    let (mut waiting, mut found): (Vec<&str>, BTreeSet<&str>) = (root.collect(), BTreeSet::new());
    while let Some(id) = waiting.pop() {
        if found.insert(id) {
            let edges = nodes.get(id).map_or(&[][..], |node| &node.deps);
            let normal = edges.iter().filter(|edge| edge.dep_kinds.iter().any(|kind| kind.kind.is_none()));
            waiting.extend(normal.map(|edge| &*edge.pkg));
        }
    }
    found
}

/// Returns the licence files of a package, ordered by name.
fn files(package: &Package) -> std::io::Result<Vec<String>> {
    let folder = package.manifest_path.parent().unwrap_or(Path::new(""));
    let data = if package.name.starts_with("lipz") { &DATA[..] } else { &[] };
    let mut paths = Vec::new();
    for folder in std::iter::once(folder.to_owned()).chain(data.iter().map(|data| folder.join(data))) {
        if !folder.is_dir() {
            continue;
        }
        for entry in fs::read_dir(&folder)? {
            let path = entry?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
            if path.is_file() && NAMES.iter().any(|start| name.starts_with(start)) && !name.contains("gpl") {
                paths.push(path);
            }
        }
    }
    paths.sort();
    paths.iter().map(|path| Ok(String::from_utf8_lossy(&fs::read(path)?).replace("\r\n", "\n"))).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn the_notices_are_those_of_linked_crates_and_data() {
        let text = notices("lipz", "x86_64-unknown-linux-gnu").unwrap();
        // A dependency, and the notices of the acoustic model and of the tables of numbers.
        for part in ["\nsymphonia 0.6", ": MPL-2.0", "Carnegie Mellon University", "UNICODE LICENSE V3"] {
            assert!(text.contains(part), "{part}");
        }
        // A dependency of tests, and one for a different system.
        assert!(!text.contains("\njsonschema ") && !text.contains("\nwindows-sys "));
        assert!(notices("lipz", "x86_64-pc-windows-msvc").unwrap().contains("\nwindows-sys "));
    }
}
