//! Recognition of phones without a script, in a whole recording or parts of it.

use super::emission::{self, Emissions};
use super::history::PathStep;
use super::{AlignedPhone, phones, quiet, steady, time};
use crate::features::cepstra::Vectors;
use crate::features::warp::Warp;
use crate::{Model, Phone, Sound};
use std::ops::Range;

/// A recording without a script.
pub(super) struct LooseAligner<'s> {
    model: &'s Model,
    /// The vectors from frame `next` on.
    vectors: Vectors<'s>,
    next: usize,
    duration_us: u64,
    quiet: Vec<bool>,
    /// By frame: whether it cannot be speech, because the audio does not change or is deep inside a quiet stretch.
    still: Vec<bool>,
    /// Receives the number of processed frames of a part at intervals.
    tell: Option<&'s dyn Fn(usize)>,
}

impl<'s> LooseAligner<'s> {
    pub(super) fn new(model: &'s Model, sound: &'s Sound, warp: Warp) -> LooseAligner<'s> {
        let vectors = Vectors::new(sound.spectrum(), warp);
        let quiet = quiet::quiet(sound.spectrum());
        let (steady, deep) = (steady::steady(vectors.clone()), quiet::deep(&quiet));
        let still = steady.iter().zip(&deep).map(|(steady, deep)| steady | deep).collect();
        LooseAligner { model, vectors, next: 0, duration_us: sound.duration_us(), quiet, still, tell: None }
    }

    /// Reports the number of processed frames of a part to `tell` at intervals.
    pub(super) fn telling(self, tell: Option<&'s dyn Fn(usize)>) -> LooseAligner<'s> {
        LooseAligner { tell, ..self }
    }

    /// Returns the phones in these frames, which are all frames of `place`. Call with ascending frames. The total time
    /// is that of one pass over all frames, for any number of parts.
    pub(super) fn phones(&mut self, frames: Range<usize>, place: &AlignedPhone) -> Vec<AlignedPhone> {
        self.vectors.by_ref().take(frames.start - self.next).for_each(drop);
        self.next = frames.start;
        let vectors = || self.vectors.clone().take(frames.len());
        let (quiet, still) = (&self.quiet[frames.clone()], &self.still[frames.clone()]);
        let mut emissions = Emissions::new(self.model, vectors(), quiet.to_vec()).telling(self.tell);
        let steps = phones::likely_phones(self.model, &mut emissions, still);
        let phone = |step: &PathStep| Phone::ALL.get(step.node).copied().unwrap_or(Phone::Sil);
        let fits = emission::fits(self.model, vectors(), &emissions.best, phone, &steps);
        let starts: Vec<f64> = steps.iter().map(|step| (frames.start + step.start) as f64).collect();
        let times = time::of_starts(&starts, frames.end, self.duration_us);
        let mut start_us = place.start_us;
        let mut phones = Vec::with_capacity(steps.len());
        for ((step, (_, end_us)), &fit) in steps.iter().zip(times).zip(&fits) {
            let end_us = end_us.min(place.end_us);
            if end_us > start_us {
                phones.push(AlignedPhone { phone: phone(step), start_us, end_us, word: None, fit });
                start_us = end_us;
            }
        }
        match phones.last_mut() {
            Some(last) => last.end_us = place.end_us,
            None => phones.push(*place),
        }
        phones
    }
}
