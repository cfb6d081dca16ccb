//! Alignment: when each word and phone of a script is said.

mod doubt;
mod edges;
mod emission;
mod graph;
mod history;
mod loose;
mod phones;
mod quiet;
mod search;
mod steady;
mod time;
mod unwritten;

use crate::features::cepstra::Vectors;
use crate::{Model, Phone, Script, Sound};
use emission::Emissions;
use graph::{Costs, Graph};
use history::Step;
use loose::Loose;
use std::fmt;
use std::ops::Range;

/// In spontaneous speech, words that are drawn out or slurred gave way to other speech at 30 nats: of the frames with the right
/// script, 81.7 % were right, now 83.4 %. More than 60 loses words that the script lacks.
const COSTS: Costs = Costs { pause: -2.0, noise: -30.0, other_speech: -60.0, missing_word: -60.0 };

/// Finds when the words and phones of a script are said.
///
/// Forced alignment with hidden Markov models: of all ways to say the script (every pronunciation, with and without pauses), the
/// one is taken that makes the sound most likely. See L. Rabiner, "A tutorial on hidden Markov models", 1989.
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

/// What an [`Aligner`] may take for granted.
#[derive(Clone, Copy, PartialEq, Debug)]
#[non_exhaustive]
pub struct AlignOptions {
    /// Pauses between words that are shorter, in microseconds, belong to the phone before them: the closure of a stop is as
    /// silent, and a mouth does not come to rest. 150 milliseconds.
    pub shortest_pause_us: u64,
}

impl Default for AlignOptions {
    fn default() -> AlignOptions {
        AlignOptions { shortest_pause_us: 150_000 }
    }
}

/// When the words and phones of a script are said.
#[derive(Clone, PartialEq, Debug)]
pub struct Alignment {
    /// The length of the sound in microseconds.
    pub duration_us: u64,
    /// All phones and pauses, from 0 to the end of the sound without gaps.
    pub phones: Vec<AlignedPhone>,
    /// The words of the script, in its order.
    pub words: Vec<AlignedWord>,
    /// For each `|` of the script, the time in microseconds at which it falls: when the word after it starts, or else when the
    /// last word ends.
    pub breaks_us: Vec<u64>,
    /// Where sound and script do not belong together, in the order of their times.
    pub mismatches: Vec<Mismatch>,
}

/// A place where the sound is not what the script says.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Mismatch {
    /// In which way.
    pub kind: MismatchKind,
    /// The words of the script, which may be none.
    pub words: Range<usize>,
    /// Where in the sound it starts, in microseconds.
    pub start_us: u64,
    /// Where it ends.
    pub end_us: u64,
}

/// How sound and script differ.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub enum MismatchKind {
    /// Something else is said than these words.
    OtherWords,
    /// The words are not said.
    NotSaid,
    /// What is said here is not in the script.
    NotInScript,
}

/// A phone with its time.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AlignedPhone {
    /// Which phone; [`Phone::Sil`] is a pause, [`Phone::Noise`] what is no speech. Speech that the script does not say has phones
    /// without a word.
    pub phone: Phone,
    /// Its start in microseconds from that of the sound.
    pub start_us: u64,
    /// Its end, where the next starts.
    pub end_us: u64,
    /// The number of the word in the script that it belongs to.
    pub word: Option<usize>,
    /// How well the sound fits the phone, in nats per frame: 0 is as well as the best of all phones, and it is never more.
    pub fit: f32,
}

/// A word with its time.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct AlignedWord {
    /// Its start in microseconds from that of the sound.
    pub start_us: u64,
    /// Its end. A word that is not heard ends where it starts.
    pub end_us: u64,
    /// Which of its pronunciations is heard; none if the word is not.
    pub pronunciation: Option<usize>,
    /// How sure it is that the word is said here, from 0 to 1. Below a half, somebody should listen.
    pub confidence: f32,
}

/// The best path through a script.
struct Path {
    graph: Graph,
    steps: Vec<Step>,
    /// By step: its start in frames.
    starts: Vec<f64>,
    /// By step: how well it fits.
    fits: Vec<f32>,
}

