//! The reader of this project.

use crate::Failure;
use crate::corpus::Corpus;
use crate::rival::{File, Reader, Rival};
use lipz_bank::{Bank, Clip, Locale, Micros};
use lipz_compiler::{Compiler, Input, Options};
use std::path::Path;

/// A bank without source records, as shipped with a game.
pub(crate) struct Lipz;

impl Rival for Lipz {
    const NAME: &'static str = "**lipz**";
    type Reader = Bank<'static>;

    fn build(corpus: &Corpus, path: &Path) -> Result<(), Failure> {
        let inputs: Vec<Input> =
            corpus.files.iter().map(|(key, json)| Input::from_bytes(key, json.as_bytes())).collect();
        let options = Options::new().strip(true);
        let bank = Compiler::new(options.clone()).compile(&inputs).bank.ok_or("the clips have errors")?;
        Ok(std::fs::write(path, bank)?)
    }

    fn open(file: &'static File) -> Result<Bank<'static>, Failure> {
        Ok(Bank::open(&file.map)?)
    }

    fn open_validated(file: &'static File) -> Result<Bank<'static>, Failure> {
        Ok(Bank::open(&file.map)?.verify()?)
    }
}

/// The same, with a faster UTF-8 check for `verify_with`.
pub(crate) struct LipzSimd;

impl Rival for LipzSimd {
    const NAME: &'static str = "**lipz**, verified with simdutf8";
    type Reader = Bank<'static>;

    fn build(corpus: &Corpus, path: &Path) -> Result<(), Failure> {
        Lipz::build(corpus, path)
    }

    fn open(file: &'static File) -> Result<Bank<'static>, Failure> {
        Lipz::open(file)
    }

    fn open_validated(file: &'static File) -> Result<Bank<'static>, Failure> {
        Ok(Bank::open(&file.map)?.verify_with(|bytes| simdutf8::basic::from_utf8(bytes).ok())?)
    }
}

impl Reader for Bank<'static> {
    type Clip<'r> = Clip<'r>;
    type Locale<'r> = Locale;

    fn locale(&self, tag: &str) -> Option<Locale> {
        Bank::locale(self, tag)
    }

    #[inline]
    fn find(&self, key: &str) -> Option<u32> {
        self.clip_by_key(key).map(|clip| clip.slot())
    }

    #[inline]
    fn clip(&self, number: u32) -> Option<Clip<'_>> {
        self.clip_at(number)
    }

    #[inline]
    fn viseme(&self, clip: Clip<'_>, time_us: u32) -> u8 {
        clip.viseme_at(Micros(time_us.into())).code()
    }

    #[inline(always)]
    fn text<T>(&self, clip: Clip<'_>, locale: Locale, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        Some(then(clip.segment_at(Micros(time_us.into()))?.text(locale)?.as_str()))
    }

    #[inline(always)]
    fn event<T>(&self, clip: Clip<'_>, time_us: u32, then: impl FnOnce(&str) -> T) -> Option<T> {
        Some(then(clip.segment_at(Micros(time_us.into()))?.event().unwrap_or("")))
    }
}
