//! Banks that hold the clips of a project between them: each clip is in the one that its id names.

use crate::{Bank, Clip, ClipId, EventName, Locale};
use core::fmt;
use lipz_layout::shard_of;

/// The most banks of a set.
const MOST_BANKS: usize = 4096;

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
}

impl<'data, 'bank> BankSet<'data, 'bank> {
    /// The set of these banks, the one of shard 0 first.
    ///
    /// # Errors
    /// When there is no bank, or there are more than 4096.
    pub fn new(banks: &'bank [Bank<'data>]) -> Result<BankSet<'data, 'bank>, BankSetError> {
        if banks.is_empty() || banks.len() > MOST_BANKS {
            return Err(BankSetError::Count);
        }
        Ok(BankSet { banks })
    }

    /// Checks that each clip is in the bank that its id names: in another one, it is never found. Reads all ids. The banks
    /// are [verified](Bank::verify) on their own.
    ///
    /// # Errors
    /// When a bank has a clip of another one: the banks are in another order, or one is missing.
    pub fn verify(self) -> Result<BankSet<'data, 'bank>, BankSetError> {
        for (place, bank) in self.banks.iter().enumerate() {
            if bank.keys.iter().any(|record| self.shard(record.id.get()) != place) {
                return Err(BankSetError::OtherShard { bank: place });
            }
        }
        Ok(self)
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

    /// The bank that has the clip with this id, if any has it.
    #[inline]
    pub fn bank_of(&self, id: ClipId) -> Option<&'bank Bank<'data>> {
        self.banks.get(self.shard(id.get()))
    }

    /// The clip with this id: looked for in one bank.
    #[inline]
    pub fn clip(&self, id: ClipId) -> Option<Clip<'data, 'bank>> {
        self.bank_of(id)?.clip(id)
    }

    /// The clip with this key, compared whole.
    pub fn clip_by_key(&self, key: &str) -> Option<Clip<'data, 'bank>> {
        self.bank_of(ClipId::from_key(key))?.clip_by_key(key)
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

/// Why banks are no set.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
#[non_exhaustive]
pub enum BankSetError {
    /// There is no bank, or there are more than 4096.
    Count,
    /// A bank has a clip that belongs into another one.
    OtherShard {
        /// Its place among the banks.
        bank: usize,
    },
}

impl fmt::Display for BankSetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            BankSetError::Count => f.write_str("a set has 1 to 4096 banks"),
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
