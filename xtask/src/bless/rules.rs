//! The rules in `crates/lipz-diagnostics/rules`: one file each, from which the table of codes is generated.

use crate::Failure;
use std::fmt::Write;
use std::path::Path;

/// The folder of the rules.
pub(super) const FOLDER: &str = "crates/lipz-diagnostics/rules";

/// The table generated from them.
pub(super) const TABLE: &str = "crates/lipz-diagnostics/src/code/table.rs";

/// The headings above codes in lists, by the hundreds of their numbers.
const GROUPS: [&str; 24] = [
    "Reading files",
    "JSON",
    "Elements",
    "Frame rate and viseme type",
    "Viseme codes",
    "Locales and texts",
    "Segments",
    "Events",
    "Keys and sources",
    "Banks and outputs",
    "Settings",
    "Files of other tools",
    "Ids",
    "Subtitles",
    "Babble",
    "Fallout",
    "Command line",
    "Recordings",
    "Curves and emotions",
    "Translators' files",
    "Dubs",
    "Patches",
    "Shards",
    "Phones",
];

/// A rule: `# NUMBER name`, `severity: summary`, and the page, separated by empty lines.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Rule {
    pub(super) number: String,
    pub(super) name: String,
    pub(super) severity: String,
    pub(super) summary: String,
    pub(super) page: String,
}

impl Rule {
    /// Returns all rules, ordered by number.
    pub(super) fn all(folder: &Path) -> Result<Vec<Rule>, Failure> {
        let failed = |error: std::io::Error| format!("`{}`: {error}", folder.display());
        let mut rules = Vec::new();
        for entry in std::fs::read_dir(folder).map_err(failed)? {
            let path = entry.map_err(failed)?.path();
            let text = std::fs::read_to_string(&path).map_err(failed)?;
            let rule = Rule::parse(&text).filter(|rule| path.file_stem().is_some_and(|stem| *stem == *rule.number));
            let wrong = || format!("`{}` does not start with `# NUMBER name` and `severity: summary`", path.display());
            rules.push(rule.ok_or_else(wrong)?);
        }
        rules.sort_by(|a, b| a.number.cmp(&b.number));
        Ok(rules)
    }

    fn parse(text: &str) -> Option<Rule> {
        let mut paragraphs = text.splitn(3, "\n\n");
        let (number, name) = paragraphs.next()?.strip_prefix("# ")?.split_once(' ')?;
        let (severity, summary) = paragraphs.next()?.split_once(": ")?;
        let is_number =
            number.strip_prefix("LZ").is_some_and(|digits| digits.len() == 4 && digits.parse::<u16>().is_ok());
        let is_name = name.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit() || byte == b'-');
        let is_whole = is_number && is_name && ["error", "warning"].contains(&severity) && !summary.contains('\n');
        is_whole.then_some(Rule {
            number: number.to_owned(),
            name: name.to_owned(),
            severity: severity.to_owned(),
            summary: summary.to_owned(),
            page: paragraphs.next()?.to_owned(),
        })
    }

    /// Returns the heading above the rule in lists.
    pub(super) fn group(&self) -> Result<&'static str, Failure> {
        let hundred = self.number.get(2..4).and_then(|digits| digits.parse::<usize>().ok());
        let group = hundred.and_then(|hundred| GROUPS.get(hundred)).copied();
        group.ok_or_else(|| format!("{} has no group: add one to xtask/src/bless/rules.rs", self.number))
    }

    /// Returns the name of the variant: `ForeignCode` for `foreign-code`.
    fn variant(&self) -> String {
        let capital = |word: &str| word[..1].to_uppercase() + &word[1..];
        self.name.split('-').filter(|word| !word.is_empty()).map(capital).collect()
    }
}

/// Returns the table of codes, as Rust.
pub(super) fn table(rules: &[Rule]) -> Result<String, Failure> {
    let mut table =
        "//! The table of all rules, written by `cargo xtask bless` from the files in `rules/`: change it there.\n\n\
        use crate::Severity;\n\ncodes! {\n"
            .to_owned();
    let mut before = "";
    for rule in rules {
        let group = rule.group()?;
        if group != before {
            let gap = if before.is_empty() { "" } else { "\n" };
            let _ = writeln!(table, "{gap}    {group:?}");
            before = group;
        }
        let (variant, number, name, summary) = (rule.variant(), &rule.number, &rule.name, &rule.summary);
        let severity = if rule.severity == "error" { "Error" } else { "Warning" };
        let _ = writeln!(table, "    {variant} {number:?} {name:?} {severity} {summary:?}");
    }
    Ok(table + "}\n")
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn a_rule_is_read_from_its_file() {
        let rule = Rule::parse("# LZ0401 foreign-code\n\nerror: a \"code\"\n\n**What.** A\n\nB\n").unwrap();
        assert_eq!(rule.page, "**What.** A\n\nB\n");
        assert_eq!(rule.variant(), "ForeignCode");
        let table = table(&[rule]).unwrap();
        assert!(
            table.contains(
                "    \"Viseme codes\"\n    ForeignCode \"LZ0401\" \"foreign-code\" Error \"a \\\"code\\\"\"\n"
            )
        );
        for wrong in
            ["# LZ401 a\n\nerror: b\n\nc", "# LZ0401 a\n\nfatal: b\n\nc", "LZ0401 a\n\nerror: b\n\nc", "# LZ0401 a"]
        {
            assert_eq!(Rule::parse(wrong), None, "{wrong}");
        }
    }
}
