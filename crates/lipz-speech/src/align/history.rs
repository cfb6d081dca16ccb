//! The history of a search: the data kept of each frame, and when it is dropped.
//!
//! The paths that are still possible share their past up to some frame. This common part is decided: it becomes steps,
//! and its rows are dropped. Therefore memory does not grow with the length of the recording.

use std::collections::VecDeque;

/// A node of the best path, and its frames.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct PathStep {
    pub(super) node: usize,
    pub(super) start: usize,
    pub(super) end: usize,
}

/// A state of a node. Each node has three positions.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct Position(pub(super) usize);

impl Position {
    pub(super) fn node(self) -> usize {
        self.0 / crate::model::STATES
    }
}

/// The data that a search keeps of one frame.
pub(super) trait FrameHistory {
    /// Returns the position in the frame before (`before` is its row) of the path that is at `position` in this frame,
    /// and whether the path entered the node in this frame. Without a row before, only the latter is meaningful.
    fn back(&self, position: Position, before: Option<&Self>) -> (Position, bool);

    /// Returns the size in bytes.
    fn bytes(&self) -> usize;
}

/// The undecided rows.
pub(super) struct History<R> {
    rows: VecDeque<R>,
    /// The frame of the first row. Unless it is frame 0, the position of the path in it is decided.
    first: usize,
    bytes: usize,
    steps: Vec<PathStep>,
    /// The number of frames in `steps`.
    decided: usize,
}

impl<R: FrameHistory> History<R> {
    pub(super) fn new() -> History<R> {
        History { rows: VecDeque::new(), first: 0, bytes: 0, steps: Vec::new(), decided: 0 }
    }

    pub(super) fn push(&mut self, row: R) {
        self.bytes += row.bytes();
        self.rows.push_back(row);
    }

    pub(super) fn bytes(&self) -> usize {
        self.bytes
    }

    pub(super) fn last(&self) -> Option<&R> {
        self.rows.back()
    }

    pub(super) fn last_mut(&mut self) -> Option<&mut R> {
        self.rows.back_mut()
    }

    /// Returns the index of the next frame to be pushed.
    pub(super) fn frames(&self) -> usize {
        self.first + self.rows.len()
    }

    /// Decides the common part of all paths that are in one of `positions` in the last frame.
    pub(super) fn decide_common(&mut self, mut positions: Vec<Position>) {
        let mut frame = self.frames();
        while frame > self.first + 1 {
            frame -= 1;
            positions.sort_unstable();
            positions.dedup();
            if let [position] = positions[..] {
                self.decide(frame, position);
                return;
            }
            for position in &mut positions {
                *position = self.back(frame, *position).0;
            }
        }
    }

    /// Decides the older half of the path that is in `position` in the last frame. Returns the last decided frame and
    /// the position there. Paths with a different past become impossible.
    pub(super) fn decide_half(&mut self, position: Position) -> (usize, Position) {
        let middle = self.first + self.rows.len() / 2;
        let position = self.trace(position, middle);
        self.decide(middle, position);
        (middle, position)
    }

    /// Returns the position in `frame` of the path that is in `position` in the last frame.
    pub(super) fn trace(&self, mut position: Position, frame: usize) -> Position {
        for later in (frame + 1..self.frames()).rev() {
            position = self.back(later, position).0;
        }
        position
    }

    /// Decides all frames of the path that is in `position` in the last frame.
    pub(super) fn finish(mut self, position: Option<Position>) -> Vec<PathStep> {
        if let (Some(position), Some(last)) = (position, self.frames().checked_sub(1)) {
            self.decide(last, position);
        }
        self.steps
    }

    fn back(&self, frame: usize, position: Position) -> (Position, bool) {
        let row = |frame: usize| self.rows.get(frame.checked_sub(self.first)?);
        let before = frame.checked_sub(1).and_then(row);
        row(frame).map_or((position, true), |row| row.back(position, before))
    }

    /// Decides the path that is in `position` in `frame`, and drops the rows before it.
    fn decide(&mut self, frame: usize, mut position: Position) {
        let mut path = Vec::new();
        for frame in (self.decided..=frame).rev() {
            let (before, enters) = self.back(frame, position);
            path.push((position.node(), enters));
            position = before;
        }
        for (node, enters) in path.into_iter().rev() {
            match self.steps.last_mut() {
                Some(step) if step.node == node && !enters => step.end += 1,
                _ => self.steps.push(PathStep { node, start: self.decided, end: self.decided + 1 }),
            }
            self.decided += 1;
        }
        while self.first < frame {
            let Some(row) = self.rows.pop_front() else { break };
            self.bytes -= row.bytes();
            self.first += 1;
        }
    }
}
