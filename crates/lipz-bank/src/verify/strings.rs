//! Checks strings that follow each other in their pool, most of them in ascending order.

use crate::pool::Pool;

/// The state of the check of a pool's strings, while their owners are visited.
pub(super) struct Strings<'data> {
    pool: Pool<'data>,
    before: &'data str,
    end: u32,
}

impl<'data> Strings<'data> {
    /// Starts the check of the strings from `start` on.
    pub(super) fn new(pool: Pool<'data>, start: u32) -> Self {
        Strings { pool, before: "", end: start }
    }

    /// Returns the string at this place, if it is in the pool, directly follows the one before it, and is greater.
    pub(super) fn next_ascending(&mut self, offset: u32, length: u32) -> Option<&'data str> {
        let string = self.pool.text_at(offset, length).filter(|string| self.ascends(string))?;
        self.follows(offset, length).then_some(string)
    }

    /// Whether the string is greater than the one before it, and therefore not empty.
    #[inline(never)] // in the order of the bytes; many bytes are compared, in several places
    pub(super) fn ascends(&mut self, string: &'data str) -> bool {
        string > core::mem::replace(&mut self.before, string)
    }

    /// Whether a string at this place directly follows the one before it.
    pub(super) fn follows(&mut self, offset: u32, length: u32) -> bool {
        let end = core::mem::replace(&mut self.end, offset.wrapping_add(length));
        offset == end
    }

    /// Returns the end of the strings.
    pub(super) fn end(&self) -> u32 {
        self.end
    }

    /// Whether the strings fill the pool.
    pub(super) fn fill_the_pool(&self) -> bool {
        self.end as usize == self.pool.bytes().len()
    }
}