impl<'m> Aligner<'m> {
    /// An aligner with this model.
    pub fn new(model: &'m Model, options: AlignOptions) -> Aligner<'m> {
        Aligner { model, options, progress: None }
    }

    /// Tells `progress` every ten seconds of a sound which part of it is done, from 0 to 1.
    #[must_use]
    pub fn with_progress(self, progress: &'m (dyn Fn(f32) + Sync)) -> Aligner<'m> {
        Aligner { progress: Some(progress), ..self }
    }

    /// Tells how many of so many frames are done.
    fn tell(&self, done: usize, frames: usize) {
        if let Some(progress) = self.progress {
            progress(done as f32 / frames.max(1) as f32);
        }
    }

    /// Aligns `sound` to `script`.
    ///
    /// Always finds something, however little the two have in common: [`AlignedWord::confidence`] tells. Time is proportional to
    /// the length of the sound, memory to that of the script.
    pub fn align(&self, sound: &Sound, script: &Script) -> Alignment {
        self.alignment(sound, script, &self.path(sound, script))
    }

    /// The phones of `sound` with their frames, from the first to the last without gaps; none if the script is not what is said.
    pub(crate) fn frames(&self, sound: &Sound, script: &Script) -> Option<Vec<(Phone, Range<usize>)>> {
        let path = self.path(sound, script);
        let is_said = self.alignment(sound, script, &path).mismatches.is_empty();
        let frames = |step: &Step| (path.graph.nodes[step.node].phone, step.start..step.end);
        is_said.then(|| path.steps.iter().map(frames).collect())
    }

    fn path(&self, sound: &Sound, script: &Script) -> Path {
        let graph = Graph::new(script, &COSTS);
        let vectors = Vectors::new(sound.spectrum());
        let tell = |done| self.tell(done, sound.spectrum().len());
        let mut emissions =
            Emissions::new(self.model, vectors.clone(), quiet::quiet(sound.spectrum())).telling(Some(&tell));
        let steps = search::best_path(&graph, self.model, &mut emissions);
        let phone = |step: &Step| graph.nodes[step.node].phone;
        let phones: Vec<Phone> = steps.iter().map(phone).collect();
        let starts = edges::starts(self.model, vectors.clone(), &phones, &steps);
        let fits = emission::fits(self.model, vectors, &emissions.best, phone, &steps);
        Path { graph, steps, starts, fits }
    }

    /// The phones of `sound`, whatever is said: an alignment without words.
    ///
    /// Without a script, one phone in four is mistaken for another, most of them for one that looks alike. Works best for
    /// English.
    pub fn listen(&self, sound: &Sound) -> Alignment {
        let duration_us = sound.duration_us();
        let frames = 0..sound.spectrum().len();
        let all = AlignedPhone { phone: Phone::Sil, start_us: 0, end_us: duration_us, word: None, fit: 0.0 };
        let tell = |done| self.tell(done, sound.spectrum().len());
        let phones = Loose::new(self.model, sound).telling(Some(&tell)).phones(frames, &all);
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
            phones.push(AlignedPhone { phone: node.phone, start_us, end_us, word, fit });
        }
        let phones = time::cover(phones, duration_us);
        let confidences = doubt::confidences(&phones, heard.len());
        let mismatches = doubt::mismatches(&phones, heard.len());
        let phones = unwritten::put_phones(self.model, sound, &path.steps, phones);
        let phones = time::join_pauses(phones, self.options.shortest_pause_us);
        let words = time::words(&phones, &heard, &confidences);
        let last_us = words.iter().map(|word| word.end_us).max().unwrap_or(duration_us);
        let break_us = |&word: &usize| words.get(word).map_or(last_us, |word| word.start_us);
        let breaks_us = script.breaks.iter().map(break_us).collect();
        Alignment { duration_us, phones, words, breaks_us, mismatches }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use crate::{Origin, Pronunciation, Script, Word};

    /// A script of words with these pronunciations.
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
