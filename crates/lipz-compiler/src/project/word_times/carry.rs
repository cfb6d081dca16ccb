//! Finding the words of a text again after the text has changed.
//!
//! Words that occur once in both texts are found first. The longest run of them in the same order is kept, and extended
//! in both directions by equal neighbours.

use super::StoredWord;
use super::spoken_text::SpokenText;
use std::collections::{HashMap, HashSet};
use std::ops::Range;

/// The longest word that is found again, in bytes. It bounds the time for a record that was written by hand.
const LONGEST: usize = 256;

/// The identity of a word: its hash and its length in bytes.
type WordId = (u16, usize);

/// Returns the hash of a word, without regard to capital letters and the kind of its apostrophes.
pub(super) fn hash(word: &str) -> u16 {
    lipz_layout::checksum(word.replace('’', "'").to_lowercase().as_bytes()) as u16
}

/// Returns the start of each word in the spoken text of a different text, or `None` for words that it lacks.
pub(super) fn starts_in(words: &[StoredWord], text: &SpokenText) -> Vec<Option<usize>> {
    let target = Target { spoken: &text.spoken, boundaries: text.boundaries() };
    let ids: Vec<Option<WordId>> = words.iter().map(StoredWord::id).collect();
    let mut starts = vec![None; words.len()];
    for (index, start) in longest_run(&unique_in_both(&ids, &target)) {
        starts[index] = Some(start);
    }
    extend_forward(&ids, &target, &mut starts);
    extend_backward(&ids, &target, &mut starts);
    starts
}

impl StoredWord {
    fn id(&self) -> Option<WordId> {
        let length = self.time.range.len();
        self.hash.filter(|_| (1..=LONGEST).contains(&length)).map(|hash| (hash, length))
    }
}

/// The text in which words are searched.
struct Target<'t> {
    spoken: &'t str,
    boundaries: Vec<usize>,
}

impl Target<'_> {
    fn has(&self, (expected, length): WordId, start: usize) -> bool {
        let end = start + length;
        let is_word = self.boundaries.binary_search(&end).is_ok();
        is_word && self.spoken.get(start..end).is_some_and(|word| hash(word) == expected)
    }

    fn is_letter_at(&self, start: usize) -> bool {
        self.spoken.get(start..).and_then(|rest| rest.chars().next()).is_some_and(char::is_alphanumeric)
    }
}

/// Returns index and start of all words that occur once in both texts, by index.
fn unique_in_both(ids: &[Option<WordId>], target: &Target<'_>) -> Vec<(usize, usize)> {
    let mut counts: HashMap<WordId, usize> = HashMap::new();
    ids.iter().flatten().for_each(|id| *counts.entry(*id).or_default() += 1);
    let lengths: HashSet<usize> = counts.keys().map(|(_, length)| *length).collect();
    let mut found: HashMap<WordId, (usize, usize)> = HashMap::new();
    for start in &target.boundaries {
        for length in &lengths {
            let end = start + length;
            let Some(word) = target.spoken.get(*start..end) else { continue };
            if target.boundaries.binary_search(&end).is_err() {
                continue;
            }
            let id = (hash(word), *length);
            if counts.get(&id) == Some(&1) {
                found.entry(id).or_insert((*start, 0)).1 += 1;
            }
        }
    }
    let start = |id: &WordId| found.get(id).filter(|(_, count)| *count == 1).map(|(start, _)| *start);
    ids.iter().enumerate().filter_map(|(index, id)| Some((index, start(id.as_ref()?)?))).collect()
}

/// Returns the longest part of these pairs whose second numbers ascend. The first ones do.
fn longest_run(pairs: &[(usize, usize)]) -> Vec<(usize, usize)> {
    // For each length, the pair with the lowest end of a run of that length; for each pair, the one before it.
    let mut ends: Vec<usize> = Vec::new();
    let mut before: Vec<Option<usize>> = Vec::with_capacity(pairs.len());
    for (index, (_, start)) in pairs.iter().enumerate() {
        let length = ends.partition_point(|end| pairs[*end].1 < *start);
        before.push(length.checked_sub(1).map(|shorter| ends[shorter]));
        match ends.get_mut(length) {
            Some(end) => *end = index,
            None => ends.push(index),
        }
    }
    let mut run: Vec<(usize, usize)> =
        std::iter::successors(ends.last().copied(), |index| before[*index]).map(|index| pairs[index]).collect();
    run.reverse();
    run
}

