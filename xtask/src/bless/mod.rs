//! `cargo xtask bless`: writes every generated file of the repository.
//!
//! First it generates the table of rules and their page, and writes the version of the workspace to the manifests of
//! packages. Then it runs the tests with committed expected outputs again, which write these. Read the difference
//! before you commit it. `cargo xtask bless lipz` runs only the tests of one crate, `cargo xtask bless rules` and
//! `cargo xtask bless versions` run none.

mod diagnostics_page;
mod rules;
mod versions;

use crate::cargo;
use crate::paths::workspace_root;
use crate::{Failure, tools};
use clap::Args;
use rules::Rule;

/// What to write.
#[derive(Args, Debug)]
pub(crate) struct Settings {
    /// `rules` or `versions` for only the files without tests, or a crate to add the expected outputs of its tests
    #[arg(value_parser = names())]
    only: Option<String>,
}

/// The tests that write their expected outputs.
const TESTS: [&[&str]; 6] = [
    &["--package", "lipz-bank", "--test", "golden"],
    &["--package", "lipz-capi", "--test", "header"],
    &["--package", "lipz-compiler", "--test", "ids"],
    &["--package", "lipz-interop", "--test", "fallout_lip", "--test", "fixtures"],
    &["--package", "lipz-testkit", "--features", "std", "--test", "playback_cases"],
    &["--package", "lipz"],
];

fn names() -> Vec<&'static str> {
    TESTS.iter().map(|test| test[1]).chain(["rules", "versions"]).collect()
}

pub(crate) fn run(settings: &Settings) -> Result<(), Failure> {
    for (path, contents) in made_from_rules()?.into_iter().chain(versions::with_version()?) {
        std::fs::write(workspace_root().join(path), contents).map_err(|error| format!("`{path}`: {error}"))?;
    }
    for test in TESTS.iter().filter(|test| settings.only.as_deref().is_none_or(|only| test[1] == only)) {
        let mut run = cargo::command();
        run.args(["test", "--quiet", "--no-fail-fast"])
            .args(*test)
            .env("LIPZ_BLESS", "1")
            .current_dir(workspace_root());
        tools::succeed(&mut run, &format!("cargo test {}", test.join(" ")))?;
    }
    Ok(())
}

/// Returns the files that are generated from the rules, with their contents.
fn made_from_rules() -> Result<[(&'static str, String); 2], Failure> {
    let rules = Rule::all(&workspace_root().join(rules::FOLDER))?;
    Ok([(rules::TABLE, rules::table(&rules)?), (diagnostics_page::PATH, diagnostics_page::page(&rules)?)])
}

/// Whether a committed file is current.
#[cfg(test)]
fn is_current(path: &str, contents: &str) -> bool {
    std::fs::read_to_string(workspace_root().join(path)).is_ok_and(|committed| committed == contents)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn what_is_made_from_rules_is_current() {
        for (path, contents) in made_from_rules().unwrap() {
            assert!(is_current(path, &contents), "{path} differs from the rules: run `cargo xtask bless`");
        }
    }

    #[test]
    fn manifests_and_pages_have_the_version_of_the_workspace() {
        for (path, contents) in versions::with_version().unwrap() {
            assert!(is_current(path, &contents), "{path} has a different version: run `cargo xtask bless versions`");
        }
    }
}
