//! Statistics of frames whose states are known: how many frames each Gaussian explains, and their values.

use super::score::exponentiate;
use super::{DENSITIES, Model, STATES, STREAMS};
use crate::Phone;
use crate::features::cepstra::{COEFFICIENTS, NUMBERS};

/// Sums over frames. They use double precision and the order of the frames, so they are the same on every machine.
#[derive(Clone, Debug)]
pub(crate) struct Counts {
    /// By phone, stream, Gaussian: the number of frames it explains.
    pub(super) frames: Vec<f64>,
    /// By phone, stream, dimension, Gaussian: the sum of the values in those frames, and of their squares.
    pub(super) sums: Vec<f64>,
    pub(super) squares: Vec<f64>,
    /// By state, stream, Gaussian: the number of frames it explains.
    pub(super) shares: Vec<f64>,
    /// By state: the number of its frames, and of its visits.
    pub(super) stays: Vec<f64>,
    pub(super) entered: Vec<f64>,
}

const STATE_COUNT: usize = Phone::COUNT * STATES;
const BOOKS: usize = Phone::COUNT * STREAMS;

impl Counts {
    pub(crate) fn new() -> Counts {
        Counts {
            frames: vec![0.0; BOOKS * DENSITIES],
            sums: vec![0.0; BOOKS * DENSITIES * COEFFICIENTS],
            squares: vec![0.0; BOOKS * DENSITIES * COEFFICIENTS],
            shares: vec![0.0; STATE_COUNT * STREAMS * DENSITIES],
            stays: vec![0.0; STATE_COUNT],
            entered: vec![0.0; STATE_COUNT],
        }
    }

    /// Adds the frames of one visit to a state.
    pub(crate) fn visit<'v>(
        &mut self,
        model: &Model,
        phone: Phone,
        state: usize,
        vectors: impl Iterator<Item = &'v [f32; NUMBERS]>,
    ) {
        let number = phone.index() * STATES + state;
        self.entered[number] += 1.0;
        for vector in vectors {
            self.stays[number] += 1.0;
            for (stream, numbers) in vector.chunks_exact(COEFFICIENTS).enumerate() {
                self.add_frame(model, phone.index() * STREAMS + stream, number * STREAMS + stream, numbers);
            }
        }
    }

    /// Adds the values of a stream in a frame. Each Gaussian gets its share in the likelihood.
    fn add_frame(&mut self, model: &Model, book: usize, weights: usize, numbers: &[f32]) {
        let mut densities = model.densities(book, numbers);
        exponentiate(&mut densities);
        let weights = weights * DENSITIES..(weights + 1) * DENSITIES;
        let parts = || densities.iter().zip(&model.weights[weights.clone()]).map(|(density, weight)| density * weight);
        let sum: f32 = parts().sum();
        if sum <= 0.0 {
            return;
        }
        let mut shares = [0.0; DENSITIES];
        for (share, part) in shares.iter_mut().zip(parts()) {
            *share = f64::from(part / sum);
        }
        add(&mut self.frames[book * DENSITIES..][..DENSITIES], &shares, 1.0);
        add(&mut self.shares[weights], &shares, 1.0);
        for (dimension, &number) in numbers.iter().enumerate() {
            let range = (book * COEFFICIENTS + dimension) * DENSITIES..;
            let number = f64::from(number);
            add(&mut self.sums[range.clone()][..DENSITIES], &shares, number);
            add(&mut self.squares[range][..DENSITIES], &shares, number * number);
        }
    }

    /// Adds the counts of `other`.
    pub(crate) fn extend(&mut self, other: &Counts) {
        for (to, from) in [
            (&mut self.frames, &other.frames),
            (&mut self.sums, &other.sums),
            (&mut self.squares, &other.squares),
            (&mut self.shares, &other.shares),
            (&mut self.stays, &other.stays),
            (&mut self.entered, &other.entered),
        ] {
            add(to, from, 1.0);
        }
    }
}

fn add(to: &mut [f64], from: &[f64], factor: f64) {
    for (to, from) in to.iter_mut().zip(from) {
        *to += from * factor;
    }
}
