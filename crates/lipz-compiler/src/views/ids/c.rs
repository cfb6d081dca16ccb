//! Ids as a C header.

use super::source_text::{NOTICE, quoted};
use super::tree::IdFolder;
use super::words::{ascii, upper_snake, words};
use lipz_bank::ClipId;
use std::fmt::Write;

/// The default prefix of names. `lipz.h` guarantees to use no such name.
pub(super) const DEFAULT_PREFIX: &str = "LIPZ_ID_";

/// The prefix of the constants in `lipz.h`.
const HEADER_PREFIX: &str = "LIPZ_";

/// The prefix of locales after the general prefix; also part of the include guard.
const LOCALE: &str = "LOCALE_";
const GUARD: &str = "IDS_H";

/// Returns `ACT1_MARA_HELLO` for `act1/mara-hello`: C has no folders.
pub(super) fn identifiers(key: &str) -> Vec<String> {
    let name = name(key);
    vec![if name.starts_with(LOCALE) || name == GUARD { format!("{name}_") } else { name }]
}

/// Whether a name with this prefix may be in `lipz.h`, now or later, or is reserved in C: these start with `_` and a
/// capital, or with two `_` (C99, 7.1.3). Keywords are in lower case, unlike names with any prefix.
pub(super) fn is_taken(prefix: &str) -> bool {
    let may_be_of_header = HEADER_PREFIX.starts_with(prefix) || prefix.starts_with(HEADER_PREFIX);
    may_be_of_header && !prefix.starts_with(DEFAULT_PREFIX) || prefix.starts_with('_')
}

fn name(text: &str) -> String {
    let words: Vec<String> = text.split('/').flat_map(words).map(|word| ascii(&word.to_uppercase())).collect();
    // The prefix is a valid start of an identifier.
    upper_snake(&words).trim_start_matches('_').to_owned()
}

/// Returns the file. It uses macros, which are constants everywhere, including `#if` and `case`.
pub(super) fn header(root: &IdFolder<'_>, locales: &[&str], prefix: &str) -> String {
    let guard = format!("{prefix}{GUARD}");
    let mut out = format!("/* {NOTICE} */\n#ifndef {guard}\n#define {guard}\n\n#include <stdint.h>\n\n");
    for (name, clip) in &root.clips {
        let (about, id) = (comment(&clip.about()), ClipId::from_u64(clip.id));
        let _ = write!(out, "/* {about} */\n#define {prefix}{name} UINT64_C(0x{id})\n");
    }
    out.push('\n');
    for locale in locales {
        let _ = writeln!(out, "#define {prefix}{LOCALE}{} {}", name(locale), quoted(locale));
    }
    let _ = write!(out, "\n#endif /* {guard} */\n");
    out
}

/// Returns the text without sequences that start or end a comment.
pub(super) fn comment(text: &str) -> String {
    text.replace("*/", "* /").replace("/*", "/ *")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prefixes_that_lead_to_names_of_others_are_taken() {
        for prefix in ["LIPZ_", "LIPZ", "L", "LIPZ_GAME_", "LIPZ_CLIP_", "_", "_GAME_", "__GAME_"] {
            assert!(is_taken(prefix), "{prefix}");
        }
        for prefix in [DEFAULT_PREFIX, "LIPZ_ID_GAME_", "GAME_LIPZ_", "lipz_", "CLIP_", "X"] {
            assert!(!is_taken(prefix), "{prefix}");
        }
    }

    #[test]
    fn keys_follow_c() {
        let name = |key| identifiers(key).join(" ");
        assert_eq!(name("act1/mara-good-evening"), "ACT1_MARA_GOOD_EVENING");
        assert_eq!(name("Ärger/1-はい"), "ARGER_1_U306FU3044");
        assert_eq!(name("1st/hello"), "1ST_HELLO");
        assert_eq!(name("locale/en-us"), "LOCALE_EN_US_");
        assert_eq!(name("ids/h"), "IDS_H_");
    }
}
