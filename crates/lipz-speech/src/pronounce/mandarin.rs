//! Mandarin: Chinese characters with all their readings in pinyin, and pinyin itself.

use super::variants::add;
use super::{Origin, Pronunciation, readings};
use crate::Phone::{self, *};
use crate::pronounce::variants::sequence;

/// Returns all pronunciations of Chinese characters, usually one, or `None` if the reading of a character is unknown.
pub(super) fn pronounce(han: &str) -> Option<Vec<Pronunciation>> {
    let mut parts = Vec::new();
    for c in han.chars() {
        let mut ways = Vec::new();
        for reading in readings::of(c)? {
            if let Some(phones) = syllable(reading) {
                add(&mut ways, phones);
            }
        }
        parts.push(ways);
    }
    let all = sequence(&parts).into_iter().filter(|phones| !phones.is_empty());
    let all: Vec<Pronunciation> = all.map(|phones| Pronunciation { phones, origin: Origin::Dictionary }).collect();
    (!all.is_empty()).then_some(all)
}

/// Returns the phones of a syllable in pinyin without its tone, or `None` if it is not a syllable.
fn syllable(pinyin: &str) -> Option<Vec<Phone>> {
    match pinyin {
        "m" | "hm" => return Some(vec![M]),
        "n" | "ng" | "hng" => return Some(vec![N]),
        _ => {}
    }
    let (initial, rest): (&[Phone], &str) = INITIALS
        .iter()
        .find_map(|(letters, phones)| Some((*phones, pinyin.strip_prefix(letters)?)))
        .unwrap_or((&[], pinyin));
    // The spelling differs without an initial, and after j, q and x.
    let soft = pinyin.starts_with(['j', 'q', 'x']);
    let last = match (rest, initial) {
        (rest, _) if soft && rest.starts_with('u') => {
            FINALS.iter().find(|(letters, _)| letters.strip_prefix('ü') == Some(&rest[1..]))
        }
        ("i", [D, Z] | [T, S] | [S] | [Jh] | [Ch] | [Sh] | [R]) if !soft => return Some([initial, &[Ih]].concat()),
        _ => FINALS.iter().find(|(letters, _)| *letters == rest),
    };
    last.map(|(_, phones)| [initial, *phones].concat())
}

/// Initials, the longest first.
const INITIALS: [(&str, &[Phone]); 21] = [
    ("zh", &[Jh]),
    ("ch", &[Ch]),
    ("sh", &[Sh]),
    ("b", &[B]),
    ("p", &[P]),
    ("m", &[M]),
    ("f", &[F]),
    ("d", &[D]),
    ("t", &[T]),
    ("n", &[N]),
    ("l", &[L]),
    ("g", &[G]),
    ("k", &[K]),
    ("h", &[Hh]),
    ("j", &[Jh]),
    ("q", &[Ch]),
    ("x", &[Sh]),
    ("r", &[R]),
    ("z", &[D, Z]),
    ("c", &[T, S]),
    ("s", &[S]),
];

const FINALS: [(&str, &[Phone]); 64] = [
    ("a", &[Aa]),
    ("o", &[Ao]),
    ("e", &[Ah]),
    ("ê", &[Eh]),
    ("i", &[Iy]),
    ("u", &[Uw]),
    ("ü", &[Uw]),
    ("ai", &[Ay]),
    ("ei", &[Ey]),
    ("ao", &[Aw]),
    ("ou", &[Ow]),
    ("an", &[Aa, N]),
    ("en", &[Ah, N]),
    ("ang", &[Aa, Ng]),
    ("eng", &[Ah, Ng]),
    ("ong", &[Uh, Ng]),
    ("er", &[Er]),
    ("r", &[Er]),
    ("ia", &[Y, Aa]),
    ("ie", &[Y, Eh]),
    ("iao", &[Y, Aw]),
    ("iu", &[Y, Ow]),
    ("ian", &[Y, Eh, N]),
    ("in", &[Iy, N]),
    ("iang", &[Y, Aa, Ng]),
    ("ing", &[Iy, Ng]),
    ("iong", &[Y, Uh, Ng]),
    ("io", &[Y, Ao]),
    ("ua", &[W, Aa]),
    ("uo", &[W, Ao]),
    ("uai", &[W, Ay]),
    ("ui", &[W, Ey]),
    ("uan", &[W, Aa, N]),
    ("un", &[W, Ah, N]),
    ("uang", &[W, Aa, Ng]),
    ("ue", &[W, Eh]),
    ("üe", &[W, Eh]),
    ("üan", &[W, Eh, N]),
    ("ün", &[Uw, N]),
    ("yi", &[Iy]),
    ("ya", &[Y, Aa]),
    ("ye", &[Y, Eh]),
    ("yao", &[Y, Aw]),
    ("you", &[Y, Ow]),
    ("yan", &[Y, Eh, N]),
    ("yin", &[Iy, N]),
    ("yang", &[Y, Aa, Ng]),
    ("ying", &[Iy, Ng]),
    ("yong", &[Y, Uh, Ng]),
    ("yo", &[Y, Ao]),
    ("yai", &[Y, Ay]),
    ("yu", &[Uw]),
    ("yue", &[W, Eh]),
    ("yuan", &[W, Eh, N]),
    ("yun", &[Uw, N]),
    ("wu", &[Uw]),
    ("wa", &[W, Aa]),
    ("wo", &[W, Ao]),
    ("wai", &[W, Ay]),
    ("wei", &[W, Ey]),
    ("wan", &[W, Aa, N]),
    ("wen", &[W, Ah, N]),
    ("wang", &[W, Aa, Ng]),
    ("weng", &[W, Ah, Ng]),
];

#[cfg(test)]
mod tests {
    use super::*;

    fn all(han: &str) -> Vec<String> {
        pronounce(han).unwrap_or_default().iter().map(ToString::to_string).collect()
    }

    #[test]
    fn characters_have_all_their_readings() {
        assert_eq!(all("好"), ["HH AW"]);
        assert_eq!(all("女"), ["N UW", "R UW"]);
        assert_eq!(all("学"), ["SH W EH"]);
        assert_eq!(all("去"), ["CH UW"]);
        assert_eq!(all("知"), ["JH IH"]);
        assert_eq!(all("还")[..2], ["HH AY", "HH W AA N"]);
        assert_eq!(all("中国")[0], "JH UH NG G W AO");
        assert_eq!(all("A"), Vec::<String>::new());
    }

    #[test]
    fn every_reading_is_a_syllable() {
        let readings = ('\u{4e00}'..='\u{9fff}').filter_map(readings::of).flatten();
        let mut strange: Vec<&str> = readings.filter(|plain| syllable(plain).is_none()).collect();
        strange.sort_unstable();
        strange.dedup();
        assert_eq!(strange, Vec::<&str>::new());
    }
}
