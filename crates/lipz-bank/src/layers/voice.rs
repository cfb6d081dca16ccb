//! Which clips of a stack are dubs of which others, whoever keeps its banks.

use crate::{Bank, ClipId, Spoken};
use lipz_layout::{DUB_OF, LAYER_DUB, LAYER_DUB_OF, LAYER_NO_DUB, LAYER_OTHER_DUB, LayerDubRecord, OTHER_DUB};

/// Who keeps the banks of a stack: [`Layers`](crate::Layers), or a program that cannot.
pub trait Stacked<'data> {
    /// The bank with this index, 0 for the base; `None` behind the topmost.
    fn bank_at(&self, at: usize) -> Option<Bank<'data>>;

    /// The number of segments of the clip that the stack has with this id.
    fn segment_count(&self, id: ClipId) -> Option<u32>;
}

/// What a bank says about a clip in a voice.
enum Entry {
    /// Nothing is played for it.
    Nothing,
    Dub(ClipId),
    /// The dub in another voice.
    OtherDub(ClipId),
    DubOf(ClipId),
}

/// Whether the entry of a layer is one, whichever clips it is about.
pub(super) fn is_entry(dub: &LayerDubRecord) -> bool {
    match dub.kind.get() {
        LAYER_NO_DUB => dub.other_id.get() == 0,
        LAYER_DUB | LAYER_DUB_OF | LAYER_OTHER_DUB => dub.other_id != dub.clip_id,
        _ => false,
    }
}

/// The tags of the voices of a stack, that of the originals first, then the others in the order of their tags: those of all
/// banks from the topmost one that says which there are.
pub fn voice_tags<'data, S: Stacked<'data>>(stack: &S) -> VoiceTags<'data, '_, S> {
    let mut tags = VoiceTags { stack, first: 0, original: "", last: None };
    let mut at = 0_usize;
    while let Some(bank) = stack.bank_at(at) {
        if bank.layer().map_or(false, |layer| layer.has_voices()) {
            tags = VoiceTags { first: at, original: "", ..tags };
        }
        tags.original = tags_of(&bank, at).next().unwrap_or(tags.original);
        at = at.saturating_add(1);
    }
    tags
}

/// The tags that a bank lists.
fn tags_of<'data>(bank: &Bank<'data>, at: usize) -> impl Iterator<Item = &'data str> {
    let of_base = if at == 0 { Some(bank.voices().map(|voice| voice.tag())) } else { None };
    let of_layer = bank.layer().filter(|_| at > 0).map(|layer| layer.voices());
    of_base.into_iter().flatten().chain(of_layer.into_iter().flatten())
}

/// The tags of the voices of a stack.
#[derive(Clone, Debug)]
pub struct VoiceTags<'data, 'stack, S> {
    stack: &'stack S,
    /// The lowest bank whose list counts.
    first: usize,
    original: &'data str,
    /// The one before.
    last: Option<&'data str>,
}

impl<'data, S: Stacked<'data>> Iterator for VoiceTags<'data, '_, S> {
    type Item = &'data str;

    fn next(&mut self) -> Option<&'data str> {
        if self.original.is_empty() {
            return None;
        }
        let last = match self.last {
            None => {
                self.last = Some("");
                return Some(self.original);
            }
            Some(last) => last,
        };
        // Each list is in order: the next tag is the least of those behind the last one.
        let mut next: Option<&'data str> = None;
        let mut at = self.first;
        while let Some(bank) = self.stack.bank_at(at) {
            let others = tags_of(&bank, at).skip(1).filter(|tag| *tag > last && *tag != self.original);
            next = others.chain(next).min();
            at = at.saturating_add(1);
        }
        self.last = next.or(self.last);
        next
    }
}

/// The clip of which the one with this id is a dub, and the voice; `None` if it is none. A dub is none of another dub, and has
/// as many segments as its original: layers that do not know each other can say otherwise.
pub fn original_of<'data>(stack: &impl Stacked<'data>, id: ClipId) -> Option<(&'data str, ClipId)> {
    let (voice, original) = said_original(stack, id)?;
    let segment_count = stack.segment_count(original)?;
    let fits = stack.segment_count(id) == Some(segment_count) && said_original(stack, original).is_none();
    if fits { Some((voice, original)) } else { None }
}

