//! What stands for the cache without the feature `cache`: no file is ever known.

use crate::Input;
use crate::clip::{ClipData, Locales};
use std::convert::Infallible;
use std::marker::PhantomData;

/// The stamp of a file.
#[derive(Clone, Copy)]
pub(crate) struct Stamp;

/// The name of a file in a cache.
pub(crate) struct Name;

/// A cache, of which there is none.
pub(crate) struct Cache<'b>(Infallible, PhantomData<&'b ()>);

/// What a run has stamped and recalled: nothing.
#[derive(Default)]
pub(crate) struct FileStamps {
    pub(crate) files: Vec<(Name, Stamp)>,
    pub(crate) recalled: usize,
    pub(crate) unread: usize,
}

/// A file that was looked at, of which there is none.
pub(crate) struct CachedFile<'c>(Infallible, PhantomData<&'c ()>);

impl Cache<'_> {
    pub(crate) fn file<'c>(&'c self, _input: &'c Input, _next: &mut usize) -> Option<CachedFile<'c>> {
        match self.0 {}
    }
}

impl FileStamps {
    pub(crate) fn append(&mut self, other: FileStamps) {
        self.files.extend(other.files);
        self.recalled += other.recalled;
        self.unread += other.unread;
    }
}

impl CachedFile<'_> {
    pub(crate) fn unread(&self) -> Option<Stamp> {
        match self.0 {}
    }

    pub(crate) fn read(&self, _bytes: &[u8]) -> (Stamp, bool) {
        match self.0 {}
    }

    pub(crate) fn key(&self) -> &str {
        match self.0 {}
    }

    pub(crate) fn name(&self) -> Name {
        match self.0 {}
    }

    pub(crate) fn recall(&self, _locales: &mut Locales, _clip: &mut ClipData) -> bool {
        match self.0 {}
    }
}
