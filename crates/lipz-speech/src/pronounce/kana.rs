//! Japanese: kana by their sounds, and Chinese characters with the table of readings.

use super::variants::{add, sequence};
use super::{Origin, Pronunciation};
use crate::Phone::{self, *};
use crate::text::{WritingSystem, writing};
use std::collections::HashMap;
use std::sync::LazyLock;
use unicode_normalization::UnicodeNormalization;

/// Words in Chinese characters and their readings in kana, and the number of characters of the longest.
static READINGS: LazyLock<(HashMap<&str, Vec<&str>>, usize)> = LazyLock::new(|| {
    let lines = include_str!("../../data/languages/ja.txt").lines().filter(|line| !line.starts_with('#'));
    let entries = lines.flat_map(|line| line.split_whitespace()).filter_map(|entry| entry.split_once('='));
    let readings: HashMap<&str, Vec<&str>> = entries.map(|(word, kana)| (word, kana.split('/').collect())).collect();
    let longest = readings.keys().map(|word| word.chars().count()).max().unwrap_or_default();
    (readings, longest)
});

/// The sounds of the kana that stand for a consonant and a vowel, five vowels a row.
const ROWS: [(&str, &[Phone]); 16] = [
    ("あいうえお", &[]),
    ("かきくけこ", &[K]),
    ("がぎぐげご", &[G]),
    ("さしすせそ", &[S]),
    ("ざじずぜぞ", &[Z]),
    ("たちつてと", &[T]),
    ("だぢづでど", &[D]),
    ("なにぬねの", &[N]),
    ("はひふへほ", &[Hh]),
    ("ばびぶべぼ", &[B]),
    ("ぱぴぷぺぽ", &[P]),
    ("まみむめも", &[M]),
    ("や\0ゆ\0よ", &[Y]),
    ("らりるれろ", &[R]),
    ("わゐ\0ゑを", &[W]),
    ("\0\0ゔ\0\0", &[V]),
];
const VOWELS: [Phone; 5] = [Aa, Iy, Uw, Eh, Ao];

/// Returns all pronunciations of a run of hiragana or katakana.
pub(super) fn pronounce(kana: &str) -> Vec<Pronunciation> {
    run(kana, false)
}

/// Returns all pronunciations of a run of kana directly after a word in a different script, where `は` and `へ` are
/// particles.
pub(super) fn pronounce_behind_word(kana: &str) -> Vec<Pronunciation> {
    run(kana, true)
}

/// Returns all pronunciations of an explicit reading in kana, which contains no particles.
pub(super) fn reading(kana: &str) -> Vec<Vec<Phone>> {
    said(&hiragana(kana)).into_iter().filter(|phones| !phones.is_empty()).collect()
}

/// Whether a text consists of kana only.
pub(super) fn is_kana(text: &str) -> bool {
    !text.is_empty() && text.chars().all(|c| matches!(writing(c), WritingSystem::Hiragana | WritingSystem::Katakana))
}

fn run(kana: &str, is_behind_word: bool) -> Vec<Pronunciation> {
    let with = |phones| Pronunciation { phones, origin: Origin::Rules };
    ways(kana, is_behind_word).into_iter().filter(|phones| !phones.is_empty()).map(with).collect()
}

/// Returns all pronunciations of Chinese characters. `guess` returns those of characters that are not in the table.
pub(super) fn characters(han: &str, guess: impl Fn(&str) -> Vec<Vec<Phone>>) -> Vec<Pronunciation> {
    let chars: Vec<(usize, char)> = han.char_indices().collect();
    let (readings, longest) = &*READINGS;
    let (mut at, mut parts) = (0, Vec::new());
    let mut origin = Origin::Dictionary;
    while let Some((start, _)) = chars.get(at) {
        let end = |count: usize| chars.get(at + count).map_or(han.len(), |(place, _)| *place);
        let found = (1..=(*longest).min(chars.len() - at)).rev().find_map(|count| {
            han.get(*start..end(count)).and_then(|word| readings.get(word)).map(|kana| (count, kana))
        });
        if let Some((count, kana)) = found {
            parts.push(kana.iter().flat_map(|kana| reading(kana)).collect());
            at += count;
        } else {
            origin = Origin::Letters;
            parts.push(han.get(*start..end(1)).map(&guess).unwrap_or_default());
            at += 1;
        }
    }
    let all = sequence(&parts).into_iter().filter(|phones| !phones.is_empty());
    all.map(|phones| Pronunciation { phones, origin }).collect()
}

/// Text before a particle `は` where there are no Chinese characters: particles, and words that are often subjects.
const BEFORE_PARTICLE: [&str; 15] = [
    "に",
    "で",
    "と",
    "から",
    "まで",
    "こと",
    "これ",
    "それ",
    "あれ",
    "ここ",
    "そこ",
    "わたし",
    "あなた",
    "ぼく",
    "きょう",
];

