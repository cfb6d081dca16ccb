//! `cargo xtask edges`: which crates depend on which, held to the allow-lists in `allowed`.
//!
//! Direct dependencies are read from the manifests: every target and every optional one counts.
//! Transitive ones are what cargo resolves for one target, so that a run needs no crate that the
//! build did not need.

mod allowed;

use crate::Failure;
use crate::ci::cargo_command;
use allowed::{ALLOWED, COMMAND_LINE_ONLY, COMMAND_LINE_USERS, Rule};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};

/// The target whose transitive dependencies are checked, wherever the check runs.
const TARGET: &str = "x86_64-unknown-linux-gnu";

/// The dependencies of a crate of the workspace, without those of its tests.
#[derive(Debug, Default)]
struct Edges {
    direct: BTreeSet<String>,
    all: BTreeSet<String>,
}

pub(crate) fn run() -> Result<(), Failure> {
    let found = edges_of_workspace()?;
    let refused = refused(&found, ALLOWED);
    for line in &refused {
        eprintln!("{line}");
    }
    if refused.is_empty() {
        println!("the dependencies of {} crates are as allowed", found.len());
        Ok(())
    } else {
        Err(format!("{} dependencies are not in the allow-lists of xtask/src/edges/allowed.rs", refused.len()))
    }
}

/// Every edge that the rules do not allow, as a line to print.
fn refused(found: &BTreeMap<String, Edges>, rules: &[Rule]) -> Vec<String> {
    let mut lines = Vec::new();
    for (name, edges) in found {
        let Some(rule) = rules.iter().find(|rule| rule.name == name) else {
            lines.push(format!("{name} has no rule: say what it may depend on"));
            continue;
        };
        let mut refuse = |other: &String, why: &str| lines.push(format!("{name} → {other}: {why}"));
        for other in &edges.direct {
            if rule.direct.is_some_and(|direct| !direct.contains(&other.as_str())) {
                refuse(other, "not an allowed direct dependency");
            }
        }
        for other in &edges.all {
            let may = |transitive: &[&[&str]]| transitive.iter().any(|list| list.contains(&other.as_str()));
            if COMMAND_LINE_ONLY.contains(&other.as_str()) && !COMMAND_LINE_USERS.contains(&name.as_str()) {
                refuse(other, "only the command line may depend on it");
            } else if rule.transitive.is_some_and(|transitive| !may(transitive)) {
                refuse(other, "not an allowed transitive dependency");
            }
        }
    }
    lines.extend(
        rules.iter().filter(|rule| !found.contains_key(rule.name)).map(|rule| format!("{} has a rule only", rule.name)),
    );
    lines
}

/// As much as is needed of what `cargo metadata` prints.
#[derive(Deserialize)]
struct Metadata {
    packages: Vec<Package>,
}

#[derive(Deserialize)]
struct Package {
    name: String,
    dependencies: Vec<Dependency>,
}

#[derive(Deserialize)]
struct Dependency {
    name: String,
    kind: Option<String>,
}

fn edges_of_workspace() -> Result<BTreeMap<String, Edges>, Failure> {
    let metadata = output_of(&["metadata", "--no-deps", "--format-version", "1", "--locked"])?;
    let metadata: Metadata =
        serde_json::from_str(&metadata).map_err(|error| format!("`cargo metadata` printed something else: {error}"))?;
    let mut found = BTreeMap::new();
    for package in metadata.packages {
        let is_dev = |dependency: &Dependency| dependency.kind.as_deref() == Some("dev");
        let used = package.dependencies.iter().filter(|dependency| !is_dev(dependency));
        let direct = used.map(|dependency| dependency.name.clone()).collect();
        let all = transitive(&package.name)?;
        found.insert(package.name, Edges { direct, all });
    }
    Ok(found)
}

/// The crates that `cargo tree` lists below `package`.
fn transitive(package: &str) -> Result<BTreeSet<String>, Failure> {
    let tree = output_of(&[
        "tree",
        "--package",
        package,
        "--edges",
        "normal",
        "--target",
        TARGET,
        "--prefix",
        "none",
        "--format",
        "{p}",
        "--locked",
    ])?;
    let names = tree.lines().filter_map(|line| line.split(' ').next()).filter(|name| !name.is_empty());
    let mut names: BTreeSet<String> = names.map(str::to_owned).collect();
    if names.remove(package) { Ok(names) } else { Err(format!("`cargo tree` does not list {package} itself")) }
}

fn output_of(arguments: &[&str]) -> Result<String, Failure> {
    let shown = format!("cargo {}", arguments.join(" "));
    let output =
        cargo_command().args(arguments).output().map_err(|error| format!("`{shown}` cannot be run: {error}"))?;
    if !output.status.success() {
        let error = String::from_utf8_lossy(&output.stderr);
        return Err(format!("`{shown}` ended with {}: {}", output.status, error.trim()));
    }
    String::from_utf8(output.stdout).map_err(|_| format!("`{shown}` printed something that is not UTF-8"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_workspace_has_the_edges_of_its_design() {
        let found = edges_of_workspace().unwrap();
        assert!(found["lipz-bank"].all.contains("zerocopy"), "the dependencies are not seen at all: {found:?}");
        assert_eq!(refused(&found, ALLOWED), Vec::<String>::new());
    }

    fn made_up(name: &str, direct: &[&str], all: &[&str]) -> BTreeMap<String, Edges> {
        let set = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        BTreeMap::from([(name.to_owned(), Edges { direct: set(direct), all: set(all) })])
    }

    /// The lines about `name` alone: the other crates of the rules are not made up.
    fn lines(found: &BTreeMap<String, Edges>) -> Vec<String> {
        let mut lines = refused(found, ALLOWED);
        lines.retain(|line| !line.ends_with("has a rule only"));
        lines
    }

    #[test]
    fn made_up_edges_are_refused() {
        assert_eq!(lines(&made_up("lipz-bank", &["zerocopy"], &["zerocopy", "syn"])), Vec::<String>::new());
        let direct = lines(&made_up("lipz-bank", &["zerocopy", "memchr"], &["zerocopy", "memchr"]));
        assert_eq!(direct.len(), 2, "direct and transitive: {direct:?}");
        assert_eq!(lines(&made_up("lipz-bank", &["zerocopy"], &["zerocopy", "memchr"])).len(), 1);
        assert_eq!(lines(&made_up("lipz-file", &["lipz-compiler"], &[])).len(), 1);
        assert_eq!(lines(&made_up("lipz-compiler", &["lipz"], &[])).len(), 1);
        for name in COMMAND_LINE_ONLY {
            assert_eq!(lines(&made_up("lipz-compiler", &[], &[name])).len(), 1, "{name}");
            assert_eq!(lines(&made_up("lipz", &[], &[name])), Vec::<String>::new(), "{name}");
        }
    }

    #[test]
    fn crates_and_rules_belong_together() {
        assert_eq!(lines(&made_up("lipz-new", &[], &[])).len(), 1);
        let missing = refused(&made_up("lipz-bank", &[], &[]), ALLOWED);
        assert_eq!(missing.len(), ALLOWED.len() - 1);
    }
}
