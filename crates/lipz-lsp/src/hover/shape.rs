//! Mouth shapes, with their sounds and pictures.

use lipz_types::VisemeType;
use std::collections::HashMap;
use std::fmt::Write;
use std::sync::LazyLock;

/// An SVG of each shape, by type and code; `cargo xtask pictures` draws them.
static PICTURES: LazyLock<HashMap<String, HashMap<char, String>>> =
    LazyLock::new(|| serde_json::from_str(include_str!("../../pictures/shapes.json")).unwrap_or_default());

/// The sounds of each code, in the order of [`VisemeType::codes`].
fn sounds(kind: VisemeType) -> &'static [&'static str] {
    match kind {
        VisemeType::Blair => &[
            "rest",
            "A, I: “father”, “fly”",
            "M, B, P: “map”",
            "O: “go”",
            "most consonants: “see”",
            "W, Q: “we”, “queen”",
            "E: “bet”",
            "F, V: “five”",
            "L: “light”",
            "U: “blue”",
        ],
        VisemeType::ToonBoom => &[
            "rest",
            "M, B, P: “map”",
            "most consonants: “see”",
            "E: “bet”",
            "A, I: “father”, “fly”",
            "O: “go”",
            "W, Q: “we”, “queen”",
            "F, V: “five”",
        ],
        VisemeType::Rms => &[
            "rest",
            "closed",
            "minimally open",
            "louder",
            "louder",
            "louder",
            "louder",
            "louder",
            "“yell” open",
            "louder",
            "fully open",
        ],
    }
}

/// Returns the description of a code in Markdown, with its picture; `None` if the type does not have the code.
pub(super) fn about(kind: VisemeType, code: char, has_pictures: bool) -> Option<String> {
    let index = kind.codes().find(code)?;
    let said = format!("**{code}** of {}: {}", kind.name(), sounds(kind).get(index)?);
    let picture = PICTURES.get(kind.name()).and_then(|codes| codes.get(&code)).filter(|_| has_pictures);
    Some(match picture {
        Some(svg) => format!("![the mouth]({})\n\n{said}", data_uri(svg)),
        None => said,
    })
}

/// Returns a picture as a data URI (RFC 2397).
fn data_uri(svg: &str) -> String {
    let mut uri = "data:image/svg+xml,".to_owned();
    for byte in svg.bytes() {
        match byte {
            b'0'..=b'9' | b'a'..=b'z' | b'A'..=b'Z' | b'-' | b'.' | b'_' | b'~' => uri.push(char::from(byte)),
            _ => {
                let _ = write!(uri, "%{byte:02X}");
            }
        }
    }
    uri
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn every_code_is_explained_and_drawn() {
        for kind in VisemeType::ALL {
            assert_eq!(sounds(kind).len(), kind.codes().len());
            for code in kind.codes().chars() {
                let about = about(kind, code, true).unwrap();
                assert!(about.starts_with("![the mouth](data:image/svg+xml,%3Csvg%20"), "{about:.60}");
                let address = about.split(['(', ')']).nth(1).unwrap();
                assert!(!address.contains([' ', '<', '"']), "{code}: one address");
            }
            assert_eq!(about(kind, 'Z', true), None);
            assert!(about(kind, '-', false).unwrap().starts_with("**-**"));
        }
    }
}
