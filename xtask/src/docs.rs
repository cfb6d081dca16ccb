//! `cargo xtask docs`: writes docs/DIAGNOSTICS.md, whose contents are in the code.

use crate::{Failure, place};
use lipz::Code;
use std::fmt::Write;
use std::fs;

const PATH: &str = "docs/DIAGNOSTICS.md";

const INTRODUCTION: &str = "\
<!-- Written by `cargo xtask docs` from crates/lipz/src/diagnostic: change it there. -->

# Diagnostics

Every finding of lipz has a code. `lipz explain LZ0401` shows what this page says about it. Numbers are
never given a new meaning. An error forbids to write the bank, a warning does not.
";

pub(crate) fn run() -> Result<(), Failure> {
    let path = place::workspace_root().join(PATH);
    fs::write(&path, document()).map_err(|error| format!("{PATH} cannot be written: {error}"))
}

/// The whole page: the codes by group, then what there is to know about each.
fn document() -> String {
    let mut text = INTRODUCTION.to_owned();
    for group in Code::ALL.chunk_by(|a, b| a.group() == b.group()) {
        let title = group.first().map_or("", |code| code.group());
        let _ = writeln!(text, "\n**{title}**\n\n| code | level | about |\n| --- | --- | --- |");
        for code in group {
            let (name, level, summary) = (code.name(), code.default_level(), code.summary());
            let _ = writeln!(text, "| [{code} {name}](#{}) | {level} | {summary} |", anchor(*code));
        }
    }
    for code in Code::ALL {
        let (name, level, summary) = (code.name(), code.default_level(), code.summary());
        let _ = writeln!(text, "\n## {code} {name}\n\n*{level}: {summary}*\n\n{}", code.page().trim_end());
    }
    text
}

/// How GitHub and others name the heading of the code in a link.
fn anchor(code: Code) -> String {
    format!("{} {}", code.number(), code.name()).to_lowercase().replace(' ', "-")
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn the_page_in_docs_is_current() {
        let page = fs::read_to_string(place::workspace_root().join(PATH)).unwrap();
        assert!(page == document(), "{PATH} is not what the code says: run `cargo xtask docs`");
    }
}
