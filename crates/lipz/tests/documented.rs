//! The documentation that a new rule or format needs: a row on the page where users look for it.
//!
//! CONTRIBUTING.md has the instructions. A failure names the missing rows.
#![allow(clippy::unwrap_used, reason = "tests")]

mod support;

use lipz_diagnostics::Code;
use lipz_interop::formats;
use std::fs;
use support::repository;

fn read(page: &str) -> String {
    fs::read_to_string(repository().join(page)).unwrap()
}

/// Returns the first cells of all table rows of a page.
fn first_cells(page: &str) -> Vec<&str> {
    page.lines().filter_map(|line| line.strip_prefix("| ")?.split(" | ").next()).collect()
}

#[test]
fn rules_about_lipz_files_are_in_lipz_files_md() {
    let page = read("docs/reference/lipz-files.md");
    // Elements, rates and types, visemes, texts, segments, events. The remaining codes concern reading and writing.
    let codes = Code::ALL.iter().filter(|code| ("LZ0200".."LZ0800").contains(&code.number()));
    let missing: Vec<&str> = codes.map(|code| code.number()).filter(|number| !page.contains(number)).collect();
    assert!(missing.is_empty(), "docs/reference/lipz-files.md does not mention {missing:?}: add a row");
}

#[test]
fn formats_of_other_tools_are_in_other_tools_md() {
    let page = read("docs/guides/other-tools.md");
    let cells = first_cells(&page);
    let is_missing = |name: &&str| !cells.iter().any(|cell| cell.contains(&format!("`{name}`")));
    let missing: Vec<&str> = formats::ALL.iter().map(|format| format.name).filter(is_missing).collect();
    assert!(missing.is_empty(), "docs/guides/other-tools.md has no row for {missing:?}: add one to its first table");
}
