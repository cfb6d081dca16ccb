//! Repetitions and similar texts among the remaining work, as translation vendors count them.

use super::{Amount, LocaleWork, OpenSegment};
use crate::exchange::difference::common_words;
use crate::exchange::words;
use std::collections::{BTreeSet, HashMap, HashSet};
use unicode_segmentation::UnicodeSegmentation;

/// The least similarity that counts, in percent, as in the usual bands of vendors.
const LEAST_PERCENT: usize = 75;
/// The number of rare words by which similar texts are found, and the most texts that are compared for each. Similar
/// texts share most words, so their rarest ones are enough, and the time grows linearly with the texts.
const RARE_WORDS: usize = 4;
const MOST_COMPARED: usize = 32;
/// The most words of texts that are compared.
const LONGEST_WORDS: usize = 400;

/// The best match of an open segment's source text.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum SourceMatch {
    /// No translated text is similar.
    New,
    /// A translated text has this many percent of the words in the same order, from 75 to 99.
    Similar(u8),
    /// A translated segment has the same source text.
    Same,
    /// An earlier open segment has the same source text.
    Repeated,
}

impl SourceMatch {
    /// The names of the bands in which vendors count words, from the most work to the least.
    pub const BANDS: [&str; 6] = ["new", "75 to 84 %", "85 to 94 %", "95 to 99 %", "100 %", "repeated"];

    /// Returns the index of the band in [`SourceMatch::BANDS`].
    pub fn band(self) -> usize {
        match self {
            SourceMatch::New => 0,
            SourceMatch::Similar(..85) => 1,
            SourceMatch::Similar(..95) => 2,
            SourceMatch::Similar(_) => 3,
            SourceMatch::Same => 4,
            SourceMatch::Repeated => 5,
        }
    }

    /// Returns a description: `new`, `87 %`, `100 %` or `repeated`.
    pub fn name(self) -> String {
        match self {
            SourceMatch::Similar(percent) => format!("{percent} %"),
            other => SourceMatch::BANDS[other.band()].to_owned(),
        }
    }
}

impl LocaleWork {
    /// Returns the match of each open segment, in their order. Upper and lower case are different.
    ///
    /// The similarity of two texts is the number of words that they have in common, in the same order, relative to the
    /// longer text.
    pub fn matches(&self) -> Vec<SourceMatch> {
        let memory = SourceMemory::new(self.translated.iter().map(AsRef::as_ref));
        let mut seen = HashSet::new();
        let of_segment = |open: &OpenSegment| match () {
            () if memory.texts.contains(open.source.as_str()) => SourceMatch::Same,
            () if !seen.insert(open.source.clone()) => SourceMatch::Repeated,
            () => memory.similar(&open.source, open.made_from.as_deref()),
        };
        self.open.iter().map(of_segment).collect()
    }

    /// Returns the open amount in each of the [`SourceMatch::BANDS`].
    pub fn bands(&self) -> [Amount; SourceMatch::BANDS.len()] {
        let mut bands = [Amount::default(); SourceMatch::BANDS.len()];
        for (open, found) in self.open.iter().zip(self.matches()) {
            bands[found.band()].add(Amount { segments: 1, words: words(&open.source) });
        }
        bands
    }
}

/// The source texts of translated segments, with an index of their words.
struct SourceMemory<'t> {
    texts: BTreeSet<&'t str>,
    words: Vec<Vec<&'t str>>,
    /// The numbers of the texts that contain a word.
    with_word: HashMap<&'t str, Vec<usize>>,
}

impl<'t> SourceMemory<'t> {
    fn new(texts: impl Iterator<Item = &'t str>) -> SourceMemory<'t> {
        let texts: BTreeSet<&str> = texts.collect();
        let words: Vec<Vec<&str>> = texts.iter().map(|text| text.unicode_words().collect()).collect();
        let mut with_word: HashMap<&str, Vec<usize>> = HashMap::new();
        for (number, words) in words.iter().enumerate() {
            for word in words {
                let numbers = with_word.entry(word).or_default();
                if numbers.last() != Some(&number) {
                    numbers.push(number);
                }
            }
        }
        SourceMemory { texts, words, with_word }
    }

    /// Returns the match with the most similar text, which may be the old source text of the segment.
    fn similar(&self, source: &str, made_from: Option<&str>) -> SourceMatch {
        let own: Vec<&str> = source.unicode_words().collect();
        let mut postings: Vec<&[usize]> =
            own.iter().filter_map(|word| Some(self.with_word.get(word)?.as_slice())).collect();
        postings.sort_unstable_by_key(|numbers| numbers.len());
        let rarest = postings.into_iter().take(RARE_WORDS).flat_map(|numbers| numbers.iter().take(MOST_COMPARED));
        let candidates: BTreeSet<usize> = rarest.copied().collect();
        let of_memory =
            candidates.iter().filter_map(|number| self.words.get(*number)).map(|words| percent(&own, words));
        let of_old = made_from.map(|old| percent(&own, &old.unicode_words().collect::<Vec<_>>()));
        match of_memory.chain(of_old).max() {
            // Texts that differ only in their punctuation.
            Some(most @ LEAST_PERCENT..) => SourceMatch::Similar(u8::try_from(most.min(99)).unwrap_or(99)),
            _ => SourceMatch::New,
        }
    }
}

/// Returns the similarity of two texts in percent, or 0 for texts of very different or great lengths.
fn percent(one: &[&str], other: &[&str]) -> usize {
    let (short, long) = (one.len().min(other.len()), one.len().max(other.len()));
    if short * 100 < long * LEAST_PERCENT || long == 0 || long > LONGEST_WORDS {
        return 0;
    }
    common_words(one, other) * 100 / long
}
