//! Locales and names of a stack: looked up once, in all of its layers.

use super::{LayeredClip, Layers, Placed};
use crate::{EventName, Locale, TextBank};
use core::fmt;
use lipz_layout::LAYER_DEFAULT_LOCALE;

/// A locale of [`Layers`]: where each layer has its texts.
///
/// Look it up once, with [`Layers::locale`], and pass it to every text query.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct LayeredLocale<'data, const N: usize> {
    /// That of the topmost layer that has it.
    own: Locale<'data>,
    /// For each layer the locale whose texts show, and whether it stands in for this one.
    entries: [Option<(Locale<'data>, bool)>; N],
}

impl<'data, const N: usize> LayeredLocale<'data, N> {
    /// The tag, as in `text_en-us` of a Lipz file: `en-us`.
    pub fn tag(&self) -> &'data str {
        self.own.tag()
    }

    /// The locale in the layer with this index, or the one that stands in for it there.
    #[inline]
    pub(super) fn in_layer(&self, layer: usize) -> Option<(Locale<'data>, bool)> {
        self.entries.get(layer).copied().flatten()
    }

    /// The tag of the locale whose texts clips of the layer with this index show; `None` if they have none.
    pub fn tag_in(&self, layer: usize) -> Option<&'data str> {
        Some(self.in_layer(layer)?.0.tag())
    }
}

/// The tag, not the texts.
impl<const N: usize> fmt::Debug for LayeredLocale<'_, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "LayeredLocale({:?})", self.tag())
    }
}

/// A name in the events of [`Layers`]: its name in each layer that mentions it.
#[derive(Clone, Copy, Debug)]
pub struct LayeredName<'data, const N: usize> {
    entries: [Option<EventName<'data>>; N],
}

impl<'data, const N: usize> LayeredName<'data, N> {
    /// The name in the bank of the clip, to be compared with the names in its events, or set as the
    /// [speaker](crate::Cursor::with_speaker); `None` if that bank does not mention it.
    pub fn of(&self, clip: &LayeredClip<'_, '_>) -> Option<EventName<'data>> {
        self.entries.get(clip.layer()).copied().flatten()
    }
}

impl<'data, const N: usize> Layers<'data, N> {
    /// The locale with this tag, spelled as in the banks (`en-us`). Look it up once and pass it to text queries.
    ///
    /// In layers that do not have it, the locale shows that stands in for it, marked as a
    /// [fallback](crate::Text::is_fallback).
    pub fn locale(&self, tag: &str) -> Option<LayeredLocale<'data, N>> {
        self.locale_in(tag, &[])
    }

    /// Like [`Layers::locale`], also in text banks, each of which one of the banks has opened.
    pub fn locale_in(&self, tag: &str, texts: &[TextBank<'data>]) -> Option<LayeredLocale<'data, N>> {
        let below = |layer: &Placed<'data>, locale: Locale<'data>| {
            let place = layer.bank.locales().position(|other| other == locale)?;
            layer.bank.locales().nth(layer.table.stand_in(place)?)
        };
        let mut entries = [None; N];
        let mut own = None;
        let mut stand_in = None;
        let mut is_removed = false;
        // From the top: a layer says what stands in for its locales below it, and which of those below do not count.
        for (entry, layer) in entries.iter_mut().zip(self.all()).rev() {
            let of_texts = || {
                let texts = texts.iter().filter(|texts| texts.bank == layer.bank.origin());
                texts.filter_map(|texts| texts.locale(tag)).next()
            };
            let found = if is_removed { None } else { layer.bank.locale(tag).or_else(of_texts) };
            if let Some(found) = found {
                own = own.or(Some(found));
                *entry = Some((found, false));
                stand_in = below(layer, found);
            } else if let Some(other) = stand_in {
                let found = layer.bank.locale(other.tag());
                *entry = found.map(|other: Locale<'data>| (other, true));
                // What the layer brought itself has another one below it.
                stand_in = found.and_then(|found| below(layer, found)).or(stand_in);
            }
            is_removed |= layer.table.removes_locale(tag);
            // Nothing of that counts below: it is another locale with the same tag, which came later.
            stand_in = stand_in.filter(|other| !layer.table.removes_locale(other.tag()));
        }
        Some(LayeredLocale { own: own?, entries })
    }

    /// The tags of all locales of the stack, in no order, each once: those of the topmost layer come first.
    pub fn locale_tags(&self) -> impl Iterator<Item = &'data str> + '_ {
        let tags = self.all().iter().enumerate().rev();
        tags.flat_map(move |(at, layer)| {
            let above = self.all().get(at.saturating_add(1)..).unwrap_or(&[]);
            let is_new = move |tag: &&str| {
                above.iter().all(|above| above.bank.locale(tag).is_none() && !above.table.removes_locale(tag))
            };
            layer.bank.locales().map(|locale| locale.tag()).filter(is_new)
        })
    }

    /// The tag of the default locale: that of the topmost layer that says which one it is.
    pub fn default_locale(&self) -> Option<&'data str> {
        let says =
            self.all().iter().rev().find(|layer| layer.table.has(LAYER_DEFAULT_LOCALE)).or(self.all().first())?;
        says.bank.default_locale().map(|locale| locale.tag())
    }

    /// The name that events mention, spelled as there (`amy`); `None` if no event of any layer does.
    pub fn event_name(&self, name: &str) -> Option<LayeredName<'data, N>> {
        let mut entries = [None; N];
        for (entry, layer) in entries.iter_mut().zip(self.all()) {
            *entry = layer.bank.event_name(name);
        }
        if entries.iter().all(Option::is_none) { None } else { Some(LayeredName { entries }) }
    }
}
