//! `cargo xtask edges`: checks the dependencies between crates against the rules in `allowed`, and the imports between
//! their files against the order of `wings`.
//!
//! Direct dependencies are read from the manifests: every target and every optional one counts. Dependencies below them
//! are those that cargo resolves for one target with default features, so that a run needs only crates that the build
//! needs.

mod allowed;
mod wings;

use crate::Failure;
use crate::cargo;
use allowed::{Below, COMMAND_LINE_ONLY, FREE, RULES, ZEROCOPY};
use std::collections::{BTreeMap, BTreeSet};

/// The target for the check of transitive dependencies, on any machine.
const TARGET: &str = "x86_64-unknown-linux-gnu";

/// The dependencies of a crate of the workspace, without those of its tests.
#[derive(Debug, Default)]
struct Edges {
    direct: BTreeSet<String>,
    all: BTreeSet<String>,
}

/// Options of `cargo xtask edges`.
#[derive(clap::Args, Debug)]
pub(crate) struct Settings {
    /// Print the files of the crates with wings, each with the first sentence of its comment
    #[arg(long)]
    map: bool,
}

pub(crate) fn run(settings: &Settings) -> Result<(), Failure> {
    if settings.map {
        print!("{}", wings::map()?);
        return Ok(());
    }
    let (numbers, against) = wings::check()?;
    println!("{}", numbers.join("\n"));
    let found = edges_of_workspace()?;
    let refused = [refused(&found), against].concat();
    if refused.is_empty() {
        println!("the dependencies of {} crates are as allowed", found.len());
        return Ok(());
    }
    Err(format!(
        "{}\nxtask/src/edges/allowed.rs has the rules for crates, xtask/src/edges/wings/table.rs those for files",
        refused.join("\n")
    ))
}

/// Returns one line for every edge that the rules do not allow.
fn refused(found: &BTreeMap<String, Edges>) -> Vec<String> {
    let mut lines = Vec::new();
    for (name, edges) in found.iter().filter(|(name, _)| !FREE.contains(&name.as_str())) {
        let Some(rule) = RULES.iter().find(|rule| rule.name == name) else {
            lines.push(format!("{name} has no rule: list its allowed dependencies"));
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
                lines.push(format!("{name}: {} crates below it, but {most} are allowed", edges.all.len()));
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

/// Returns the crates that `cargo tree` lists below `package`.
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
