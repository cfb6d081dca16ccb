//! Baselines: known diagnostics that a project hides, so that only new ones are reported.

use crate::{Code, Diagnostic, Report, Severity, Span, escape};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// Known diagnostics, counted by file and rule. Unlike positions, these counts do not change with every edit of a file.
///
/// The text form has one line for each, `2 LZ0501 voices/mayor.lipz`. Lines that start with `#` are comments.
///
/// ```
/// use lipz_diagnostics::{Baseline, Code, Diagnostic, Report};
/// let found = || Report::about("a.lipz", Diagnostic::new(Code::UnknownElement, "`x_take`"));
/// let known = Baseline::from_reports(&[found()], |path| path.to_owned());
/// assert!(known.to_string().ends_with("\n1 LZ0203 a.lipz\n"));
///
/// let mut reports = vec![found(), Report::about("b.lipz", Diagnostic::new(Code::UnknownElement, "`x_mood`"))];
/// assert_eq!(known.pass_over(&mut reports, |path| path.to_owned()), 1);
/// assert!(reports[0].diagnostics.is_empty() && !reports[1].diagnostics.is_empty());
/// ```
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Baseline {
    entries: BTreeMap<(String, Code), BaselineCount>,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct BaselineCount {
    count: usize,
    /// The line, if the baseline was parsed from text.
    span: Span,
}

/// The first line of a baseline file.
const HEADING: &str = "# Diagnostics that `lipz check --baseline` hides: count, rule and file.\n";

impl Baseline {
    /// Parses a baseline, and reports invalid lines (LZ1606).
    pub fn parse(text: &str) -> (Baseline, Vec<Diagnostic>) {
        let mut baseline = Baseline::default();
        let mut diagnostics = Vec::new();
        let mut start = 0;
        for line in text.split_inclusive('\n') {
            let content = line.trim_end();
            let span = Span::new(start, start + content.len());
            start += line.len();
            if content.is_empty() || content.starts_with('#') {
                continue;
            }
            match entry(content) {
                Ok((count, code, path)) => {
                    baseline.entries.insert((path.to_owned(), code), BaselineCount { count, span });
                }
                Err(message) => {
                    let help = "write a count, a code and a path: `2 LZ0501 voices/mayor.lipz`";
                    diagnostics.push(Diagnostic::at(Code::BaselineEntry, span, message).help(help));
                }
            }
        }
        (baseline, diagnostics)
    }

    /// Returns all diagnostics of `reports` that may be hidden. `name` converts paths to the names of files in the
    /// baseline.
    pub fn from_reports(reports: &[Report], name: impl Fn(&str) -> String) -> Baseline {
        let mut entries: BTreeMap<(String, Code), BaselineCount> = BTreeMap::new();
        for report in reports {
            for found in report.diagnostics.iter().filter(|found| may_be_known(found)) {
                let none = BaselineCount { count: 0, span: Span::new(0, 0) };
                entries.entry((name(&report.source.path), found.code)).or_insert(none).count += found.count();
            }
        }
        Baseline { entries }
    }

    /// Adds the entries of `other` for the files that `is_kept` selects.
    pub fn keep(&mut self, other: &Baseline, is_kept: impl Fn(&str) -> bool) {
        for ((path, code), entry) in other.entries.iter().filter(|((path, _), _)| is_kept(path)) {
            self.entries.entry((path.clone(), *code)).or_insert(*entry);
        }
    }

    /// Removes known diagnostics from `reports`, and returns their number. If a rule reports more often in a file than
    /// before, all of its diagnostics stay, because the new ones cannot be identified.
    pub fn pass_over(&self, reports: &mut [Report], name: impl Fn(&str) -> String) -> usize {
        let found = Baseline::from_reports(reports, &name);
        let mut known = BTreeSet::new();
        for (place, entry) in &found.entries {
            if self.entries.get(place).is_some_and(|known| entry.count <= known.count) {
                known.insert(place);
            }
        }
        let mut passed = 0;
        for report in reports {
            let path = name(&report.source.path);
            report.diagnostics.retain(|found| {
                let is_known = may_be_known(found) && known.contains(&(path.clone(), found.code));
                passed += if is_known { found.count() } else { 0 };
                !is_known
            });
        }
        passed
    }

    /// Reports entries with higher counts than in `reports`, for the files that `is_checked` selects (LZ1606).
    pub fn left_over(
        &self,
        reports: &[Report],
        name: impl Fn(&str) -> String,
        is_checked: impl Fn(&str) -> bool,
    ) -> Vec<Diagnostic> {
        let found = Baseline::from_reports(reports, name);
        let left = |((path, code), entry): (&(String, Code), &BaselineCount)| {
            let count = found.entries.get(&(path.clone(), *code)).map_or(0, |found| found.count);
            if count >= entry.count || !is_checked(path) {
                return None;
            }
            let shown = escape::quoted(path);
            let message = match count {
                0 => format!("{shown} has no {code}, but the baseline lists it"),
                _ => format!("{shown} has {count} {code}, but the baseline lists {}", entry.count),
            };
            let help = "write the baseline again with `--write-baseline`";
            Some(Diagnostic::at(Code::BaselineEntry, entry.span, message).help(help))
        };
        let mut left: Vec<Diagnostic> = self.entries.iter().filter_map(left).collect();
        left.sort_by_key(Diagnostic::start);
        left
    }

    /// Returns the number of known diagnostics.
    pub fn count(&self) -> usize {
        self.entries.values().map(|entry| entry.count).sum()
    }
}

/// Prints the text that [`Baseline::parse`] parses.
impl fmt::Display for Baseline {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(HEADING)?;
        self.entries.iter().try_for_each(|((path, code), entry)| writeln!(f, "{} {code} {path}", entry.count))
    }
}

