//! The levels that a project gives to lints, applied to findings.

use crate::Levels;
use lipz::{Code, Diagnostic};

/// Gives the findings the levels of the project and drops those that it allows. Errors that cannot be
/// lowered stay errors ([`Code::can_be_lowered`]).
pub fn apply(levels: &Levels, diagnostics: &mut Vec<Diagnostic>) {
    if levels.is_empty() {
        return;
    }
    diagnostics.retain_mut(|finding| match levels.get(&finding.code) {
        Some(&level) if level >= Some(finding.level) || finding.code.can_be_lowered() => {
            finding.level = level.unwrap_or(finding.level);
            level.is_some()
        }
        _ => true,
    });
}

/// Whether the project gives the rule a lower level than its own.
pub(crate) fn is_lowered(levels: &Levels, code: Code) -> bool {
    levels.get(&code).is_some_and(|&level| level < Some(code.default_level()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lipz::Level;

    #[test]
    fn findings_are_raised_lowered_and_dropped() {
        let levels = Levels::from([
            (Code::UnknownEmotion, Some(Level::Error)),
            (Code::SegmentCount, Some(Level::Warning)),
            (Code::ByteOrderMark, None),
            (Code::ForeignCode, None),
        ]);
        let mut findings: Vec<Diagnostic> =
            [Code::UnknownEmotion, Code::SegmentCount, Code::ByteOrderMark, Code::ForeignCode, Code::NulInText]
                .map(|code| Diagnostic::new(code, ""))
                .into();
        for _ in 0..2 {
            apply(&levels, &mut findings);
            let left: Vec<_> = findings.iter().map(|finding| (finding.code, finding.level)).collect();
            let expected = [
                (Code::UnknownEmotion, Level::Error),
                (Code::SegmentCount, Level::Warning),
                (Code::ForeignCode, Level::Error),
                (Code::NulInText, Level::Warning),
            ];
            assert_eq!(left, expected, "errors that are fixed stay; a second time changes nothing");
        }
    }
}
