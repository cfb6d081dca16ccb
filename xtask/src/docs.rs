//! `cargo xtask docs`: writes docs/DIAGNOSTICS.md, whose contents are in the code.

use crate::{Failure, place};
use lipz::Code;
use std::fmt::Write;
use std::fs;

const PATH: &str = "docs/DIAGNOSTICS.md";

const INTRODUCTION: &str = r#"<!-- Written by `cargo xtask docs` from crates/lipz/src/diagnostic: change it there. -->

# Diagnostics

Every finding of lipz has a code. `lipz explain LZ0401` shows what this page says about it. Numbers are
never given a new meaning. While there are errors no bank is written; warnings do not prevent it.
"#;

const FOR_PROGRAMS: &str = r#"
## For programs

`--format json` prints one object: the numbers of `errors` and `warnings`, and `findings`, sorted by
file and place. A finding has

| field | is |
| --- | --- |
| `code`, `name` | `"LZ0401"`, `"foreign-code"` |
| `level` | `"error"` or `"warning"` |
| `message` | one sentence that is enough by itself |
| `path` | the file as it was named or found; empty if the finding is about none |
| `span` | the characters that it is about; `null` if it is about the whole file |
| `label` | a remark about them, or `null` |
| `labels` | other places that belong to it: `span` and `text` |
| `notes` | further facts, one line each |
| `help` | what to do, or `null` |
| `fix` | the change that does it, if one is certain: `span` and `replacement`; otherwise `null` |

A span goes from `start` to `end`, the place behind its last character. Both have `line` and `column`,
counted from 1 in characters (Unicode scalar values), and `offset_bytes` in the text, from 0. A byte
order mark is not part of the text.

`--format sarif` has the same findings with the property names of SARIF 2.1.0, and the pages below as
the help of its rules. `--format github` prints workflow commands of GitHub Actions.
"#;

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
    text.push_str(FOR_PROGRAMS);
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
