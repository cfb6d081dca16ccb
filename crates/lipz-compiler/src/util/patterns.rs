//! The patterns for files and keys in `lipz.toml`.

use glob::MatchOptions;

/// The rules of matching: `*` and `?` match no slash, `**` matches any folders, and letters are case-sensitive.
pub(crate) const MATCHING: MatchOptions =
    MatchOptions { case_sensitive: true, require_literal_separator: true, require_literal_leading_dot: false };