/// Returns the parts of a line, or why it is invalid.
fn entry(line: &str) -> Result<(usize, Code, &str), String> {
    let mut parts = line.splitn(3, ' ');
    let (Some(count), Some(code), Some(path)) = (parts.next(), parts.next(), parts.next()) else {
        return Err("a line of the baseline has fewer than three fields".to_owned());
    };
    let count = count.parse().map_err(|_| format!("{} is not a count", escape::quoted(count)))?;
    let code = code.parse().map_err(|_| format!("{} is not a rule", escape::quoted(code)))?;
    Ok((count, code, path))
}

/// Whether a diagnostic may be hidden. It may not if files were not found or not written, because a check of nothing
/// must not look successful.
fn may_be_known(found: &Diagnostic) -> bool {
    let is_about_files = ("LZ0800".."LZ1100").contains(&found.code.number());
    found.code != Code::BaselineEntry && !(is_about_files && found.severity == Severity::Error)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(path: &str, codes: &[Code]) -> Report {
        Report::all_about(path, codes.iter().map(|code| Diagnostic::new(*code, "")).collect())
    }

    fn same(path: &str) -> String {
        path.to_owned()
    }

    #[test]
    fn what_is_new_is_reported_and_what_is_gone_is_told() {
        let before = [
            report("a b.lipz", &[Code::UnknownElement, Code::UnknownElement, Code::SegmentCount]),
            report("c.lipz", &[Code::SegmentCount]),
            report("voices", &[Code::NoSources]),
        ];
        let written = Baseline::from_reports(&before, same).to_string();
        let (known, faults) = Baseline::parse(&written);
        assert_eq!((known.count(), known.to_string(), faults.len()), (4, written, 0));

        let mut now = before.to_vec();
        assert_eq!(known.pass_over(&mut now, same), 4);
        assert_eq!(now.iter().map(|report| report.diagnostics.len()).collect::<Vec<_>>(), [0, 0, 1], "no sources");

        let mut more = vec![report("a b.lipz", &[Code::UnknownElement; 3])];
        assert_eq!(known.pass_over(&mut more, same), 0, "one of three is new");
        let fewer = [report("a b.lipz", &[Code::UnknownElement])];
        let told: Vec<_> =
            known.left_over(&fewer, same, |path| path != "c.lipz").into_iter().map(|d| d.message).collect();
        assert_eq!(
            told,
            [
                "`a b.lipz` has 1 LZ0203, but the baseline lists 2",
                "`a b.lipz` has no LZ0601, but the baseline lists it"
            ]
        );
    }

    #[test]
    fn lines_that_are_no_entries_are_reported() {
        let (known, faults) = Baseline::parse("# mine\r\n\r\n1 LZ0601 a.lipz\r\nx LZ0601 a\n1 LZ9999 a\n1 LZ0601");
        assert_eq!(known.count(), 1);
        let messages: Vec<&str> = faults.iter().map(|fault| fault.message.as_str()).collect();
        assert_eq!(messages[..2], ["`x` is not a count", "`LZ9999` is not a rule"]);
        assert_eq!(messages.len(), 3);
    }

    #[test]
    fn what_was_not_checked_is_kept() {
        let (old, _) = Baseline::parse("1 LZ0601 a.lipz\n1 LZ0601 b.lipz\n");
        let mut new = Baseline::from_reports(&[report("a.lipz", &[Code::UnknownElement])], same);
        new.keep(&old, |path| path == "b.lipz");
        assert!(new.to_string().ends_with("\n1 LZ0203 a.lipz\n1 LZ0601 b.lipz\n"), "{new}");
    }
}
