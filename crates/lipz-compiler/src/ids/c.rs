//! Ids as a C header.

use super::tree::Folder;
use super::words::{ascii, upper_snake, words};
use super::{NOTICE, quoted};
use lipz_bank::ClipId;
use std::fmt::Write;

/// What the names of locales start with, behind the prefix; and the include guard.
const LOCALE: &str = "LOCALE_";
const GUARD: &str = "IDS_H";

/// `act1/mara-hello` is `ACT1_MARA_HELLO`: C has no folders.
pub(super) fn identifiers(key: &str) -> Vec<String> {
    let name = name(key);
    vec![if name.starts_with(LOCALE) || name == GUARD { format!("{name}_") } else { name }]
}

fn name(text: &str) -> String {
    let words: Vec<String> = text.split('/').flat_map(words).map(|word| ascii(&word.to_uppercase())).collect();
    // The prefix is a start that identifiers can have.
    upper_snake(&words).trim_start_matches('_').to_owned()
}

/// The file. Macros, so that they are constants everywhere, also in `#if` and `case`.
pub(super) fn header(root: &Folder<'_>, locales: &[&str], prefix: &str) -> String {
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

/// The text without what starts or ends a comment.
pub(super) fn comment(text: &str) -> String {
    text.replace("*/", "* /").replace("/*", "/ *")
}

#[cfg(test)]
mod tests {
    use super::*;

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
