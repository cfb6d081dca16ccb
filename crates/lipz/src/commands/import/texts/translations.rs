//! The translations to import, clip by clip.

use crate::shared::text_record::RecordFile;
use lipz_compiler::Input;
use lipz_diagnostics::{Diagnostic, Report};
use lipz_texts::{Entry, Merge, MergedFile, TextTranslations};
use std::collections::BTreeMap;

/// The translations of all files, and what they are merged with.
pub(super) struct Translations<'e> {
    by_key: BTreeMap<&'e str, Vec<&'e Entry>>,
    /// With `--by-text`, the translations of texts whose clips the files do not name.
    by_text: Option<TextTranslations<'e>>,
    pub(super) source_locale: &'e str,
    pub(super) default_locale: Option<&'e str>,
    record: &'e RecordFile,
}

impl<'e> Translations<'e> {
    pub(super) fn new(
        entries: &'e [Entry],
        by_text: Option<TextTranslations<'e>>,
        (source_locale, default_locale): (&'e str, Option<&'e str>),
        record: &'e RecordFile,
    ) -> Translations<'e> {
        let mut by_key: BTreeMap<&str, Vec<&Entry>> = BTreeMap::new();
        for entry in entries {
            by_key.entry(&entry.key.text).or_default().push(entry);
        }
        Translations { by_key, by_text, source_locale, default_locale, record }
    }

    /// Returns the translations of clips that the files name.
    pub(super) fn entries(&self) -> impl Iterator<Item = &'e Entry> + '_ {
        self.by_key.values().flatten().copied()
    }

    /// Whether some of them may be for this clip.
    pub(super) fn concern(&self, input: &Input) -> bool {
        self.by_text.is_some() || self.by_key.contains_key(&*input.key)
    }

    /// Merges them into a clip. Also returns the entries that were found by its texts.
    pub(super) fn merge(
        &self,
        merge: &Merge<'_>,
        input: &Input,
        bytes: &[u8],
    ) -> Result<(MergedFile, Vec<Entry>), Report> {
        let parsed = lipz_file::parse(bytes);
        let mut diagnostics = parsed.diagnostics;
        diagnostics.retain(Diagnostic::is_error);
        let Some(document) = parsed.document.filter(|_| diagnostics.is_empty()) else {
            return Err(Report::from_bytes(input.name(), bytes, diagnostics));
        };
        let own = self.by_key.get(&*input.key).map_or(&[][..], Vec::as_slice);
        let locales = (self.source_locale, self.default_locale);
        let of_texts = self.by_text.as_ref().map(|by_text| by_text.of_clip(&input.key, &document, locales, own));
        let of_texts = of_texts.unwrap_or_default();
        let entries: Vec<&Entry> = own.iter().copied().chain(&of_texts).collect();
        let imported = self.record.record.imported(&self.record.name(input), self.source_locale);
        let merge = merge.clone().imported(imported);
        let merged = merge.merge(&String::from_utf8_lossy(bytes), &document, &entries);
        Ok((merged, of_texts))
    }

    /// Reports the translations of texts that are not among `used`.
    pub(super) fn unused(&self, used: &[Entry]) -> Vec<(usize, Diagnostic)> {
        self.by_text.as_ref().map(|by_text| by_text.unused(used)).unwrap_or_default()
    }
}
