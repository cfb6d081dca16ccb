//! Banks that hold the clips of a project between them: each clip is in the one that its id names.

use crate::{Bank, Clip, ClipId, EventName, Locale, SetIndex, Voice};
use core::fmt;
use lipz_layout::{MAX_SET_BANKS, shard_of};

/// The banks of all shards of a project, which answer as one.
///
/// A bank ends at 4 GiB. A set has up to 4096 of them, and the top bits of a clip's id say in which one it is: finding a
/// clip costs what it costs in that bank. A clip of the set is the [`Clip`] of its bank, with all of its queries. Only
/// [locales](BankSet::locale) and [names](BankSet::event_name) are others in each bank, and asked for by the clip.
///
/// ```
/// use lipz_bank::{Bank, BankSet, BankSetError, ClipId};
///
/// # fn main() -> Result<(), BankSetError> {
/// # let bytes: &[u8] = include_bytes!("../examples/act1.lipzbank");
/// # let banks = [Bank::open(bytes).unwrap()];
/// let set = BankSet::new(&banks)?.verify()?; // shard 0 first
/// let german = set.locale("de-de");
/// if let (Some(clip), Some(german)) = (set.clip(ClipId::from_key("act1/mara-good-evening")), german) {
///     let text = german.of(&clip).and_then(|german| clip.segment(0)?.text(german));
///     println!("{}", text.map_or("", |text| text.as_str()));
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy)]
pub struct BankSet<'data, 'bank> {
    banks: &'bank [Bank<'data>],
    /// What says which clips are in another bank than that of their id, if any are.
    index: Option<SetIndex<'data>>,
}

impl<'data, 'bank> BankSet<'data, 'bank> {
    /// The set of these banks, the one of shard 0 first, in which each clip is in the bank of its id.
    ///
    /// # Errors
    /// When there is no bank, or there are more than 4096.
    pub fn new(banks: &'bank [Bank<'data>]) -> Result<BankSet<'data, 'bank>, BankSetError> {
        if banks.is_empty() || banks.len() > MAX_SET_BANKS {
            return Err(BankSetError::Count);
        }
        Ok(BankSet { banks, index: None })
    }

    /// The set of the banks that an index names, in its order. Finding a clip costs what it costs without; only a dub that is
    /// asked for by itself costs a search in the index, because it is in the bank of its original.
    ///
    /// # Errors
    /// When these are not the banks that the index names.
    pub fn with_index(
        banks: &'bank [Bank<'data>],
        index: &SetIndex<'data>,
    ) -> Result<BankSet<'data, 'bank>, BankSetError> {
        if banks.len() != index.bank_count() {
            return Err(BankSetError::Count);
        }
        let differs = |(bank, entry): (&Bank<'_>, crate::SetBank<'_>)| !entry.is_of(bank);
        if let Some(bank) = banks.iter().zip(index.banks()).position(differs) {
            return Err(BankSetError::OtherBank { bank });
        }
        Ok(BankSet { banks, index: Some(*index).filter(|index| index.moved_count() > 0) })
    }

    /// Checks that each clip is where it is looked for, in the bank of its id or in the one that the index names: elsewhere it
    /// is never found. Reads all ids. Banks and index are [verified](Bank::verify) on their own.
    ///
    /// # Errors
    /// When a bank has a clip of another one: the banks are in another order, or one is missing.
    pub fn verify(self) -> Result<BankSet<'data, 'bank>, BankSetError> {
        for (place, bank) in self.banks.iter().enumerate() {
            for record in bank.keys {
                if self.place(record.id.get()) != place {
                    return Err(BankSetError::OtherShard { bank: place });
                }
            }
        }
        Ok(self)
    }

    /// The bank that a clip is in, if that is not the one of its id.
    fn moved_to(&self, id: u64) -> Option<usize> {
        self.index?.moved_to(id)
    }

    /// The banks.
    pub const fn banks(&self) -> &'bank [Bank<'data>] {
        self.banks
    }

    /// The number of clips in all banks.
    pub fn clip_count(&self) -> usize {
        self.banks.iter().fold(0, |count, bank| count.saturating_add(bank.clip_count()))
    }

    /// The place of the bank that has the clips with this id's top bits.
    #[inline]
    fn shard(&self, id: u64) -> usize {
        shard_of(id, self.banks.len() as u32) as usize
    }

    /// The place of the bank that has the clip with this id.
    fn place(&self, id: u64) -> usize {
        self.moved_to(id).unwrap_or_else(|| self.shard(id))
    }

    /// The bank that has the clip with this id, if any has it.
    #[inline]
    pub fn bank_of(&self, id: ClipId) -> Option<&'bank Bank<'data>> {
        self.banks.get(self.place(id.get()))
    }

    /// The clip with this id: looked for in one bank.
    #[inline]
    pub fn clip(&self, id: ClipId) -> Option<Clip<'data, 'bank>> {
        match self.banks.get(self.shard(id.get()))?.clip(id) {
            None if self.index.is_some() => self.moved_clip(id),
            found => found,
        }
    }

    /// The clip with this id, if it is not in the bank of its id.
    #[cold]
    fn moved_clip(&self, id: ClipId) -> Option<Clip<'data, 'bank>> {
        self.banks.get(self.moved_to(id.get())?)?.clip(id)
    }

    /// The clip with this key, compared whole.
    #[inline]
    pub fn clip_by_key(&self, key: &str) -> Option<Clip<'data, 'bank>> {
        let id = ClipId::from_key(key);
        match self.banks.get(self.shard(id.get()))?.clip_with_key(id, key) {
            None if self.index.is_some() => self.moved_clip(id).filter(|clip| clip.key() == key),
            found => found,
        }
    }

    /// All clips, one bank after the other, those of each in the order of their keys.
    pub fn clips(&self) -> impl Iterator<Item = Clip<'data, 'bank>> {
        self.banks.iter().flat_map(Bank::clips)
    }

    /// The clips whose keys start with `prefix`, in the same order.
    pub fn clips_under<'prefix>(&self, prefix: &'prefix str) -> impl Iterator<Item = Clip<'data, 'bank>> + 'prefix
    where
        'bank: 'prefix,
    {
        self.banks.iter().flat_map(move |bank| bank.clips_under(prefix))
    }

    /// The locale with this tag, spelled as in the banks (`en-us`), if any has it. Look it up once.
    pub fn locale(&self, tag: &str) -> Option<SetLocale<'data>> {
        self.banks.iter().find_map(|bank| {
            let place = bank.locales().position(|locale| locale.tag() == tag)?;
            SetLocale::new(bank, place)
        })
    }

    /// The default locale: that of the first bank that has one.
    pub fn default_locale(&self) -> Option<SetLocale<'data>> {
        self.banks.iter().find_map(|bank| {
            let place = bank.locales().position(|locale| locale.is_default())?;
            SetLocale::new(bank, place)
        })
    }

    /// The voice in this locale, spelled as in the banks (`de-de`), if any has dubs in it, or originals with dubs.
    pub fn voice(&self, tag: &str) -> Option<SetVoice<'data>> {
        self.banks.iter().find_map(|bank| bank.voice(tag)).map(|voice| SetVoice { tag: voice.tag() })
    }

    /// The name that events mention, spelled as there (`amy`); `None` if no event of any bank does.
    pub fn event_name(&self, name: &str) -> Option<SetName<'data>> {
        self.banks.iter().find_map(|bank| bank.event_name(name)).map(|name| SetName { name: name.as_str() })
    }
}

