//! Phonemes.

/// The last code that stands for a sound.
pub(super) const LAST_PHONEME: u8 = 0x29;
