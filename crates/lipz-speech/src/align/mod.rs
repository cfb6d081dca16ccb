//! Alignment: finds the time of each word and phone of a script.

mod doubt;
mod edges;
mod emission;
mod excerpt;
mod graph;
mod history;
mod loose_aligner;
mod phones;
mod posterior;
mod quiet;
mod search;
mod size;
mod steady;
mod time;
mod unwritten;

use crate::features::cepstra::Vectors;
use crate::features::warp::Warp;
use crate::script::Word;
use crate::{Model, Phone, Script, Sound};
use emission::Emissions;
use excerpt::Excerpt;
use graph::{Costs, Graph};
use history::PathStep;
use loose_aligner::LooseAligner;
use std::fmt;
use std::ops::Range;

/// At 30 nats, drawn-out or slurred words of spontaneous speech lost to other speech: 81.7 % of the frames with the
/// correct script were right, compared with 83.4 % now. Above 60, words missing from the script are lost.
const COSTS: Costs = Costs { pause: -2.0, noise: -30.0, other_speech: -60.0, missing_word: -60.0 };

/// The progress after the first of two passes, the second of which only voices of another size need.
const HALF: f32 = 0.5;

/// Finds the times of the words and phones of a script.
///
/// Uses forced alignment with hidden Markov models: of all ways to say the script (every pronunciation, with and
/// without pauses), it chooses the one that makes the audio most likely. See L. Rabiner, "A tutorial on hidden Markov
/// models", 1989.
#[derive(Clone)]
pub struct Aligner<'m> {
    model: &'m Model,
    options: AlignOptions,
    progress: Option<&'m (dyn Fn(f32) + Sync)>,
}

impl fmt::Debug for Aligner<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Aligner").field("options", &self.options).finish_non_exhaustive()
    }
}

/// The assumptions of an [`Aligner`].
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct AlignOptions {
    /// Pauses between words that are shorter than this, in microseconds, belong to the phone before them, because the
    /// closure of a stop is as silent, and a mouth does not come to rest. The default is 150 milliseconds.
    pub shortest_pause_us: u64,
}

impl Default for AlignOptions {
    fn default() -> AlignOptions {
        AlignOptions { shortest_pause_us: 150_000 }
    }
}

/// The times of the words and phones of a script.
#[derive(Clone, PartialEq, Debug)]
pub struct Alignment {
    /// The length of the audio in microseconds.
    pub duration_us: u64,
    /// All phones and pauses, from 0 to the end of the audio without gaps.
    pub phones: Vec<AlignedPhone>,
    /// The words of the script, in its order.
    pub words: Vec<AlignedWord>,
    /// For each `|` of the script, its time in microseconds: the start of the word after it, or the end of the last
    /// word.
    pub breaks_us: Vec<u64>,
    /// The places where audio and script differ, ordered by time.
    pub mismatches: Vec<Mismatch>,
}

/// A place where the audio differs from the script.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Mismatch {
    /// The kind of difference.
    pub kind: MismatchKind,
    /// The affected words of the script; may be empty.
    pub words: Range<usize>,
    /// The start in microseconds, from the start of the audio.
    pub start_us: u64,
    /// The end in microseconds, exclusive.
    pub end_us: u64,
}

/// The kinds of difference between audio and script.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub enum MismatchKind {
    /// Different words are spoken.
    OtherWords,
    /// The words are missing from the audio.
    NotSaid,
    /// Speech that is missing from the script.
    NotInScript,
}

/// A phone with its time.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AlignedPhone {
    /// The phone; [`Phone::Sil`] is a pause, [`Phone::Noise`] is noise. Speech that is not in the script has phones
    /// without a word.
    pub phone: Phone,
    /// The start in microseconds, from the start of the audio.
    pub start_us: u64,
    /// The end in microseconds, where the next phone starts.
    pub end_us: u64,
    /// The index in the script of the word that contains the phone.
    pub word: Option<usize>,
    /// The fit of the phone to the audio, in nats per frame: at most 0, which is as good as the best of all phones.
    pub fit: f32,
}

