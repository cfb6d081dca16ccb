//! `cargo xtask edges`: which crates depend on which, held to the rules in `allowed`.
//!
//! Direct dependencies are read from the manifests: every target and every optional one counts. Those below
//! them are what cargo resolves for one target with the features on by default, so that a run needs no crate
//! that the build did not need.

mod allowed;

use crate::Failure;
use crate::cargo;
use allowed::{Below, COMMAND_LINE_ONLY, FREE, RULES, ZEROCOPY};
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
    let refused = refused(&found);
    if refused.is_empty() {
        println!("the dependencies of {} crates are as allowed", found.len());
        return Ok(());
    }
    Err(format!("{}\nxtask/src/edges/allowed.rs has the rules", refused.join("\n")))
}

/// Every edge that the rules do not allow, as a line to print.
fn refused(found: &BTreeMap<String, Edges>) -> Vec<String> {
    let mut lines = Vec::new();
    for (name, edges) in found.iter().filter(|(name, _)| !FREE.contains(&name.as_str())) {
        let Some(rule) = RULES.iter().find(|rule| rule.name == name) else {
            lines.push(format!("{name} has no rule: say what it may depend on"));
            continue;
        };
        let direct = edges.direct.iter().filter(|other| !rule.direct.contains(&other.as_str()));
        lines.extend(direct.map(|other| format!("{name} → {other}: not an allowed direct dependency")));
        let for_people = edges.all.iter().filter(|other| COMMAND_LINE_ONLY.contains(&other.as_str()));
        lines.extend(for_people.map(|other| format!("{name} → {other}: only the command line may depend on it")));
        match rule.below {
            Below::Only(names) => {
                let may = |other: &&str| names.contains(other) || ZEROCOPY.contains(other);
                let below = edges.all.iter().map(String::as_str).filter(|other| !may(other));
                lines.extend(below.map(|other| format!("{name} → {other}: not allowed below it")));
            }
            Below::AtMost(most) if edges.all.len() > most => {
                lines.push(format!("{name}: {} crates below it, and {most} are allowed", edges.all.len()));
            }
            Below::AtMost(_) => {}
        }
    }
    lines
}

fn edges_of_workspace() -> Result<BTreeMap<String, Edges>, Failure> {
    let mut found = BTreeMap::new();
    for package in cargo::workspace()? {
        let used = package.dependencies.iter().filter(|dependency| !dependency.is_for_tests());
        let direct = used.map(|dependency| dependency.name.clone()).collect();
        let all = below(&package.name)?;
        found.insert(package.name, Edges { direct, all });
    }
    Ok(found)
}

/// The crates that `cargo tree` lists below `package`.
fn below(package: &str) -> Result<BTreeSet<String>, Failure> {
    let what = ["tree", "--locked", "--edges", "normal", "--target", TARGET, "--package", package];
    let tree = cargo::output(&[&what[..], &["--prefix", "none", "--format", "{p}"]].concat())?;
    let names = tree.lines().filter_map(|line| line.split(' ').next()).filter(|name| !name.is_empty());
    let mut names: BTreeSet<String> = names.map(str::to_owned).collect();
    if names.remove(package) { Ok(names) } else { Err(format!("`cargo tree` does not list {package} itself")) }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn the_workspace_has_the_edges_of_its_design() {
        let found = edges_of_workspace().unwrap();
        assert!(found["lipz-bank"].all.contains("zerocopy"), "the dependencies are not seen at all: {found:?}");
        assert_eq!(refused(&found), Vec::<String>::new());
        for name in RULES.iter().map(|rule| rule.name).chain(FREE) {
            assert!(found.contains_key(name), "{name} is not a crate of the workspace");
        }
    }

    fn lines(name: &str, direct: &[&str], all: &[&str]) -> usize {
        let set = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        refused(&BTreeMap::from([(name.to_owned(), Edges { direct: set(direct), all: set(all) })])).len()
    }

    #[test]
    fn made_up_edges_are_refused() {
        assert_eq!(lines("lipz-bank", &["zerocopy"], &["zerocopy", "syn"]), 0);
        assert_eq!(lines("lipz-bank", &["zerocopy", "memchr"], &["zerocopy", "memchr"]), 2, "direct and below");
        assert_eq!(lines("lipz-bank", &["zerocopy"], &["zerocopy", "memchr"]), 1);
        assert_eq!(lines("lipz-types", &[], &["memchr"]), 1, "counted");
        assert_eq!(lines("lipz-file", &["lipz-compiler"], &[]), 1);
        assert_eq!(lines("lipz-compiler", &["lipz"], &[]), 1);
        assert_eq!(lines("lipz-new", &[], &[]), 1, "a crate needs a rule");
        for name in COMMAND_LINE_ONLY {
            assert_eq!(lines("lipz-compiler", &[], &[name]), 1, "{name}");
            assert_eq!(lines("lipz", &[], &[name]), 0, "{name}");
        }
    }
}
