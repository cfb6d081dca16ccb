//! docs/DIAGNOSTICS.md, made from the rules.

use super::rules::Rule;
use crate::Failure;
use std::fmt::Write;

pub(super) const PATH: &str = "docs/DIAGNOSTICS.md";

const INTRODUCTION: &str = r#"<!-- Written by `cargo xtask bless` from crates/lipz-diagnostics/rules: change it there. -->

# Diagnostics

Every diagnostic of lipz has a code. `lipz explain LZ0401` shows what this page says about it. Numbers are
never given a new meaning. While there are errors no bank is written; warnings do not prevent it.
"#;

const FOR_PROGRAMS: &str = r#"
## For programs

`--format json` prints one object: the numbers of `errors` and `warnings`, and `diagnostics`, sorted by
file and place. A diagnostic has

| field | is |
| --- | --- |
| `code`, `name` | `"LZ0401"`, `"foreign-code"` |
| `severity` | `"error"` or `"warning"` |
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
