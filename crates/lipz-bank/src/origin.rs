//! Which bank a handle came from.

use lipz_layout::Header;

/// The bank that a handle came from: 32 bits of the checksum, which differ between banks of different contents.
///
/// Each bit of the checksum depends on all of the contents. Whoever forges a bank can choose them: a handle then
/// leads to other contents, but never out of the bank.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(crate) struct Origin(u32);

impl Origin {
    /// The bank with this header.
    #[inline]
    pub(crate) fn new(header: &Header) -> Origin {
        Origin(header.checksum.get() as u32)
    }

    /// A debug assertion that a handle from here is used with its own bank.
    #[inline(always)]
    pub(crate) fn assert_is(self, bank: Origin) {
        debug_assert!(
            self == bank,
            "a handle of another bank: look locales and names up again when a bank is replaced"
        );
    }
}
