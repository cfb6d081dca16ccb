//! The asset: a bank that owns its bytes, and its loader.

use bevy::asset::io::Reader;
use bevy::asset::{Asset, AssetLoader, LoadContext};
use bevy::reflect::TypePath;
use lipz_bank::Bank;
use self_cell::self_cell;
use std::{fmt, io};

self_cell!(
    struct OwnedBank {
        owner: Box<[u8]>,
        #[covariant]
        dependent: Bank,
    }
);

/// A bank as an asset. `assets.load("dialogue.lipzbank")` loads and verifies it.
#[derive(Asset, TypePath)]
pub struct LipzBank(OwnedBank);

impl LipzBank {
    /// Opens the bank that consists of these bytes, such as a downloaded one, and checks every byte and every
    /// reference.
    ///
    /// # Errors
    /// If the bytes are not a bank, or are damaged.
    pub fn open(bytes: impl Into<Box<[u8]>>) -> Result<LipzBank, lipz_bank::Error> {
        OwnedBank::try_new(bytes.into(), |bytes| Bank::open(bytes)?.verify()).map(LipzBank)
    }

    /// Returns the bank for queries of your own: clips, texts, curves, articulation.
    pub fn bank(&self) -> &Bank<'_> {
        self.0.borrow_dependent()
    }
}

impl fmt::Debug for LipzBank {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("LipzBank").field(self.bank()).finish()
    }
}

/// The loader of `.lipzbank` files. [`LipzPlugin`](crate::LipzPlugin) adds it.
#[derive(Default, TypePath)]
pub struct BankLoader;

/// The reason for which a bank did not load.
#[derive(Debug)]
pub enum BankLoadError {
    /// The file could not be read to its end.
    Read(io::Error),
    /// The file is not a bank, or is damaged.
    Bank(lipz_bank::Error),
}

impl fmt::Display for BankLoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BankLoadError::Read(error) => error.fmt(f),
            BankLoadError::Bank(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for BankLoadError {}

impl AssetLoader for BankLoader {
    type Asset = LipzBank;
    type Settings = ();
    type Error = BankLoadError;

    async fn load(&self, reader: &mut dyn Reader, (): &(), _: &mut LoadContext<'_>) -> Result<LipzBank, BankLoadError> {
        let mut bytes = Vec::new();
        reader.read_to_end(&mut bytes).await.map_err(BankLoadError::Read)?;
        LipzBank::open(bytes).map_err(BankLoadError::Bank)
    }

    fn extensions(&self) -> &[&str] {
        &["lipzbank"]
    }
}
