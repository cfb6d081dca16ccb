//! The best path through a graph: Viterbi's algorithm (A. Viterbi, 1967), within a beam.

use super::graph::Graph;
use super::history::{FrameHistory, History, PathStep, Position};
use crate::model::{Model, STATES, Scores};

/// The value of an impossible path.
const NEVER: f32 = -1e30;
/// Paths that are worse than the best by more than this are dropped, in nats. The beam is so wide that only paths
/// seconds away in the script are dropped.
const BEAM: f32 = 2_000.0;
/// The number of frames after which the common part of all paths is decided.
const DECIDE_FRAMES: usize = 256;
/// The most bytes of undecided history: half a minute or more. Only speech that repeats itself for so long stays
/// undecided.
const MOST_BYTES: usize = 2 << 20;
/// The choice of a junction to skip the word before it.
const SKIP: u8 = u8::MAX;

/// The data kept of a frame.
pub(super) struct Decisions<'g> {
    graph: &'g Graph,
    /// The first node that has a state. For it and the nodes after it, one bit per state: whether it was entered.
    first_node: usize,
    entered: Vec<u8>,
    /// The first junction that has a path. For it and the junctions after it, the best arrival.
    first_junction: usize,
    choices: Vec<u8>,
}

impl Decisions<'_> {
    /// Returns the node whose last state contains the path that passes a junction after this frame.
    fn arrival(&self, mut junction: usize) -> usize {
        loop {
            let choice = junction.checked_sub(self.first_junction).and_then(|index| self.choices.get(index));
            match choice {
                Some(&SKIP) if junction > 0 => junction -= 1,
                Some(&choice) => {
                    return self.graph.arrivals[junction].get(usize::from(choice)).copied().unwrap_or(self.first_node);
                }
                None => return self.first_node,
            }
        }
    }
}

impl FrameHistory for Decisions<'_> {
    fn back(&self, position: Position, before: Option<&Self>) -> (Position, bool) {
        let (node, state) = (position.0 / STATES, position.0 % STATES);
        let bits = node.checked_sub(self.first_node).and_then(|index| self.entered.get(index)).copied().unwrap_or(0);
        if bits >> state & 1 == 0 {
            return (position, false);
        }
        if state > 0 {
            return (Position(position.0 - 1), false);
        }
        let from = match &self.graph.nodes[node] {
            first if first.is_first => before.map_or(node, |before| before.arrival(first.junction)),
            _ => node - 1,
        };
        (Position(from * STATES + STATES - 1), true)
    }

    fn bytes(&self) -> usize {
        size_of::<Self>() + self.entered.len() + self.choices.len()
    }
}

/// Returns the best path through `graph`, for audio whose frames have these `scores`. It ends in the last junction if
/// any path does, and covers every frame.
pub(super) fn best_path(graph: &Graph, model: &Model, scores: impl Iterator<Item = Scores>) -> Vec<PathStep> {
    let mut search = Search::new(graph, model);
    let mut history = History::new();
    for (frame, scores) in scores.enumerate() {
        let decisions = search.advance(&scores);
        history.push(decisions);
        if frame % DECIDE_FRAMES == DECIDE_FRAMES - 1 {
            history.decide_common(search.positions());
            if history.bytes() > MOST_BYTES {
                let (decided, position) = history.decide_half(search.best());
                let (first_junction, choices) = search.keep(|other| history.trace(other, decided) == position);
                if let Some(row) = history.last_mut() {
                    (row.first_junction, row.choices) = (first_junction, choices);
                }
            }
        }
    }
    let last = graph.junctions() - 1;
    let arrived = search.at[last] > NEVER && last >= search.low;
    let end = history.last().map(|row| match arrived {
        true => Position(row.arrival(last) * STATES + STATES - 1),
        false => search.best(),
    });
    history.finish(end)
}

struct Search<'g> {
    graph: &'g Graph,
    model: &'g Model,
    /// By node and state: the value of the best path in it, relative to the best of all.
    states: Vec<[f32; STATES]>,
    /// By junction: the value of the best path that has just arrived.
    at: Vec<f32>,
    /// The junctions whose nodes have paths: from `low` to `high`, inclusive.
    low: usize,
    high: usize,
    /// By junction from `low` to `high`: the best value of its nodes.
    tops: Vec<f32>,
}

