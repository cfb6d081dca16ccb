//! Strings that lie one behind the other in their pool, most in ascending order.

use crate::pool::Pool;

/// The check of the strings of a pool while those that own them are gone through.
pub(super) struct Strings<'data> {
    pool: Pool<'data>,
    before: &'data str,
    end: u32,
}

impl<'data> Strings<'data> {
    /// The check of the strings from `start` on.
    pub(super) fn new(pool: Pool<'data>, start: u32) -> Self {
        Strings { pool, before: "", end: start }
    }

    /// The string at this place, if it lies in the pool, right behind the one before it, and above that.
    pub(super) fn next_ascending(&mut self, offset: u32, length: u32) -> Option<&'data str> {
        let string = self.pool.text_at(offset, length).filter(|string| self.ascends(string))?;
        self.follows(offset, length).then_some(string)
    }

    /// Whether the string is above the one before it, and so not empty.
    #[inline(never)] // in the order of the bytes, many of which are compared in many places
    pub(super) fn ascends(&mut self, string: &'data str) -> bool {
        string > core::mem::replace(&mut self.before, string)
    }

    /// Whether a string at this place is right behind the one before it.
    pub(super) fn follows(&mut self, offset: u32, length: u32) -> bool {
        let end = core::mem::replace(&mut self.end, offset.wrapping_add(length));
        offset == end
    }

    /// Where the strings end.
    pub(super) fn end(&self) -> u32 {
        self.end
    }

    /// Whether they fill the pool.
    pub(super) fn fill_the_pool(&self) -> bool {
        self.end as usize == self.pool.bytes().len()
    }
}
