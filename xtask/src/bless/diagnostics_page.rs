//! docs/reference/diagnostics.md, made from the rules.

use super::rules::Rule;
use crate::Failure;
use std::fmt::Write;

pub(super) const PATH: &str = "docs/reference/diagnostics.md";

const INTRODUCTION: &str = r#"<!-- Written by `cargo xtask bless` from crates/lipz-diagnostics/rules: change it there. -->

# Diagnostics

Every diagnostic of lipz has a code, and every code has a rule that reports it. `lipz explain LZ0401` prints
the section of this page about a code. A code never gets a new meaning. lipz writes no bank while there are
errors; warnings do not prevent it.
"#;

const FOR_PROGRAMS: &str = r#"
## For programs

`--format json` prints one object: the numbers of `errors` and `warnings`, and `diagnostics`, sorted by
file and place. The fields of a diagnostic:

| field | contents |
| --- | --- |
| `code`, `name` | `"LZ0401"`, `"foreign-code"` |
| `severity` | `"error"` or `"warning"` |
| `message` | one sentence, complete by itself |
| `path` | the path of the file, as named or found; empty if the diagnostic is about no file |
| `span` | the characters it is about; `null` if it is about the whole file |
| `label` | a remark about the span, or `null` |
| `labels` | related places, each with `span` and `text` |
| `notes` | more facts, one line each |
| `help` | what to do, or `null` |
| `fix` | a safe fix, `span` and `replacement`, or `null` |

A span goes from `start` to `end`, the place after its last character. Each has a `line` and a `column`,
counted from 1 in characters (Unicode scalar values), and an `offset_bytes` into the text, counted from 0. A
byte order mark is not part of the text.

`--format sarif` prints the same diagnostics under the property names of SARIF 2.1.0, with the sections below
as the help of its rules. `--format github` prints workflow commands of GitHub Actions.

`--format gitlab` prints GitLab's Code Quality report; an error is `major`, a warning `minor`. A job keeps it with
`artifacts: reports: codequality: lipz.json`. `--format junit` prints a report with a test suite per file: errors are failed
tests, warnings are tests that passed and have output. `--format concise` prints a line per diagnostic, with `[fixable]` behind those
that `lipz check --fix` fixes; Vim reads them with `errorformat=%f:%l:%c:\ %m`.

`lipz check --statistics` prints how often each rule has reported, with `--json` as a list of objects with `code`, `name`,
`severity`, `count` and `fixable`.
"#;

/// The whole page: the codes by group, then what there is to know about each.
pub(super) fn page(rules: &[Rule]) -> Result<String, Failure> {
    let mut text = INTRODUCTION.to_owned();
    let mut before = "";
    for rule in rules {
        let group = rule.group()?;
        if group != before {
            let _ = writeln!(text, "\n**{group}**\n\n| code | severity | about |\n| --- | --- | --- |");
            before = group;
        }
        let Rule { number, name, severity, summary, .. } = rule;
        let _ = writeln!(text, "| [{number} {name}](#{}) | {severity} | {summary} |", anchor(rule));
    }
    text.push_str(FOR_PROGRAMS);
    for Rule { number, name, severity, summary, page } in rules {
        let _ = writeln!(text, "\n## {number} {name}\n\n*{severity}: {summary}*\n\n{}", page.trim_end());
    }
    Ok(text)
}

/// How GitHub and others name the heading of the rule in a link.
fn anchor(rule: &Rule) -> String {
    format!("{}-{}", rule.number.to_lowercase(), rule.name)
}
