//! All clips of a stack in the order of their keys.

use super::{LayeredClip, Layers};
use crate::{Clip, Clips};
use core::fmt;
use core::iter::FusedIterator;

/// Clips of [`Layers`] in the order of their keys, each once, without those that a layer removes.
#[derive(Clone)]
pub struct LayeredClips<'data, 'bank, const N: usize> {
    layers: &'bank Layers<'data, N>,
    /// What is left of each layer, with the next clip taken out.
    left: [Option<(Clip<'data, 'bank>, Clips<'data, 'bank>)>; N],
}

impl<'data, 'bank, const N: usize> LayeredClips<'data, 'bank, N> {
    pub(super) fn new(layers: &'bank Layers<'data, N>, prefix: &str) -> Self {
        let mut left = [(); N].map(|()| None);
        for (left, layer) in left.iter_mut().zip(layers.all()) {
            let mut clips = layer.bank.clips_under(prefix);
            *left = clips.next().map(|first| (first, clips));
        }
        LayeredClips { layers, left }
    }
}

impl<'data, 'bank, const N: usize> Iterator for LayeredClips<'data, 'bank, N> {
    type Item = LayeredClip<'data, 'bank>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let next = self.left.iter().flatten().map(|(clip, _)| clip).min_by_key(|clip| clip.key())?;
            let (id, key) = (next.id(), next.key());
            for left in &mut self.left {
                // A damaged bank may have keys that do not ascend: each step takes one clip at least all the same.
                if let Some((clip, clips)) = left {
                    if clip.key() == key {
                        *left = clips.next().map(|next| (next, clips.clone()));
                    }
                }
            }
            if let Some(clip) = self.layers.clip(id) {
                return Some(clip);
            }
        }
    }
}

impl<const N: usize> FusedIterator for LayeredClips<'_, '_, N> {}

/// The clips that are left.
impl<const N: usize> fmt::Debug for LayeredClips<'_, '_, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.clone().map(|clip| clip.key())).finish()
    }
}
