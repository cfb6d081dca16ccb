//! The levels of rules in a project, and their effect on diagnostics.

use crate::{Code, Diagnostic, Severity};
use std::collections::{BTreeMap, btree_map};

/// The levels of rules in a project. All other rules have their default level.
///
/// Rules that are allowed by default ([`Code::is_allowed_by_default`]) report nothing unless their level is set.
///
/// A level is a severity, or `None` to allow the reported problems. Errors that cannot be lowered
/// ([`Code::can_be_lowered`]) stay errors at any level.
///
/// ```
/// use lipz_diagnostics::{Code, Diagnostic, Levels, Severity};
/// let levels = Levels::from([(Code::UnknownEmotion, Some(Severity::Error)), (Code::ByteOrderMark, None)]);
/// assert_eq!(levels.severity(Code::UnknownEmotion), Some(Severity::Error));
///
/// let mut diagnostics = vec![
///     Diagnostic::new(Code::UnknownEmotion, "`smug` is not an emotion"),
///     Diagnostic::new(Code::ByteOrderMark, "the file starts with a byte order mark"),
/// ];
/// levels.apply(&mut diagnostics);
/// assert_eq!(diagnostics.len(), 1);
/// assert!(diagnostics[0].is_error());
/// ```
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Levels(BTreeMap<Code, Option<Severity>>);

impl Levels {
    /// Returns the default levels of all rules.
    pub fn new() -> Levels {
        Levels::default()
    }

    /// Sets the level of a rule; `None` allows the reported problems. The last level counts.
    pub fn set(&mut self, code: Code, level: Option<Severity>) {
        self.0.insert(code, level);
    }

    /// Returns the severity of the rule in this project; `None` if its problems are allowed.
    pub fn severity(&self, code: Code) -> Option<Severity> {
        self.at(code, code.default_severity())
    }

    /// Whether the rule reports with a severity below its default, or not at all.
    pub fn lowers(&self, code: Code) -> bool {
        self.severity(code) < Some(code.default_severity())
    }

    /// Sets the severities of the diagnostics in this project, and removes allowed ones.
    pub fn apply(&self, diagnostics: &mut Vec<Diagnostic>) {
        diagnostics.retain_mut(|diagnostic| {
            let severity = self.at(diagnostic.code, diagnostic.severity);
            diagnostic.severity = severity.unwrap_or(diagnostic.severity);
            severity.is_some()
        });
    }

    /// Returns the severity after applying the level.
    fn at(&self, code: Code, severity: Severity) -> Option<Severity> {
        match self.0.get(&code) {
            None if code.is_allowed_by_default() => None,
            Some(&level) if level >= Some(severity) || code.can_be_lowered() => level,
            _ => Some(severity),
        }
    }
}

impl Extend<(Code, Option<Severity>)> for Levels {
    fn extend<I: IntoIterator<Item = (Code, Option<Severity>)>>(&mut self, levels: I) {
        self.0.extend(levels);
    }
}

impl FromIterator<(Code, Option<Severity>)> for Levels {
    fn from_iter<I: IntoIterator<Item = (Code, Option<Severity>)>>(levels: I) -> Levels {
        Levels(levels.into_iter().collect())
    }
}

impl<const N: usize> From<[(Code, Option<Severity>); N]> for Levels {
    fn from(levels: [(Code, Option<Severity>); N]) -> Levels {
        levels.into_iter().collect()
    }
}

/// Returns the levels that were set, ordered by code.
impl IntoIterator for Levels {
    type Item = (Code, Option<Severity>);
    type IntoIter = btree_map::IntoIter<Code, Option<Severity>>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn diagnostics_are_raised_lowered_and_dropped() {
        let levels = Levels::from([
            (Code::UnknownEmotion, Some(Severity::Error)),
            (Code::SegmentCount, Some(Severity::Warning)),
            (Code::ByteOrderMark, None),
            (Code::ForeignCode, None),
        ]);
        let mut diagnostics: Vec<Diagnostic> =
            [Code::UnknownEmotion, Code::SegmentCount, Code::ByteOrderMark, Code::ForeignCode, Code::NulInText]
                .map(|code| Diagnostic::new(code, ""))
                .into();
        for _ in 0..2 {
            levels.apply(&mut diagnostics);
            let left: Vec<_> = diagnostics.iter().map(|diagnostic| (diagnostic.code, diagnostic.severity)).collect();
            let expected = [
                (Code::UnknownEmotion, Severity::Error),
                (Code::SegmentCount, Severity::Warning),
                (Code::ForeignCode, Severity::Error),
                (Code::NulInText, Severity::Warning),
            ];
            assert_eq!(left, expected, "errors that are fixed stay; a second time changes nothing");
        }
        assert_eq!(levels.severity(Code::ByteOrderMark), None);
        assert_eq!(levels.severity(Code::ForeignCode), Some(Severity::Error));
        let lowered: Vec<Code> = Code::ALL.iter().copied().filter(|code| levels.lowers(*code)).collect();
        assert_eq!(lowered, [Code::ByteOrderMark, Code::SegmentCount, Code::OtherEvents, Code::EndPunctuation]);
    }

    #[test]
    fn what_is_allowed_by_default_has_to_be_asked_for() {
        let mut diagnostics = vec![Diagnostic::new(Code::OtherEvents, "")];
        Levels::from([(Code::OtherEvents, Some(Severity::Warning))]).apply(&mut diagnostics);
        assert_eq!(diagnostics.len(), 1);
        Levels::new().apply(&mut diagnostics);
        assert_eq!(diagnostics.len(), 0);
    }

    #[test]
    fn the_last_level_counts() {
        let mut levels = Levels::new();
        levels.set(Code::UnknownEmotion, None);
        levels.extend([(Code::UnknownEmotion, Some(Severity::Error))]);
        assert_eq!(levels.into_iter().collect::<Vec<_>>(), [(Code::UnknownEmotion, Some(Severity::Error))]);
    }
}
