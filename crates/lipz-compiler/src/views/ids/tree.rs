//! The clips of a bank as a tree of identifiers, from which each language is generated.

use crate::bank::dialogue::TaggedLocale;
use lipz_bank::{Clip, Text};
use lipz_diagnostics::{Code, Diagnostic, escape};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// The number of characters of a text that a comment shows.
const TEXT_SHOWN: usize = 80;

/// Returns the identifiers of a key: those of its folders, then that of the clip.
pub(super) type Naming = fn(key: &str) -> Vec<String>;

/// The clips and folders of a folder, by identifier. Folders with the same identifier are merged.
#[derive(Default)]
pub(super) struct IdFolder<'data> {
    pub(super) folders: BTreeMap<String, IdFolder<'data>>,
    pub(super) clips: BTreeMap<String, Leaf<'data>>,
}

/// A clip in generated code.
pub(super) struct Leaf<'data> {
    pub(super) key: &'data str,
    pub(super) id: u64,
    /// The beginning of its text, on one line; empty if it has none.
    pub(super) text: String,
}

impl Leaf<'_> {
    /// Returns `act1/mara-hello: Hello, Otto.`
    pub(super) fn about(&self) -> String {
        let separator = if self.text.is_empty() { "" } else { ": " };
        format!("{}{separator}{}", escape::text(self.key), self.text)
    }
}

impl<'data> IdFolder<'data> {
    /// Creates the tree of clips, which are sorted by key. Returns a diagnostic for each clip with the identifier of
    /// another.
    pub(super) fn new(
        clips: &[Clip<'data>],
        locales: &[TaggedLocale<'_>],
        naming: Naming,
        language: &str,
    ) -> Result<IdFolder<'data>, Vec<Diagnostic>> {
        let mut root = IdFolder::default();
        let mut clashes = Vec::new();
        let locales = locales_for_comments(locales);
        for clip in clips {
            let mut folders = naming(clip.key());
            let Some(name) = folders.pop() else { continue };
            let folder = folders.into_iter().fold(&mut root, |folder, name| folder.folders.entry(name).or_default());
            match folder.clips.entry(name) {
                Entry::Occupied(before) => clashes.push(clash(before.get().key, clip.key(), before.key(), language)),
                Entry::Vacant(free) => {
                    free.insert(Leaf { key: clip.key(), id: clip.id().get(), text: text(clip, &locales) });
                }
            }
        }
        if clashes.is_empty() { Ok(root) } else { Err(clashes) }
    }

    /// Returns the name of a clip in languages where clips and folders share a namespace: folders take precedence.
    pub(super) fn name_beside_folders(&self, clip: &str) -> String {
        if self.folders.contains_key(clip) { format!("{clip}_") } else { clip.to_owned() }
    }
}

fn clash(first: &str, second: &str, name: &str, language: &str) -> Diagnostic {
    let (first, second) = (escape::text(first), escape::text(second));
    Diagnostic::new(
        Code::IdentifierClash,
        format!("the keys `{first}` and `{second}` have the same identifier `{name}` in {language}"),
    )
    .help("rename one of the two files; characters other than letters and digits only separate words")
}

/// Returns the locales whose texts comments show, in order of preference: the default locale, then the others, sorted
/// by tag.
fn locales_for_comments<'d>(locales: &[TaggedLocale<'d>]) -> Vec<TaggedLocale<'d>> {
    let mut locales = locales.to_vec();
    locales.sort_by_key(|locale| !locale.is_default);
    locales
}

/// Returns the beginning of a clip's text on one line.
fn text(clip: &Clip<'_>, locales: &[TaggedLocale<'_>]) -> String {
    let in_locale = |locale: &TaggedLocale<'_>| {
        let texts = clip.segments().filter_map(|segment| segment.text(locale.locale));
        let own = texts.filter(|text| !text.is_fallback() && !text.is_empty());
        let texts: Vec<&str> = own.map(Text::as_str).collect();
        (!texts.is_empty()).then(|| texts.join(" "))
    };
    let whole = locales.iter().find_map(in_locale).unwrap_or_default();
    match whole.char_indices().nth(TEXT_SHOWN) {
        Some((end, _)) => format!("{}…", escape::text(whole[..end].trim_end())),
        None => escape::text(&whole).into_owned(),
    }
}
