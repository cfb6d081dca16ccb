//! What people write instead of codes and delimiters.

use super::tally::Counted;
use lipz_bank::VisemeType;

/// Characters that are read or typed for `|`: the published PDF has `l` and `I`, keyboards the others.
pub(in crate::check) const DELIMITER_LOOKALIKES: [char; 5] = ['l', 'I', '¦', '│', '｜'];

/// What the format author's own tool wrote for 9, the character behind it in ASCII. No other mistake
/// leads to it.
pub(super) const NINE_OF_THE_AUTHORS_TOOL: char = ':';

/// What the author probably meant by a character that is no code of the type; one of `foreign`.
pub(super) fn instead(character: char, viseme_type: VisemeType, foreign: &[&Counted]) -> Option<String> {
    let no_other_digits = || foreign.iter().all(|found| !matches!(found.character, '1'..='9'));
    let pdf = "files copied from the published specification have this damage";
    let upper = character.to_ascii_uppercase();
    Some(match character {
        'l' | 'I' => format!("this looks like `{character}` used for `|`: {pdf}"),
        _ if DELIMITER_LOOKALIKES.contains(&character) => format!("this looks like `{character}` used for `|`"),
        '0' if viseme_type == VisemeType::Blair && no_other_digits() => {
            format!("this looks like `0` used for `O`: {pdf}")
        }
        'O' if viseme_type == VisemeType::Rms => "this looks like `O` used for `0`".into(),
        NINE_OF_THE_AUTHORS_TOOL if viseme_type == VisemeType::Rms => {
            "the format author's own tool wrote `:` for 9".into()
        }
        '‐' | '‑' | '‒' | '–' | '—' | '−' | 'ー' | '_' | '.' | 'X' => "rest is the hyphen, `-`".into(),
        _ if latin(character).is_some_and(|code| viseme_type.contains(code as u8)) => {
            let code = latin(character).unwrap_or_default();
            format!("it only looks like the code `{code}`: write `{code}`")
        }
        _ if upper != character && viseme_type.contains(upper as u8) => format!("codes are upper case: `{upper}`"),
        _ => return None,
    })
}

/// The ASCII character that a letter of another script or width looks like.
fn latin(character: char) -> Option<char> {
    Some(match character {
        'А' | 'Α' => 'A',
        'В' | 'Β' => 'B',
        'С' | 'Ϲ' => 'C',
        'Е' | 'Ε' => 'E',
        'Ԍ' => 'G',
        'М' | 'Μ' => 'M',
        'О' | 'Ο' => 'O',
        'Ѕ' => 'S',
        'Ԝ' => 'W',
        // Full width: in the order of ASCII.
        '！'..='～' => char::from_u32(u32::from(character) - (u32::from('！') - u32::from('!')))?,
        _ => return None,
    })
}