/// A word with its time.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AlignedWord {
    /// The start in microseconds, from the start of the audio.
    pub start_us: u64,
    /// The end in microseconds. A word that is not spoken ends where it starts.
    pub end_us: u64,
    /// The index of the spoken pronunciation, or `None` if the word is missing from the audio.
    pub pronunciation: Option<usize>,
    /// The probability that the word is spoken here, from 0 to 1. Below 0.5, check it by ear.
    pub confidence: f32,
}

/// The best path through a script.
struct Path {
    graph: Graph,
    /// The size of the voice.
    warp: Warp,
    steps: Vec<PathStep>,
    /// By step: its start in frames.
    starts: Vec<f64>,
    /// By step: its fit.
    fits: Vec<f32>,
}

impl<'m> Aligner<'m> {
    /// Returns an aligner with this model.
    pub fn new(model: &'m Model, options: AlignOptions) -> Aligner<'m> {
        Aligner { model, options, progress: None }
    }

    /// Calls `progress` after every ten seconds of audio with the completed fraction, from 0 to 1.
    #[must_use]
    pub fn with_progress(self, progress: &'m (dyn Fn(f32) + Sync)) -> Aligner<'m> {
        Aligner { progress: Some(progress), ..self }
    }

    /// Reports that `done` of `frames` frames of a part of the work are done.
    fn tell(&self, done: usize, frames: usize, part: &Range<f32>) {
        if let Some(progress) = self.progress {
            progress(part.start + (part.end - part.start) * done as f32 / frames.max(1) as f32);
        }
    }

    /// Aligns `sound` to `script`.
    ///
    /// Always returns an alignment, even if the two have little in common: see [`AlignedWord::confidence`]. Time is
    /// proportional to the length of the audio, memory to that of both.
    pub fn align(&self, sound: &Sound, script: &Script) -> Alignment {
        match Excerpt::new(sound) {
            Some(excerpt) => {
                let sound = &excerpt.sound;
                excerpt.alignment(self.alignment(sound, script, &self.path(sound, script)))
            }
            None => silent(sound, script),
        }
    }

    /// Returns the phones of `sound` with their frames, from first to last without gaps, or `None` if the script does
    /// not match.
    pub(crate) fn frames(&self, sound: &Sound, script: &Script) -> Option<Vec<(Phone, Range<usize>)>> {
        let path = self.path(sound, script);
        let is_said = self.alignment(sound, script, &path).mismatches.is_empty();
        let frames = |step: &PathStep| (path.graph.nodes[step.node].phone, step.start..step.end);
        is_said.then(|| path.steps.iter().map(frames).collect())
    }

    fn path(&self, sound: &Sound, script: &Script) -> Path {
        let graph = Graph::new(script, &COSTS);
        let phone = |step: &PathStep| graph.nodes[step.node].phone;
        let (mut steps, mut best) = self.best_path(sound, &graph, Warp::NONE, &(0.0..HALF));
        let warp = size::warp(self.model, sound, &steps, phone);
        if warp != Warp::NONE {
            (steps, best) = self.best_path(sound, &graph, warp, &(HALF..1.0));
        }
        let vectors = Vectors::new(sound.spectrum(), warp);
        let phones: Vec<Phone> = steps.iter().map(phone).collect();
        let starts = edges::starts(self.model, vectors.clone(), &phones, &steps);
        let fits = emission::fits(self.model, vectors, &best, phone, &steps);
        Path { graph, warp, steps, starts, fits }
    }

    /// Returns the best path for a voice of this size, and the score of the best phone of each frame. Its progress is
    /// that of `part` of the work.
    fn best_path(&self, sound: &Sound, graph: &Graph, warp: Warp, part: &Range<f32>) -> (Vec<PathStep>, Vec<f32>) {
        let tell = |done| self.tell(done, sound.spectrum().len(), part);
        let vectors = Vectors::new(sound.spectrum(), warp);
        let mut emissions = Emissions::new(self.model, vectors, quiet::quiet(sound.spectrum())).telling(Some(&tell));
        let steps = search::best_path(graph, self.model, &mut emissions);
        (steps, emissions.best)
    }

    /// Returns the phones of `sound` without a script: an alignment without words.
    ///
    /// One phone in four is recognised as a different one, mostly as one that looks alike. Works best for English.
    pub fn listen(&self, sound: &Sound) -> Alignment {
        match Excerpt::new(sound) {
            Some(excerpt) => excerpt.alignment(self.listen_to(&excerpt.sound)),
            None => silent(sound, &Script::default()),
        }
    }

    fn listen_to(&self, sound: &Sound) -> Alignment {
        let duration_us = sound.duration_us();
        let frames = 0..sound.spectrum().len();
        let all = AlignedPhone { phone: Phone::Sil, start_us: 0, end_us: duration_us, word: None, fit: 0.0 };
        let tell = |done| self.tell(done, sound.spectrum().len(), &(0.0..1.0));
        let phones = LooseAligner::new(self.model, sound, Warp::NONE).telling(Some(&tell)).phones(frames, &all);
        let phones = time::join_pauses(phones, self.options.shortest_pause_us);
        let (words, breaks_us, mismatches) = Default::default();
        Alignment { duration_us, phones, words, breaks_us, mismatches }
    }

    fn alignment(&self, sound: &Sound, script: &Script, path: &Path) -> Alignment {
        let duration_us = sound.duration_us();
        let mut phones = Vec::with_capacity(path.steps.len());
        let mut heard = vec![None; script.words.len()];
        let times = time::of_starts(&path.starts, path.steps.last().map_or(0, |step| step.end), duration_us);
        for ((step, (start_us, end_us)), &fit) in path.steps.iter().zip(times).zip(&path.fits) {
            let node = &path.graph.nodes[step.node];
            let word = node.phone.is_speech().then_some(node.junction);
            if let Some(word) = word {
                heard[word] = Some(node.pronunciation);
            }
            let is_drawn_out = word.and_then(|word| script.words.get(word)).is_some_and(Word::is_drawn_out);
            let fit = if is_drawn_out { fit.max(doubt::DRAWN_OUT_FIT) } else { fit };
            phones.push(AlignedPhone { phone: node.phone, start_us, end_us, word, fit });
        }
        let phones = time::cover(phones, duration_us);
        let confidences = doubt::confidences(&phones, heard.len());
        let mismatches = doubt::mismatches(&phones, heard.len());
        let phones = unwritten::put_phones(self.model, sound, path, phones);
        let phones = time::join_pauses(phones, self.options.shortest_pause_us);
        let words = time::words(&phones, &heard, &confidences);
        let last_us = words.iter().map(|word| word.end_us).max().unwrap_or(duration_us);
        let break_us = |&word: &usize| words.get(word).map_or(last_us, |word| word.start_us);
        let breaks_us = script.breaks.iter().map(break_us).collect();
        Alignment { duration_us, phones, words, breaks_us, mismatches }
    }
}

/// Returns the alignment of a recording in which nothing is audible: no word is spoken, and the mouth rests.
fn silent(sound: &Sound, script: &Script) -> Alignment {
    let duration_us = sound.duration_us();
    let missing = AlignedWord { start_us: 0, end_us: 0, pronunciation: None, confidence: 0.0 };
    Alignment {
        duration_us,
        phones: time::cover(Vec::new(), duration_us),
        words: vec![missing; script.words.len()],
        breaks_us: vec![0; script.breaks.len()],
        mismatches: Vec::new(),
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use crate::{Origin, Pronunciation, Script, Word};

    /// Returns a script of words with these pronunciations.
    pub(crate) fn script(words: &[&[&str]]) -> Script {
        let pronunciation = |phones: &&str| Pronunciation {
            phones: phones.split(' ').map(|phone| phone.parse().unwrap()).collect(),
            origin: Origin::Dictionary,
        };
        let word = |(number, pronunciations): (usize, &&[&str])| Word {
            text: format!("word {number}"),
            range: 0..0,
            pronunciations: pronunciations.iter().map(pronunciation).collect(),
        };
        Script { words: words.iter().enumerate().map(word).collect(), breaks: Vec::new() }
    }
}
