//! Names and levels of lints, in `lipz.toml` and on the command line.

use lipz_diagnostics::{Code, Severity, suggest::nearest};

/// The group of all lints that are warnings by default.
const WARNINGS: &str = "warnings";

/// Levels by name; "allow" drops the diagnostic.
pub const LEVELS: [(&str, Option<Severity>); 3] =
    [("allow", None), ("warn", Some(Severity::Warning)), ("deny", Some(Severity::Error))];

/// What people from other tools write for a level.
const OTHER_NAMES: [(&str, &str); 5] =
    [("warning", "warn"), ("error", "deny"), ("forbid", "deny"), ("off", "allow"), ("ignore", "allow")];

/// Lints that a project names together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Selection {
    /// One lint, by name or code.
    One(Code),
    /// `warnings`: those that are warnings by default.
    Warnings,
}

impl Selection {
    /// The lints that `text` names: `unknown-emotion`, `LZ0702`, `warnings`.
    ///
    /// ```
    /// use lipz_diagnostics::Code;
    /// use lipz_compiler::settings::lint::Selection;
    /// assert_eq!(Selection::named("LZ0702"), Some(Selection::One(Code::UnknownEmotion)));
    /// assert!(Selection::named("warnings").is_some_and(|all| all.codes().contains(&Code::UnknownEmotion)));
    /// ```
    pub fn named(text: &str) -> Option<Selection> {
        if text == WARNINGS {
            return Some(Selection::Warnings);
        }
        text.parse().ok().map(Selection::One)
    }

    /// The selected lints.
    pub fn codes(&self) -> Vec<Code> {
        match self {
            Selection::One(code) => vec![*code],
            Selection::Warnings => {
                let is_warning =
                    |code: &Code| code.default_severity() == Severity::Warning && !code.is_allowed_by_default();
                Code::ALL.iter().copied().filter(is_warning).collect()
            }
        }
    }
}

/// The name of the lint that somebody who wrote `text` probably meant.
pub fn suggestion(text: &str) -> Option<&'static str> {
    nearest(text, Code::ALL.iter().map(|code| code.name()).chain([WARNINGS]))
}

/// Why `code` cannot have this level; `None` if it can.
pub fn refusal(code: Code, level: Option<Severity>) -> Option<&'static str> {
    let is_lowered = level < Some(code.default_severity());
    (is_lowered && !code.can_be_lowered()).then_some(match code {
        Code::RefusedKey | Code::DuplicateKey | Code::IdCollision => {
            "a bank cannot store such keys: rename the files, or name a root above them"
        }
        Code::LowCoverage => "the project requires it: translate more, or lower the minimum",
        // The codes of banks, outputs and settings follow those of sources.
        _ if code > Code::NoSources => "it is about what lipz does, not about Lipz files",
        _ => "such a file has no certain meaning, and lipz does not guess: fix the file",
    })
}

/// The level with this name, or the one that was probably meant.
pub(super) fn level(text: &str) -> Result<Option<Severity>, Option<&'static str>> {
    match LEVELS.iter().find(|(name, _)| *name == text) {
        Some((_, level)) => Ok(*level),
        None => {
            let other = OTHER_NAMES.iter().find(|(name, _)| name.eq_ignore_ascii_case(text)).map(|(_, level)| *level);
            Err(other.or_else(|| nearest(text, LEVELS.map(|(name, _)| name))))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_fixed_and_warnings_are_not() {
        for level in [None, Some(Severity::Warning), Some(Severity::Error)] {
            assert_eq!(refusal(Code::UnknownEmotion, level), None);
            assert_eq!(refusal(Code::SegmentCount, level), None);
            assert_eq!(refusal(Code::ForeignCode, level).is_some(), level != Some(Severity::Error));
        }
    }

    #[test]
    fn levels_of_other_tools_are_understood() {
        assert_eq!(level("warn"), Ok(Some(Severity::Warning)));
        assert_eq!(level("Error"), Err(Some("deny")));
        assert_eq!(level("alow"), Err(Some("allow")));
        assert_eq!(level("fatal"), Err(None));
    }
}