/// The banks.
impl fmt::Debug for BankSet<'_, '_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("BankSet").field(&self.banks).finish()
    }
}

/// A locale of a [`BankSet`]: its tag, and where it mostly is. Each bank has a [`Locale`] of its own for it.
#[derive(Clone, Copy, Debug)]
pub struct SetLocale<'data> {
    tag: &'data str,
    /// The place in the first bank that has it: all banks of one project have the same locales.
    place: usize,
}

impl<'data> SetLocale<'data> {
    fn new(bank: &Bank<'data>, place: usize) -> Option<SetLocale<'data>> {
        Some(SetLocale { tag: bank.locales().nth(place)?.tag(), place })
    }

    /// The tag, as in `text_en-us` of a Lipz file: `en-us`.
    pub const fn tag(&self) -> &'data str {
        self.tag
    }

    /// The locale in the bank of this clip, for its segments; `None` if that bank has no texts in it.
    #[inline]
    pub fn of<'other>(&self, clip: &Clip<'other, '_>) -> Option<Locale<'other>> {
        let bank = clip.bank;
        let there = bank.texts.at(bank.origin(), self.place);
        there.filter(|locale| locale.tag() == self.tag).or_else(|| bank.locale(self.tag))
    }
}

/// Equal are locales with equal tags.
impl PartialEq for SetLocale<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.tag == other.tag
    }
}
impl Eq for SetLocale<'_> {}

/// A name in the events of a [`BankSet`]: each bank numbers names on its own.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct SetName<'data> {
    name: &'data str,
}

impl SetName<'_> {
    /// The name in the bank of the clip, to be compared with the names in its events, or set as the
    /// [speaker](crate::Cursor::with_speaker); `None` if that bank does not mention it.
    pub fn of<'other>(&self, clip: &Clip<'other, '_>) -> Option<EventName<'other>> {
        clip.bank.event_name(self.name)
    }
}

/// A voice of a [`BankSet`]: each bank with dubs has a [`Voice`] of its own for it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct SetVoice<'data> {
    tag: &'data str,
}

impl<'data> SetVoice<'data> {
    /// The locale of the voice: `de-de`.
    pub const fn tag(&self) -> &'data str {
        self.tag
    }

    /// The voice in the bank of the clip, for [`Clip::in_voice`]; `None` if that bank has no dubs: play the clip as it is.
    pub fn of<'other>(&self, clip: &Clip<'other, '_>) -> Option<Voice<'other>> {
        clip.bank.voice(self.tag)
    }
}

/// Why banks are no set.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub enum BankSetError {
    /// There is no bank, or there are more than 4096, or not as many as the index names.
    Count,
    /// A bank is not the one that the index names.
    OtherBank {
        /// Its place among the banks.
        bank: usize,
    },
    /// A bank has a clip that belongs into another one.
    OtherShard {
        /// Its place among the banks.
        bank: usize,
    },
}

impl fmt::Display for BankSetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BankSetError::Count => f.write_str("a set has 1 to 4096 banks, as many as its index names"),
            BankSetError::OtherBank { bank } => write!(f, "bank {bank} is not the one that the index of the set names"),
            BankSetError::OtherShard { bank } => {
                write!(
                    f,
                    "bank {bank} of the set has a clip of another one: name the banks of all shards, in their order"
                )
            }
        }
    }
}

#[cfg(feature = "std")]
impl std::error::Error for BankSetError {}
