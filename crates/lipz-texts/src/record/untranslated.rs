//! The source texts of clips that have comments of translators, but no translation. A renamed clip is found by them.

use super::TextRecord;
use super::sources::Sources;
use crate::exchange::ClipTexts;
use crate::exchange::model::joined;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

/// The files with one source text: those that were deleted, and those that are not in the record.
#[derive(Default)]
struct Alike<'f> {
    old: BTreeSet<&'f str>,
    new: BTreeSet<&'f str>,
}

impl TextRecord {
    /// Stores the current source texts of a clip, if translators have commented it, but not translated it.
    pub fn keep_source(&mut self, file: &str, source_locale: &str, sources: &[String]) {
        self.untranslated.remove(file);
        if self.comments.contains_key(file)
            && !self.files.contains_key(file)
            && sources.iter().any(|text| !text.is_empty())
        {
            let source = (source_locale.to_owned(), sources.to_vec());
            self.untranslated.insert(file.to_owned(), Sources::from([source]));
        }
    }

    /// Drops the source texts of clips that are translated by now, or whose comments were deleted.
    pub(super) fn drop_sources(&mut self) {
        let TextRecord { files, comments, untranslated } = self;
        untranslated.retain(|file, _| comments.contains_key(file) && !files.contains_key(file));
    }

    /// Matches `lost` files without translations with `new` files by their source texts, if one file of each has them.
    pub(super) fn follow_untranslated(
        &self,
        lost: &[String],
        new: &[(String, ClipTexts)],
        found: &mut Vec<(String, String)>,
    ) {
        let taken: HashSet<String> = found.iter().map(|(_, new)| new.clone()).collect();
        let mut by_source: HashMap<(&str, String), Alike<'_>> = HashMap::new();
        for file in lost {
            for (locale, sources) in self.untranslated.get(file).into_iter().flatten() {
                by_source.entry((locale, joined(sources))).or_default().old.insert(file);
            }
        }
        if by_source.is_empty() {
            return;
        }
        for (file, texts) in new.iter().filter(|(file, _)| !taken.contains(file)) {
            for (locale, texts) in texts {
                if let Some(alike) = by_source.get_mut(&(locale.as_str(), joined(texts))) {
                    alike.new.insert(file);
                }
            }
        }
        let mut renamed: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
        for Alike { old, new } in by_source.into_values().filter(|alike| alike.old.len() == 1 && alike.new.len() == 1) {
            old.into_iter().zip(new).for_each(|(old, new)| _ = renamed.entry(old).or_default().insert(new));
        }
        let only = renamed.into_iter().filter(|(_, now)| now.len() == 1);
        found.extend(only.flat_map(|(old, now)| now.into_iter().map(move |now| (old.to_owned(), now.to_owned()))));
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::exchange::State;

    fn texts(texts: &[&str]) -> Vec<String> {
        texts.iter().map(|text| (*text).to_owned()).collect()
    }

    fn clip(source: &[&str]) -> ClipTexts {
        ClipTexts::from([("en-us".to_owned(), texts(source))])
    }

    fn commented(sources: &[(&str, &[&str])]) -> TextRecord {
        let mut record = TextRecord::default();
        for (file, source) in sources {
            record.take_comments(file, "de-de", &texts(&["Formal?"]), None);
            record.keep_source(file, "en-us", &texts(source));
        }
        record
    }

    #[test]
    fn source_texts_are_written_and_read_back() {
        let mut record = commented(&[("a.lipz", &["Good evening.", "You?"])]);
        let text = record.to_string();
        let line = "a.lipz\ten-us\tde-de:-,-\tGood evening. | You?\na.lipz\tde-de\tcomment\tFormal?\n";
        assert!(text.ends_with(line), "{text}");
        assert_eq!(TextRecord::parse(&text).unwrap(), (record.clone(), vec![]));
        // The source text of a translation takes its place.
        record.approve("a.lipz", "en-us", "de-de", &["Good evening."], &["Guten Abend."], &[Some(State::Translated)]);
        assert!(!record.to_string().contains(":-"), "{record}");
        let mut deleted = TextRecord::parse(&text).unwrap().0;
        deleted.take_comments("a.lipz", "de-de", &[], Some(crate::exchange::Mark::of_comments(&texts(&["Formal?"]))));
        assert!(deleted.is_empty(), "{deleted}");
    }

    #[test]
    fn renamed_clips_keep_comments_if_one_clip_has_their_source() {
        let lost = texts(&["a", "b", "c"]);
        let record = || commented(&[("a", &["Good evening."]), ("b", &["Yes."]), ("c", &["Yes."])]);
        let new = |source: &[&[&str]]| -> Vec<(String, ClipTexts)> {
            (1..).zip(source).map(|(number, source)| (format!("new/{number}"), clip(source))).collect()
        };
        let mut renamed = record();
        let moved = renamed.follow(&lost, &new(&[&["Good evening."], &["Yes."]]));
        assert_eq!(moved, [("a".to_owned(), "new/1".to_owned())]);
        assert_eq!(renamed.comments("new/1", "de-de"), ["Formal?"]);
        assert!(renamed.to_string().contains("new/1\ten-us\tde-de:-\tGood evening.\n"), "{renamed}");
        assert_eq!(record().follow(&lost, &new(&[&["Good evening."], &["Good evening."]])), []);
        assert_eq!(record().follow(&lost, &new(&[&["Good morning."]])), []);
    }
}
