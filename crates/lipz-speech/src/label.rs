//! Labels of phones in files of phoneticians.

use crate::Phone;
use crate::pronounce::ipa_phones;

/// The phones that a label means: one of the CMU Pronouncing Dictionary, with or without stress, if `is_arpabet`, otherwise the
/// nearest of those in IPA; `spn`, a word that an aligner did not know, is a vowel. Nothing, if it is no phone.
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
