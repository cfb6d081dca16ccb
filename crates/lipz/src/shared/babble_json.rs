//! Babble profiles as commands print them in JSON.

use lipz_bank::Babble;
use serde::Serialize;
use std::borrow::Cow;

/// A babble profile.
#[derive(Serialize)]
pub(crate) struct BabbleJson<'d> {
    pub(crate) name: &'d str,
    pub(crate) ooh: Cow<'d, str>,
    pub(crate) aah: Cow<'d, str>,
    pub(crate) ooh_power_transfer: Cow<'d, str>,
    pub(crate) aah_power_transfer: Cow<'d, str>,
    pub(crate) rate: [u32; 2],
}

impl<'d> BabbleJson<'d> {
    pub(crate) fn of(babble: Babble<'d>) -> Self {
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
