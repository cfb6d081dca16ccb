//! Names and levels of lints, in `lipz.toml` and on the command line.

use lipz_diagnostics::{Code, Severity, suggest::nearest};

/// The group of all lints that are warnings by default.
const WARNINGS: &str = "warnings";

/// Levels by name. "allow" drops the diagnostic.
pub const LEVELS: [(&str, Option<Severity>); 3] =
    [("allow", None), ("warn", Some(Severity::Warning)), ("deny", Some(Severity::Error))];

/// Names of levels in other tools.
const OTHER_NAMES: [(&str, &str); 5] =
    [("warning", "warn"), ("error", "deny"), ("forbid", "deny"), ("off", "allow"), ("ignore", "allow")];

/// A selection of lints.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Selection {
    /// One lint, by name or code.
    One(Code),
    /// `warnings`: lints that are warnings by default.
    Warnings,
}

impl Selection {
    /// Returns the lints that `text` names: `unknown-emotion`, `LZ0702`, `warnings`.
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

    /// Returns the selected lints.
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

/// Returns the name of the lint that `text` was probably meant to be.
pub fn suggestion(text: &str) -> Option<&'static str> {
    nearest(text, Code::ALL.iter().map(|code| code.name()).chain([WARNINGS]))
}

/// Returns the reason why `code` cannot have this level; `None` if it can.
pub fn refusal(code: Code, level: Option<Severity>) -> Option<&'static str> {
    let is_lowered = level < Some(code.default_severity());
    (is_lowered && !code.can_be_lowered()).then_some(match code {
        Code::RefusedKey | Code::DuplicateKey | Code::IdCollision => {
            "rename the files, or name a root above them; a bank cannot store such keys"
        }
        Code::LowCoverage => "translate more, or lower the minimum that the project requires",
        // The codes of banks, outputs and settings come after those of sources.
        _ if code > Code::NoSources => "remove the line; the error is about the work of lipz, not about Lipz files",
        _ => "fix the file; its meaning is ambiguous",
    })
}

/// Returns the level with this name, or as an error the level that was probably meant.
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
