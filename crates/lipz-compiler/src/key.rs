//! Keys: which paths can be clips everywhere, and which of them clash.

use crate::{Input, Report};
use icu_casemap::CaseMapper;
use lipz::{Code, Diagnostic};
use std::collections::HashMap;
use unicode_normalization::UnicodeNormalization;

/// Extension of Lipz files.
pub const EXTENSION: &str = "lipz";

/// Longest part of a key between slashes: file systems allow 255 bytes, with the extension.
const MAX_PART_BYTES: usize = 255 - ".lipz".len();
/// Longest key: its length is stored in 16 bits.
const MAX_KEY_BYTES: usize = u16::MAX as usize;

/// Why `key` cannot be the path of a file on every system, below every folder; `None` if it can.
///
/// The rules are those of Windows file names (Microsoft, "Naming Files, Paths, and Namespaces"),
/// which are the strictest, and that nothing leads out of the folder.
///
/// ```
/// use lipz_compiler::key::refusal;
/// assert_eq!(refusal("act1/samson-hello"), None);
/// assert!(refusal("../passwd").is_some());
/// assert!(refusal("act1/con").is_some());
/// ```
pub fn refusal(key: &str) -> Option<String> {
    if key.len() > MAX_KEY_BYTES {
        return Some(format!("it has {} bytes, more than {MAX_KEY_BYTES}", key.len()));
    }
    if let Some(bad) = key.chars().find(|&c| c.is_control() || "\\:<>\"|?*".contains(c)) {
        return Some(format!("it contains `{}`", bad.escape_default()));
    }
    let parts: Vec<&str> = key.split('/').collect();
    let folders = parts.len() - 1;
    parts.iter().enumerate().find_map(|(index, part)| part_refusal(part, index < folders))
}

fn part_refusal(part: &str, is_folder: bool) -> Option<String> {
    match part {
        "" => return Some("a part of it is empty: it starts or ends with `/`, or contains `//`".into()),
        "." | ".." => return Some(format!("`{part}` leads to another folder")),
        _ => {}
    }
    if part.ends_with(['.', ' ']) || part.starts_with(' ') {
        return Some(format!("`{part}` starts or ends with a blank, or ends with a dot"));
    }
    if part.len() > MAX_PART_BYTES {
        return Some(format!("`{part}` has {} bytes, more than {MAX_PART_BYTES}", part.len()));
    }
    let stem = part.split('.').next().unwrap_or(part).trim_end().to_uppercase();
    let is_device = match stem.as_str() {
        "CON" | "PRN" | "AUX" | "NUL" | "CONIN$" | "CONOUT$" => true,
        _ => stem.strip_prefix("COM").or_else(|| stem.strip_prefix("LPT")).is_some_and(|digit| {
            matches!(digit, "0" | "1" | "2" | "3" | "4" | "5" | "6" | "7" | "8" | "9" | "¹" | "²" | "³")
        }),
    };
    if is_device {
        return Some(format!("`{part}` is the name of a device on Windows"));
    }
    if is_folder && part.to_ascii_lowercase().ends_with(".lipz") {
        return Some(format!("the folder `{part}` is named like a Lipz file"));
    }
    None
}

/// The key as a file system sees it that ignores case and Unicode normalisation: equal for keys
/// that are one file there (Unicode Standard, section 3.13, canonical caseless matching).
pub fn folded(key: &str) -> String {
    if key.is_ascii() {
        return key.to_ascii_lowercase();
    }
    let decomposed: String = key.nfd().collect();
    CaseMapper::new().fold_string(&decomposed).nfd().collect()
}

/// Reports refused keys, keys that appear twice, and keys that are one file on some systems.
pub(crate) fn check(inputs: &[Input], reports: &mut Vec<Report>) {
    let mut seen: HashMap<String, &Input> = HashMap::with_capacity(inputs.len());
    for input in inputs {
        let key = &input.key;
        if let Some(why) = refusal(key) {
            reports.push(Report::failure(
                &input.name,
                Code::RefusedKey,
                format!("the key `{}` cannot be used: {why}", key.escape_debug()),
                "rename the file or folder: keys become file names on other systems when a bank is unpacked",
            ));
            continue;
        }
        let Some(before) = seen.insert(folded(key), input) else { continue };
        let finding = if before.key == *key {
            Diagnostic::new(Code::DuplicateKey, format!("the key `{key}` appears twice"))
                .note(format!("the other file is {}", before.name))
                .help("pack one of the two, or give the sources a common root with --root")
        } else {
            Diagnostic::new(
                Code::KeyClash,
                format!("the keys `{}` and `{key}` are one file on some systems", before.key),
            )
            .note(format!("the other file is {}", before.name))
            .note("Windows and macOS ignore case, macOS ignores Unicode normalisation")
            .help("rename one of the two")
        };
        reports.push(Report::about(&input.name, finding));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_that_lead_out_or_name_devices_are_refused() {
        let refused = [
            "",
            "/",
            "/etc/passwd",
            "..",
            "../x",
            "a/../b",
            "a/..",
            "./a",
            "a//b",
            "a/",
            "a\\b",
            "c:x",
            "a\0b",
            "a\nb",
            "con",
            "CON",
            "act/NUL.take",
            "com1",
            "lpt¹",
            "aux .x",
            "a.",
            "a ",
            " a",
            "a|b",
            "what?",
            "x.lipz/a",
            "conout$",
        ];
        for key in refused {
            assert!(refusal(key).is_some(), "{key:?}");
        }
        let long = "x".repeat(251);
        assert!(refusal(&long).is_some());
        for key in ["a", "act1/samson-hello", "Ärger/être/日本", "console", "com", "com10", "a.b", "...a", "a b"] {
            assert_eq!(refusal(key), None, "{key:?}");
        }
    }

    #[test]
    fn folding_finds_what_file_systems_equate() {
        assert_eq!(folded("Act1/HELLO"), folded("act1/hello"));
        assert_eq!(folded("\u{e9}t\u{e9}"), folded("E\u{301}TE\u{301}"));
        assert_eq!(folded("STRASSE/é"), folded("straße/É"));
        assert_ne!(folded("a"), folded("b"));
    }
}
