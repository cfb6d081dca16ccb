//! Korean: hangul, letter by letter, with the sound changes between neighbours.

use super::{Origin, Pronunciation};
use crate::Phone::{self, *};
use unicode_normalization::UnicodeNormalization;

/// The first of the 11,172 syllables, which are sorted by their letters.
const FIRST: u32 = 0xac00;
const VOWELS: u32 = 21;
const FINALS: u32 = 28;

/// The indices of the initial consonants.
const G: u32 = 0;
const N_: u32 = 2;
const D_: u32 = 3;
const R_: u32 = 5;
const M_: u32 = 6;
const B_: u32 = 7;
const S_: u32 = 9;
const NONE: u32 = 11;
const J_: u32 = 12;
const CH_: u32 = 14;
const K_: u32 = 15;
const T_: u32 = 16;
const P_: u32 = 17;
const H_: u32 = 18;
/// The vowel *i*.
const I: u32 = 20;

/// A syllable: initial consonant, vowel, and final consonants with the numbers of initial ones.
#[derive(Clone, Copy)]
struct Syllable {
    initial: u32,
    vowel: u32,
    /// The final consonant that is pronounced.
    last: Option<u32>,
    /// The final consonant before a vowel, and the initial consonant that moves to the next syllable.
    before_vowel: (Option<u32>, u32),
}

/// Returns the pronunciation of a word in hangul.
pub(super) fn pronounce(word: &str) -> Vec<Pronunciation> {
    let syllables: Vec<Syllable> = word.nfc().filter_map(syllable).collect();
    let syllables = joined(syllables);
    let mut phones: Vec<Phone> = Vec::new();
    for (at, syllable) in syllables.iter().enumerate() {
        let voiced = at > 0 && phones.last().is_some_and(|last| last.is_vowel() || matches!(last, N | M | Ng | L | R));
        let doubled = phones.last() == Some(&L) && syllable.initial == R_;
        if !doubled {
            phones.extend_from_slice(initial(syllable.initial, syllable.vowel, voiced));
        }
        phones.extend_from_slice(vowel(syllable.vowel));
        phones.extend(syllable.last.map(last));
    }
    match phones.is_empty() {
        true => Vec::new(),
        false => vec![Pronunciation { phones, origin: Origin::Rules }],
    }
}

fn syllable(c: char) -> Option<Syllable> {
    let number = (c as u32).checked_sub(FIRST).filter(|number| *number < 19 * VOWELS * FINALS)?;
    let finals = finals(number % FINALS);
    Some(Syllable {
        initial: number / FINALS / VOWELS,
        vowel: number / FINALS % VOWELS,
        last: finals.map(|finals| finals.0),
        before_vowel: finals.map_or((None, NONE), |finals| (finals.1, finals.2)),
    })
}

/// Returns the pronounced final consonant; and before a vowel, the one that stays and the one that moves on.
fn finals(number: u32) -> Option<(u32, Option<u32>, u32)> {
    let one = |consonant| Some((consonant, None, consonant));
    match number {
        1 => one(G),
        2 => Some((G, None, 1)),
        3 => Some((G, Some(G), 10)),
        4 | 6 => one(N_),
        5 => Some((N_, Some(N_), J_)),
        7 => one(D_),
        8 | 15 => one(R_),
        9 => Some((G, Some(R_), G)),
        10 => Some((M_, Some(R_), M_)),
        11 => Some((R_, Some(R_), B_)),
        12 => Some((R_, Some(R_), 10)),
        13 => Some((R_, Some(R_), T_)),
        14 => Some((P_, Some(R_), P_)),
        16 => one(M_),
        17 => one(B_),
        18 => Some((B_, Some(B_), 10)),
        19 => one(S_),
        20 => Some((S_, None, 10)),
        // ng stays, h is silent.
        21 => Some((NONE, Some(NONE), NONE)),
        22 => one(J_),
        23 => one(CH_),
        24 => one(K_),
        25 => one(T_),
        26 => one(P_),
        27 => Some((H_, None, NONE)),
        _ => None,
    }
}

