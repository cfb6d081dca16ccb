//! Entries with plural forms: a text and its variants for plural categories.

use crate::exchange::model::{Division, Exchange, Item, Unit};
use crate::plural::{PluralForms, join_category};
use lipz_file::locale::split_category;
use std::collections::{BTreeMap, BTreeSet};

/// The items of a file in one locale, some of which are plural forms of others.
pub(super) struct Grouped<'e> {
    pub(super) items: Vec<Item<'e>>,
    /// By the index of an item: its plural forms.
    forms: BTreeMap<usize, ItemForms>,
    /// The items that are forms of others.
    inner: BTreeSet<usize>,
}

/// The plural forms of an item.
pub(super) struct ItemForms {
    /// The source text for one thing: that of the variant `one`, or that of the item.
    pub(super) singular: String,
    /// The category and the index of the item of each form; `None` for a form without a category.
    pub(super) items: Vec<(&'static str, Option<usize>)>,
}

impl<'e> Grouped<'e> {
    /// Groups the items of a file with the locale at `at`. Without `forms`, each variant stays on its own.
    pub(super) fn new(
        exchange: &'e Exchange,
        at: usize,
        division: Division,
        forms: Option<&PluralForms>,
    ) -> Grouped<'e> {
        let items: Vec<Item<'e>> = exchange.items(Some(at), division).collect();
        let mut grouped = Grouped { items, forms: BTreeMap::new(), inner: BTreeSet::new() };
        let Some(forms) = forms.filter(|_| grouped.items.iter().any(|item| item.unit.variant.is_some())) else {
            return grouped;
        };
        fn variant<'i>(item: &'i Item<'_>) -> &'i str {
            item.unit.variant.as_deref().unwrap_or("")
        }
        let place = |item: &Item<'e>, variant: &str| (item.unit.key.as_str(), variant.to_owned(), item.number);
        let places: BTreeMap<_, usize> =
            grouped.items.iter().zip(0..).map(|(item, index)| (place(item, variant(item)), index)).collect();
        // A language without plural categories has no items for them, but its entry still has the form of a plural.
        let mut plurals: BTreeMap<(&str, &str), Vec<&Unit>> = BTreeMap::new();
        for unit in &exchange.units {
            if let (Some(_), rest) = split_category(unit.variant.as_deref().unwrap_or("")) {
                plurals.entry((unit.key.as_str(), rest)).or_default().push(unit);
            }
        }
        for (index, item) in grouped.items.iter().enumerate() {
            let rest = variant(item);
            let variants = plurals.get(&(item.unit.key.as_str(), rest)).map_or(&[][..], Vec::as_slice);
            let varies = variants.iter().any(|unit| !item.source_of_variant(unit).is_empty());
            if split_category(rest).0.is_some() || !varies {
                continue;
            }
            let of_form = |key: &Option<&'static str>| match key {
                None => ("", None),
                Some("") => ("", Some(index)),
                Some(key) => (*key, places.get(&place(item, &join_category(key, rest))).copied()),
            };
            let of_forms: Vec<(&str, Option<usize>)> = forms.keys.iter().map(of_form).collect();
            let others = of_forms.iter().filter_map(|(_, form)| *form).filter(|form| *form != index);
            grouped.inner.extend(others);
            if exchange.locales.get(at).is_some_and(String::is_empty) {
                // A template always has two forms, whatever the categories of the source are.
                let place_of = |unit: &&Unit| {
                    let variant = unit.variant.clone().unwrap_or_default();
                    places.get(&(unit.key.as_str(), variant, item.number)).copied()
                };
                grouped.inner.extend(variants.iter().filter_map(place_of));
            }
            let one = join_category("one", rest);
            let one = variants.iter().find(|unit| unit.variant.as_ref() == Some(&one));
            let singular = one.map(|unit| item.source_of_variant(unit)).filter(|source| !source.is_empty());
            let singular = singular.unwrap_or_else(|| item.source());
            grouped.forms.insert(index, ItemForms { singular, items: of_forms });
        }
        grouped
    }

    /// Returns the items that have an entry of their own, each with the items of its plural forms, if it has any.
    pub(super) fn entries(&self) -> impl Iterator<Item = (&Item<'e>, Option<&ItemForms>)> {
        let outer = self.items.iter().enumerate().filter(|(index, _)| !self.inner.contains(index));
        outer.map(|(index, item)| (item, self.forms.get(&index)))
    }

    /// Whether an entry has plural forms.
    pub(super) fn has_plurals(&self) -> bool {
        !self.forms.is_empty()
    }
}
