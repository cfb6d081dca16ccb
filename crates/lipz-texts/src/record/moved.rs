//! Renamed Lipz files, whose records follow them.

use super::TextRecord;
use crate::exchange::model::joined;
use crate::exchange::{ClipTexts, Mark};
use std::collections::HashMap;

impl TextRecord {
    /// Matches the `lost` files, which were deleted, with the `new` files, which are not in the record, and moves the
    /// lines of lost files. Files match if their texts do: the source text and a translation, or a translation alone if
    /// only one lost file has it, or the source text alone if the lost file has comments and no translation. Returns
    /// the old and the new paths.
    pub fn follow(&mut self, lost: &[String], new: &[(String, ClipTexts)]) -> Vec<(String, String)> {
        let mut by_translation: HashMap<(String, Vec<Mark>), Vec<usize>> = HashMap::new();
        for (number, versions) in
            lost.iter().enumerate().filter_map(|(number, lost)| Some((number, self.files.get(lost)?)))
        {
            for (locale, made) in versions.iter().flat_map(|version| &version.made) {
                let marks: Option<Vec<Mark>> = made.iter().map(|made| made.map(|made| made.mark)).collect();
                let Some(marks) = marks else { continue };
                let numbers = by_translation.entry((locale.clone(), marks)).or_default();
                if numbers.last() != Some(&number) {
                    numbers.push(number);
                }
            }
        }
        let mut found: Vec<(String, String)> = Vec::new();
        let mut is_taken = vec![false; lost.len()];
        for (file, texts) in new {
            let marks = |texts: &[String]| texts.iter().map(|text| Mark::of(text)).collect::<Vec<_>>();
            let alike = texts.iter().filter_map(|(locale, texts)| by_translation.get(&(locale.clone(), marks(texts))));
            let mut alike: Vec<usize> = alike.flatten().copied().filter(|number| !is_taken[*number]).collect();
            alike.sort_unstable();
            alike.dedup();
            let has_source = |number: &&usize| lost.get(**number).is_some_and(|lost| self.has_source(lost, texts));
            let only = if let [only] = alike.as_slice() { Some(only) } else { None };
            let Some(number) = alike.iter().find(has_source).or(only).copied() else { continue };
            is_taken[number] = true;
            found.extend(lost.get(number).map(|lost| (lost.clone(), file.clone())));
        }
        self.follow_untranslated(lost, new, &mut found);
        for (old, new) in &found {
            if let Some(versions) = self.files.remove(old) {
                self.files.insert(new.clone(), versions);
            }
            if let Some(comments) = self.comments.remove(old) {
                self.comments.insert(new.clone(), comments);
            }
            if let Some(sources) = self.untranslated.remove(old) {
                self.untranslated.insert(new.clone(), sources);
            }
        }
        found
    }

    /// Whether a version of a file has the source texts of a clip.
    fn has_source(&self, file: &str, texts: &ClipTexts) -> bool {
        let versions = self.files.get(file).into_iter().flatten();
        let is_source =
            |locale: &str, sources: &[String]| texts.get(locale).is_some_and(|texts| joined(texts) == joined(sources));
        versions.into_iter().any(|version| is_source(&version.source_locale, &version.sources))
    }
}
