//! The sections that are copied from the clips: frames, texts, source records.

use super::{ClipPlace, Layout, texts};
use crate::clip::{Clip, Clips};
use crate::parallel;

/// A part of a section, which one thread at a time copies.
struct Lane<'b> {
    part: Part,
    place: &'b mut [u8],
}

/// Which part.
enum Part {
    Frames,
    /// The texts of a locale, which start at an offset in the pool.
    Texts {
        locale: usize,
        start: usize,
    },
    Sources,
}

/// Clips that are copied before their memory is given back: some 700 kB.
const CLIPS_AT_ONCE: usize = 1024;

/// Copies what the clips of `batches` own to `places`: those of frames, texts and, if they are kept,
/// source records. Clips are copied from the last to the first and given back on the way, so that clips and bank do
/// not add up.
pub(super) fn fill(layout: &Layout, batches: Vec<Clips>, places: Vec<&mut [u8]>) {
    let mut places = places.into_iter();
    let mut lanes = Vec::new();
    lanes.extend(places.next().map(|place| Lane { part: Part::Frames, place }));
    let (mut start, mut rest) = (0, places.next().unwrap_or_default());
    for (locale, &length) in layout.texts.lengths.iter().enumerate() {
        let (place, behind) = rest.split_at_mut(length);
        lanes.push(Lane { part: Part::Texts { locale, start }, place });
        start += length;
        rest = behind;
    }
    lanes.extend(places.next().map(|place| Lane { part: Part::Sources, place }));
    let slots = batch_slots(&batches, &layout.order);
    let mut batches: Vec<(Clips, &Vec<u32>)> = std::iter::zip(batches, &slots).collect();
    // The layout has its own.
    batches.iter_mut().for_each(|(clips, _)| clips.drop_names());
    // Neighbours in the bank come from all batches: these shrink together, so that its pages are taken one by one.
    while let Some((clips, slots)) =
        batches.iter_mut().filter(|(clips, _)| clips.count() > 0).max_by_key(|(clips, _)| clips.count())
    {
        let rest = clips.count().saturating_sub(CLIPS_AT_ONCE);
        parallel::for_each(lanes.iter_mut().collect(), |lane: &mut Lane<'_>| {
            let last = std::iter::zip(clips.iter(), *slots).skip(rest);
            last.for_each(|(clip, &slot)| lane.copy(layout, &clip, slot as usize));
        });
        clips.keep_first(rest);
    }
}

/// For each batch, the slots of its clips.
fn batch_slots(batches: &[Clips], order: &[ClipPlace]) -> Vec<Vec<u32>> {
    let mut slots: Vec<Vec<u32>> = batches.iter().map(|clips| vec![0; clips.count()]).collect();
    order.iter().for_each(|place| slots[place.batch as usize][place.index as usize] = place.slot);
    slots
}

impl Lane<'_> {
    /// Copies the part of a clip. Equal texts and source records have one place, and are copied to it
    /// again.
    fn copy(&mut self, layout: &Layout, clip: &Clip<'_>, slot: usize) {
        match self.part {
            Part::Frames => {
                self.copy_to(layout.records.clips[slot].frames_offset_bytes.get() as usize, &clip.frames().bytes());
            }
            Part::Texts { locale, start } => {
                let Some(text) = clip.text_in(locale as u32) else { return };
                let segments_first = layout.records.clips[slot].segments_first.get() as usize;
                let first = locale * layout.segment_count + segments_first;
                let starts = &layout.texts.starts[first..first + clip.starts().len()];
                texts::copy(&clip.displays(text).bytes(), starts, start, self.place);
            }
            Part::Sources => self.copy_to(layout.sources.index[slot].get() as usize, &clip.source().bytes()),
        }
    }

    fn copy_to(&mut self, offset: usize, bytes: &[u8]) {
        self.place[offset..offset + bytes.len()].copy_from_slice(bytes);
    }
}
