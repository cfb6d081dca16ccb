//! The levels that a project gives to rules, and diagnostics at these levels.

use crate::{Code, Diagnostic, Severity};
use std::collections::BTreeMap;

/// The levels that a project gives to rules: `None` allows what the rule reports.
pub type Levels = BTreeMap<Code, Option<Severity>>;

/// Gives the findings the levels of the project and drops those that it allows. Errors that cannot be
/// lowered stay errors ([`Code::can_be_lowered`]).
pub fn adjust(levels: &Levels, diagnostics: &mut Vec<Diagnostic>) {
    if levels.is_empty() {
        return;
    }
    diagnostics.retain_mut(|finding| match levels.get(&finding.code) {
        Some(&level) if level >= Some(finding.severity) || finding.code.can_be_lowered() => {
            finding.severity = level.unwrap_or(finding.severity);
            level.is_some()
        }
        _ => true,
    });
}

/// Whether the project gives the rule a lower level than its own.
pub fn is_lowered(levels: &Levels, code: Code) -> bool {
    levels.get(&code).is_some_and(|&level| level < Some(code.default_severity()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn findings_are_raised_lowered_and_dropped() {
        let levels = Levels::from([
            (Code::UnknownEmotion, Some(Severity::Error)),
            (Code::SegmentCount, Some(Severity::Warning)),
            (Code::ByteOrderMark, None),
            (Code::ForeignCode, None),
        ]);
        let mut findings: Vec<Diagnostic> =
            [Code::UnknownEmotion, Code::SegmentCount, Code::ByteOrderMark, Code::ForeignCode, Code::NulInText]
                .map(|code| Diagnostic::new(code, ""))
                .into();
        for _ in 0..2 {
            adjust(&levels, &mut findings);
            let left: Vec<_> = findings.iter().map(|finding| (finding.code, finding.severity)).collect();
            let expected = [
                (Code::UnknownEmotion, Severity::Error),
                (Code::SegmentCount, Severity::Warning),
                (Code::ForeignCode, Severity::Error),
                (Code::NulInText, Severity::Warning),
            ];
            assert_eq!(left, expected, "errors that are fixed stay; a second time changes nothing");
        }
    }
}
