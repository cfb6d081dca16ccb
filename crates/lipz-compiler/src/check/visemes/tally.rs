//! The distinct characters of a viseme string.

use lipz_bank::VisemeType;
use lipz_file::text::{DELIMITER, is_white_space};

/// The maximum number of distinct characters to count. A string with more is not a viseme string.
const COUNTED: usize = 64;

/// A character of a viseme string.
pub(super) struct CharacterCount {
    pub(super) character: char,
    pub(super) first_at: usize,
    pub(super) count: usize,
}

/// The distinct characters of a viseme string, without delimiters and white space.
pub(super) struct Tally(Vec<CharacterCount>);

impl Tally {
    pub(super) fn new(text: &str) -> Tally {
        let mut found: Vec<CharacterCount> = Vec::new();
        for (at, character) in text.char_indices() {
            if character == DELIMITER || is_white_space(character) {
                continue;
            }
            let has_room = found.len() < COUNTED;
            match found.iter_mut().find(|counted| counted.character == character) {
                Some(counted) => counted.count += 1,
                None if has_room => found.push(CharacterCount { character, first_at: at, count: 1 }),
                None => {}
            }
        }
        Tally(found)
    }

    /// Returns the characters that are not codes of the type.
    pub(super) fn foreign_to(&self, viseme_type: VisemeType) -> impl Iterator<Item = &CharacterCount> {
        self.0.iter().filter(move |counted| !contains(viseme_type, counted.character))
    }

    /// Returns the types that have codes for all characters.
    pub(super) fn fitting(&self) -> impl Iterator<Item = VisemeType> {
        VisemeType::ALL.into_iter().filter(|known| self.foreign_to(*known).next().is_none())
    }

    /// Returns the type with the fewest foreign codes.
    pub(super) fn nearest(&self) -> VisemeType {
        let foreign_count = |known: &VisemeType| self.foreign_to(*known).map(|foreign| foreign.count).sum::<usize>();
        VisemeType::ALL.into_iter().min_by_key(foreign_count).unwrap_or(VisemeType::Blair)
    }

    /// Whether the codes belong to the type but are all in lower case. A single `l` is more likely a damaged `|`.
    pub(super) fn is_lower_case_of(&self, viseme_type: VisemeType) -> bool {
        self.0.iter().any(|counted| counted.character.is_ascii_lowercase() && counted.character != 'l')
            && self.0.iter().all(|counted| {
                let upper = counted.character.to_ascii_uppercase();
                !counted.character.is_ascii_uppercase() && contains(viseme_type, upper)
            })
    }
}

/// Whether the character is a code of the type.
pub(super) fn contains(viseme_type: VisemeType, character: char) -> bool {
    u8::try_from(character).is_ok_and(|code| viseme_type.contains(code))
}