/// Adds words that directly follow a found one, or the start of the text.
fn extend_forward(ids: &[Option<WordId>], target: &Target<'_>, starts: &mut [Option<usize>]) {
    let limits = next_starts(starts, target.spoken.len());
    let (mut end, mut is_adjacent) = (0, true);
    for (index, id) in ids.iter().enumerate() {
        let Some(id) = id else { continue };
        if starts[index].is_none() && is_adjacent {
            let fits = |start: &usize| start + id.1 <= limits[index] && target.has(*id, *start);
            starts[index] = target.following(end).find(fits);
        }
        is_adjacent = starts[index].is_some();
        end = starts[index].map_or(end, |start| start + id.1);
    }
}

/// Adds words that directly precede a found one, or the end of the text.
fn extend_backward(ids: &[Option<WordId>], target: &Target<'_>, starts: &mut [Option<usize>]) {
    let mut limits = vec![0; ids.len()];
    let mut last_end = 0;
    for (index, id) in ids.iter().enumerate() {
        limits[index] = last_end;
        last_end = starts[index].zip(*id).map_or(last_end, |(start, (_, length))| start + length);
    }
    let (mut next, mut is_adjacent) = (target.spoken.len(), true);
    for (index, id) in ids.iter().enumerate().rev() {
        let Some(id) = id else { continue };
        if starts[index].is_none() && is_adjacent {
            let start = |end: usize| end.checked_sub(id.1).filter(|start| *start >= limits[index]);
            let fits = |start: &usize| target.boundaries.binary_search(start).is_ok() && target.has(*id, *start);
            starts[index] = target.preceding(next).filter_map(start).find(fits);
        }
        is_adjacent = starts[index].is_some();
        next = starts[index].unwrap_or(next);
    }
}

/// Returns, for each word, the start of the next found one.
fn next_starts(starts: &[Option<usize>], end: usize) -> Vec<usize> {
    let mut limits = vec![end; starts.len()];
    let mut next = end;
    for (limit, start) in std::iter::zip(&mut limits, starts).rev() {
        *limit = next;
        next = start.unwrap_or(next);
    }
    limits
}

impl Target<'_> {
    /// Returns the possible starts of the first word from `at` on: those before its first letter, and that.
    fn following(&self, at: usize) -> impl Iterator<Item = usize> + '_ {
        let rest: Range<usize> = self.boundaries.partition_point(|boundary| *boundary < at)..self.boundaries.len();
        let mut is_over = false;
        self.boundaries[rest].iter().copied().take_while(move |start| {
            let was_over = is_over;
            is_over = is_over || self.is_letter_at(*start);
            !was_over
        })
    }

    /// Returns the possible ends of the last word before `at`: those behind its last letter, and that.
    fn preceding(&self, at: usize) -> impl Iterator<Item = usize> + '_ {
        let rest = ..self.boundaries.partition_point(|boundary| *boundary <= at);
        let mut is_over = false;
        self.boundaries[rest].iter().rev().copied().take_while(move |end| {
            let was_over = is_over;
            let last = self.spoken.get(..*end).and_then(|before| before.chars().next_back());
            is_over = is_over || last.is_some_and(char::is_alphanumeric);
            !was_over
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_run_ascends() {
        let pairs = |starts: &[usize]| starts.iter().copied().enumerate().collect::<Vec<_>>();
        assert_eq!(longest_run(&[]), []);
        assert_eq!(longest_run(&pairs(&[5, 1, 2, 9, 3])), [(1, 1), (2, 2), (4, 3)]);
        assert_eq!(longest_run(&pairs(&[3, 2, 1])).len(), 1);
    }
}
