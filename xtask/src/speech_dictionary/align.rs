//! Aligns the letters of words with their phones: each letter stands for none, one or two.
//!
//! The dictionary does not contain this alignment, so it is estimated: first the best path through each word with the
//! current probabilities, then new probabilities from the paths.

use super::source::{PHONES, Words};

/// The phones of a letter.
pub(super) type Sounds = Vec<u8>;

/// A word with the phones of each of its letters.
#[derive(Debug)]
pub(super) struct Aligned {
    pub(super) letters: Vec<u8>,
    pub(super) sounds: Vec<Sounds>,
}

/// The letters: `a` to `z`, and the apostrophe.
const LETTERS: usize = 27;
const SINGLE: usize = 1;
const PAIR: usize = SINGLE + PHONES.len();
const ALL: usize = PAIR + PHONES.len() * PHONES.len();
/// The number of estimation rounds. After six, no important path changes.
const ROUNDS: usize = 6;
/// If the letters explain the phones less well than this, per letter, the word is an abbreviation: `mrs`, `lbs`.
const WORST_MEAN: f64 = 0.012;

fn letter(byte: u8) -> usize {
    match byte {
        b'a'..=b'z' => usize::from(byte - b'a'),
        _ => LETTERS - 1,
    }
}

fn number(sounds: &[u8]) -> usize {
    match *sounds {
        [one] => SINGLE + usize::from(one),
        [one, two] => PAIR + usize::from(one) * PHONES.len() + usize::from(two),
        _ => 0,
    }
}

/// Aligns the words that letters can explain: those of letters and apostrophes only.
pub(super) fn align(words: &Words) -> Vec<Aligned> {
    let pairs: Vec<(&[u8], &[u8])> = words
        .iter()
        .filter(|(word, _)| !word.contains('.'))
        .flat_map(|(word, all)| all.iter().map(|phones| (word.as_bytes(), phones.as_slice())))
        .filter(|(word, phones)| phones.len() <= 2 * word.len())
        .collect();
    let mut chances = first_guess(&pairs);
    for _ in 0..ROUNDS {
        let mut counts = vec![[0.0; ALL]; LETTERS];
        for (word, phones) in &pairs {
            let Some((sounds, _)) = best_way(word, phones, &chances) else { continue };
            for (byte, sounds) in word.iter().zip(&sounds) {
                counts[letter(*byte)][number(sounds)] += 1.0;
            }
        }
        chances = normalised(counts);
    }
    let mut aligned = Vec::new();
    for (word, phones) in pairs {
        let Some((sounds, chance)) = best_way(word, phones, &chances) else { continue };
        let worst = (0..word.len()).fold(1.0, |chance, _| chance * WORST_MEAN);
        if chance >= worst {
            aligned.push(Aligned { letters: word.to_vec(), sounds });
        }
    }
    aligned
}

/// Pairs letters and phones at about the same position in their word.
fn first_guess(pairs: &[(&[u8], &[u8])]) -> Vec<[f64; ALL]> {
    let mut counts = vec![[0.0; ALL]; LETTERS];
    for (word, phones) in pairs {
        for (at, byte) in word.iter().enumerate() {
            for (place, phone) in phones.iter().enumerate() {
                let distance = (at * phones.len()).abs_diff(place * word.len());
                counts[letter(*byte)][SINGLE + usize::from(*phone)] +=
                    1.0 / f64::from(u32::try_from(1 + distance).unwrap_or(u32::MAX));
            }
        }
    }
    for counts in &mut counts {
        let sum: f64 = counts.iter().sum();
        counts[0] = sum * 0.2;
        for one in 0..PHONES.len() {
            for two in 0..PHONES.len() {
                let product = counts[SINGLE + one] * counts[SINGLE + two] / sum.max(1.0);
                counts[PAIR + one * PHONES.len() + two] = product * 0.02;
            }
        }
    }
    normalised(counts)
}

/// Converts counts to probabilities. None is zero, so that every word has a path.
fn normalised(mut counts: Vec<[f64; ALL]>) -> Vec<[f64; ALL]> {
    for counts in &mut counts {
        let sum: f64 = counts.iter().sum::<f64>() + 1.0;
        for count in counts.iter_mut() {
            *count = (*count + 1e-3) / sum;
        }
    }
    counts
}

/// Returns the most likely path through a word, and its probability. Products of 28 probabilities do not underflow in
/// an `f64`.
fn best_way(word: &[u8], phones: &[u8], chances: &[[f64; ALL]]) -> Option<(Vec<Sounds>, f64)> {
    let width = phones.len() + 1;
    let mut best = vec![0.0_f64; (word.len() + 1) * width];
    let mut taken = vec![0_usize; (word.len() + 1) * width];
    best[0] = 1.0;
    for (at, byte) in word.iter().enumerate() {
        for place in 0..width {
            let so_far = best[at * width + place];
            if so_far == 0.0 {
                continue;
            }
            for count in 0..=2.min(phones.len() - place) {
                let chance = so_far * chances[letter(*byte)][number(&phones[place..place + count])];
                let cell = (at + 1) * width + place + count;
                if chance > best[cell] {
                    best[cell] = chance;
                    taken[cell] = count;
                }
            }
        }
    }
    let chance = *best.last()?;
    if chance == 0.0 {
        return None;
    }
    let mut sounds = vec![Sounds::new(); word.len()];
    let mut place = phones.len();
    for at in (0..word.len()).rev() {
        let count = taken[(at + 1) * width + place];
        sounds[at] = phones[place - count..place].to_vec();
        place -= count;
    }
    Some((sounds, chance))
}
