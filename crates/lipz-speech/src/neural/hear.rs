//! Recognition: finds the tokens in a recording, piece by piece.

use super::Recogniser;
use super::network::STRIDE;
use super::phone_costs::PhoneCosts;
use super::spectrum::{MELS, Spectra};
use super::tokens::Token;
use crate::features::mel::RATE_HZ;
use crate::pronounce::ipa_phones;
use crate::sound::{Resampler, decode};
use crate::{Origin, Pronunciation, Script, Sound, SoundError, Word};
use std::io::{Read, Seek};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The frames of the spectrum that the network recognises at a time, 12 seconds, and its context before and after, 2
/// seconds. Each frame attends to all others, so time grows with the square of it.
const PIECE: usize = 1_200;
const AROUND: usize = 200;

/// The exponent that sharpens the network's probabilities: that of the authors of `hama`.
const SHARPNESS: f32 = 1.0 / 0.95;

/// The words that a [`Recogniser`] found in a recording.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct RecognisedWords {
    /// For each word, its symbols of the IPA.
    words: Vec<String>,
    /// The costs of all phones, if the network names all phones.
    pub(super) costs: PhoneCosts,
}

impl RecognisedWords {
    /// Whether no words were found.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// Returns the words, in the IPA.
    pub(super) fn words(&self) -> impl Iterator<Item = &str> {
        self.words.iter().map(String::as_str)
    }

    #[cfg(test)]
    pub(super) fn of_words(words: &[&str]) -> RecognisedWords {
        RecognisedWords { words: words.iter().map(|&word| word.to_owned()).collect(), costs: PhoneCosts::default() }
    }

    /// Returns the words as a script, spelled in the IPA.
    pub fn script(&self) -> Script {
        let word = |word: &String| {
            let phones = ipa_phones(word).ok().filter(|phones| !phones.is_empty())?;
            let pronunciations = vec![Pronunciation { phones, origin: Origin::Rules }];
            Some(Word { text: word.clone(), range: 0..0, pronunciations })
        };
        Script { words: self.words.iter().filter_map(word).collect(), breaks: Vec::new() }
    }
}

impl Recogniser {
    /// Recognises the speech in a WAV, FLAC, Ogg Vorbis or MP3 file. Time is proportional to its length. Memory grows
    /// by 2 kilobytes per second.
    ///
    /// # Errors
    ///
    /// As for [`Sound::read`].
    pub fn hear<S>(&self, source: S, extension: Option<&str>) -> Result<RecognisedWords, SoundError>
    where
        S: Read + Seek + Send + Sync,
    {
        let mut listener: Option<(Resampler, Listener<'_>)> = None;
        let mut count = 0;
        // As in `Sound::read`: decoders may panic in debug builds.
        let decode = AssertUnwindSafe(|| {
            decode::decode(source, extension, |rate_hz, samples| {
                count += samples.len() as u64;
                if count > Sound::LONGEST_S * u64::from(rate_hz) {
                    return Err(SoundError::TooLong);
                }
                let new = || (Resampler::new(rate_hz, RATE_HZ), Listener::new(self));
                let (resampler, listener) = listener.get_or_insert_with(new);
                let mut resampled = Vec::new();
                resampler.push(samples, &mut resampled);
                listener.push(&resampled);
                Ok(())
            })
        });
        catch_unwind(decode).unwrap_or(Err(SoundError::DecoderFailed))?;
        let (resampler, mut listener) = listener.ok_or(SoundError::NoSound)?;
        let mut resampled = Vec::new();
        resampler.finish(&mut resampled);
        listener.push(&resampled);
        Ok(listener.finish())
    }

    /// Recognises the speech in mono samples from -1 to 1, at 16,000 per second.
    #[cfg(test)]
    pub(super) fn hear_samples(&self, samples: &[f32]) -> RecognisedWords {
        let mut listener = Listener::new(self);
        listener.push(samples);
        listener.finish()
    }
}

/// The words found so far, and the frames still to be recognised.
struct Listener<'r> {
    recogniser: &'r Recogniser,
    spectra: Spectra,
    /// Frames of the spectrum. The first `before` have been recognised.
    frames: Vec<f32>,
    before: usize,
    last: Option<usize>,
    found: RecognisedWords,
    is_new: bool,
}

impl<'r> Listener<'r> {
    fn new(recogniser: &'r Recogniser) -> Listener<'r> {
        let spectra = Spectra::new();
        let found = RecognisedWords::default();
        Listener { recogniser, spectra, frames: Vec::new(), before: 0, last: None, found, is_new: true }
    }

    fn push(&mut self, samples: &[f32]) {
        // In small blocks, to limit the buffered frames.
        for samples in samples.chunks(RATE_HZ as usize) {
            self.spectra.push(samples, &self.recogniser.network.bands, &mut self.frames);
            while self.frames.len() / MELS >= self.before + PIECE + AROUND {
                self.hear(self.before + PIECE + AROUND, PIECE);
                let done = (self.before + PIECE).saturating_sub(AROUND);
                self.frames.drain(..done * MELS);
                self.before = AROUND;
            }
        }
    }

    fn finish(mut self) -> RecognisedWords {
        self.spectra.finish(&self.recogniser.network.bands, &mut self.frames);
        let count = self.frames.len() / MELS;
        self.hear(count, count - self.before.min(count));
        self.found
    }

    /// Recognises `piece` frames after those already recognised, with a context of `known` frames.
    fn hear(&mut self, known: usize, piece: usize) {
        let Recogniser { network, tokens, phone_tokens, blank_nats, .. } = self.recogniser;
        let likely = network.run(self.frames.get(..known * MELS).unwrap_or_default());
        let frames = likely.chunks_exact(tokens.len()).skip(self.before / STRIDE).take(piece.div_ceil(STRIDE));
        for frame in frames {
            phone_tokens.iter().for_each(|phones| self.found.costs.push(phones, frame));
            let value = |(token, likely): (usize, &f32)| {
                let bias = if tokens[token] == Token::Blank { *blank_nats } else { 0.0 };
                (token, likely * SHARPNESS + bias)
            };
            let best = frame.iter().enumerate().map(value).max_by(|one, other| one.1.total_cmp(&other.1));
            let Some((token, _)) = best.filter(|(token, _)| Some(*token) != self.last) else { continue };
            self.last = Some(token);
            match &tokens[token] {
                Token::Border => self.is_new = true,
                Token::Symbols(symbols) => {
                    if std::mem::take(&mut self.is_new) {
                        self.found.words.push(String::new());
                    }
                    self.found.words.last_mut().into_iter().for_each(|word| word.push_str(symbols));
                }
                Token::Blank | Token::Other => {}
            }
        }
    }
}
