//! Words that could not be found clearly in their recording.

/// A word that could not be found clearly in its recording.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct DoubtfulWord {
    /// The key of the clip.
    pub key: String,
    /// The expected start, in microseconds.
    pub start_us: u64,
    /// The word.
    pub word: String,
}