/// Whether a `は` after this hiragana is a particle, as far as can be determined without a dictionary.
fn is_before_particle(before: &str) -> bool {
    BEFORE_PARTICLE.iter().any(|word| before.ends_with(word))
}

/// Returns the alternatives of kana: `は` and `へ` have a different pronunciation as particles, and `u` and `i` between
/// voiceless sounds may be silent. The particle comes first if it stands alone, at the end of a run, at the start of a
/// run after a word in a different script, and after the words of [`BEFORE_PARTICLE`].
fn ways(kana: &str, is_behind_word: bool) -> Vec<Vec<Phone>> {
    let plain = hiragana(kana);
    let is_hiragana = kana.chars().any(|c| writing(c) == WritingSystem::Hiragana);
    let mut parts: Vec<Vec<Vec<Phone>>> = Vec::new();
    let mut rest = String::new();
    let last = plain.chars().count().saturating_sub(1);
    for (at, c) in plain.chars().enumerate() {
        let particle: Option<(&[Phone], &[Phone])> = match c {
            'は' if is_hiragana => Some((&[W, Aa], &[Hh, Aa])),
            'へ' if is_hiragana => Some((&[Eh], &[Hh, Eh])),
            _ => None,
        };
        let Some((particle, plain)) = particle else {
            rest.push(c);
            continue;
        };
        let is_behind_particle = is_before_particle(&rest);
        parts.push(said(&rest));
        rest.clear();
        let both = [particle.to_vec(), plain.to_vec()];
        let is_particle = at == last || at == 0 && is_behind_word || c == 'は' && is_behind_particle;
        parts.push(if is_particle { both.to_vec() } else { both.into_iter().rev().collect() });
    }
    parts.push(said(&rest));
    parts.retain(|ways| ways.iter().any(|way| !way.is_empty()));
    sequence(&parts)
}

/// Returns the phones of hiragana with every vowel, and without those that may be silent.
fn said(kana: &str) -> Vec<Vec<Phone>> {
    let full = phones(kana);
    let mut quiet = Vec::with_capacity(full.len());
    for (at, phone) in full.iter().enumerate() {
        let near = |at: Option<usize>| at.and_then(|at| full.get(at)).copied();
        let voiceless = |phone: Phone| matches!(phone, K | S | Sh | T | Ch | Hh | F | P);
        let after = near(at.checked_sub(1)).is_some_and(voiceless);
        let before = near(Some(at + 1)).map_or(*phone == Uw, voiceless);
        if !(matches!(phone, Uw | Iy) && after && before) {
            quiet.push(*phone);
        }
    }
    let mut all = vec![full];
    add(&mut all, quiet);
    all
}

/// Converts katakana, half width or not, to hiragana.
fn hiragana(kana: &str) -> String {
    kana.nfkc()
        .map(|c| if ('ァ'..='ヶ').contains(&c) { char::from_u32(c as u32 - 0x60).unwrap_or(c) } else { c })
        .collect()
}

/// Returns the phones of hiragana. Long vowels and doubled consonants appear once, because they are held.
fn phones(kana: &str) -> Vec<Phone> {
    let mut phones: Vec<Phone> = Vec::new();
    let mut chars = kana.chars().peekable();
    while let Some(c) = chars.next() {
        match c {
            'ん' => phones.push(match chars.peek().and_then(|next| mora(*next)) {
                Some((consonant, _)) if matches!(consonant.first(), Some(P | B | M)) => M,
                Some((consonant, _)) if matches!(consonant.first(), Some(K | G)) => Ng,
                _ => N,
            }),
            'ゃ' | 'ゅ' | 'ょ' | 'ぁ' | 'ぃ' | 'ぅ' | 'ぇ' | 'ぉ' | 'ゎ' => small(c, &mut phones),
            _ => {
                let Some((consonant, vowel)) = mora(c) else { continue };
                let long = match (phones.last(), vowel) {
                    _ if !consonant.is_empty() => false,
                    (Some(last), vowel) if *last == vowel => true,
                    (Some(Ao), Uw) => true,
                    (Some(Eh), Iy) => true,
                    _ => false,
                };
                if !long {
                    phones.extend_from_slice(consonant);
                    phones.push(vowel);
                }
            }
        }
    }
    phones
}

