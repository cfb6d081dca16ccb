//! postcard and bincode: compact bytes, parsed into structures when opened.

use crate::Failure;
use crate::corpus::{Clips, Corpus};
use crate::rival::{File, Rival};
use crate::rivals::loaded::Loaded;
use std::path::Path;

/// postcard, through serde.
pub(crate) struct Postcard;

impl Rival for Postcard {
    const NAME: &'static str = "postcard 1";
    type Reader = Loaded;

    fn build(corpus: &Corpus, path: &Path) -> Result<(), Failure> {
        Ok(std::fs::write(path, postcard::to_stdvec(&corpus.bank)?)?)
    }

    fn open(file: &'static File) -> Result<Loaded, Failure> {
        Ok(Loaded::new(postcard::from_bytes(&file.map)?))
    }

    /// The parser checks all data.
    fn open_validated(file: &'static File) -> Result<Loaded, Failure> {
        Self::open(file)
    }
}

/// bincode, with its own derive.
pub(crate) struct Bincode;

impl Rival for Bincode {
    const NAME: &'static str = "bincode 2.0.1";
    type Reader = Loaded;

    fn build(corpus: &Corpus, path: &Path) -> Result<(), Failure> {
        Ok(std::fs::write(path, bincode::encode_to_vec(&corpus.bank, bincode::config::standard())?)?)
    }

    fn open(file: &'static File) -> Result<Loaded, Failure> {
        let (clips, _): (Clips, usize) = bincode::decode_from_slice(&file.map, bincode::config::standard())?;
        Ok(Loaded::new(clips))
    }

    /// The parser checks all data.
    fn open_validated(file: &'static File) -> Result<Loaded, Failure> {
        Self::open(file)
    }
}
