//! The sections that are copied from the clips: frames, texts, source records.

use super::{ClipPlace, Layout, texts};
use crate::clip::{Clip, Clips};
use crate::util::parallel;

/// A part of a section that one thread copies at a time.
struct Lane<'b> {
    part: PartKind,
    place: &'b mut [u8],
}

/// The kind of a part.
enum PartKind {
    Frames,
    /// The texts of a locale, which start at an offset in the pool.
    Texts {
        locale: usize,
        start: usize,
    },
    Sources,
}

/// The number of clips to copy before their memory is freed, about 700 kB.
const CLIPS_AT_ONCE: usize = 1024;

/// Copies the content of the clips in `batches` to `places`: frames, texts and, if kept, source records. Clips are
/// copied from the last to the first and freed in between, so that the memory of clips and bank does not add up.
pub(super) fn fill(layout: &Layout, batches: Vec<Clips>, places: Vec<&mut [u8]>) {
    let mut places = places.into_iter();
    let mut lanes = Vec::new();
    lanes.extend(places.next().map(|place| Lane { part: PartKind::Frames, place }));
    let (mut start, mut rest) = (0, places.next().unwrap_or_default());
    for (locale, &length) in layout.texts.lengths.iter().enumerate() {
        let (place, behind) = rest.split_at_mut(length);
        lanes.push(Lane { part: PartKind::Texts { locale, start }, place });
        start += length;
        rest = behind;
    }
    lanes.extend(places.next().map(|place| Lane { part: PartKind::Sources, place }));
    let slots = batch_slots(&batches, &layout.order);
    let mut batches: Vec<(Clips, &Vec<u32>)> = std::iter::zip(batches, &slots).collect();
    // The layout has its own names.
    batches.iter_mut().for_each(|(clips, _)| clips.drop_names());
    // Neighbours in the bank come from all batches. Shrinking these together touches the pages of the bank in sequence.
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

/// Returns the slots of the clips of each batch.
fn batch_slots(batches: &[Clips], order: &[ClipPlace]) -> Vec<Vec<u32>> {
    let mut slots: Vec<Vec<u32>> = batches.iter().map(|clips| vec![0; clips.count()]).collect();
    order.iter().for_each(|place| slots[place.batch as usize][place.index as usize] = place.slot);
    slots
}

impl Lane<'_> {
    /// Copies the part of a clip. Equal texts and source records share one position, and are copied to it again.
    fn copy(&mut self, layout: &Layout, clip: &Clip<'_>, slot: usize) {
        match self.part {
            PartKind::Frames => {
                self.copy_to(layout.records.clips[slot].frames_offset_bytes.get() as usize, &clip.frames().bytes());
            }
            PartKind::Texts { locale, start } => {
                let Some(text) = clip.text_in(locale as u32) else { return };
                let segments_first = layout.records.clips[slot].segments_first.get() as usize;
                let first = locale * layout.segment_count + segments_first;
                let starts = &layout.texts.starts[first..first + clip.starts().len()];
                texts::copy(&clip.displays(text).bytes(), starts, start, self.place);
            }
            PartKind::Sources => self.copy_to(layout.sources.index[slot].get() as usize, &clip.source().bytes()),
        }
    }

    fn copy_to(&mut self, offset: usize, bytes: &[u8]) {
        self.place[offset..offset + bytes.len()].copy_from_slice(bytes);
    }
}
