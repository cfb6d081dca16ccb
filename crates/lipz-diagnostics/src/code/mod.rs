//! Every code, once. Number, name, level, summary and page of a rule are one file in `rules/`;
//! `table.rs` lists them, and `cargo xtask bless` writes it.

use crate::Severity;
use std::fmt;
use std::str::FromStr;

macro_rules! codes {
    ($($group:literal $($variant:ident $number:literal $name:literal $level:ident $summary:literal)+)+) => {
        /// A rule, by its stable code. Numbers are never given a new meaning.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        #[non_exhaustive]
        pub enum Code {
            $($(#[doc = concat!("`", $number, "` ", $name, ": ", $summary)] $variant,)+)+
        }

        impl Code {
            /// Every code in the order of the numbers.
            pub const ALL: &'static [Code] = &[$($(Code::$variant),+),+];

            /// The stable number, `LZ0401`.
            pub const fn number(self) -> &'static str {
                match self { $($(Code::$variant => $number,)+)+ }
            }

            /// The name for settings, `foreign-code`.
            pub const fn name(self) -> &'static str {
                match self { $($(Code::$variant => $name,)+)+ }
            }

            /// The severity unless a project sets another; rules that are
            /// [allowed by default](Code::is_allowed_by_default) have to be asked for.
            pub const fn default_severity(self) -> Severity {
                match self { $($(Code::$variant => Severity::$level,)+)+ }
            }

            /// What the rule is about, in one line.
            pub const fn summary(self) -> &'static str {
                match self { $($(Code::$variant => $summary,)+)+ }
            }

            /// The heading under which lists show the code.
            pub const fn group(self) -> &'static str {
                match self { $($(Code::$variant => $group,)+)+ }
            }

            /// The file of the rule.
            pub(super) const fn file(self) -> &'static str {
                match self { $($(Code::$variant => include_str!(concat!("../../rules/", $number, ".md")),)+)+ }
            }
        }
    };
}

mod table;

pub use table::Code;

impl Code {
    /// Whether a project may lower the level of the rule, in `lipz.toml` or on the command line. Every
    /// level may be raised.
    ///
    /// Most errors are fixed: the file or the bank has no meaning then. These say what they do instead:
    /// elements are joined to one segment ([`Code::SegmentCount`]), a text without a locale is kept for
    /// unpacking like an unknown element ([`Code::TextWithoutLocale`]), keys clash on other systems only
    /// ([`Code::KeyClash`]), and an empty folder adds no clips ([`Code::NoSources`]).
    pub const fn can_be_lowered(self) -> bool {
        matches!(self.default_severity(), Severity::Warning)
            || matches!(self, Code::SegmentCount | Code::TextWithoutLocale | Code::KeyClash | Code::NoSources)
    }

    /// Whether the rule reports only where a project gives it a level: it is about a matter of choice.
    pub const fn is_allowed_by_default(self) -> bool {
        matches!(self, Code::OtherEvents)
    }

    /// What a writer or localiser should know about the rule, in Markdown: what, why, example and fix.
    pub fn page(self) -> &'static str {
        // Heading and summary are the paragraphs before.
        self.file().splitn(3, "\n\n").nth(2).unwrap_or_default()
    }
}

/// The code with this number or name, whatever the case of the letters.
///
/// ```
/// use lipz_diagnostics::Code;
/// assert_eq!("lz0401".parse(), Ok(Code::ForeignCode));
/// assert_eq!("foreign-code".parse(), Ok(Code::ForeignCode));
/// assert!("LZ0400".parse::<Code>().is_err());
/// ```
impl FromStr for Code {
    type Err = UnknownCode;

    fn from_str(text: &str) -> Result<Code, UnknownCode> {
        let is = |known: &str| known.eq_ignore_ascii_case(text);
        Code::ALL.iter().copied().find(|code| is(code.number()) || is(code.name())).ok_or(UnknownCode(()))
    }
}

/// No rule has this number or name.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct UnknownCode(());

impl fmt::Display for UnknownCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("no rule has this number or name")
    }
}

impl std::error::Error for UnknownCode {}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.number())
    }
}

#[cfg(test)]
#[allow(clippy::panic, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn numbers_ascend_and_names_differ() {
        let numbers: Vec<_> = Code::ALL.iter().map(|code| code.number()).collect();
        assert!(numbers.is_sorted_by(|a, b| a < b), "{numbers:?}");
        let mut names: Vec<_> = Code::ALL.iter().map(|code| code.name()).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), Code::ALL.len());
    }

    #[test]
    fn groups_are_the_hundreds_of_the_numbers() {
        for pair in Code::ALL.windows(2) {
            let [a, b] = pair else { continue };
            let same_hundred = a.number()[..4] == b.number()[..4];
            assert_eq!(a.group() == b.group(), same_hundred, "{a} {} and {b} {}", a.group(), b.group());
        }
    }

    #[test]
    fn pages_have_their_four_parts() {
        for code in Code::ALL {
            let mut rest = code.page();
            assert!(rest.starts_with("**What.** "), "{code}");
            for part in ["**What.** ", "**Why.** ", "**Example.**", "**Fix.** "] {
                let at = rest.find(part).unwrap_or_else(|| panic!("{code}: {part} is missing or out of order"));
                rest = &rest[at..];
            }
        }
    }
}
