//! String pools: UTF-8 bytes that `verify` checks once. Before that, each query checks them.

/// A section of interned strings.
#[derive(Clone, Copy)]
pub(crate) enum Pool<'data> {
    /// Not verified: each string is checked on each query.
    Bytes(&'data [u8]),
    /// Verified: strings are slices at character boundaries, without another check.
    Checked(&'data str),
}

impl<'data> Pool<'data> {
    /// Whether `verify` has marked the pool as checked.
    pub(crate) const fn is_checked(&self) -> bool {
        matches!(self, Pool::Checked(_))
    }

    pub(crate) fn bytes(self) -> &'data [u8] {
        match self {
            Pool::Bytes(bytes) => bytes,
            Pool::Checked(text) => text.as_bytes(),
        }
    }

    /// Returns the bytes from `start` up to, but not including, `end`, if they are in the pool.
    #[inline]
    pub(crate) fn slice(self, start: usize, end: usize) -> Option<&'data [u8]> {
        self.bytes().get(start..end)
    }

    /// Returns the string from `start` up to, but not including, `end`, if it is in the pool and is UTF-8.
    #[inline]
    pub(crate) fn text(self, start: usize, end: usize) -> Option<&'data str> {
        match self {
            Pool::Bytes(bytes) => core::str::from_utf8(bytes.get(start..end)?).ok(),
            Pool::Checked(text) => text.get(start..end),
        }
    }

    /// Returns the string of `length` bytes at `offset`.
    #[inline(never)] // names and tags: used in many places, none of which is critical for speed
    pub(crate) fn text_at(self, offset: u32, length: u32) -> Option<&'data str> {
        let start = offset as usize;
        self.text(start, start.checked_add(length as usize)?)
    }
}
