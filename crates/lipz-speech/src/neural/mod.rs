//! Recognition of phones by a neural network, for recordings without a transcript.
//!
//! The network recognises phones better than the acoustic model, but not their times. Therefore its phones become the
//! script of the aligner. The network also shows whether a script matches the recording. lipz has a network of its own
//! (`xtask/speech_net`), which users can replace with a larger one.

mod convert;
mod file;
mod hear;
mod math;
mod network;
mod opinion;
mod phone_costs;
mod spectrum;
mod tokens;

pub use file::RecogniserError;
pub use hear::RecognisedWords;

use network::Network;
use phone_costs::PhoneTokens;
use std::sync::OnceLock;
use tokens::Token;

/// A neural network that recognises phones.
#[derive(Clone, Debug)]
pub struct Recogniser {
    network: Network,
    tokens: Vec<Token>,
    /// The tokens of phones, if each phone has a token of its own.
    phone_tokens: Option<PhoneTokens>,
    /// The logarithm of what the probability of a blank is multiplied by.
    blank_nats: f32,
    hash: u64,
}

impl Recogniser {
    /// Returns the built-in recogniser. It was trained on synthetic speech: `crates/lipz-speech/model/NOTICE`.
    pub fn built_in() -> &'static Recogniser {
        static RECOGNISER: OnceLock<Recogniser> = OnceLock::new();
        RECOGNISER.get_or_init(|| {
            let bytes = include_bytes!("../../model/phones.bin");
            Recogniser::from_bytes(bytes).unwrap_or_else(|error| unreachable!("the built-in recogniser: {error}"))
        })
    }

    /// Returns a hash of the file, which identifies the recogniser.
    pub fn hash(&self) -> u64 {
        self.hash
    }
}