/// The clip of which banks say that the one with this id is a dub.
fn said_original<'data>(stack: &impl Stacked<'data>, id: ClipId) -> Option<(&'data str, ClipId)> {
    for voice in voice_tags(stack).skip(1) {
        let mut at = top(stack);
        while let Some(below) = at.checked_sub(1) {
            at = below;
            match entry(stack, at, id, voice) {
                Ok(Some(Entry::DubOf(original))) => return Some((voice, original)),
                Ok(None) => {}
                Ok(Some(_)) | Err(NoVoice) => break,
            }
        }
    }
    None
}

/// The clip that is played in a voice for the original with this id; `None` if the original is. The dub counts wherever it is;
/// of those in other voices, that of the topmost layer.
pub fn played_in<'data>(stack: &impl Stacked<'data>, original: ClipId, voice: &str) -> Option<(ClipId, Spoken)> {
    let mut other: Option<ClipId> = None;
    let mut at = top(stack);
    while let Some(below) = at.checked_sub(1) {
        at = below;
        match entry(stack, at, original, voice) {
            Ok(Some(Entry::Dub(dub))) => {
                if original_of(stack, dub) == Some((voice, original)) {
                    return Some((dub, Spoken::Dub));
                }
            }
            Ok(Some(Entry::OtherDub(dub))) => {
                if original_of(stack, dub).map_or(false, |(_, of)| of == original) {
                    other = other.or(Some(dub));
                }
            }
            Ok(None) => {}
            Ok(Some(Entry::Nothing | Entry::DubOf(_))) | Err(NoVoice) => break,
        }
    }
    other.map(|dub| (dub, Spoken::OtherDub))
}

/// The number of banks.
fn top<'data>(stack: &impl Stacked<'data>) -> usize {
    let mut count = 0_usize;
    while stack.bank_at(count).is_some() {
        count = count.saturating_add(1);
    }
    count
}

/// The voice is none of a layer that says which there are: what is said below does not count.
struct NoVoice;

/// What the bank with this index says about a clip in a voice, if it says something.
fn entry<'data>(stack: &impl Stacked<'data>, at: usize, id: ClipId, voice: &str) -> Result<Option<Entry>, NoVoice> {
    let bank = match stack.bank_at(at) {
        Some(bank) => bank,
        None => return Ok(None),
    };
    let layer = match bank.layer() {
        Some(layer) if at > 0 => layer,
        _ => return Ok(in_base(&bank, id, voice)),
    };
    let number = match (layer.voices().skip(1).position(|tag| tag == voice), layer.has_voices()) {
        (Some(place), _) => place.saturating_add(1),
        (None, true) => return Err(NoVoice),
        (None, false) => return Ok(None),
    };
    let place = (id.get(), number);
    let found = layer.dubs.binary_search_by(|dub| (dub.clip_id.get(), usize::from(dub.voice.get())).cmp(&place));
    let dub = found.ok().and_then(|found| layer.dubs.get(found));
    Ok(dub.map(|dub| {
        let other = ClipId::from_u64(dub.other_id.get());
        match dub.kind.get() {
            LAYER_DUB => Entry::Dub(other),
            LAYER_OTHER_DUB => Entry::OtherDub(other),
            LAYER_DUB_OF => Entry::DubOf(other),
            _ => Entry::Nothing,
        }
    }))
}

/// The same in the base, which says it by slots.
fn in_base(base: &Bank<'_>, id: ClipId, voice: &str) -> Option<Entry> {
    let voice = base.voice(voice)?;
    let entry = voice.entry(base.find(id)?.0);
    let other = base.clip_at(entry & !(DUB_OF | OTHER_DUB))?.id();
    Some(match (entry & DUB_OF != 0, entry & OTHER_DUB != 0) {
        (true, _) => Entry::DubOf(other),
        (false, true) => Entry::OtherDub(other),
        (false, false) => Entry::Dub(other),
    })
}
