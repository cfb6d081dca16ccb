//! Layers: a bank with patches, downloads and mods over it, which answer as one.

mod clip;
mod clips;
mod error;
mod locale;
mod table;
mod voice;
mod voiced;

pub use clip::LayeredClip;
pub use clips::LayeredClips;
pub use error::LayersError;
pub use locale::{LayeredLocale, LayeredName};
pub use table::Layer;
pub use voice::{Stacked, VoiceTags, original_of, played_in, voice_tags};
pub use voiced::{LayeredVoice, LayeredVoicedClip};

use crate::{Babble, Bank, ClipId, Error, ErrorKind, FaceProfile};
use core::fmt;
use lipz_layout::{LAYER_BABBLE, LAYER_FACES, U64};
use table::may_have;

/// A bank and the layers over it, the topmost of which answers.
///
/// A *layer* is a bank that `lipz pack --over` made: a patch, a download, a mod. It has what is new or changed, and
/// says what it removes. The stack answers as the bank would that was packed with all of it in one go. Clip ids are the
/// same, and a [`Cursor`](crate::Cursor) plays a [`LayeredClip`] as any clip.
///
/// ```
/// use lipz_bank::{Bank, ClipId, Layers, Micros};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let base: &[u8] = include_bytes!("../../examples/act1.lipzbank");
/// let layers = Layers::new([Bank::open(base)?.verify()?])?; // and patches: [base, patch, mod]
/// let german = layers.locale("de-de").ok_or("no German")?;
/// let clip = layers.clip(ClipId::from_key("act1/mara-good-evening")).ok_or("no such clip")?;
/// let segment = clip.segment_at(Micros(500_000)).ok_or("silence")?;
/// assert_eq!(clip.text(segment.index(), &german).map(|text| text.as_str()), Some("Guten Abend, Otto."));
/// # Ok(())
/// # }
/// ```
///
/// `N` is the number of banks. A program that finds out how many there are has room for as many as it allows:
/// [`Layers::from_slice`].
#[derive(Clone, Copy)]
pub struct Layers<'data, const N: usize> {
    /// Those behind `count` are never looked at.
    layers: [Placed<'data>; N],
    count: usize,
    /// For each layer the bits of the ids that it says something about; for the base, and where there is none, no bits. They are
    /// together, and as many as there can be, so that looking whether any layer counts is no loop.
    filters: [&'data [U64]; N],
}

/// The filter of what says nothing about any id.
const NO_BITS: [U64; 1] = [U64::ZERO];

/// A bank of a stack.
#[derive(Clone, Copy)]
struct Placed<'data> {
    bank: Bank<'data>,
    /// [`Layer::NONE`] for the base.
    table: Layer<'data>,
}

/// Where a clip is: the layer in the upper half, the slot in the lower one. Two of them fit into registers.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Place(u64);

impl Place {
    /// Of a clip that no layer has.
    const NONE: Place = Place(u64::MAX);

    #[inline]
    const fn new(layer: usize, slot: u32) -> Place {
        Place((layer as u64) << 32 | slot as u64)
    }

    #[inline]
    const fn layer(self) -> u32 {
        (self.0 >> 32) as u32
    }

    #[inline]
    const fn slot(self) -> u32 {
        self.0 as u32
    }
}

/// Where a clip of a stack is, and where its texts are: mostly the same.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Places {
    clip: Place,
    texts: Place,
}