impl<'g> Search<'g> {
    fn new(graph: &'g Graph, model: &'g Model) -> Search<'g> {
        let mut at = vec![NEVER; graph.junctions()];
        at[0] = 0.0;
        let mut search = Search {
            graph,
            model,
            states: vec![[NEVER; STATES]; graph.nodes.len()],
            at,
            low: 0,
            high: 0,
            tops: Vec::new(),
        };
        search.pass_words();
        search
    }

    /// Advances all paths by one frame.
    fn advance(&mut self, scores: &Scores) -> Decisions<'g> {
        let graph = self.graph;
        let first_node = graph.nodes_of(self.low).start;
        let mut entered = vec![0; graph.nodes_of(self.high).end - first_node];
        self.tops.clear();
        self.tops.resize(self.high + 1 - self.low, NEVER);
        // Backwards, so that the node before each node still has its old value.
        for junction in (self.low..=self.high).rev() {
            let mut top = NEVER;
            for node in graph.nodes_of(junction).rev() {
                let (states, bits) = self.step(node, scores);
                entered[node - first_node] = bits;
                self.states[node] = states;
                top = top.max(states[0]).max(states[1]).max(states[2]);
            }
            self.tops[junction - self.low] = top;
        }
        let best = self.tops.iter().copied().fold(NEVER, f32::max);
        for states in &mut self.states[first_node..graph.nodes_of(self.high).end] {
            *states = states.map(|value| (value - best).max(NEVER));
        }
        for top in &mut self.tops {
            *top = (*top - best).max(NEVER);
        }
        let first_junction = self.low;
        let choices = self.arrive();
        self.prune();
        Decisions { graph, first_node, entered, first_junction, choices }
    }

    /// Returns the states of a node in the next frame, and which of them were entered.
    fn step(&self, node: usize, scores: &Scores) -> ([f32; STATES], u8) {
        let Model { stay, leave, .. } = self.model;
        let graph = &self.graph.nodes[node];
        let base = graph.phone.index() * STATES;
        let [first, second, third] = self.states[node];
        let enter = match graph.is_first {
            true => self.at[graph.junction] + graph.cost,
            false => self.left(node - 1),
        };
        let mut bits = 0;
        let mut better = |stays: f32, enters: f32, state: usize| {
            if enters > stays {
                bits |= 1 << state;
            }
            stays.max(enters) + scores[base + state]
        };
        let states = [
            better(first + stay[base], enter, 0),
            better(second + stay[base + 1], first + leave[base], 1),
            better(third + stay[base + 2], second + leave[base + 1], 2),
        ];
        (states, bits)
    }

    /// Returns the value of the best path that leaves a node after this frame.
    fn left(&self, node: usize) -> f32 {
        self.states[node][STATES - 1] + self.model.leave[self.graph.nodes[node].phone.index() * STATES + STATES - 1]
    }

    /// Chooses the best path to each junction, from the words before it and its fillers.
    fn arrive(&mut self) -> Vec<u8> {
        let last = (self.high + 1).min(self.graph.junctions() - 1);
        let mut choices = Vec::with_capacity(last + 1 - self.low);
        for junction in self.low..=last {
            let (mut best, mut choice) = (NEVER, 0);
            for (number, &node) in (0..SKIP).zip(&self.graph.arrivals[junction]) {
                let value = self.left(node);
                if value > best {
                    (best, choice) = (value, number);
                }
            }
            if junction > self.low && self.at[junction - 1] + self.graph.skips[junction] > best {
                (best, choice) = (self.at[junction - 1] + self.graph.skips[junction], SKIP);
            }
            self.at[junction] = best.max(NEVER);
            choices.push(choice);
        }
        self.high = last;
        let passed = self.pass_words();
        choices.resize(choices.len() + passed, SKIP);
        choices
    }

    /// Lets paths skip missing words beyond the last junction. Returns the number of skipped words.
    fn pass_words(&mut self) -> usize {
        let before = self.high;
        while self.high + 1 < self.graph.junctions() {
            let value = self.at[self.high] + self.graph.skips[self.high + 1];
            if value < -BEAM {
                break;
            }
            self.high += 1;
            self.at[self.high] = value;
        }
        self.high - before
    }

    /// Drops the junctions at both ends whose paths are outside the beam.
    fn prune(&mut self) {
        let hopeless = |search: &Search<'_>, junction: usize| {
            let top = search.tops.get(junction - search.tops_from()).copied().unwrap_or(NEVER);
            top < -BEAM && search.at[junction] < -BEAM
        };
        let mut low = self.low;
        while low < self.high && hopeless(self, low) {
            low += 1;
        }
        let mut high = self.high;
        while high > low && hopeless(self, high) {
            high -= 1;
        }
        for junction in (self.low..low).chain(high + 1..=self.high) {
            self.at[junction] = NEVER;
            self.states[self.graph.nodes_of(junction)].fill([NEVER; STATES]);
        }
        (self.low, self.high) = (low, high);
    }

    /// Returns the junction of the first of `tops`, before `prune` moves it.
    fn tops_from(&self) -> usize {
        self.low
    }

    /// Returns all states that have a path within the beam.
    fn positions(&self) -> Vec<Position> {
        let nodes = self.graph.nodes_of(self.low).start..self.graph.nodes_of(self.high).end;
        let states = nodes.flat_map(|node| (0..STATES).map(move |state| (node, state)));
        let alive = states.filter(|&(node, state)| self.states[node][state] > NEVER / 2.0);
        alive.map(|(node, state)| Position(node * STATES + state)).collect()
    }

    /// Returns the state of the best path.
    fn best(&self) -> Position {
        let value = |position: &Position| self.states[position.node()][position.0 % STATES];
        let best = self.positions().into_iter().max_by(|a, b| value(a).total_cmp(&value(b)));
        best.unwrap_or(Position(self.graph.nodes_of(self.low).start * STATES))
    }

    /// Drops all paths except those to the positions that `keep` accepts. Returns the first junction and the choices of
    /// the junctions, which may have changed.
    fn keep(&mut self, keep: impl Fn(Position) -> bool) -> (usize, Vec<u8>) {
        for position in self.positions() {
            if !keep(position) {
                self.states[position.node()][position.0 % STATES] = NEVER;
            }
        }
        (self.low, self.arrive())
    }
}
