//! The phones of a sound, or of parts of it, whatever is said there.

use super::emission::{self, Emissions};
use super::history::Step;
use super::{AlignedPhone, phones, quiet, steady, time};
use crate::features::cepstra::Vectors;
use crate::{Model, Phone, Sound};
use std::ops::Range;

/// A sound without a script.
pub(super) struct Loose<'s> {
    model: &'s Model,
    /// The vectors from frame `next` on.
    vectors: Vectors<'s>,
    next: usize,
    duration_us: u64,
    quiet: Vec<bool>,
    /// By frame: whether nobody can speak there: the sound does not change, or it is deep inside of a quiet stretch.
    still: Vec<bool>,
    /// Is told every now and then how many frames of a part are done.
    tell: Option<&'s dyn Fn(usize)>,
}

impl<'s> Loose<'s> {
    pub(super) fn new(model: &'s Model, sound: &'s Sound) -> Loose<'s> {
        let vectors = Vectors::new(sound.spectrum());
        let quiet = quiet::quiet(sound.spectrum());
        let (steady, deep) = (steady::steady(vectors.clone()), quiet::deep(&quiet));
        let still = steady.iter().zip(&deep).map(|(steady, deep)| steady | deep).collect();
        Loose { model, vectors, next: 0, duration_us: sound.duration_us(), quiet, still, tell: None }
    }

    /// Tells every now and then how many frames of a part are done.
    pub(super) fn telling(self, tell: Option<&'s dyn Fn(usize)>) -> Loose<'s> {
        Loose { tell, ..self }
    }

    /// The phones that are heard in these frames, which are all of `place`. Frames come in order: time is that of all frames
    /// once, however many parts are asked for.
    pub(super) fn phones(&mut self, frames: Range<usize>, place: &AlignedPhone) -> Vec<AlignedPhone> {
        self.vectors.by_ref().take(frames.start - self.next).for_each(drop);
        self.next = frames.start;
        let vectors = || self.vectors.clone().take(frames.len());
        let (quiet, still) = (&self.quiet[frames.clone()], &self.still[frames.clone()]);
        let mut emissions = Emissions::new(self.model, vectors(), quiet.to_vec()).telling(self.tell);
        let steps = phones::likely_phones(self.model, &mut emissions, still);
        let phone = |step: &Step| Phone::ALL.get(step.node).copied().unwrap_or(Phone::Sil);
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
