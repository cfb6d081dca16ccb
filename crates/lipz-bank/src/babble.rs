//! Babble: generated mouth movement for a voice without visemes.

use crate::file::profiles;
use crate::verify::error_in;
use crate::{Bank, Error, ErrorKind, Fps, Time};
use core::fmt;
use lipz_layout::{BabbleRecord, Tag};
use lipz_types::StoredFps;
use zerocopy::FromBytes;

pub use lipz_types::Weight;

/// The weights of the two mouth movements of babble.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
#[non_exhaustive]
pub struct Weights {
    /// How far the lips are pursed.
    pub ooh: Weight,
    /// How far the jaw is open.
    pub aah: Weight,
}

/// The power of the voice: an `f32` from 0 to 1, a [`VoiceLevel`], or a function that measures either.
pub trait Power: sealed::Sealed {
    /// Returns the index for this power in each of two transfers of these lengths.
    #[doc(hidden)]
    fn indices(self, lengths: [usize; 2]) -> [usize; 2];
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for super::VoiceLevel {}
    impl<M: FnOnce() -> P, P: super::Power> Sealed for M {}
}

/// The power of the voice without floating point, in 65,536ths.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct VoiceLevel(pub u16);

impl VoiceLevel {
    /// The power to use for a voice that is not measured: three quarters. At this power all digits of the default
    /// profile show, but not at their widest.
    pub const UNMEASURED: VoiceLevel = VoiceLevel(0xC000);
}

impl Power for VoiceLevel {
    fn indices(self, lengths: [usize; 2]) -> [usize; 2] {
        // The digits are at most 65,535, and the level is less than 1, so the index is in range.
        lengths.map(|length| ((length as u32).wrapping_mul(u32::from(self.0)) >> 16) as usize)
    }
}

impl Power for f32 {
    /// Uses the arithmetic of the viewer. Values below 0 and NaN count as silence.
    fn indices(self, lengths: [usize; 2]) -> [usize; 2] {
        lengths.map(|length| ((length as f32 * self) as usize).min(length.saturating_sub(1)))
    }
}

impl<M: FnOnce() -> P, P: Power> Power for M {
    fn indices(self, lengths: [usize; 2]) -> [usize; 2] {
        self().indices(lengths)
    }
}

/// A babble profile: loops of digits for lips and jaw, which the power of the voice modulates (Second Life's "LipSync",
/// "How to babble").
///
/// ```
/// use lipz_bank::Micros;
/// use lipz_bank::babble::{Babble, VoiceLevel};
/// let babble = Babble::DEFAULT; // or that of a bank: bank.default_babble(), bank.babble("robot")
/// let since_speech_began = Micros(250_000);
/// let mouth = babble.at(since_speech_began, 0.8); // the power of the voice
/// assert_eq!((mouth.ooh.ten_thousandths(), mouth.aah.to_f32()), (8 * 8 * 121, 0.5929));
/// babble.at(since_speech_began, || 0.8); // measured by a function
/// babble.at(since_speech_began, VoiceLevel::UNMEASURED); // not measured
/// ```
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Babble<'data> {
    name: &'data [u8],
    ooh: &'data [u8],
    aah: &'data [u8],
    ooh_power_transfer: &'data [u8],
    aah_power_transfer: &'data [u8],
    rate: Fps,
}

impl Babble<'static> {
    /// The viewer's own profile, which needs no bank.
    pub const DEFAULT: Babble<'static> = Babble {
        name: b"default",
        ooh: b"1247898743223344444443200000",
        aah: b"257998776531013446642343",
        ooh_power_transfer: b"0012345566778899",
        aah_power_transfer: b"0000123456789",
        rate: Fps::whole(24),
    };
}

impl<'data> Babble<'data> {
    /// Returns the profile at the start of `bytes`, and the bytes after it; `None` if they are damaged.
    pub(crate) fn split_first(bytes: &'data [u8]) -> Option<(Babble<'data>, &'data [u8])> {
        let (record, mut rest) = BabbleRecord::ref_from_prefix(bytes).ok()?;
        let mut take = |length: u16| {
            let taken = rest.get(..usize::from(length))?;
            rest = rest.get(usize::from(length)..)?;
            Some(taken)
        };
        let (numerator, denominator) = (record.rate_numerator.get(), record.rate_denominator.get());
        let babble = Babble {
            name: take(record.name_length_bytes.get())?,
            ooh: take(record.ooh_length_bytes.get())?,
            aah: take(record.aah_length_bytes.get())?,
            ooh_power_transfer: take(record.ooh_power_transfer_length_bytes.get())?,
            aah_power_transfer: take(record.aah_power_transfer_length_bytes.get())?,
            rate: StoredFps::from_parts(numerator, denominator, record.frames_per_micro_q64.get())?.checked()?,
        };
        Some((babble, rest))
    }

