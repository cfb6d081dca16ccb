//! Babble profiles as commands print them in JSON.

use lipz_bank::Babble;
use serde::Serialize;
use std::borrow::Cow;

/// A babble profile.
#[derive(Serialize)]
pub(super) struct BabbleJson<'d> {
    pub(super) name: &'d str,
    pub(super) ooh: Cow<'d, str>,
    pub(super) aah: Cow<'d, str>,
    pub(super) ooh_power_transfer: Cow<'d, str>,
    pub(super) aah_power_transfer: Cow<'d, str>,
    pub(super) rate: [u32; 2],
}

impl<'d> BabbleJson<'d> {
    pub(super) fn of(babble: Babble<'d>) -> Self {
        let rate = babble.rate();
        BabbleJson {
            name: babble.name(),
            ooh: String::from_utf8_lossy(babble.ooh()),
            aah: String::from_utf8_lossy(babble.aah()),
            ooh_power_transfer: String::from_utf8_lossy(babble.ooh_power_transfer()),
            aah_power_transfer: String::from_utf8_lossy(babble.aah_power_transfer()),
            rate: [rate.numerator(), rate.denominator()],
        }
    }
}
