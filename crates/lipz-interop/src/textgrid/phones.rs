//! Conversion of phone labels to symbols of mapping tables: ARPAbet, and the letters of the IPA.

/// The labels of silence, from aligners and by hand.
const SILENCES: [&str; 10] = ["", "sil", "sp", "silence", "pau", "<eps>", "<sil>", "#", "_", "<p:>"];

/// Whether a label stands for silence.
pub fn is_silence(label: &str) -> bool {
    SILENCES.iter().any(|silence| label.eq_ignore_ascii_case(silence))
}

/// The labels of noises in corpora and aligners (P2FA, FAVE, Buckeye, Gentle), without their brackets.
const NOISES: [&str; 15] = [
    "sl",
    "ns",
    "br",
    "cg",
    "ls",
    "noise",
    "nsn",
    "breath",
    "breathing",
    "inhale",
    "exhale",
    "cough",
    "lipsmack",
    "click",
    "music",
];

/// The labels of speech whose phones are unknown, without their brackets. Laughter moves the mouth, too.
const SPOKEN_NOISES: [&str; 9] = ["spn", "unk", "oov", "unknown", "vocnoise", "lg", "laugh", "laughter", "laughing"];

/// Whether a label stands for a noise, during which the mouth rests: `{BR}`, `noise`.
pub(super) fn is_noise(label: &str) -> bool {
    NOISES.iter().any(|noise| bare(label).eq_ignore_ascii_case(noise))
}

/// Whether a label stands for speech whose phones are unknown: `spn`, `<unk>`, `{LG}`.
pub(super) fn is_spoken_noise(label: &str) -> bool {
    SPOKEN_NOISES.iter().any(|noise| bare(label).eq_ignore_ascii_case(noise))
}

/// Returns a label without the brackets around it.
fn bare(label: &str) -> &str {
    let inside = |(open, close)| label.strip_prefix(open).and_then(|label| label.strip_suffix(close));
    [('{', '}'), ('<', '>'), ('[', ']'), ('(', ')')].into_iter().find_map(inside).unwrap_or(label)
}

/// Returns an ARPAbet phone without the digit of its stress.
pub(super) fn without_stress(label: &str) -> &str {
    label.strip_suffix(['0', '1', '2']).unwrap_or(label)
}

/// Returns a phone without invisible details: stress, length, tones, ties, and marks of voice and place.
pub(super) fn plain_ipa(label: &str) -> String {
    let shows = |c: &char| {
        !matches!(c,
            '\u{2b0}'..='\u{2ff}' // modifier letters, such as ʰ ʲ ʷ, stress, length, tones
            | '\u{300}'..='\u{36f}' // combining marks, ties
            | '\u{1d2c}'..='\u{1d6a}' | '\u{1d78}' | '\u{1d9b}'..='\u{1dbf}' | '\u{207f}' // more modifier letters
            | '\'' | ':' | '.' | '0'..='9')
    };
    decomposed(label).filter(shows).collect()
}

/// Returns a phone in X-SAMPA without invisible details: stress, length, tones, and marks after `_`.
pub(super) fn plain_xsampa(label: &str) -> String {
    let mark = label
        .char_indices()
        .skip(1)
        .find(|&(at, c)| c == '_' && !label.get(at..).is_some_and(|mark| mark.starts_with("_<")));
    let phone = mark.map_or(label, |(at, _)| label.get(..at).unwrap_or(label));
    phone.chars().filter(|c| !matches!(c, ':' | '~' | '"' | '%' | '\'' | '=' | '-' | '.')).collect()
}

/// Returns the characters of a label, with letters and marks of the IPA separated.
fn decomposed(label: &str) -> impl Iterator<Item = char> + '_ {
    label.chars().map(|c| match c {
        'ã' => 'a',
        'ẽ' => 'e',
        'ĩ' => 'i',
        'õ' => 'o',
        'ũ' => 'u',
        'ɡ' => 'g',
        _ => c,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_of_aligners() {
        assert!(["{NS}", "noise", "<BR>", "br", "[breath]"].into_iter().all(is_noise));
        assert!(["spn", "<unk>", "{LG}", "LAUGH"].into_iter().all(is_spoken_noise));
        assert!(["", "b", "AH0", "{b}", "{NS"].into_iter().all(|label| !is_noise(label) && !is_spoken_noise(label)));
        for (label, plain) in
            [("t͡ʃ", "tʃ"), ("ɑː", "ɑ"), ("ˈa", "a"), ("tʰ", "t"), ("ɔ̃", "ɔ"), ("a˥˩", "a"), ("d̪", "d"), ("ç", "ç")]
        {
            assert_eq!(plain_ipa(label), plain, "{label}");
        }
        for (label, plain) in
            [("a:", "a"), ("a~", "a"), ("\"{", "{"), ("t_h", "t"), ("b_<", "b_<"), ("@`", "@`"), ("n=", "n")]
        {
            assert_eq!(plain_xsampa(label), plain, "{label}");
        }
    }
}
