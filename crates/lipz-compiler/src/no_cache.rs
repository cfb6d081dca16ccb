//! What stands for the cache without the feature `cache`: no file is ever known.

use crate::Input;
use crate::compile::FileReader;
use std::convert::Infallible;
use std::marker::PhantomData;

/// The stamp of a file.
#[derive(Clone, Copy)]
pub(crate) struct Stamp;

/// What a thread needs to look at files: nothing.
#[derive(Default)]
pub(crate) struct Look;

/// The name of a file in a cache.
pub(crate) struct Name;

/// A cache, of which there is none.
pub(crate) struct Cache<'s>(Infallible, PhantomData<&'s ()>);

/// A file that was looked at, of which there is none.
pub(crate) struct CachedFile<'c>(Infallible, PhantomData<&'c ()>);

impl Cache<'_> {
    pub(crate) fn file<'c>(
        &'c self,
        _index: usize,
        _input: &'c Input,
        _look: &mut Look,
        _reader: &mut FileReader,
    ) -> Option<CachedFile<'c>> {
        match self.0 {}
    }
}

impl Stamp {
    pub(crate) fn mark(&mut self, _is_marked: bool) {}

    pub(crate) fn is_marked(self) -> bool {
        false
    }
}

impl CachedFile<'_> {
    pub(crate) fn unread(&self) -> Option<Stamp> {
        match self.0 {}
    }

    pub(crate) fn read(&self, _bytes: &[u8]) -> (Stamp, bool) {
        match self.0 {}
    }

    pub(crate) fn name(&self) -> Name {
        match self.0 {}
    }
}
