//! The phones of a clip, and their form in a bank.

use lipz_bank::Clip;
use lipz_file::phones;
use lipz_layout::{PHONES_ARE_CERTAIN, PHONES_ARE_WIDE};
use lipz_types::Phone;

/// The phones of a clip; none if the file has no element for them.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct ClipPhones {
    /// Whether they were recognised without the text of the recording.
    pub(crate) is_guessed: bool,
    /// The level of the speech in decibels relative to full scale.
    pub(crate) level_db: Option<i8>,
    /// Numbers and starts in milliseconds.
    pub(crate) spans: Vec<(u8, u32)>,
}

/// The level of a clip without one, as stored in a bank.
const NO_LEVEL: i8 = i8::MIN;

impl ClipPhones {
    /// Returns the phones of an element.
    pub(crate) fn of_track(track: &phones::PhoneTrack) -> ClipPhones {
        let spans = track.phones.iter().map(|phone| (phone.phone.number(), phone.start_ms));
        ClipPhones { is_guessed: track.is_guessed, level_db: track.level_db, spans: spans.collect() }
    }

    /// Sets the phones to those of a clip in a bank.
    pub(crate) fn recall(&mut self, clip: &Clip<'_>) {
        let phones = clip.phones();
        self.is_guessed = !phones.are_certain();
        self.level_db = phones.level_db();
        self.spans.clear();
        self.spans.extend(phones.iter().map(|span| (span.number, span.start_ms)));
    }

    /// Returns the value of the element in its canonical form; `None` without phones.
    pub(crate) fn text(&self) -> Option<String> {
        // A phone of a later version is silence, as for the reader.
        let known = |&(number, start_ms): &(u8, u32)| (Phone::from_number(number).unwrap_or(Phone::SILENCE), start_ms);
        let spans: Vec<_> = self.spans.iter().map(known).collect();
        (!spans.is_empty()).then(|| phones::write(self.is_guessed, self.level_db, spans))
    }

    /// Removes all phones and keeps the allocation.
    pub(crate) fn clear(&mut self) {
        self.spans.clear();
        (self.is_guessed, self.level_db) = (false, None);
    }

    /// Appends the data of the section of phones. Returns the flags of the clip's record.
    pub(crate) fn encode(&self, to: &mut Vec<u8>) -> u32 {
        let is_wide = self.spans.iter().any(|(_, start_ms)| u16::try_from(*start_ms).is_err());
        to.push(self.level_db.unwrap_or(NO_LEVEL) as u8);
        for (number, start_ms) in &self.spans {
            to.push(*number);
            let bytes = start_ms.to_le_bytes();
            to.extend_from_slice(if is_wide { &bytes } else { &bytes[..2] });
        }
        let certain = if self.is_guessed { 0 } else { PHONES_ARE_CERTAIN };
        certain | if is_wide { PHONES_ARE_WIDE } else { 0 }
    }
}
