//! Pronunciations in annotations: phones, IPA or a respelling.

use super::lexicon::arpabet;
use super::{Pronouncer, ipa, variants};
use crate::{Origin, Phone};
use std::ops::Range;

/// Returns all pronunciations given after the colon of `{say: …}`.
///
/// # Errors
/// Returns the range of an invalid phone.
pub(super) fn phones(pronouncer: &Pronouncer, how: &str) -> Result<Vec<Vec<Phone>>, Range<usize>> {
    if how.is_empty() {
        return Ok(Vec::new());
    }
    let between = |open: char, close: char| how.strip_prefix(open).and_then(|how| how.strip_suffix(close));
    if let Some(symbols) = between('/', '/').or_else(|| between('[', ']')) {
        let phones = ipa::phones(symbols).map_err(|bad| {
            let at = symbols.find(bad).map_or(0, |at| 1 + at);
            at..at + how.get(at..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8)
        })?;
        return Ok(vec![phones]);
    }
    let names: Vec<Option<Phone>> = how.split_whitespace().map(arpabet).collect();
    if names.iter().all(Option::is_some) {
        return Ok(vec![names.into_iter().flatten().collect()]);
    }
    // Recognises a typo among phones, as opposed to a word among words.
    let capitals =
        |name: &str| name.len() <= 3 && name.bytes().all(|byte| byte.is_ascii_uppercase() || byte.is_ascii_digit());
    if names.iter().flatten().count() >= 2 && how.split_whitespace().all(capitals) {
        let bad = how.split_whitespace().zip(&names).find(|(_, phone)| phone.is_none()).map_or("", |(name, _)| name);
        let at = bad.as_ptr() as usize - how.as_ptr() as usize;
        return Err(at..at + bad.len());
    }
    let (parts, _) = words(pronouncer, how);
    let mut all = variants::sequence(&parts);
    all.retain(|phones| !phones.is_empty());
    match all.is_empty() {
        true => Err(0..how.len()),
        false => Ok(all),
    }
}

/// Returns the pronunciations of each word of a text, and the weakest origin of any. Hyphens divide words, and case is
/// ignored: `lee-SAR` is two syllables.
pub(super) fn words(pronouncer: &Pronouncer, text: &str) -> (Vec<Vec<Vec<Phone>>>, Origin) {
    let mut origin = Origin::Say;
    let mut all = Vec::new();
    let divides = |c: char| c.is_whitespace() || matches!(c, '-' | '‐' | '\u{ad}' | ',' | '·');
    for word in text.split(divides).filter(|word| !word.is_empty()) {
        let ways = pronouncer.pronounce(&word.to_lowercase());
        origin = origin.max(ways.first().map_or(Origin::Say, |way| way.origin));
        all.push(ways.into_iter().map(|way| way.phones).collect());
    }
    (all, origin)
}
