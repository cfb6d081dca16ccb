//! Phone labels in annotation files.

use crate::Phone;
use crate::pronounce::ipa_phones;

/// Returns the phones that a label stands for, or `None` if it is not a phone.
///
/// If `is_arpabet`, the label is a phone of the CMU Pronouncing Dictionary, with or without stress. Otherwise it is in
/// IPA, and the nearest phones are returned. `spn`, with which aligners mark unknown words, becomes a vowel.
///
/// ```
/// use lipz_speech::{Phone, phones_of_label};
/// assert_eq!(phones_of_label("AY1", true), Some(vec![Phone::Ay]));
/// assert_eq!(phones_of_label("t͡ʃ", false), Some(vec![Phone::Ch]));
/// assert_eq!(phones_of_label("?!", false), None);
/// ```
pub fn phones_of_label(label: &str, is_arpabet: bool) -> Option<Vec<Phone>> {
    match is_arpabet {
        _ if label == "spn" => Some(vec![Phone::Ah]),
        true => label.parse().ok().map(|phone| vec![phone]),
        false => ipa_phones(label).ok().filter(|phones| !phones.is_empty()),
    }
}
