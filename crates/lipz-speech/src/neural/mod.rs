//! Phones by a neural network: what is said, when nobody has written it down.
//!
//! The network hears phones better than the acoustic model does, but not when they are said: so its phones become the script of
//! the aligner. Where there is a script, they tell whether it is what is said. It is no part of lipz: a user adds its file.

mod convert;
mod file;
mod hear;
mod math;
mod network;
mod opinion;
mod spectrum;
mod tokens;

pub use file::RecogniserError;
pub use hear::Heard;

use network::Network;
use tokens::Token;

/// A neural network that hears phones.
#[derive(Clone, Debug)]
pub struct Recogniser {
    network: Network,
    tokens: Vec<Token>,
    hash: u64,
}

impl Recogniser {
    /// A hash of its file: other recognisers hear other phones.
    pub fn hash(&self) -> u64 {
        self.hash
    }
}
