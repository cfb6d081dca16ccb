//! Keys: the rules for paths of clips on every system, and clashes between keys.

mod clash;

#[cfg(feature = "unpack")]
pub(crate) use clash::clash;
pub use clash::{check, folded};

use lipz_diagnostics::escape;

/// The extension of Lipz files.
pub const EXTENSION: &str = "lipz";

/// The longest part of a key between slashes. File systems allow 255 bytes, including the extension.
const MAX_PART_BYTES: usize = 255 - ".lipz".len();
/// The longest key. Its length is stored in 16 bits.
const MAX_KEY_BYTES: usize = u16::MAX as usize;

/// Returns why `key` cannot be the path of a file on every system, below every folder; `None` if it can.
///
/// The rules are those of Windows file names (Microsoft, "Naming Files, Paths, and Namespaces"), which are the
/// strictest. In addition, no key may lead out of the folder.
///
/// ```
/// use lipz_compiler::key::refusal;
/// assert_eq!(refusal("act1/samson-hello"), None);
/// assert!(refusal("../passwd").is_some());
/// assert!(refusal("act1/con").is_some());
/// ```
pub fn refusal(key: &str) -> Option<String> {
    if is_plain(key) {
        return None;
    }
    if key.len() > MAX_KEY_BYTES {
        return Some(format!("it has {} bytes, more than {MAX_KEY_BYTES}", key.len()));
    }
    if let Some(bad) =
        key.chars().find(|&c| c.is_control() || matches!(c, '\\' | ':' | '<' | '>' | '"' | '|' | '?' | '*'))
    {
        return Some(format!("it contains {}, which Windows does not allow", escape::character(bad)));
    }
    match key {
        "" => return Some("it is empty".into()),
        _ if key.starts_with('/') => return Some("it is an absolute path".into()),
        _ if key.ends_with('/') => return Some("it ends with `/`".into()),
        _ => {}
    }
    let (folders, file) = key.rsplit_once('/').map_or((None, key), |(folders, file)| (Some(folders), file));
    let folders = folders.into_iter().flat_map(|folders| folders.split('/'));
    folders.map(|part| (part, true)).chain([(file, false)]).find_map(|(part, is_folder)| part_refusal(part, is_folder))
}

/// Whether a quick check shows that a key is valid: nearly every key consists of ASCII letters, digits, `-` and `_`.
fn is_plain(key: &str) -> bool {
    let is_plain = |byte: u8| byte.is_ascii_alphanumeric() | matches!(byte, b'-' | b'_' | b'/');
    // Devices have names of three and four such characters.
    let has_length =
        |part: &[u8]| matches!(part.len(), 1..=2 | 5..=MAX_PART_BYTES) || part.len() == 4 && part[3] > b'9';
    // The loop does not stop early, so that several bytes are examined at once.
    key.len() <= MAX_KEY_BYTES
        && key.bytes().fold(true, |are_plain, byte| are_plain & is_plain(byte))
        && key.as_bytes().split(|byte| *byte == b'/').all(has_length)
}

fn part_refusal(part: &str, is_folder: bool) -> Option<String> {
    let shown = || escape::text(part);
    let end = match part {
        "" => return Some("it contains `//`".into()),
        "." | ".." => return Some(format!("`{part}` leads to another folder")),
        _ if part.starts_with(' ') => Some("starts with a space"),
        _ if part.ends_with(' ') => Some("ends with a space"),
        _ if part.ends_with('.') => Some("ends with a dot"),
        _ => None,
    };
    if let Some(end) = end {
        return Some(format!("`{}` {end}, which Windows does not allow", shown()));
    }
    if part.len() > MAX_PART_BYTES {
        return Some(format!("`{}` has {} bytes, more than {MAX_PART_BYTES}", shown(), part.len()));
    }
    let stem = part.split('.').next().unwrap_or(part).trim_end();
    if is_device(stem) {
        return Some(format!("`{}` is a device name on Windows", shown()));
    }
    if is_folder && part.rsplit_once('.').is_some_and(|(_, extension)| extension.eq_ignore_ascii_case(EXTENSION)) {
        return Some(format!("the folder `{}` is named like a Lipz file", shown()));
    }
    None
}

/// Whether Windows has a device of this name.
fn is_device(stem: &str) -> bool {
    let is = |name: &str| stem.eq_ignore_ascii_case(name);
    match (stem.get(..3), stem.get(3..)) {
        (Some(_), Some("")) => ["CON", "PRN", "AUX", "NUL"].into_iter().any(is),
        (Some(port), Some("0" | "1" | "2" | "3" | "4" | "5" | "6" | "7" | "8" | "9" | "¹" | "²" | "³")) => {
            port.eq_ignore_ascii_case("COM") || port.eq_ignore_ascii_case("LPT")
        }
        _ => is("CONIN$") || is("CONOUT$"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_keys_are_refused_for_nothing_else() {
        let parts = [
            "con",
            "COM1",
            "com¹",
            "prn",
            "door",
            "a",
            "ab",
            "abc",
            "line-000001",
            "x.lipz",
            "",
            "9999",
            &"x".repeat(251),
        ];
        for one in parts {
            for other in parts {
                let key = format!("{one}/{other}");
                let part = part_refusal(one, true).or_else(|| part_refusal(other, false));
                assert!(!is_plain(&key) || part.is_none(), "{key}: {part:?}");
            }
        }
        assert!(["act01/scene03/line-000249", "door/a"].into_iter().all(is_plain));
    }

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
}