    /// Returns the name of the profile. Empty only in a damaged bank.
    pub fn name(&self) -> &'data str {
        core::str::from_utf8(self.name).unwrap_or("")
    }

    pub(crate) const fn name_bytes(&self) -> &'data [u8] {
        self.name
    }

    /// Returns the loop for the lips, in ASCII digits.
    pub const fn ooh(&self) -> &'data [u8] {
        self.ooh
    }

    /// Returns the loop for the jaw, in ASCII digits.
    pub const fn aah(&self) -> &'data [u8] {
        self.aah
    }

    /// Returns the effect of the power on the lips: digits for equal steps from silence to full power.
    pub const fn ooh_power_transfer(&self) -> &'data [u8] {
        self.ooh_power_transfer
    }

    /// Returns the effect of the power on the jaw, in the same form.
    pub const fn aah_power_transfer(&self) -> &'data [u8] {
        self.aah_power_transfer
    }

    /// Returns the rate of the loops, in digits per second.
    pub const fn rate(&self) -> Fps {
        self.rate
    }

    /// Returns how far lips and jaw have moved `elapsed` after the start of speech, at this power. Both are 0 before
    /// the start.
    ///
    /// Each loop starts with its first digit at 0. The result is computed from the time and never stepped, so nothing
    /// drifts.
    pub fn at<T: Time, P: Power>(&self, elapsed: T, power: P) -> Weights {
        let index = match self.rate.frame_at(elapsed) {
            Some(index) => index,
            None => return Weights::default(),
        };
        let [ooh, aah] = power.indices([self.ooh_power_transfer.len(), self.aah_power_transfer.len()]);
        Weights {
            ooh: product(self.ooh, index, self.ooh_power_transfer, ooh),
            aah: product(self.aah, index, self.aah_power_transfer, aah),
        }
    }
}

/// Returns the product of a digit of a loop and one of the transfer; 0 if one of them is empty.
fn product(digits: &[u8], index: u32, transfer: &[u8], power_index: usize) -> Weight {
    let turned = (index as usize).checked_rem(digits.len()).and_then(|at| digits.get(at));
    match (turned, transfer.get(power_index)) {
        (Some(own), Some(power)) => Weight::from_digits(*own, *power),
        _ => Weight::default(),
    }
}

impl fmt::Debug for Babble<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Babble").field(&self.name()).finish()
    }
}

impl<'data> Bank<'data> {
    /// Returns the babble profile with this name.
    pub fn babble(&self, name: &str) -> Option<Babble<'data>> {
        self.babbles().find(|babble| babble.name == name.as_bytes())
    }

    /// Returns the project's profile, `[babble]` in its settings, or [`Babble::DEFAULT`].
    pub fn default_babble(&self) -> Babble<'data> {
        self.babble("default").unwrap_or(Babble::DEFAULT)
    }

    /// Returns all babble profiles of the bank, ordered by name.
    pub fn babbles(&self) -> impl Iterator<Item = Babble<'data>> + Clone {
        profiles(self.file.section(Tag::BABBLE), Babble::split_first)
    }
}

/// Checks the section, if the bank has it: profiles follow each other, ordered by name.
pub(crate) fn check(bank: &Bank<'_>) -> Result<(), Error> {
    let mut rest = bank.file.section(Tag::BABBLE);
    let mut before: &[u8] = &[];
    while !rest.is_empty() {
        match Babble::split_first(rest) {
            Some((babble, behind)) if babble.name_bytes() > before && is_valid(&babble) => {
                before = babble.name_bytes();
                rest = behind;
            }
            _ => return Err(error_in(&bank.file, ErrorKind::Babble, rest)),
        }
    }
    Ok(())
}

fn is_valid(babble: &Babble<'_>) -> bool {
    let strings = [babble.ooh(), babble.aah(), babble.ooh_power_transfer(), babble.aah_power_transfer()];
    let are_digits = strings.iter().all(|digits| !digits.is_empty() && digits.iter().all(u8::is_ascii_digit));
    are_digits && core::str::from_utf8(babble.name_bytes()).is_ok()
}
