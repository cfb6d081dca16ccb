//! No rival: the cost of the queries themselves.

use crate::Failure;
use crate::corpus::Corpus;
use crate::rival::{File, Reader, Rival};
use std::path::Path;

/// Returns answers without reading data.
pub(crate) struct Nothing;

impl Rival for Nothing {
    const NAME: &'static str = "(harness)";
    type Reader = Nothing;

    fn build(_: &Corpus, path: &Path) -> Result<(), Failure> {
        Ok(std::fs::write(path, " ")?)
    }

    fn open(_: &'static File) -> Result<Nothing, Failure> {
        Ok(Nothing)
    }

    fn open_validated(_: &'static File) -> Result<Nothing, Failure> {
        Ok(Nothing)
    }
}

impl Reader for Nothing {
    type Clip<'r> = u32;
    type Locale<'r> = ();

    fn locale(&self, _: &str) -> Option<()> {
        Some(())
    }

    #[inline]
    fn find(&self, key: &str) -> Option<u32> {
        Some(key.len() as u32)
    }

    #[inline]
    fn clip(&self, number: u32) -> Option<u32> {
        Some(number)
    }

    #[inline]
    fn viseme(&self, clip: u32, time_us: u32) -> u8 {
        (clip ^ time_us) as u8
    }

    #[inline(always)]
    fn text<T>(&self, clip: u32, (): (), time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        Some(then(if clip == time_us { "a" } else { "b" }))
    }

    #[inline(always)]
    fn event<T>(&self, clip: u32, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        Some(then(if clip == time_us { "a" } else { "" }))
    }
}
