//! Conversion of phone labels to symbols of mapping tables: ARPAbet, and the letters of the IPA.

/// The labels of silence, from aligners and by hand.
const SILENCES: [&str; 10] = ["", "sil", "sp", "silence", "pau", "<eps>", "<sil>", "#", "_", "<p:>"];

/// Whether a label stands for silence.
pub fn is_silence(label: &str) -> bool {
    SILENCES.iter().any(|silence| label.eq_ignore_ascii_case(silence))
}

/// Whether a label is an ARPAbet phone, with or without its stress: `AH0`.
pub(super) fn is_arpabet(label: &str) -> bool {
    let letters = without_stress(label);
    (1..=2).contains(&letters.len()) && letters.bytes().all(|byte| byte.is_ascii_uppercase())
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
        assert!(is_arpabet("AH0") && is_arpabet("T") && is_arpabet("ZH"));
        assert!(!is_arpabet("spn") && !is_arpabet("") && !is_arpabet("1") && !is_arpabet("ABC"));
        for (label, plain) in
            [("t͡ʃ", "tʃ"), ("ɑː", "ɑ"), ("ˈa", "a"), ("tʰ", "t"), ("ɔ̃", "ɔ"), ("a˥˩", "a"), ("d̪", "d"), ("ç", "ç")]
        {
            assert_eq!(plain_ipa(label), plain, "{label}");
        }
    }
}
