//! The graph of all ways to say a script, which is searched for the best path.
//!
//! There is a *junction*, which takes no time, before each word and after the last. From a junction, a path leads
//! through one of the pronunciations of its word to the next junction, or through a filler (silence, noise, other
//! speech) back to the same junction, or past the word, which is then missing. So every phone has one predecessor, and
//! only junctions choose.

use crate::script::Word;
use crate::{Phone, Script};
use std::ops::Range;

/// A phone of a pronunciation, or a filler.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) phone: Phone,
    /// Whether paths enter it from its junction, rather than from the node before it.
    pub(super) is_first: bool,
    /// The junction of a filler, or the one before the node's word.
    pub(super) junction: usize,
    /// The index of the pronunciation that contains the node.
    pub(super) pronunciation: usize,
    /// The cost of entering the node, in nats: not positive.
    pub(super) cost: f32,
}

/// The costs of differences from the script, in nats: not positive.
#[derive(Clone, Copy, Debug)]
pub(super) struct Costs {
    /// A pause between words.
    pub(super) pause: f32,
    /// A noise.
    pub(super) noise: f32,
    /// Speech that is not in the script.
    pub(super) other_speech: f32,
    /// A missing word.
    pub(super) missing_word: f32,
}

/// All ways to say a script.
#[derive(Clone, Debug)]
pub(super) struct Graph {
    pub(super) nodes: Vec<Node>,
    /// By junction: the nodes that lead into it.
    pub(super) arrivals: Vec<Vec<usize>>,
    /// By junction: its first node. The last entry is the number of nodes.
    starts: Vec<usize>,
    /// By junction: the cost of skipping the word before it.
    pub(super) skips: Vec<f32>,
}

/// The most pronunciations of a word that are tried. This bounds the time for any script.
const MOST_PRONUNCIATIONS: usize = 32;

impl Graph {
    pub(super) fn new(script: &Script, costs: &Costs) -> Graph {
        let junctions = script.words.len() + 1;
        let mut graph = Graph {
            nodes: Vec::new(),
            arrivals: vec![Vec::new(); junctions],
            starts: Vec::with_capacity(junctions + 1),
            skips: vec![f32::NEG_INFINITY; junctions],
        };
        for junction in 0..junctions {
            graph.starts.push(graph.nodes.len());
            // Silence at the start and the end of a recording costs nothing.
            let pause = if junction == 0 || junction + 1 == junctions { 0.0 } else { costs.pause };
            graph.add_filler(Phone::Sil, junction, pause);
            // The sound of a drawn-out word may last for seconds, and is as steady as a noise.
            let beside = [junction.checked_sub(1), Some(junction)].into_iter().flatten();
            let (noise, other_speech) = match beside.filter_map(|word| script.words.get(word)).any(Word::is_drawn_out) {
                true => (f32::NEG_INFINITY, f32::NEG_INFINITY),
                false => (costs.noise, costs.other_speech),
            };
            graph.add_filler(Phone::Noise, junction, noise);
            graph.add_filler(Phone::Spoken, junction, other_speech);
            if let Some(word) = script.words.get(junction) {
                for (number, pronunciation) in word.pronunciations.iter().take(MOST_PRONUNCIATIONS).enumerate() {
                    graph.add_pronunciation(&pronunciation.phones, junction, number);
                }
                let is_heard = graph.nodes.len() > graph.starts[junction] + FILLERS;
                graph.skips[junction + 1] = if is_heard { costs.missing_word } else { 0.0 };
            }
        }
        graph.starts.push(graph.nodes.len());
        graph
    }

    pub(super) fn junctions(&self) -> usize {
        self.arrivals.len()
    }

    /// Returns the nodes of a junction: its fillers and its word.
    pub(super) fn nodes_of(&self, junction: usize) -> Range<usize> {
        let start = |junction: usize| self.starts.get(junction).copied().unwrap_or(self.nodes.len());
        start(junction)..start(junction + 1)
    }

    fn add_filler(&mut self, phone: Phone, junction: usize, cost: f32) {
        self.arrivals[junction].push(self.nodes.len());
        self.nodes.push(Node { phone, is_first: true, junction, pronunciation: 0, cost });
    }

    fn add_pronunciation(&mut self, phones: &[Phone], junction: usize, pronunciation: usize) {
        let start = self.nodes.len();
        for &phone in phones.iter().filter(|phone| phone.is_speech()) {
            let is_first = self.nodes.len() == start;
            self.nodes.push(Node { phone, is_first, junction, pronunciation, cost: 0.0 });
        }
        if self.nodes.len() > start {
            self.arrivals[junction + 1].push(self.nodes.len() - 1);
        }
    }
}

/// The number of fillers of each junction.
const FILLERS: usize = 3;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::align::tests::script;

    const COSTS: Costs = Costs { pause: -2.0, noise: -3.0, other_speech: -3.0, missing_word: -4.0 };

    #[test]
    fn every_pronunciation_leads_from_one_junction_to_the_next() {
        let graph = Graph::new(&script(&[&["AH", "EY"], &["K AE T"]]), &COSTS);
        assert_eq!(graph.junctions(), 3);
        assert_eq!(graph.nodes_of(0).len(), FILLERS + 2);
        assert_eq!(graph.nodes_of(1).len(), FILLERS + 3);
        assert_eq!(graph.nodes_of(2).len(), FILLERS);
        assert_eq!(graph.arrivals[1].len(), 2 + FILLERS);
        assert_eq!(graph.arrivals[2].len(), 1 + FILLERS);
        let word = &graph.nodes[graph.nodes_of(1)][FILLERS..];
        assert_eq!(word.iter().map(|node| node.is_first).collect::<Vec<_>>(), [true, false, false]);
    }

    #[test]
    fn a_word_without_pronunciation_is_passed_by_for_nothing() {
        let graph = Graph::new(&script(&[&[], &["SIL"], &["AA"]]), &COSTS);
        assert_eq!(graph.skips[1..], [0.0, 0.0, -4.0]);
    }
}
