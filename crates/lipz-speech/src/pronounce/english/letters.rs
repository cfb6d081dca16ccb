//! Letter-to-sound rules for English words that are in no dictionary: a decision tree, learnt from the dictionary.
//!
//! `data/english/letters.bin`: `LZLS`; the number of sounds, and two bytes for each: its phones, or 255 for none; for
//! `'` and `a` to `z` the offset of their node, in three bytes; then nodes. A node has its sound, the neighbour that it
//! tests (an index of `NEIGHBOURS`), the number of answers, and the answers. An answer is a letter and the offset of
//! the next node, or a letter plus 128 and its sound. `cargo xtask speech-dictionary` writes the file.

use crate::Phone;

static TREE: &[u8] = include_bytes!("../../../data/english/letters.bin");

/// The relative positions of the neighbours that a node may test.
const NEIGHBOURS: [isize; 10] = [1, -1, 2, -2, 3, -3, 4, -4, 5, -5];
/// The letter outside a word.
const OUTSIDE: u8 = b'#';
/// The offset of the table of sounds, after the name of the format and their number.
const SOUNDS: usize = 5;

/// Returns the phones of a word of `a` to `z` and `'`. Other characters are silent.
pub(crate) fn phones(word: &str) -> Vec<Phone> {
    let letters = word.as_bytes();
    let mut phones = Vec::with_capacity(letters.len());
    for at in 0..letters.len() {
        let Some(sound) = sound(letters, at) else { continue };
        let place = SOUNDS + 2 * usize::from(sound);
        let sounds = TREE.get(place..place + 2).unwrap_or_default();
        phones.extend(sounds.iter().filter_map(|number| Phone::ALL.get(usize::from(*number))));
    }
    phones
}

/// Returns the number of the sound of one letter.
fn sound(word: &[u8], at: usize) -> Option<u8> {
    let root = match word.get(at)? {
        b'\'' => 0,
        letter @ b'a'..=b'z' => 1 + usize::from(letter - b'a'),
        _ => return None,
    };
    let roots = SOUNDS + 2 * usize::from(*TREE.get(4)?);
    let mut node = place(roots + 3 * root)?;
    // Each step tests a different neighbour.
    for _ in 0..=NEIGHBOURS.len() {
        let &[sound, neighbour, count] = TREE.get(node..node + 3)? else { return None };
        let Some(answer) = answer(word, at, usize::from(neighbour)) else { return Some(sound) };
        let mut entry = node + 3;
        let mut next = None;
        for _ in 0..count {
            let letter = *TREE.get(entry)?;
            if letter & 0x7f == answer {
                match letter & 0x80 {
                    0 => next = place(entry + 1),
                    _ => return TREE.get(entry + 1).copied(),
                }
                break;
            }
            entry += if letter & 0x80 == 0 { 4 } else { 2 };
        }
        match next {
            Some(next) => node = next,
            None => return Some(sound),
        }
    }
    None
}

fn answer(word: &[u8], at: usize, neighbour: usize) -> Option<u8> {
    let place = at.checked_add_signed(*NEIGHBOURS.get(neighbour)?);
    Some(place.and_then(|place| word.get(place)).copied().unwrap_or(OUTSIDE))
}

/// Reads an offset in the tree, which has three bytes.
fn place(at: usize) -> Option<usize> {
    let &[one, two, three] = TREE.get(at..at + 3)? else { return None };
    Some(usize::from(one) | usize::from(two) << 8 | usize::from(three) << 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(word: &str) -> String {
        phones(word).iter().map(|phone| phone.name()).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn letters_sound_as_their_neighbours_say() {
        let cases = [
            ("", ""),
            ("blick", "B L IH K"),
            ("shaft", "SH AE F T"),
            ("phone", "F OW N"),
            ("knight", "N AY T"),
            ("quest", "K W EH S T"),
            ("fame", "F EY M"),
            ("boots", "B UW T S"),
            ("ümlaut?", "M L AO T"),
        ];
        for (word, expected) in cases {
            assert_eq!(said(word), expected, "{word}");
        }
    }

    #[test]
    fn a_word_of_any_length_has_an_end() {
        assert!(phones(&"z".repeat(100_000)).len() <= 200_000);
    }
}