impl<'data, const N: usize> Layers<'data, N> {
    /// The stack of these banks, the base first, each over those before it.
    ///
    /// A layer fits if the banks that it was made over are below it, in their order. Others may lie between: a mod of the
    /// base goes over its patch, too. Takes time in proportion to what layers say about the banks below them.
    ///
    /// # Errors
    /// When a layer was made over other banks than those below it (its kind is [`ErrorKind::OtherBase`]), when a bank above
    /// the first is not a layer, or what one says about the banks below it is not valid.
    pub fn new(banks: [Bank<'data>; N]) -> Result<Layers<'data, N>, LayersError> {
        Layers::from_slice(&banks)
    }

    /// Like [`Layers::new`], for at most `N` banks.
    ///
    /// # Errors
    /// As for [`Layers::new`], and when there are no banks or more than `N`.
    pub fn from_slice(banks: &[Bank<'data>]) -> Result<Layers<'data, N>, LayersError> {
        let at_start = |kind| Error::new(kind, 0);
        let first = match banks.first() {
            Some(first) if banks.len() <= N => *first,
            _ => return Err(LayersError::new(banks.len(), at_start(ErrorKind::LayerCount))),
        };
        let mut layers = [Placed { bank: first, table: Layer::NONE }; N];
        let mut filters: [&[U64]; N] = [&NO_BITS; N];
        for (at, ((layer, filter), bank)) in layers.iter_mut().zip(&mut filters).zip(banks).enumerate() {
            let table = bank.verified_layer().map_err(|error| LayersError::new(at, error))?.unwrap_or(Layer::NONE);
            *layer = Placed { bank: *bank, table };
            let below = banks.get(..at).unwrap_or(&[]);
            if at > 0 && table.bases.is_empty() {
                return Err(LayersError::new(at, at_start(ErrorKind::NotALayer)));
            }
            if at > 0 {
                *filter = table.filter;
            }
            let mut found = below.iter();
            // Each is looked for above the one before it.
            if !table.bases.iter().all(|base| found.any(|bank| bank.checksum() == base.get())) {
                return Err(LayersError::new(at, at_start(ErrorKind::OtherBase)));
            }
        }
        Ok(Layers { layers, count: banks.len(), filters })
    }

    /// The layers, the base first.
    #[inline]
    fn all(&self) -> &[Placed<'data>] {
        self.layers.get(..self.count).unwrap_or(&[])
    }

    /// The number of banks.
    pub const fn layer_count(&self) -> usize {
        self.count
    }

    /// The bank with this index, 0 for the base.
    pub fn bank(&self, layer: usize) -> Option<&Bank<'data>> {
        Some(&self.all().get(layer)?.bank)
    }

    /// The clip with this id, of the topmost layer that has it; `None` if none does, or one above removes it.
    #[cfg_attr(target_pointer_width = "64", inline(always))] // otherwise the whole clip is copied for the call
    #[cfg_attr(not(target_pointer_width = "64"), inline)]
    pub fn clip(&self, id: ClipId) -> Option<LayeredClip<'data, '_>> {
        let base = &self.layers.first()?.bank;
        let (places, bank, texts) = if self.filters.iter().skip(1).any(|filter| may_have(filter, id)) {
            let places = self.places(id);
            let bank = |place: Place| self.bank(place.layer() as usize);
            (places, bank(places.clip)?, bank(places.texts))
        } else {
            let place = Place::new(0, base.find(id)?.0);
            (Places { clip: place, texts: place }, base, Some(base))
        };
        Some(LayeredClip::new(bank.clip_at(places.clip.slot())?, places, texts))
    }

    /// Where the clip with this id is, about which a layer may say something: the filters let few ids through that are not
    /// those of their layers.
    #[cold]
    #[inline(never)]
    fn places(&self, id: ClipId) -> Places {
        let mut places = Places { clip: Place::NONE, texts: Place::NONE };
        let mut has_texts_of_original = false;
        for (at, layer) in self.all().iter().enumerate().rev() {
            if !layer.table.may_have(id) {
                continue;
            }
            let slot = match layer.bank.find(id) {
                Some((slot, _)) => slot,
                None if layer.table.removes(id) => break,
                None => continue,
            };
            let place = Place::new(at, slot);
            let (has_clip, has_texts) = layer.table.parts(slot);
            if has_texts && places.texts == Place::NONE && !has_texts_of_original {
                places.texts = place;
            }
            if has_clip && places.clip == Place::NONE {
                places.clip = place;
            }
            has_texts_of_original |= places.texts == Place::NONE && layer.table.has_texts_of_original(slot);
            if places.clip != Place::NONE && (places.texts != Place::NONE || has_texts_of_original) {
                break;
            }
        }
        if has_texts_of_original {
            let original = original_of(self, id);
            places.texts = original.map_or(Place::NONE, |(_, original)| self.own_texts(original));
        }
        places
    }

    /// Where the texts of the clip with this id are, if it has its own.
    fn own_texts(&self, id: ClipId) -> Place {
        for (at, layer) in self.all().iter().enumerate().rev() {
            match layer.bank.find(id) {
                Some((slot, _)) if layer.table.parts(slot).1 => return Place::new(at, slot),
                Some((slot, _)) if layer.table.has_texts_of_original(slot) => return Place::NONE,
                None if layer.table.removes(id) => return Place::NONE,
                _ => {}
            }
        }
        Place::NONE
    }

    /// The clip with this key, compared whole.
    pub fn clip_by_key(&self, key: &str) -> Option<LayeredClip<'data, '_>> {
        self.clip(ClipId::from_key(key)).filter(|clip| clip.key() == key)
    }

    /// All clips in the order of their keys.
    pub fn clips(&self) -> LayeredClips<'data, '_, N> {
        LayeredClips::new(self, "")
    }

    /// The clips whose keys start with `prefix`, in the order of their keys.
    pub fn clips_under(&self, prefix: &str) -> LayeredClips<'data, '_, N> {
        LayeredClips::new(self, prefix)
    }

    /// The babble profile with this name: of the topmost layer that says something about profiles.
    pub fn babble(&self, name: &str) -> Option<Babble<'data>> {
        self.of_babble()?.babble(name)
    }

    /// The profile of the project; [`Babble::DEFAULT`] if it has none.
    pub fn default_babble(&self) -> Babble<'data> {
        self.of_babble().map_or(Babble::DEFAULT, Bank::default_babble)
    }

    /// The bank whose babble profiles count.
    pub fn of_babble(&self) -> Option<&Bank<'data>> {
        self.that_says(LAYER_BABBLE)
    }

    /// The face profile with this name: of the topmost layer that says something about profiles.
    pub fn face_profile(&self, name: &str) -> Option<FaceProfile<'data>> {
        self.of_faces()?.face_profile(name)
    }

    /// The face profile of the project; [`FaceProfile::DEFAULT`] if it has none.
    pub fn default_face_profile(&self) -> FaceProfile<'data> {
        self.of_faces().map_or(FaceProfile::DEFAULT, Bank::default_face_profile)
    }

    /// The bank whose face profiles count.
    pub fn of_faces(&self) -> Option<&Bank<'data>> {
        self.that_says(LAYER_FACES)
    }

    /// The topmost layer with this flag, or the base.
    fn that_says(&self, flag: u32) -> Option<&Bank<'data>> {
        let says = self.all().iter().rev().find(|layer| layer.table.has(flag)).or(self.all().first())?;
        Some(&says.bank)
    }
}

/// The banks, not their bytes.
impl<const N: usize> fmt::Debug for Layers<'_, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.all().iter().map(|layer| &layer.bank)).finish()
    }
}
