//! Characters that people write instead of codes and delimiters.

use super::tally::CharacterCount;
use lipz_bank::VisemeType;

/// Characters that are misread or typed for `|`: the published PDF has `l` and `I`, and keyboards have the rest.
pub(in crate::check) const DELIMITER_LOOKALIKES: [char; 5] = ['l', 'I', '¦', '│', '｜'];

/// The output of the format author's own tool for 9: the next character in ASCII. Other mistakes do not lead to it.
pub(super) const NINE_OF_THE_AUTHORS_TOOL: char = ':';

/// Returns the help for a character that is not a code of the type. It is one of `foreign`.
pub(super) fn instead(character: char, viseme_type: VisemeType, foreign: &[&CharacterCount]) -> Option<String> {
    let no_other_digits = || foreign.iter().all(|found| !matches!(found.character, '1'..='9'));
    let pdf = "files copied from the published specification have this damage";
    let upper = character.to_ascii_uppercase();
    Some(match character {
        'l' | 'I' => format!("write `|` instead of `{character}`; {pdf}"),
        _ if DELIMITER_LOOKALIKES.contains(&character) => format!("write `|` instead of `{character}`"),
        '0' if viseme_type == VisemeType::Blair && no_other_digits() => {
            format!("write `O` instead of `0`; {pdf}")
        }
        'O' if viseme_type == VisemeType::Rms => "write `0` instead of `O`".into(),
        NINE_OF_THE_AUTHORS_TOOL if viseme_type == VisemeType::Rms => {
            "write 9 instead of `:`, which the format author's own tool wrote".into()
        }
        '‐' | '‑' | '‒' | '–' | '—' | '−' | 'ー' | '_' | '.' | 'X' => {
            "write a hyphen, `-`, for rest".into()
        }
        _ if latin(character).is_some_and(|code| viseme_type.contains(code as u8)) => {
            let code = latin(character).unwrap_or_default();
            format!("replace it with `{code}`, which looks the same")
        }
        _ if upper != character && viseme_type.contains(upper as u8) => {
            format!("write `{upper}`; codes are upper case")
        }
        _ => return None,
    })
}

/// Returns the ASCII character that a letter of another script or width looks like.
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
        // Full-width characters have the order of ASCII.
        '！'..='～' => char::from_u32(u32::from(character) - (u32::from('！') - u32::from('!')))?,
        _ => return None,
    })
}
