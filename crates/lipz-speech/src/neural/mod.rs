//! Recognition of phones by a neural network, for recordings without a transcript.
//!
//! The network recognises phones better than the acoustic model, but not their times. Therefore its phones become the
//! script of the aligner. If there is a script, they show whether it matches the recording. The network is not part of
//! lipz: users add its file.

mod convert;
mod file;
mod hear;
mod math;
mod network;
mod opinion;
mod spectrum;
mod tokens;

pub use file::RecogniserError;
pub use hear::RecognisedWords;

use network::Network;
use tokens::Token;

/// A neural network that recognises phones.
#[derive(Clone, Debug)]
pub struct Recogniser {
    network: Network,
    tokens: Vec<Token>,
    hash: u64,
}

impl Recogniser {
    /// Returns a hash of the file, which identifies the recogniser.
    pub fn hash(&self) -> u64 {
        self.hash
    }
}
