//! The element `phones`: the phones of an alignment.

use lipz_file::phones;
use lipz_speech::AlignedPhone;
use lipz_types::Phone;

/// The quietest level that the element stores, in decibels relative to full scale.
const QUIETEST_DB: f32 = -127.0;

/// Returns the value of the element; `None` without phones. `is_guessed` states that there was no text.
pub(super) fn text(aligned: &[AlignedPhone], is_guessed: bool, level_db: f32) -> Option<String> {
    let mut track: Vec<(Phone, u32)> = Vec::with_capacity(aligned.len());
    for aligned in aligned {
        // Noises have no phone. Times are multiples of 10 ms, so no two phones start in the same millisecond.
        let phone = aligned.phone.name().parse().unwrap_or(Phone::SILENCE);
        let start_ms = u32::try_from(aligned.start_us / 1000).unwrap_or(u32::MAX);
        if track.last().is_none_or(|(last, last_ms)| *last_ms < start_ms && (*last != phone || phone != Phone::SILENCE))
        {
            track.push((phone, start_ms));
        }
    }
    #[allow(clippy::cast_possible_truncation, reason = "limited to the range of the type")]
    let level_db = level_db.round().clamp(QUIETEST_DB, 0.0) as i8;
    (!track.is_empty()).then(|| phones::write(is_guessed, Some(level_db), track))
}