/// Applies the sound changes between neighbours.
fn joined(mut syllables: Vec<Syllable>) -> Vec<Syllable> {
    for at in 1..syllables.len() {
        let [.., before, after] = &mut syllables[..=at] else { continue };
        let Some(last) = before.last else { continue };
        match (last, after.initial) {
            // ㄷ and ㅌ soften before i.
            (_, NONE) => {
                let (stays, moves) = before.before_vowel;
                before.last = stays;
                after.initial = match moves {
                    D_ if after.vowel == I => J_,
                    T_ if after.vowel == I => CH_,
                    moves => moves,
                };
            }
            (NONE, _) => {}
            // ㅎ aspirates its neighbour.
            (H_, G) => (before.last, after.initial) = (None, K_),
            (H_, D_) => (before.last, after.initial) = (None, T_),
            (H_, J_) => (before.last, after.initial) = (None, CH_),
            (H_, S_) => before.last = None,
            (G, H_) => (before.last, after.initial) = (None, K_),
            (D_ | S_, H_) => (before.last, after.initial) = (None, T_),
            (B_, H_) => (before.last, after.initial) = (None, P_),
            (J_, H_) => (before.last, after.initial) = (None, CH_),
            // Before and after nasals.
            (G | K_, N_ | M_) => before.last = Some(NONE),
            (D_ | S_ | J_ | CH_ | T_ | H_, N_ | M_) => before.last = Some(N_),
            (B_ | P_, N_ | M_) => before.last = Some(M_),
            (N_, R_) => before.last = Some(R_),
            (R_, N_) => after.initial = R_,
            (M_, R_) => after.initial = N_,
            _ => {}
        }
    }
    syllables
}

fn initial(number: u32, vowel: u32, voiced: bool) -> &'static [Phone] {
    // Vowels that begin with i or y.
    let soft = matches!(vowel, 2 | 3 | 6 | 7 | 12 | 16 | 17 | I);
    match number {
        0 if voiced => &[Phone::G],
        0 | 1 | 15 => &[K],
        2 => &[N],
        3 if voiced => &[D],
        3 | 4 | 16 => &[T],
        5 => &[R],
        6 => &[M],
        7 if voiced => &[B],
        7 | 8 | 17 => &[P],
        9 | 10 if soft => &[Sh],
        9 | 10 => &[S],
        12 if voiced => &[Jh],
        12..=14 => &[Ch],
        18 => &[Hh],
        _ => &[],
    }
}

fn vowel(number: u32) -> &'static [Phone] {
    match number {
        0 => &[Aa],
        1 | 5 => &[Eh],
        2 => &[Y, Aa],
        3 | 7 => &[Y, Eh],
        4 => &[Ah],
        6 => &[Y, Ah],
        8 => &[Ow],
        9 => &[W, Aa],
        10 | 11 | 15 => &[W, Eh],
        12 => &[Y, Ow],
        13 => &[Uw],
        14 => &[W, Ah],
        16 => &[W, Iy],
        17 => &[Y, Uw],
        18 => &[Ih],
        19 => &[Ih, Iy],
        _ => &[Iy],
    }
}

/// Returns the phone of a final consonant. All stops are unreleased, and reduced to three.
fn last(number: u32) -> Phone {
    match number {
        0 | 1 | 15 => K,
        2 => N,
        5 => L,
        6 => M,
        7 | 8 | 17 => P,
        11 => Ng,
        _ => T,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn syllables_change_their_neighbours() {
        let cases = [
            ("안녕하세요", "AA N N Y AH NG HH AA S EH Y OW"),
            ("감사합니다", "K AA M S AA HH AA M N IY D AA"),
            ("한국어", "HH AA N G UW G AH"),
            ("같이", "K AA CH IY"),
            ("좋아", "CH OW AA"),
            ("좋다", "CH OW T AA"),
            ("신라", "SH IY L AA"),
            ("없어요", "AH P S AH Y OW"),
            ("닭이", "T AA L G IY"),
            ("읽는", "IY NG N IH N"),
            ("값", "K AA P"),
            ("많이", "M AA N IY"),
            ("영어", "Y AH NG AH"),
            ("시작", "SH IY JH AA K"),
        ];
        for (word, expected) in cases {
            assert_eq!(pronounce(word).first().map(ToString::to_string).unwrap_or_default(), expected, "{word}");
        }
        assert_eq!(pronounce("ㅋㅋ"), []);
    }
}