/// Replaces the vowel before a small kana: `きゃ`, `ファ`.
fn small(c: char, phones: &mut Vec<Phone>) {
    let (glide, vowel) = match c {
        'ゃ' => (true, Aa),
        'ゅ' => (true, Uw),
        'ょ' => (true, Ao),
        'ぁ' | 'ゎ' => (false, Aa),
        'ぃ' => (false, Iy),
        'ぅ' => (false, Uw),
        'ぇ' => (false, Eh),
        _ => (false, Ao),
    };
    let before = phones.len().checked_sub(2).and_then(|at| phones.get(at)).copied();
    match (phones.last().copied(), before) {
        // `ふぁ`, `てぃ`, `きゃ`. After a vowel alone (`うぃ`), `u` becomes a glide.
        (Some(last), Some(consonant)) if last.is_vowel() && !consonant.is_vowel() => {
            phones.pop();
            if glide && !matches!(consonant, Sh | Ch | Jh) {
                phones.push(Y);
            }
        }
        (Some(Uw), _) if !glide => {
            phones.pop();
            phones.push(W);
        }
        (Some(last), _) if last == vowel => return,
        _ if glide => phones.push(Y),
        _ => {}
    }
    phones.push(vowel);
}

/// Returns the consonant and the vowel of a kana.
fn mora(c: char) -> Option<(&'static [Phone], Phone)> {
    Some(match c {
        'し' => (&[Sh], Iy),
        'じ' | 'ぢ' => (&[Jh], Iy),
        'ち' => (&[Ch], Iy),
        'つ' => (&[T, S], Uw),
        'づ' => (&[Z], Uw),
        'ふ' => (&[F], Uw),
        'を' => (&[], Ao),
        'ゐ' => (&[], Iy),
        'ゑ' => (&[], Eh),
        _ => {
            let row =
                ROWS.iter().find_map(|(row, consonant)| Some((*consonant, row.chars().position(|kana| kana == c)?)));
            let (consonant, column) = row?;
            (consonant, *VOWELS.get(column)?)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn first(kana: &str) -> String {
        pronounce(kana).first().map(ToString::to_string).unwrap_or_default()
    }

    #[test]
    fn kana_sound_as_they_are_written() {
        let cases = [
            ("ありがとう", "AA R IY G AA T AO"),
            ("きょう", "K Y AO"),
            ("がっこう", "G AA K AO"),
            ("しゃしん", "SH AA SH IY N"),
            ("さんぽ", "S AA M P AO"),
            ("てんき", "T EH NG K IY"),
            ("せんせい", "S EH N S EH"),
            ("ラーメン", "R AA M EH N"),
            ("ファイル", "F AA IY R UW"),
            ("パーティー", "P AA T IY"),
            ("ウィキ", "W IY K IY"),
            ("チェス", "CH EH S UW"),
            ("ｶﾞﾝﾀﾞﾑ", "G AA N D AA M UW"),
            ("を", "AO"),
            ("は", "W AA"),
            ("わたしは", "W AA T AA SH IY W AA"),
            ("ー", ""),
        ];
        for (kana, expected) in cases {
            assert_eq!(first(kana), expected, "{kana}");
        }
    }

    #[test]
    fn particles_come_first_where_they_are_known() {
        assert_eq!(first("これはほんです"), "K AO R EH W AA HH AO N D EH S UW");
        assert_eq!(first("では"), "D EH W AA");
        assert_eq!(first("ここにはない"), "K AO K AO N IY W AA N AA IY");
        assert_eq!(first("はな"), "HH AA N AA");
        assert_eq!(first("はははは"), "HH AA HH AA HH AA W AA");
        let behind = |kana| pronounce_behind_word(kana).first().map(ToString::to_string).unwrap_or_default();
        assert_eq!(behind("はきれいです"), "W AA K IY R EH D EH S UW");
        assert_eq!(behind("への"), "EH N AO");
        assert_eq!(behind("がはな"), "G AA HH AA N AA");
        // In ambiguous cases, both pronunciations are available to the aligner.
        assert!(pronounce("はな").iter().any(|way| way.to_string() == "W AA N AA"));
        assert!(reading("はは").iter().all(|way| way == &[Hh, Aa, Hh, Aa]));
    }

    #[test]
    fn what_may_be_silent_is_a_variant() {
        let all: Vec<String> = pronounce("です").iter().map(ToString::to_string).collect();
        assert_eq!(all, ["D EH S UW", "D EH S"]);
    }

    #[test]
    fn readings_are_kana_and_each_word_has_some() {
        let (readings, longest) = &*READINGS;
        assert!(readings.len() > 100 && *longest > 1);
        for (word, kana) in readings {
            assert!(word.chars().any(|c| writing(c) == WritingSystem::Han), "{word}");
            assert!(kana.iter().all(|kana| is_kana(kana) && !reading(kana).is_empty()), "{word}");
        }
        let said = |han| {
            let all = characters(han, |_| vec![vec![M]]);
            all.first().map(|first| (first.to_string(), first.origin))
        };
        assert_eq!(said("二十三"), Some(("N IY JH UW S AA N".to_owned(), Origin::Dictionary)));
        assert_eq!(said("鬱三"), Some(("M S AA N".to_owned(), Origin::Letters)));
    }
}
